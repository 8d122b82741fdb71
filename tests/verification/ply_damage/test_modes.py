"""One quad led into each mode of damage: strength, energy per area of crack, balance of energy."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from damage import BAND, HTS40, MODES, POINT, ROOT_POINT, ROOT_QUAD, DamagedPly
from decks import BOTTOM, Deck, Ply
from meshes import regular
from runs import Results, run

THICKNESS = 0.125
DAMPING = 5.0e5


def duration(mode: str) -> float:
    """Time to lead a quad through a mode: large quads, for fibres, have sides of more inertia."""
    return 1.0e-3 if mode.startswith("fibre") else 5.0e-4


def strip(
    mode: str, ply: DamagedPly, size: tuple[float, float], strain: float, linear: bool = True
) -> Deck:
    """One quad of four nodes that is strained along x, or sheared, in step with time."""
    angle, *_, sense = MODES[mode]
    mesh, end = regular(*size, 1, 1, 4), duration(mode)
    deck = Deck(mode, end)
    deck.control(linear=linear, damping=DAMPING)
    deck.mesh(mesh)
    deck.laminate([Ply(ply, THICKNESS, angle)], order=1)
    curve = deck.curve([(0.0, 0.0), (end, 1.0)])
    deck.hold_face(range(4), BOTTOM, "z")
    if mode == "shear":
        deck.hold(mesh.where(y=0.0), "xy")
        deck.hold(mesh.where(y=size[1]), "y")
        deck.move(mesh.where(y=size[1]), 1, curve, strain * size[1])
    else:
        deck.hold(mesh.where(x=0.0), "x")
        deck.hold(mesh.where(y=0.0), "y")
        deck.move(mesh.where(x=size[0]), 1, curve, sense * strain * size[0])
    deck.profile(1, 0.5 * size[0], 0.5 * size[1], end / 400.0, 2)
    deck.intervals(glstat=end / 400.0)
    return deck


def width(rule: int, mode: str, size: tuple[float, float]) -> float:
    """Crack band of a rectangle of four nodes: the crack is normal to x, for shear to y."""
    along = size[1] if mode == "shear" else size[0]
    area = size[0] * size[1]
    return {
        BAND: along,
        POINT: 0.5 * along,
        ROOT_POINT: 0.5 * np.sqrt(area),
        ROOT_QUAD: np.sqrt(area),
    }[rule]


def led(mode: str, ply: DamagedPly, size: tuple[float, float], band: float, to: Path) -> Results:
    """Lead a quad to 1.05 times the strain at which nothing is left."""
    _, modulus, strength, toughness, _ = MODES[mode]
    longest = 2.0 * modulus * toughness / strength**2 / 1.05
    finish = 2.0 * toughness / (band * strength * min(1.0, np.sqrt(longest / band)))
    return run(strip(mode, ply, size, 1.05 * finish), to)


def check_energy(
    compare: Comparison, results: Results, mode: str, expected: float, close: float
) -> None:
    """Everything is spent on one mechanism; the balance closes; nothing comes back."""
    energy = results.table("energy")
    own = "fibre damage" if mode.startswith("fibre") else "matrix damage"
    compare.number(f"energy, {mode}", energy[own][-1], expected, unit="mJ", rel=close)
    assert energy["dissipated"] == pytest.approx(energy[own], abs=1.0e-12 * expected)
    assert np.all(np.diff(energy[own]) >= 0.0)
    # what is left is the least stiffness, 1e-6, and the corner between two steps
    assert energy["internal"][-1] == pytest.approx(energy[own][-1], rel=2.0e-4)
    assert np.abs(energy["error"]).max() < 1.0e-9


@pytest.mark.parametrize(
    ("scale", "rule"),
    [(0.5, BAND), *product((1.0, 0.25), (BAND, POINT, ROOT_POINT, ROOT_QUAD))],
)
@pytest.mark.parametrize("mode", list(MODES))
def test_mode(mode: str, scale: float, rule: int, compare: Comparison, tmp_path: Path) -> None:
    """Onset at the strength; energy per volume is the toughness over the width of the band.

    With the first rule that is the toughness times the area of the crack. The sizes leave every
    band narrow enough for every mode.
    """
    _, modulus, strength, toughness, sense = MODES[mode]
    scale *= 10.0 if mode.startswith("fibre") else 1.0
    size = (scale * 0.3, scale * 0.2)
    band = width(rule, mode, size)
    ply = replace(HTS40, switches=(rule,))
    results = led(mode, ply, size, band, tmp_path)
    profile = results.table("profile_1")
    stress = (
        sense * profile["s12" if mode == "shear" else "s11" if MODES[mode][0] == 0.0 else "s22"]
    )
    strain = np.abs(profile["gxy" if mode == "shear" else "exx"])
    rise = 1.05 * 2.0 * toughness / (band * strength) / 400.0
    # the largest stress of the lines written, within what one of them may miss on either side
    assert strength - modulus * rise <= np.abs(stress).max() <= strength * (1.0 + 1.0e-4)
    softens = strain > strength / modulus
    finish = 2.0 * toughness / (band * strength)
    line = strength * np.clip((finish - strain) / (finish - strength / modulus), 0.0, None)
    close = 2.0e-3 * strength
    found = np.abs(stress)
    compare.values(f"softening, {mode}", found[softens], line[softens], unit="MPa", abs=close)
    if scale in (1.0, 10.0) and rule == BAND:
        law = np.array([0.0, strength / modulus, finish, 1.05 * finish])
        compare.curves(
            mode,
            ("strain [-]", "stress [MPa]"),
            {"run": (strain, found)},
            {"law": (law, np.array([0.0, strength, 0.0, 0.0]))},
        )
    volume = size[0] * size[1] * THICKNESS
    # what the least stiffness, a millionth, stores at the end, and the inertia of the sides
    close = 1.3e-6 * finish * modulus / strength + 1.0e-5
    check_energy(compare, results, mode, volume * toughness / band, close)
    if rule == BAND:
        across = size[0] if mode == "shear" else size[1]
        check_energy(compare, results, mode, toughness * across * THICKNESS, close)


@pytest.mark.parametrize("mode", [mode for mode in MODES if mode != "shear"])
def test_large_displacement(mode: str, compare: Comparison, tmp_path: Path) -> None:
    """The same with Green-Lagrange strain and second Piola-Kirchhoff stress.

    Their work is per volume before the motion, so that energy per area stays the toughness.
    """
    _, _, strength, toughness, sense = MODES[mode]
    scale = 20.0 if mode.startswith("fibre") else 1.0
    size = (scale * 0.15, scale * 0.1)
    deck = strip(mode, HTS40, size, 1.25 * 2.0 * toughness / (size[0] * strength), linear=False)
    results = run(deck, tmp_path)
    check_energy(compare, results, mode, toughness * size[1] * THICKNESS, 1.0e-4)
    profile = results.table("profile_1")
    stress = sense * profile["s11" if MODES[mode][0] == 0.0 else "s22"]
    compare.number(f"strength, {mode}", stress.max(), strength, unit="MPa", rel=1.0e-2)


@pytest.mark.parametrize("mode", list(MODES))
def test_wide_band(mode: str, compare: Comparison, tmp_path: Path) -> None:
    """Where the band is too wide, damage starts early and the toughness is right.

    The strength is sqrt(2 E G / (1.05 band)) (Bazant and Oh, 1983).
    """
    _, modulus, strength, toughness, _ = MODES[mode]
    longest = 2.0 * modulus * toughness / strength**2
    size = (2.0 * longest, 2.0 * longest)
    results = led(mode, HTS40, size, 2.0 * longest, tmp_path)
    # the stress falls so fast that the inertia of the sides counts: a quarter of it at a quarter of
    # the speed
    check_energy(compare, results, mode, toughness * size[0] * THICKNESS, 5.0e-3)
    profile = results.table("profile_1")
    stress = profile["s12" if mode == "shear" else "s11" if MODES[mode][0] == 0.0 else "s22"]
    reduced = np.sqrt(2.0 * modulus * toughness / (1.05 * size[0]))
    largest = np.abs(stress).max()
    compare.number(f"reduced strength, {mode}", largest, reduced, unit="MPa", rel=5.0e-3)
    assert reduced == pytest.approx(strength / np.sqrt(2.1))
