"""Bending of simply supported [0/90/0] plates under q0 sin sin on the top face (Pagano 1970).

A quarter of the plate with planes of symmetry, brought to rest by critical damping.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from decks import Deck, Ply, ramp
from elasticity import Material
from exact_plate import CrossPly, Harmonic, frequency
from meshes import consistent_forces, regular
from runs import Results, run

PLY = Material(1.0e-9, (25.0e3, 1.0e3, 1.0e3), (0.25, 0.25, 0.25), (500.0, 500.0, 200.0))
PULL = 0.01  # MPa


def pagano(ratio: float) -> CrossPly:
    """Three equal plies, 1 mm thick in all."""
    return CrossPly(ratio, ratio, tuple((PLY, 1.0 / 3.0, angle) for angle in (0.0, 90.0, 0.0)))


def bent(plate: CrossPly, order: int, sublayers: int, quads: int, folder: Path) -> Results:
    """The plate at rest under its load; what moves still is exp(-25) of the deflection."""
    omega, half = frequency(plate, 1, 1, 2.0e6 / plate.thickness), plate.length / 2.0
    mesh = regular(half, half, quads, quads, 9)
    rise = 2.0 * np.pi / omega
    time = rise + 30.0 / omega
    deck = Deck("bending", time)
    deck.control(linear=True, damping=2.0 * omega)
    deck.mesh(mesh)
    deck.laminate([Ply(*ply) for ply in plate.plies], order, sublayers)
    deck.hold(mesh.where(x=0.0), "yz")
    deck.hold(mesh.where(y=0.0), "xz")
    deck.hold(mesh.where(x=half), "x")
    deck.hold(mesh.where(y=half), "y")
    wave = np.pi / plate.length
    forces = consistent_forces(mesh, lambda x, y: PULL * np.sin(wave * x) * np.sin(wave * y))
    deck.face_forces(forces, 3, deck.curve(ramp(rise)))
    deck.profile(1, half, half, time, 9)
    deck.profile(2, 0.0, half, time, 9)
    deck.profile(3, half, 0.0, time, 9)
    return run(deck, folder)


def at_height(results: Results, number: int, name: str, z: float) -> float:
    """Mean of the values of a profile at a height, one or two of them."""
    profile = results.profile(number)
    return float(profile[name][np.abs(profile["z"] - z) < 1e-9].mean())


# a/h, order, sublayers; errors in percent of w at z = 0, sxx at the top, txz at (0, b/2, 0) of an
# independent static finite-element solution on the same 8 x 8 mesh of Q9
SAME_ELEMENTS = [
    (4.0, 1, 1, -3.39, -11.4, 1.2),
    (4.0, 2, 1, -0.97, -0.5, -0.6),
    (4.0, 3, 1, 0.03, 1.2, 1.0),
    (4.0, 1, 3, -0.77, -0.9, 0.5),
    (10.0, 1, 1, -2.09, -2.1, 1.7),
    (10.0, 2, 1, -0.13, 1.0, 1.3),
    (10.0, 3, 1, -0.01, 1.1, 1.7),
    (10.0, 1, 3, -0.29, 0.8, 1.6),
]


@pytest.mark.parametrize("row", SAME_ELEMENTS, ids=lambda row: f"S={row[0]:g} {row[2]}xLE{row[1]}")
def test_error_is_that_of_the_elements(row: tuple[float, ...], tmp_path: Path) -> None:
    """The same elements solved statically are off by as much, to the printed digits."""
    ratio, order, sublayers, *printed = row
    plate = pagano(ratio)
    results = bent(plate, int(order), int(sublayers), 4, tmp_path)
    harmonic = Harmonic(plate)
    bottom = harmonic.bottom_under(PULL)
    middle, top = harmonic.fields(bottom, 1, 0.5), harmonic.fields(bottom, 2, 1.0)
    found = [
        at_height(results, 1, "uz", 0.0) / middle.displacement[2],
        at_height(results, 1, "sxx", 0.5) / top.stress[0],
        at_height(results, 2, "sxz", 0.0) / middle.stress[4],
    ]
    errors = 100.0 * (np.array(found) - 1.0)
    assert errors == pytest.approx(printed, abs=0.06)


@pytest.mark.parametrize("ratio", [4.0, 10.0])
def test_profiles_are_exact(ratio: float, tmp_path: Path) -> None:
    """Stress through the thickness with two LE3 per ply on 16 x 16 Q9.

    Stresses of Q9 at its corners converge with the square of the size: a fourth of the 1.2 % that
    8 x 8 Q9 leave, of the largest stress of the profile.
    """
    plate = pagano(ratio)
    results = bent(plate, 3, 2, 8, tmp_path)
    harmonic = Harmonic(plate)
    bottom = harmonic.bottom_under(PULL)
    for number, names in ((1, ("sxx", "syy", "szz")), (2, ("sxz",)), (3, ("syz",))):
        profile = results.profile(number)
        for name in names:
            exact = []
            for ply, z in zip(profile["ply"], profile["z"], strict=True):
                share = (z - (-0.5 + (ply - 1.0) / 3.0)) * 3.0
                fields = harmonic.fields(bottom, int(ply) - 1, share)
                exact.append(fields.stress[["sxx", "syy", "szz", "sxy", "sxz", "syz"].index(name)])
            largest = np.abs(exact).max()
            assert profile[name] == pytest.approx(exact, abs=0.006 * largest), name
