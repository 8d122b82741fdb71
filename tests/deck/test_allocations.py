"""The loop allocates nothing between two outputs, and a row of a history only its own content."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

from allocations import allocations, counter
from damage import HTS40
from decks import BOTTOM, TOP, Deck, Ply, Sphere
from delamination import PEEK_BOND
from elasticity import CARBON
from meshes import regular
from runs import SOLVER

__all__ = ["counter"]

# run-time checks take memory of their own
pytestmark = pytest.mark.skipif(SOLVER.parent.name == "debug", reason="a build with all checks")

STEPS = 100
FEW = STEPS // 4
FOREVER, EVERY_STEP = 1.0, 1.0e-15
PLY = 0.25
FEWER, MORE = 6, 18  # quads along a side
WIDTH, DEPTH = 24.0, 18.0
# bytes of the two areas of a point that a row of delamination projects onto the plane
AREAS = 2 * 8
# bytes that the library of the compiler takes for each number that it writes as text; a few more
# numbers of a row are not zero on more quads
TEXT = 5 * 4200


def impact(steps: int, *, joined: bool) -> Deck:
    """An impact without output between the first and the last step."""
    mesh = regular(WIDTH, DEPTH, 8, 6, 9)
    deck = Deck("impact", FOREVER, steps)
    deck.control(linear=joined, damping=1.0)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.5, 45.0 * k) for k in range(4)])
    if joined:
        deck.interfaces(1.0e5, 1.0e5)
    deck.hold(mesh.boundary(), "xyz")
    deck.sphere(Sphere(8.0, 1.0e-5, (12.0, 9.0, 9.0), (0.0, 0.0, -5.0e3), method=1 + int(joined)))
    deck.add("DATABASE_FIELD", "displacement")
    deck.intervals(glstat=FOREVER, impactor=FOREVER, binary_d3plot=FOREVER)
    return deck


def coupon(interval: float, quads: int, *, damaged: bool, steps: int = STEPS) -> Deck:
    """Plies and interfaces that fail, or elastic ones, on a base and under a clamp."""
    mesh = regular(WIDTH, DEPTH, quads, quads, 9)
    deck = Deck("coupon", FOREVER, steps)
    deck.control()
    deck.mesh(mesh)
    material = HTS40 if damaged else CARBON
    deck.laminate([Ply(material, PLY, 45.0 * k) for k in range(4)], 1)
    if damaged:
        deck.cohesive(PEEK_BOND)
    else:
        deck.interfaces(1.0e5, 1.0e5)
    deck.hold(mesh.boundary(), "xyz")
    window = (1, 0.5 * WIDTH, 0.5 * DEPTH, 0.8 * WIDTH, 0.8 * DEPTH, 2.0)
    deck.add("FIXTURE_PLANE", (1, BOTTOM, 0.0, 0.5, 0.3), window)
    force = deck.curve([(0.0, 0.0), (FOREVER, 1.0)])
    deck.add("FIXTURE_CLAMP", (2, TOP, 100.0, force, 50.0), (2.0, 2.0, 0.0, 2.0))
    centre = (0.5 * WIDTH, 0.5 * DEPTH, 8.0 + 2.0 * PLY)
    deck.sphere(Sphere(8.0, 1.0e-5, centre, (0.0, 0.0, -5.0e3)))
    deck.add("DATABASE_FIELD", "displacement")
    deck.intervals(binary_d3plot=FOREVER)
    histories = ["glstat", "impactor", "fixture"] + ["delam"] * damaged
    deck.intervals(**dict.fromkeys(histories, interval))
    return deck


DECKS = {
    "tied": partial(impact, joined=False),
    "springs": partial(impact, joined=True),
    "coupon": lambda steps: coupon(FOREVER, 6, damaged=True, steps=steps),
}


@pytest.mark.parametrize("deck", DECKS.values(), ids=DECKS)
def test_steps_allocate_nothing(counter: Path, tmp_path: Path, deck: Callable[[int], Deck]) -> None:
    """A few may differ: lists of contacts grow, and the last output depends on the state."""
    once, twice = (
        allocations(counter, deck(steps), tmp_path / str(steps)).number
        for steps in (STEPS, 2 * STEPS)
    )
    assert abs(twice - once) <= FEW


@pytest.mark.parametrize("damaged", [False, True])
def test_rows_do_not_copy_the_mesh(counter: Path, tmp_path: Path, *, damaged: bool) -> None:
    """On more quads, a row allocates no more than the areas of delamination of their points."""
    row = []
    for quads in FEWER, MORE:
        bytes_of = [
            allocations(
                counter,
                coupon(interval, quads, damaged=damaged),
                tmp_path / f"{quads}_{interval}",
            ).bytes
            for interval in (FOREVER, EVERY_STEP)
        ]
        row.append((bytes_of[1] - bytes_of[0]) / STEPS)
    needed = AREAS * 9 * (MORE**2 - FEWER**2) * damaged
    assert row[0] > 0
    assert needed <= row[1] - row[0] <= needed + TEXT
