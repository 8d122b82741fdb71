"""Two stiff plies on one quad, moved apart: work per area, tractions, what damage leaves."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from decks import BOTTOM, TOP, Bond, Deck, Ply
from elasticity import Array, isotropic
from meshes import regular
from runs import Results, run

SIDE, HEIGHT = 1.0, 0.1
AREA = SIDE**2
# Plies a thousand times as stiff as the bond, without Poisson's ratio: the faces move as told
YOUNG = 1.0e7
STIFF = isotropic(1.0e-9, YOUNG, 0.0)
DURATION, STATES = 2.0e-5, 200
# Share of the motion that the plies take: both plies' compliance over that of the bond; in shear
# twice as much, of a bond that is less than half as stiff
SOFT = 2.0 * HEIGHT / YOUNG * 1.0e5

KENANE = Bond((1.0e5, 0.4e5), (60.0, 90.0), (0.28, 0.79), -1.6)
POWERS = replace(KENANE, exponent=1.5)
# Directions of sliding to opening, and a fraction of the energy that follows from them
LONG = 0.04
TURN = np.radians(30.0)


@dataclass(frozen=True)
class Motion:
    """How the upper ply moves: legs between (opening, sliding along 30 degrees from x)."""

    legs: tuple[tuple[float, float], ...]
    nodes: int = 9
    nodal: bool = False
    linear: bool = True


def moved(bond: Bond, motion: Motion, folder: Path) -> Results:
    """Run the motion, leg after leg in equal times."""
    mesh = regular(SIDE, SIDE, 1, 1, motion.nodes)
    deck = Deck("point", DURATION)
    deck.control(linear=motion.linear)
    deck.mesh(mesh)
    deck.laminate([Ply(STIFF, HEIGHT)] * 2, 1)
    deck.cohesive(bond, nodal=motion.nodal)
    everywhere = range(len(mesh.points))
    deck.hold_face(everywhere, BOTTOM, "xyz")
    opening, sliding = np.array([(0.0, 0.0), *motion.legs]).T
    for axis, way in enumerate((sliding * np.cos(TURN), sliding * np.sin(TURN), opening)):
        deck.move_face(everywhere, TOP, axis + 1, deck.curve(smooth(way)), 1.0)
    deck.profile(1, 0.4 * SIDE, 0.6 * SIDE, DURATION / STATES, 2)
    deck.intervals(glstat=DURATION / STATES, binary_d3plot=DURATION)
    return run(deck, folder)


def smooth(way: Array) -> list[tuple[float, float]]:
    """Each leg along half a cosine: quasi-static, as the plies have no more than a start."""
    share = 0.5 * (1.0 - np.cos(np.pi * np.arange(1, 33) / 32.0))
    legs = [a + (b - a) * share for a, b in pairwise(way)]
    points = np.concatenate([way[:1], *legs])
    return list(zip(np.linspace(0.0, DURATION, len(points)), points, strict=True))


def traction(results: Results) -> tuple[Array, Array]:
    """Traction and jump over time at the place of the profile, (states, 3) along x, y, z."""
    profile = results.table("profile_1")
    stress = np.column_stack([profile[name] for name in ("sxz", "syz", "szz")])
    motion = np.column_stack([profile[name] for name in ("ux", "uy", "uz")])
    points = 4  # both faces of both plies
    return stress[1::points], motion[2::points] - motion[1::points]


def final(bond: Bond, mix: float) -> float:
    """Energy of the mix of modes."""
    return AREA * bond.toughness_of(mix)


@pytest.mark.parametrize("bond", [KENANE, POWERS], ids=["Benzeggagh-Kenane", "power law"])
@pytest.mark.parametrize("slope", [0.0, 0.6, 1.6, 3.0, np.inf])
def test_straight_path_takes_the_toughness(bond: Bond, slope: float, tmp_path: Path) -> None:
    """G_c of the mix of modes, whatever the stiffnesses; the mix of a straight path is constant."""
    opening, sliding = (LONG, slope * LONG) if np.isfinite(slope) else (0.0, LONG)
    results = moved(bond, Motion(((opening, sliding),)), tmp_path)
    twice = np.array(bond.stiffness) * np.array([opening, sliding]) ** 2
    energy = results.table("energy")
    # the compliance of the plies bends the path by SOFT at most
    expected = final(bond, twice[1] / twice.sum())
    pure = opening == 0.0 or sliding == 0.0
    assert energy["delamination"][-1] == pytest.approx(expected, rel=1e-9 if pure else SOFT)
    assert np.all(np.diff(energy["delamination"]) >= 0.0)
    assert np.all(energy["friction"] == 0.0)
    assert np.abs(energy["error"]).max() < 1e-9
