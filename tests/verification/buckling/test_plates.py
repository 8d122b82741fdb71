"""Buckling loads of compressed cross-plies, found from how their frequency falls with the load.

A plate that is compressed by e swings with omega^2 = min (K - e G) / M (`loaded_plate.py`), which
is nothing at the buckling strain. Where buckling and vibration have one mode, omega^2 falls along
a line; with clamped ends it is concave, and a line through two points near its zero meets the axis
beyond it by less than 0.3 % (asserted). So two runs of some milliseconds find the load, which slow
loading would see only through an imperfection.

The solver's strain is that of Green: a shortening d of the length L is d/L - (d/L)^2/2. What else
is of the order of the strain (0.5 %) is left in the tolerance: the plate becomes thicker and
wider.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck, Ply, ramp
from elasticity import Material
from exact_plate import CrossPly, frequency
from loaded_plate import LoadedPlate, membrane
from meshes import regular
from runs import run
from swings import fitted, zero_of_line

# T700/M21 of the library, elastic; 4.16 mm as the coupon of 16 plies
T700 = Material(1.58e-9, (121.0e3, 9.2e3, 9.2e3), (0.3, 0.3, 0.4), (5.1e3, 5.1e3, 3.3e3))
STACK = tuple(Ply(T700, 1.04, angle) for angle in (0.0, 90.0, 90.0, 0.0))
#: Shares of the buckling strain at which plates swing
SHARES = (0.8, 0.9)
#: Amplitude over the thickness: stiffening by stretch is of the square of it
AMPLITUDE = 2.0e-3


def swinging(plate: LoadedPlate, strain: float, quads: tuple[int, int], folder: Path) -> float:
    """Angular frequency of half of a plate, y up to its plane of symmetry, at a strain."""
    omega, (x, shape) = plate.mode(strain)
    thickness = sum(ply.thickness for ply in plate.plies)
    rise = 2.0e-4
    time = rise + 2.5 * np.pi / omega
    middle = 0.5 * plate.width
    mesh = regular(plate.length, middle, *quads, 9)
    deck = Deck("plate that swings under load", time)
    deck.intervals(glstat=time)
    deck.mesh(mesh)
    deck.laminate(plate.plies, order=1)
    curve = deck.curve(ramp(rise, 200))
    shortening = 1.0 - np.sqrt(1.0 - 2.0 * strain)
    side = mesh.where(y=0.0)
    deck.hold(side, "z")
    deck.hold(mesh.where(y=middle), "y")
    ends = [node for x in (0.0, plate.length) for node in mesh.where(x=x)]
    for along in sorted({*mesh.points[side, 0]}):
        nodes = ends if along in (0.0, plate.length) else side
        chosen = [node for node in nodes if mesh.points[node, 0] == along]
        deck.move(chosen, 1, curve, -shortening * along)
    if plate.clamped:
        deck.hold(ends, "z")
    wave = np.interp(mesh.points[:, 0], x, shape) * np.sin(np.pi * mesh.points[:, 1] / plate.width)
    speed = AMPLITUDE * thickness * omega * wave
    deck.velocities(np.stack([0.0 * speed, 0.0 * speed, speed], axis=1))
    node = int(np.argmax(np.abs(wave)))
    deck.histories([node], time / 2000.0)
    table = run(deck, folder).table("nodes")
    after = table["time"] > rise
    deflection = 0.5 * (table[f"n{node + 1} bottom uz"] + table[f"n{node + 1} top uz"])
    return fitted(table["time"][after], deflection[after], omega)


@pytest.mark.parametrize(
    ("length", "width", "clamped", "quads"),
    [(150.0, 100.0, False, (8, 4)), (150.0, 100.0, True, (20, 6))],
    ids=["150 x 100, simply supported", "150 x 100, ends clamped"],
)
def test_buckling_load(
    length: float,
    width: float,
    clamped: bool,
    quads: tuple[int, int],
    compare: Comparison,
    tmp_path: Path,
) -> None:
    """The load at which two frequencies under load point, within 2 %."""
    plate = LoadedPlate(length, width, STACK, clamped)
    exact = plate.buckling_strain()
    strains = exact * np.array(SHARES)
    line = np.array([plate.mode(strain)[0] ** 2 for strain in strains])
    assert zero_of_line(strains, line) == pytest.approx(exact, rel=3e-3)
    squares = [swinging(plate, strain, quads, tmp_path / f"{strain}") ** 2 for strain in strains]
    found = zero_of_line(strains, np.array(squares))
    compare.number(
        "buckling stress", found * plate.stress, exact * plate.stress, unit="MPa", rel=0.02
    )
    over = np.linspace(0.0, 1.0, 21)[:-1]
    khz = 1.0e-3 / (2.0 * np.pi)
    compare.curves(
        f"{length:g} x {width:g} mm, {'ends clamped' if clamped else 'simply supported'}",
        ("compression [MPa]", "frequency squared [kHz$^2$]"),
        {"runs": (strains * plate.stress, np.array(squares) * khz**2)},
        {
            "Ritz": (
                over * exact * plate.stress,
                np.array([plate.mode(share * exact)[0] ** 2 for share in over]) * khz**2,
            )
        },
    )


def test_transverse_shear_lowers_the_load(compare: Comparison) -> None:
    """The solid beside Kirchhoff's plate, thick and thin.

    N b^2 / pi^2 of one half-wave a x b is D11 (b/a)^2 + 2 (D12 + 2 D66) + D22 (a/b)^2.
    """
    for share, bounds in ((1.0, (-0.04, -0.01)), (0.1, (-5.0e-4, 0.0))):
        plies = tuple(Ply(T700, share * ply.thickness, ply.angle) for ply in STACK)
        plate = LoadedPlate(150.0, 100.0, plies, clamped=False)
        thickness = sum(ply.thickness for ply in plies)
        computed = plate.buckling_strain() * plate.stress
        name = f"buckling stress of a solid beside a thin plate's, {thickness:g} mm"
        compare.number(name, computed, kirchhoff(plate), unit="MPa", bounds=bounds)


def kirchhoff(plate: LoadedPlate) -> float:
    """Buckling stress of one half-wave without transverse shear."""
    levels = np.cumsum([0.0, *(ply.thickness for ply in plate.plies)])
    levels -= 0.5 * levels[-1]
    cubes = np.diff(levels**3) / 3.0
    (d11, d12), (_, d22) = sum(c * membrane(p) for c, p in zip(cubes, plate.plies, strict=True))
    d66 = cubes.sum() * T700.shear[0]
    ratio = plate.width / plate.length
    sum_of_parts = d11 * ratio**2 + 2.0 * (d12 + 2.0 * d66) + d22 / ratio**2
    return float(np.pi**2 / plate.width**2 * sum_of_parts / (levels[-1] - levels[0]))


def test_ritz_against_the_exact_plate(compare: Comparison) -> None:
    """Without load, the frequency of the solid of Srinivas and Rao."""
    plate = LoadedPlate(150.0, 100.0, STACK, clamped=False)
    layers = tuple((ply.material, ply.thickness, ply.angle) for ply in STACK)
    exact = frequency(CrossPly(150.0, 100.0, layers), 1, 1, 1.0e4)
    compare.number("first angular frequency", plate.mode(0.0)[0], exact, unit="1/s", rel=1e-4)
