"""A torn strip whose crack is pressed together and sheared: faces that stick and slip."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from decks import Deck, Ply
from elasticity import Material
from meshes import Mesh, regular
from runs import run

LENGTH, WIDTH, TIME = 16.0, 8.0, 6.0e-4
HTS40 = Material(1.6e-9, (153.0e3, 10.3e3, 10.3e3), (0.3, 0.3, 0.4), (6.0e3, 6.0e3, 3.7e3))


def rubbed(friction: float, fibres: float) -> Deck:
    """A strip is pulled until its fibres part, pressed, and sheared by half a mm."""
    mesh = regular(LENGTH, WIDTH, 16, 8, 4)
    mesh = Mesh(mesh.points - np.array([LENGTH, WIDTH]) / 2.0, mesh.quads)
    deck = Deck("pressed and sheared", TIME)
    deck.control(linear=True, damping=2.0e4)
    middles = mesh.points[mesh.quads].mean(axis=1)[:, 0]
    deck.mesh(mesh, [2 if abs(x) < 5.0 else 1 for x in middles])
    for part in (1, 2):
        deck.laminate([Ply(HTS40, 0.5, fibres)], 1, part=part)
    deck.add("CRACK_LINES", (2, 1000.0, 0.02, friction), (30.0, 50.0, 40.0))
    deck.hold(mesh.where(x=-LENGTH / 2.0), "xyz")
    right = mesh.where(x=LENGTH / 2.0)
    along = [(0.0, 0.0), (0.2 * TIME, 2.0), (0.4 * TIME, -1.0), (TIME, -1.0)]
    across = [(0.0, 0.0), (0.45 * TIME, 0.0), (0.95 * TIME, 1.0), (TIME, 1.0)]
    deck.move(right, 1, deck.curve(along), 0.04)
    deck.move(right, 2, deck.curve(across), 0.5)
    deck.hold(right, "z")
    deck.intervals(glstat=TIME / 300.0, delam=TIME / 300.0)
    return deck


@pytest.mark.parametrize("fibres", [90.0, 45.0])
def test_friction_takes_what_is_not_stored(fibres: float, tmp_path: Path) -> None:
    """The work of all forces is stored or dissipated: half a per cent of chattering faces.

    With fibres along the diagonal of the quads lines of nodes are nearer to each other, and springs
    of closed faces stiffer than the plies.
    """
    results = run(rubbed(0.6, fibres), tmp_path)
    energy = results.table("energy")
    length = WIDTH / np.sin(np.radians(fibres))
    assert results.table("cracks")["length"][-1] == pytest.approx(length, rel=1e-6)
    assert energy["friction"][-1] > 10.0
    assert np.abs(energy["stored error"]).max() < 5.0e-3
