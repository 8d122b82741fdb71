"""A plate whose interfaces have all failed, hit by a pressure: faces open and close many times.

Nothing is lost in it: no damage is left to grow, and nothing rubs. What its energy gains comes from
the step alone.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from decks import TOP, Bond, Deck, Ply
from elasticity import CARBON
from meshes import regular
from runs import Table, run

# The paper's table 6, in mm, s, t
BOND = Bond((1.3733e6, 4.933e5), (62.3, 92.3), (0.28, 0.79), -1.45)
WHOLE = replace(BOND, whole_penalty=True)
ANGLES = (0.0, 90.0, 0.0, 90.0, 90.0, 0.0, 90.0, 0.0)
SIDE, PLY, PRESSURE = 10.0, 0.25, 50.0


@dataclass(frozen=True)
class Course:
    """How the plate is computed: share of the stable step, until when; implicit interfaces."""

    bond: Bond = BOND
    share: float = 0.9
    end: float = 1.0e-4
    implicit: int = 0  # IMPL
    intact: bool = False
    pressure: float = PRESSURE
    limit: float = 10.0  # of the energy out of balance: no guard


def energies(course: Course, folder: Path) -> Table:
    """History of the energies, of a run in a folder."""
    return run(deck_of(course), folder).table("energy")


def deck_of(course: Course) -> Deck:
    """The deck of a plate."""
    deck = Deck("faces that close again", course.end)
    deck.add("CONTROL_LAYERWISE", (0, course.limit, course.implicit))
    deck.add("CONTROL_TIMESTEP", (0.0, course.share))
    mesh = regular(SIDE, SIDE, 4, 4, 9)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, PLY, angle) for angle in ANGLES], 2)
    deck.cohesive(course.bond)
    if not course.intact:
        deck.add("INITIAL_DELAMINATION", (1, 0, 0))
    deck.hold(mesh.boundary(), "xyz")
    curve = deck.curve([(0.0, 0.0), (5.0e-7, 1.0), (1.5e-6, 1.0), (2.0e-6, 0.0)])
    deck.add("LOAD_FACE_PRESSURE", (0, TOP, curve, course.pressure))
    deck.intervals(glstat=course.end / 500.0, binary_d3plot=course.end)
    return deck


def mean_kinetic(energy: Table) -> float:
    """Over the second half of the time, as a share of the work that the pressure did."""
    late = energy["time"] > 0.5 * energy["time"][-1]
    return float(energy["kinetic"][late].mean() / energy["external"][-1])
