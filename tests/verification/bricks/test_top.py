"""A free brick that spins near the axis of its middle moment of inertia, and tumbles over."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from brick_decks import Bricks, add_bricks, box
from comparison import Comparison
from decks import Deck
from elasticity import Array
from runs import run

SIZE, DENSITY = np.array([3.0, 2.0, 1.0]), 1.0e-6
SPIN = 2000.0 * np.array([0.02, 1.0, 0.01])
END = 3.0 * 2.0 * np.pi / 2000.0
CORNERS = box(SIZE, (1, 1, 1))
PLACES = CORNERS.points - 0.5 * SIZE


def turned(times: Array) -> Array:
    """Corners of the rigid body over time, (times, 8, 3), by Euler's equations.

    All of the mass is at the corners, as in the brick: m (b^2 + c^2) / 4.
    """
    squares = 0.25 * SIZE**2
    inertia = squares.sum() - squares

    def rates(_: float, state: Array) -> Array:
        spin, axes = state[:3], state[3:].reshape(3, 3)
        faster = -np.cross(spin, inertia * spin) / inertia
        # the spin is in the axes of the body, the columns of the rotation
        return np.concatenate([faster, np.cross(axes, spin).ravel()])

    start = np.concatenate([SPIN, np.eye(3).ravel()])
    way = solve_ivp(rates, (0.0, times[-1]), start, rtol=1e-11, atol=1e-12, t_eval=times)
    assert way.y[1].min() < -0.9 * SPIN[1]
    return np.einsum("ijt,kj->tki", way.y[3:].reshape(3, 3, -1), PLACES)


def tumbled(young: float, points: int, folder: Path) -> tuple[Array, Array]:
    """Times, and corners of the brick, (times, 8, 3)."""
    deck = Deck("a spinning brick", END)
    deck.control(share=0.8)
    mesh = Bricks(PLACES, CORNERS.bricks, CORNERS.layer)
    material = (1, DENSITY, young, 0.0)
    add_bricks(
        deck,
        mesh,
        lambda deck: deck.add("MAT_ELASTIC", material),
        points=points,
        hourglass=(6, 1.0),
    )
    deck.velocities(np.cross(SPIN, PLACES))
    deck.histories(range(8), END / 60.0)
    deck.intervals(glstat=END)
    table = run(deck, folder).table("nodes")
    moved = [[table[f"n{i + 1} {name}"] for name in ("ux", "uy", "uz")] for i in range(8)]
    return table["time"], PLACES + np.transpose(moved, (2, 0, 1))


@pytest.mark.parametrize("points", [1, 8])
def test_brick_tumbles(points: int, compare: Comparison, tmp_path: Path) -> None:
    """The spin turns to the other sense of its axis; a brick four times as stiff is as much closer.

    Centrifugal forces stretch the brick by 1e-5 and so change its moments of inertia; the motion
    is unstable and makes a hundred times that of it.
    """
    soft, stiff = (tumbled(young, points, tmp_path / str(young)) for young in (4.0e5, 1.6e6))
    off = [places - turned(times) for times, places in (soft, stiff)]
    exact = turned(stiff[0])
    compare.values("corners of a tumbling brick", stiff[1], exact, unit="mm", abs=4e-4)
    ratio = np.abs(off[1]).max() / np.abs(off[0]).max()
    compare.number("error of a brick four times as stiff", ratio, 0.25, abs=0.01)
