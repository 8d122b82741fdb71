"""A rigid sphere on an elastic half-space: the impact of Hertz.

With k = 4/3 E / (1 - nu^2) sqrt(R), the sphere goes in by (5 M V^2 / 4 k)^(2/5), under the force
k times that to the power of 3/2, for 2.9432 times that over V (Johnson 1985, section 11.4).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, Deck, Ply, Sphere
from elasticity import STEEL, Array
from meshes import rectangle
from runs import Table, run

YOUNG, POISSON = STEEL.young[0], STEEL.poisson[0]
RADIUS, CONTACT, DEPTH, VELOCITY = 20.0, 1.0, 20.0, 1.5e3
INDENTATION = CONTACT**2 / RADIUS
HERTZ = 4.0 / 3.0 * YOUNG / (1.0 - POISSON**2) * np.sqrt(RADIUS)
FORCE = HERTZ * INDENTATION**1.5
MASS = 4.0 * HERTZ * INDENTATION**2.5 / (5.0 * VELOCITY**2)
TIME = 2.9432 * INDENTATION / VELOCITY


def lines() -> Array:
    """Four quads under the contact, five nodes to its radius, then ever larger ones."""
    widths = np.append(np.full(4, 0.4), 0.4 * 2.0 ** np.arange(1, 6))
    widths[4:] *= (DEPTH - 1.6) / widths[4:].sum()
    return np.append(0.0, np.cumsum(widths))


@pytest.mark.parametrize("method", [1, 2], ids=["nodes on sphere", "points of plate"])
def test_sphere_strikes_a_block(method: int, compare: Comparison, tmp_path: Path) -> None:
    """A quarter of a block twenty contact radii deep and wide, two planes of symmetry.

    The impact is slow: sound crosses the block 25 times, and the sphere gets all its energy back.
    The held bottom stops what a half-space would sink there, 2/(3 pi) (3 - 2 nu)/(1 - nu) a/H of
    the indentation, 3.6 %: the block is harder by less than that, since its sides are free.
    """
    mesh = rectangle(lines(), lines(), 9)
    deck = Deck("Hertz", 1.1 * TIME)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(STEEL, float(height)) for height in np.diff(lines())[::-1]], 2)
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(mesh.where(y=0.0), "y")
    deck.hold_face(range(len(mesh.points)), BOTTOM, "z")
    deck.intervals(impactor=0.0, glstat=TIME)
    centre, velocity = (0.0, 0.0, 0.5 * DEPTH + RADIUS), (0.0, 0.0, -VELOCITY)
    sphere = Sphere(RADIUS, 0.25 * MASS, centre, velocity, guided=True, method=method)
    deck.sphere(sphere)
    ball = run(deck, tmp_path).table("impactor_1")

    harder = 2.0 / (3.0 * np.pi) * (3.0 - 2.0 * POISSON) / (1.0 - POISSON) * CONTACT / DEPTH
    force, depth = 4.0 * ball["force"].max() / FORCE, -ball["displacement"].min() / INDENTATION
    time = ball["time"][ball["force"] > 0.0].max() / TIME
    more, less = (0.0, harder), (-harder, 0.0)
    compare.number("largest force", force * FORCE, FORCE, unit="N", bounds=more)
    compare.number("indentation", depth * INDENTATION, INDENTATION, unit="mm", bounds=less)
    compare.number("duration", 1e6 * time * TIME, 1e6 * TIME, unit="µs", bounds=less)
    draw(ball, compare)
    compare.number("rebound", ball["velocity"][-1], VELOCITY, unit="mm/s", rel=1.0e-3)


def draw(ball: Table, compare: Comparison) -> None:
    """Force over time beside that of Hertz' equation of motion, M a = -k d^1.5."""
    step, depth, speed, force = TIME / 4000.0, 0.0, VELOCITY, []
    for _ in range(4000):
        force.append(HERTZ * max(depth, 0.0) ** 1.5)
        speed -= step * force[-1] / MASS
        depth += step * speed
    times = 1e6 * step * np.arange(4000)
    compare.curves(
        "sphere on a half-space",
        ("time [µs]", "force [N]"),
        {"run, four quarters": (1e6 * ball["time"], 4.0 * ball["force"])},
        {"Hertz": (times, np.array(force))},
    )
