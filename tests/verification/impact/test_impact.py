"""Elastic impact on a simply supported plate: momentum and energy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from decks import Deck, Ply, Sphere
from elasticity import CARBON
from meshes import regular
from runs import run

MASS, VELOCITY, RADIUS, SIDE, PLY = 2.0e-6, 4.0e3, 8.0, 40.0, 0.25


def impact(order: int, method: int) -> Deck:
    """A [0/90]s plate of 1 mm, struck by a ball and followed until the ball has left."""
    mesh = regular(SIDE, SIDE, 10, 10, 9)
    deck = Deck("elastic impact", 2.5e-4)
    deck.control()
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, PLY, angle) for angle in (0.0, 90.0, 90.0, 0.0)], order)
    deck.hold(mesh.where(x=0.0) + mesh.where(x=SIDE), "yz")
    deck.hold(mesh.where(y=0.0) + mesh.where(y=SIDE), "xz")
    deck.intervals(impactor=0.0, glstat=0.0)
    centre = (0.5 * SIDE, 0.5 * SIDE, RADIUS + 2.0 * PLY)
    sphere = Sphere(RADIUS, MASS, centre, (0.0, 0.0, -VELOCITY), method=method)
    deck.sphere(sphere)
    return deck


@pytest.mark.parametrize("method", [1, 2], ids=["nodes on sphere", "points of plate"])
@pytest.mark.parametrize("order", [1, 2])
def test_impact_keeps_momentum_and_energy(order: int, method: int, tmp_path: Path) -> None:
    """The impulse is what the ball's momentum changes by; the balance of energy closes.

    Each onset of contact is a plastic collision of a node: it takes its mass over that of the ball
    from the energy, a few tenths of a percent on this mesh at most.
    """
    results = run(impact(order, method), tmp_path)
    history, energy = results.table("impactor_1"), results.table("energy")
    time, velocity = history["time"], history["velocity"]
    impulse = np.trapezoid(history["force"], time)
    assert impulse == pytest.approx(MASS * (velocity[-1] - velocity[0]), rel=1e-3)
    assert history["force"].min() >= 0.0
    assert history["force"][-1] == 0.0
    assert velocity[-1] > 0.5 * VELOCITY
    assert np.abs(energy["error"]).max() < 5.0e-3
    assert np.abs(history["force x"]).max() < 1e-6 * history["force"].max()
