"""The opening in the file of interfaces: how far the upper ply has moved beyond the lower one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from decks import BOTTOM, TOP, Bond, Deck, Ply, ramp
from elasticity import CARBON
from meshes import regular
from runs import run

SIDE, PLY, END = 4.0, 0.5, 2.0e-4
WAY = 0.01


@pytest.mark.parametrize("direction", [1, 2, 3])
@pytest.mark.parametrize("face", [TOP, BOTTOM])
def test_the_opening_is_that_of_the_upper_ply_beyond_the_lower(
    face: int, direction: int, tmp_path: Path
) -> None:
    """One face moves by +0.01 and the other is held; the bond is far softer than the plies.

    A face that moves up opens the interface where it is the top one, and closes it else.
    """
    mesh = regular(SIDE, SIDE, 2, 2, 9)
    deck = Deck("opening", END)
    deck.control(linear=True, damping=1.0e6)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, PLY)] * 2, 1)
    deck.cohesive(Bond((50.0, 50.0), (50.0, 50.0), (50.0, 50.0), 1.0))
    nodes = range(len(mesh.points))
    others = "xyz".replace("xyz"[direction - 1], "")
    deck.hold_face(nodes, -face, "xyz")
    deck.hold_face(nodes, face, others)
    deck.move_face(nodes, face, direction, deck.curve(ramp(0.5 * END)), WAY)
    opening = run(deck, tmp_path).interface_field("opening")
    # stiffness of the bond times thickness over the least modulus of the plies: 1.4 %
    moved = np.zeros(3)
    moved[direction - 1] = face * WAY
    assert opening == pytest.approx(np.broadcast_to(moved, opening.shape), abs=0.02 * WAY)
