"""Bending of simply supported [0/90/0] plates under q0 sin sin on the top face (Pagano 1970).

A quarter of the plate with planes of symmetry, brought to rest by critical damping.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck, Ply, ramp
from exact_plate import CrossPly, Harmonic, frequency
from expanded_plate import ExpandedHarmonic
from meshes import consistent_forces, regular
from runs import Results, run
from static_plate import PULL, errors, pagano

VOIGT = ("sxx", "syy", "szz", "sxy", "sxz", "syz")


def bent(plate: CrossPly, order: int, sublayers: int, quads: int, folder: Path) -> Results:
    """The plate at rest under its load; what moves still is exp(-25) of the deflection."""
    omega, half = frequency(plate, 1, 1, 2.0e6 / plate.thickness), plate.length / 2.0
    mesh = regular(half, half, quads, quads, 9)
    rise = 2.0 * np.pi / omega
    time = rise + 30.0 / omega
    deck = Deck("bending", time)
    deck.intervals(glstat=time)
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


# a/h, order, sublayers; errors in percent of w at z = 0 and sxx at the top of a static solution
# with the same elements on the same 8 x 8 mesh of Q9: what
# `python tests/support/static_plate.py` prints
SAME_ELEMENTS = [
    (4.0, 1, 1, -3.39, -11.4),
    (4.0, 2, 1, -0.97, -0.5),
    (4.0, 3, 1, 0.00, 1.2),
    (4.0, 1, 3, -0.77, -0.9),
    (10.0, 1, 1, -2.09, -2.1),
    (10.0, 2, 1, -0.13, 1.0),
    (10.0, 3, 1, -0.01, 1.1),
    (10.0, 1, 3, -0.29, 0.8),
]


@pytest.mark.parametrize("row", SAME_ELEMENTS, ids=lambda row: f"S={row[0]:g} {row[2]}xLE{row[1]}")
def test_table_is_that_of_the_static_solution(row: tuple[float, ...]) -> None:
    """To half of the last printed digit."""
    ratio, order, sublayers, deflection, stress = row
    found = errors(ratio, int(order), int(sublayers))
    assert found[0] == pytest.approx(deflection, abs=0.005)
    assert found[1] == pytest.approx(stress, abs=0.05)


def sampling_error(quads: int) -> float:
    """Share by which the shear across the plate is too large at the edge of a plate.

    A cosine that falls from the edge, taken at the three Gauss points of the first quad, with the
    straight line closest to it carried to the edge: (k h)^2 / 3 and smaller terms, where h is half
    the width of the quad, and k h = pi / 4 over the quads of a quarter.
    """
    points, weights = np.polynomial.legendre.leggauss(3)
    cosine = np.cos(0.25 * np.pi / quads * (1.0 + points))
    return float(weights @ (cosine * (0.5 - 1.5 * points))) - 1.0


def shear_error(results: Results, plate: CrossPly) -> float:
    """Error of txz at (0, b/2, 0) against the exact solution."""
    harmonic = Harmonic(plate)
    exact = harmonic.fields(harmonic.bottom_under(PULL), 1, 0.5).stress[4]
    return at_height(results, 2, "sxz", 0.0) / exact - 1.0


@pytest.mark.parametrize("row", SAME_ELEMENTS, ids=lambda row: f"S={row[0]:g} {row[2]}xLE{row[1]}")
def test_error_is_that_of_the_elements(
    row: tuple[float, ...], compare: Comparison, tmp_path: Path
) -> None:
    """The same elements solved statically are off by as much, to the printed digits.

    The shear across the plate is projected before it is written: its error is that of the expansion
    through the thickness on quads without end, and that of the projection. What the nodes are off
    by is (k h)^4 / 15 at most, 0.01 %.
    """
    ratio, order, sublayers, *printed = row
    plate = pagano(ratio)
    results = bent(plate, int(order), int(sublayers), 4, tmp_path)
    harmonic, expanded = Harmonic(plate), ExpandedHarmonic(plate, int(order), int(sublayers))
    bottom = harmonic.bottom_under(PULL)
    middle, top = harmonic.fields(bottom, 1, 0.5), harmonic.fields(bottom, 2, 1.0)
    deflection, stress = (at_height(results, 1, *place) for place in (("uz", 0.0), ("sxx", 0.5)))
    bounds = [(0.01 * (error - 0.06), 0.01 * (error + 0.06)) for error in printed]
    exact = middle.displacement[2], top.stress[0]
    compare.number("w in the middle", deflection, exact[0], unit="mm", bounds=bounds[0])
    compare.number("sxx on top", stress, exact[1], unit="MPa", bounds=bounds[1])
    shear = expanded.fields(expanded.under(PULL), 1, 0.5).stress[4] / middle.stress[4]
    predicted = shear * (1.0 + sampling_error(4)) - 1.0
    bounds = (predicted - 1e-4, predicted + 1e-4)
    compare.number(
        "txz at the edge, over Pagano's", 1.0 + shear_error(results, plate), 1.0, bounds=bounds
    )


@pytest.mark.parametrize("ratio", [4.0, 10.0])
def test_shear_across_the_plate_converges(
    ratio: float, compare: Comparison, tmp_path: Path
) -> None:
    """With LE3 the projection is all that is wrong: halving the quads leaves a fourth."""
    plate = pagano(ratio)
    coarse, fine = (
        shear_error(bent(plate, 3, 1, quads, tmp_path / str(quads)), plate) for quads in (4, 8)
    )
    compare.number("error of txz with half the quad, ratio", fine / coarse, 0.25, abs=0.01)


@pytest.mark.parametrize(("ratio", "sublayers"), [(4.0, 3), (10.0, 2)])
def test_profiles_are_exact(
    ratio: float, sublayers: int, compare: Comparison, tmp_path: Path
) -> None:
    """Stress through the thickness with several LE3 per ply on 16 x 16 Q9.

    Stress in the plane and shear across it are off by as much as the derivative of a quadratic at
    the end of a quad, (k h)^2 / 3 = 0.32 %. The sublayers are thin enough that the expansion adds
    less than a fifth of this: with two for a/h = 4, u would bend within its cubics so much that txz
    of the faces was 0.7 % of the largest instead of zero, on any mesh.
    """
    plate = pagano(ratio)
    results = bent(plate, 3, sublayers, 8, tmp_path)
    harmonic = Harmonic(plate)
    bottom = harmonic.bottom_under(PULL)
    for number, names in ((1, ("sxx", "syy", "szz")), (2, ("sxz",)), (3, ("syz",))):
        profile = results.profile(number)
        places = zip(profile["ply"], profile["z"], strict=True)
        exact = np.array(
            [
                harmonic.fields(bottom, int(ply) - 1, 3.0 * (z + 0.5) - (ply - 1.0)).stress
                for ply, z in places
            ]
        )
        for name in names:
            wanted = exact[:, VOIGT.index(name)]
            bound = 1.2 * sampling_error(8) * np.abs(wanted).max()
            compare.values(f"{name} through the thickness", profile[name], wanted, abs=bound)
            if ratio == 4.0 and name != "syy":
                compare.curves(
                    f"[0/90/0], a/h = 4: {name}",
                    (f"{name} [MPa]", "z [mm]"),
                    {"run": (profile[name], profile["z"])},
                    {"Pagano": (wanted, profile["z"])},
                )
