"""A bending crack along a line starts the delamination of the interface below it, on two meshes.

The strip, its bars and its theory are those of `cracked_beam`. Poisson's ratios are zero here:
nodes at a crack may not be held, so that the strip is not in plane strain, and in plies of one
layer the strain across the thickness is the same all over it.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from cracked_beam import (
    ARM,
    BOND,
    DAMPING,
    ELASTIC,
    INNER,
    PLY,
    TIME,
    Bent,
    Strip,
    cracking_moment,
    growth_moment,
    speed,
)
from decks import BOTTOM, TOP, Deck, Ply
from delamination import slow_start
from meshes import Mesh, regular
from runs import run

FLAT = replace(ELASTIC, poisson=(0.0, 0.0, 0.0))
# An explicit interface, with the strengths and toughness of the other strip
SPRINGS = replace(BOND, stiffness=(1.0e5, 1.0e5))
STRENGTH, TOUGHNESS = 20.0, 0.01
MIDDLE = ARM + 0.5 * INNER
# Quads across the strip, of any side
ROWS = 2
# The crack starts by the mean traction over its ply
HALFWAY = 1.5 * PLY


def bend_along_a_line(side: float, folder: Path) -> Bent:
    """Bend a strip of square quads with one line in the middle of its 90 ply."""
    length, width = 2.0 * MIDDLE, ROWS * side
    mesh = regular(length, width, round(length / side), ROWS, 4)
    mesh = Mesh(mesh.points - np.array([MIDDLE, 0.0]), mesh.quads)
    centres = mesh.points[mesh.quads].mean(axis=1)[:, 0]
    deck = Deck("a crack along a line that starts a delamination", 1.1 * TIME)
    deck.control(linear=True, damping=DAMPING)
    deck.mesh(mesh, [2 if abs(x) < 2.0 else 1 for x in centres])
    for part in (1, 2):
        deck.laminate([Ply(FLAT, PLY), Ply(FLAT, PLY, 90.0)], order=1, part=part)
    deck.cohesive(SPRINGS, nodal=True, parts=(1, 2))
    deck.add("CRACK_LINES", (2, 1000.0, TOUGHNESS), (STRENGTH, 1.0e4, 1.0e4))
    deck.hold(mesh.where(x=-MIDDLE), "y")
    deck.hold_face(mesh.where(x=-MIDDLE), BOTTOM, "x")
    deck.hold_face(mesh.where(x=-MIDDLE) + mesh.where(x=MIDDLE), TOP, "z")
    bars = deck.node_set(mesh.where(x=-0.5 * INNER) + mesh.where(x=0.5 * INNER))
    deck.add("BOUNDARY_FACE_MOTION", (bars, BOTTOM, 3, 0, slow_start(deck, TIME), speed()))
    often = TIME / 600.0
    deck.intervals(spcforc=often, glstat=often, delam=often, binary_d3plot=TIME)
    return Bent(Strip(round(INNER / side), width=width), run(deck, folder))


@pytest.mark.parametrize("side", [1.0, 0.5])
def test_a_bending_crack_starts_the_delamination(
    side: float, compare: Comparison, tmp_path: Path
) -> None:
    """The crack takes its toughness though its ply is bent, and the moment of growth is one.

    2 % for the crack: between two rows the moment rises by 0.4 %, and damping takes as much; quads
    of four nodes are too stiff by half of G13 / E1 times the square of side over thickness, 1 %.
    5 % for growth, as for the other strip.
    """
    found = bend_along_a_line(side, tmp_path)
    cracks = found.results.table("cracks")
    starts = int(np.argmax(cracks["length"] > 0.0))
    moment = np.interp(cracks["time"][starts], found.energy("time"), found.moment)
    begins = cracking_moment(HALFWAY, STRENGTH, poisson=0.0)
    compare.number("moment at which the crack begins", moment, begins, unit="N", rel=0.02)
    width = found.strip.width
    energy = TOUGHNESS * PLY * width
    compare.number("energy of the crack", cracks["energy"][-1], energy, unit="mJ", rel=1e-6)
    moment, growth = found.moment[found.growing].mean(), growth_moment(poisson=0.0)
    name = "moment at which the delamination grows"
    compare.number(name, moment, growth, unit="N", rel=0.05)
    assert cracks["time"][starts] < found.energy("time")[int(np.argmax(found.failed > 0.0))]
    assert cracks["length"][-1] == pytest.approx(width)
    assert np.abs(found.energy("error")).max() < 1e-6
