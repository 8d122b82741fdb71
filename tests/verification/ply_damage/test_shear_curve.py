"""Shear of a ply there and back: the curve, what stays, what it costs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from damage import HTS40
from decks import BOTTOM, Deck, Ply
from meshes import regular
from runs import run

MODULUS, STRENGTH, ASYMPTOTE = HTS40.shear[0], HTS40.shear_strength, 93.6
SIZE, THICKNESS = 0.25, 0.125
# strain and stress along a path with the asymptote of 93.6 MPa, worked out by hand from eqs 7, 8
CYCLE = [
    (0.01, 44.296),
    (0.02, 67.629),
    (0.03, 79.920),
    (0.02, 19.920),
    (0.015, 0.0),
    (0.0, 0.0),
    (-0.015, 0.0),
    (-0.02, -19.920),
    (-0.03, -79.920),
    (-0.04, -86.394),
    (-0.02, 0.0),
    (0.03, 26.394),
    (0.04, 86.394),
    (0.045, 88.370),
]
LEG = 2.0e-4
SETS = {0.03: 0.01668, 0.04: 0.02560}


def curve_stress(strain: float) -> float:
    """Stress of the exponential curve."""
    return ASYMPTOTE * (1.0 - np.exp(-MODULUS * strain / ASYMPTOTE))


def reach(stress: float) -> float:
    """Strain at which the curve has a stress."""
    return -ASYMPTOTE / MODULUS * np.log(1.0 - stress / ASYMPTOTE)


def sheared(strains: list[float], angle: float, folder: Path) -> tuple[dict, dict]:
    """Shear one quad from strain to strain; stress at their times, and energies."""
    ply = replace(HTS40, curve=(1, 0, float(reach(STRENGTH))))
    mesh = regular(SIZE, SIZE, 1, 1, 4)
    times = [LEG * (k + 1) for k in range(len(strains))]
    deck = Deck("shear there and back", times[-1])
    deck.control(linear=True, damping=5.0e5)
    deck.mesh(mesh)
    deck.laminate([Ply(ply, THICKNESS, angle)], order=1)
    path = deck.curve([(0.0, 0.0), *zip(times, strains, strict=True)])
    deck.hold_face(range(4), BOTTOM, "z")
    deck.hold(mesh.where(y=0.0), "xy")
    deck.hold(mesh.where(y=SIZE), "y")
    deck.move(mesh.where(y=SIZE), 1, path, SIZE)
    deck.profile(1, 0.5 * SIZE, 0.5 * SIZE, LEG, 2)
    deck.intervals(glstat=LEG)
    results = run(deck, folder)
    profile, energy = results.table("profile_1"), results.table("energy")
    rows = [int(np.argmin(np.abs(profile["time"] - time))) for time in times]
    lines = [int(np.argmin(np.abs(energy["time"] - time))) for time in times]
    return (
        {name: profile[name][rows] for name in ("gxy", "s12")},
        {name: energy[name][lines] for name in energy.names},
    )


@pytest.mark.parametrize("angle", [0.0, 90.0])
def test_reference_cycle(angle: float, compare: Comparison, tmp_path: Path) -> None:
    """Along the curve, down with the first modulus, slack, and alike on the other side."""
    sign = 1.0 if angle == 0.0 else -1.0
    found, energy = sheared([strain for strain, _ in CYCLE], angle, tmp_path)
    # a step is 4e-6 of strain, at most 0.03 MPa; the references have 5 digits
    strain, stress = np.array(CYCLE).T
    assert found["gxy"] == pytest.approx(strain, abs=1.0e-5)
    met = sign * found["s12"]
    compare.values("shear stress there and back", met, stress, unit="MPa", abs=0.1)
    assert np.all(energy["matrix damage"] == 0.0)
    check_costs(energy)


def check_costs(energy: dict) -> None:
    """Where the stress is zero, all the work is spent: the area under the curve less the elastic.

    On the curve up to g: work a g - a^2/G (1 - exp(-G g/a)), elastic s(g)^2/2G.
    """
    volume = SIZE**2 * THICKNESS
    for row, top in ((5, 0.03), (10, 0.04)):
        stress = curve_stress(top)
        work = ASYMPTOTE * top - ASYMPTOTE / MODULUS * stress
        spent = volume * (work - 0.5 * stress**2 / MODULUS)
        assert energy["ply plasticity"][row] == pytest.approx(spent, rel=1.0e-4)
        assert energy["internal"][row] == pytest.approx(spent, rel=1.0e-4)
        assert top - stress / MODULUS == pytest.approx(SETS[top], abs=5.0e-6)
    assert np.all(np.diff(energy["ply plasticity"]) >= 0.0)
    assert np.abs(energy["error"]).max() < 1.0e-9


def test_cracked(compare: Comparison, tmp_path: Path) -> None:
    """Beyond the strength: plastic work up to onset, then the toughness over the band.

    Total work times the band 889.7 J/m2, of which 220 is damage and 669.7 plastic.
    """
    _, energy = sheared([0.2, 0.0], 0.0, tmp_path)
    area = SIZE * THICKNESS
    for name, toughness in (("matrix damage", 0.22), ("ply plasticity", 0.6697)):
        found = energy[name][-1]
        compare.number(f"shear until it cracks, {name}", found, toughness * area, rel=1.0e-3)
    assert energy["internal"][-1] == pytest.approx(0.8897 * area, rel=1.0e-3)
    assert np.abs(energy["error"]).max() < 1.0e-9
