"""Two stiff plies on one quad, led to and fro by chance: the law of the interface written twice."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cohesive_reference import CohesivePoint
from comparison import Comparison
from decks import BOTTOM, TOP, Bond, Deck, Ply
from elasticity import Array, isotropic
from meshes import regular
from runs import run

# Heavy plies take long steps: two thousand in a path, all of which are compared
STIFF, HEIGHT, DURATION = isotropic(1.0e-5, 1.0e7, 0.0), 0.1, 2.0e-4
KENANE = Bond((1.0e5, 0.4e5), (60.0, 90.0), (0.28, 0.79), -1.6)
BONDS = {
    "friction": replace(KENANE, friction=0.3),
    "power law, whole penalty, friction": replace(
        KENANE, exponent=1.3, whole_penalty=True, friction=0.5
    ),
    "stronger under pressure": replace(KENANE, exponent=-2.0, pressure_gain=0.6),
    "by the work": replace(KENANE, by_work=True, friction=0.3),
}


def path(seed: int, states: int = 1000, knots: int = 8) -> tuple[Array, Array]:
    """Times and separations of a smooth path that opens, slides and closes more and more."""
    random = np.random.default_rng(seed)
    corners = 0.01 * random.normal(size=(knots, 3)) * np.linspace(0.1, 1.3, knots)[:, None]
    closed = random.random(knots) < 0.4
    corners[closed, 2] = -0.15 * np.abs(corners[closed, 2])
    corners[0] = 0.0
    place = np.linspace(0.0, knots - 1.0, states)
    leg = np.minimum(place.astype(int), knots - 2)
    part = place - leg
    part = (part**3 * (10.0 - 15.0 * part + 6.0 * part**2))[:, None]
    times = np.linspace(0.0, DURATION, states)
    return times, corners[leg] * (1.0 - part) + corners[leg + 1] * part


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("bond", list(BONDS))
def test_random_path(bond: str, seed: int, compare: Comparison, tmp_path: Path) -> None:
    """Fracture and friction of every step, at the separations that the run has written.

    These are of the middle: where plies are sheared their free edges tilt the inner faces by the
    share K h / E = 1e-3, the square of which is seen. A penalty that falls under pressure releases
    energy, which counts as delamination. With damage by the work the solver finds the mix of modes
    of a step in two passes: the energies at the end, to 1e-4.
    """
    law = BONDS[bond]
    mesh = regular(1.0, 1.0, 1, 1, 4)
    deck = Deck("a random path", DURATION)
    deck.control(linear=True, share=0.7)
    deck.mesh(mesh)
    deck.laminate([Ply(STIFF, HEIGHT)] * 2, 1)
    deck.cohesive(law)
    everywhere = range(len(mesh.points))
    deck.hold_face(everywhere, BOTTOM, "xyz")
    times, way = path(seed)
    for axis in range(3):
        curve = deck.curve(zip(times, way[:, axis], strict=True))
        deck.move_face(everywhere, TOP, axis + 1, curve, 1.0)
    deck.profile(1, 0.5, 0.5, 1.0e-9 * DURATION, 2)
    deck.intervals(glstat=1.0e-9 * DURATION)
    results = run(deck, tmp_path)
    energy, profile = results.table("energy"), results.table("profile_1")
    faces = 4  # both of both plies
    motion = np.column_stack([profile[name] for name in ("ux", "uy", "uz")])
    jumps = motion[2::faces] - motion[1::faces]
    assert len(jumps) == len(energy["time"]) > 1000
    point, spent = CohesivePoint(law), []
    for jump in jumps:
        point.step(jump)
        spent.append((point.fracture + point.released, point.friction))
    assert point.damage > 0.5
    assert (point.friction > 0.0) == (law.friction > 0.0)
    found = np.column_stack([energy["delamination"], energy["friction"]])
    steps, share = (slice(-1, None), 1.0e-4) if law.by_work else (slice(None), 5.0e-6)
    close = share * np.max(spent)
    wanted = np.array(spent)[steps]
    compare.values("energies of a random path", found[steps], wanted, unit="mJ", abs=close)
