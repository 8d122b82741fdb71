"""Elastic impact on a simply supported plate: momentum, energy, and the answer of the plate."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.signal import fftconvolve

from comparison import Comparison
from decks import Deck, Ply, Sphere
from elasticity import CARBON, Array
from exact_plate import CrossPly
from expanded_plate import ExpandedHarmonic
from meshes import plane_weights, regular
from runs import DIGITS, Results, run

MASS, VELOCITY, RADIUS, SIDE, PLY = 2.0e-6, 4.0e3, 8.0, 40.0, 0.25
START = 0.5 * MASS * VELOCITY**2
ANGLES = (0.0, 90.0, 90.0, 0.0)
METHODS = pytest.mark.parametrize("method", [1, 2], ids=["nodes on sphere", "points of plate"])


def impact(
    order: int,
    method: int,
    folder: Path,
    *,
    quads: int = 10,
    time: float = 2.5e-4,
    linear: bool = False,
) -> Results:
    """A [0/90]s plate of 1 mm, struck by a ball and followed until the ball has left."""
    mesh = regular(SIDE, SIDE, quads, quads, 9)
    deck = Deck("elastic impact", time)
    deck.control(linear=linear)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, PLY, angle) for angle in ANGLES], order)
    deck.hold(mesh.where(x=0.0) + mesh.where(x=SIDE), "yz")
    deck.hold(mesh.where(y=0.0) + mesh.where(y=SIDE), "xz")
    deck.histories([mesh.at(0.5 * SIDE, 0.5 * SIDE)], 0.0)
    deck.intervals(impactor=0.0, glstat=0.005 * time, spcforc=0.0)
    centre = (0.5 * SIDE, 0.5 * SIDE, RADIUS + 2.0 * PLY)
    deck.sphere(Sphere(RADIUS, MASS, centre, (0.0, 0.0, -VELOCITY), method=method))
    return run(deck, folder)


@METHODS
@pytest.mark.parametrize("order", [1, 2])
def test_momentum_and_energy_go_where_they_can(
    order: int, method: int, compare: Comparison, tmp_path: Path
) -> None:
    """What the ball loses is the impulse of the force; supports take what ball and plate lose.

    Energy leaves the motion in collisions of the ball with a node only, and never comes back. The
    ball ends slower than it came, as it must: it cannot have more than all energy.
    """
    results = impact(order, method, tmp_path, quads=8)
    ball, energy = results.table("impactor_1"), results.table("energy")
    time, velocity = ball["time"], ball["velocity"]
    impulse = np.trapezoid(ball["force"], time)
    gained = MASS * (velocity[-1] - velocity[0])
    compare.number("impulse of the force", impulse, gained, unit="N s", rel=10.0 * DIGITS)
    supports = results.table("supports")["fz"]
    pushed = np.append(0.0, np.cumsum(0.5 * (supports[1:] + supports[:-1]) * np.diff(time)))
    momentum = energy["momentum z"] - energy["momentum z"][0]
    pushed = pushed[np.isin(time, energy["time"])]
    assert momentum == pytest.approx(pushed, abs=10.0 * DIGITS * MASS * VELOCITY)

    compare.values("total energy", energy["total"], START, unit="mJ", rel=DIGITS)
    assert min(energy[name].min() for name in ("kinetic", "internal", "contact")) >= 0.0
    assert np.diff(energy["contact"]).min() > -DIGITS * START
    assert energy["contact"][-1] < 5.0e-3 * START
    assert 0.0 < velocity[-1] < VELOCITY
    assert ball["force"].min() >= 0.0
    assert ball["force"][-1] == 0.0
    assert np.abs(ball["force x"]).max() < DIGITS * ball["force"].max()


@METHODS
@pytest.mark.parametrize(("order", "share"), [(1, 1.0 / 2.0), (2, 1.0 / 6.0)], ids=["LE1", "LE2"])
def test_first_touch_is_a_plastic_collision(
    order: int, share: float, method: int, compare: Comparison, tmp_path: Path
) -> None:
    """Ball and struck node, of mass m, go on together: m M / (m + M) V^2 / 2 is lost."""
    results = impact(order, method, tmp_path, time=1.0e-6)
    mesh = regular(SIDE, SIDE, 10, 10, 9)
    area = plane_weights(mesh)[mesh.at(0.5 * SIDE, 0.5 * SIDE)]
    node = CARBON.density * area * PLY * share
    lost = results.table("energy")["contact"][1]
    collision = START * node / (node + MASS)
    compare.number("energy lost at the first touch", lost, collision, unit="mJ", rel=1e-8)


def answer(time: Array, force: Array, most: int) -> Array:
    """Deflection of the bottom under a force in the middle, from the bending modes of LE1.

    Harmonics up to `most` half waves along x and y; even ones have a node in the middle.
    """
    plate = CrossPly(SIDE, SIDE, tuple((CARBON, PLY, angle) for angle in ANGLES))
    deflection = np.zeros(len(time))
    for m in range(1, most + 1, 2):
        for n in range(1, most + 1, 2):
            omegas, shapes = ExpandedHarmonic(plate, 1, 1, m, n).modes()
            omega, bottom, top = omegas[0], shapes[2, 0], shapes[-1, 0]
            one = np.sin(omega * time) / omega * (time[1] - time[0])
            deflection += bottom * top * fftconvolve(one, force)[: len(time)]
    return deflection / (0.25 * SIDE * SIDE)


def test_plate_answers_as_its_modes_do(compare: Comparison, tmp_path: Path) -> None:
    """The force of the run, given to the exact bending modes, makes the deflection of the run.

    Modes as short as two quads of 2 mm and shorter answer otherwise: 1 % of the deflection. The
    ball goes where the struck node goes: no gap and no penetration while they touch.
    """
    results = impact(1, 2, tmp_path, quads=20, linear=True)
    ball, nodes = results.table("impactor_1"), results.table("nodes")
    name = next(name for name in nodes.names if name.endswith("bottom uz")).split()[0]
    even = slice(0, -2)  # the last two steps are shorter
    found = nodes[f"{name} bottom uz"][even]
    exact = answer(ball["time"][even], -ball["force"][even], 41)
    close = 1.0e-2 * np.abs(exact).max()
    compare.values("deflection under the sphere", found, exact, unit="mm", abs=close)
    times = 1e6 * ball["time"][even]
    compare.curves(
        "impact on a simply supported plate",
        ("time [µs]", "deflection of the bottom [mm]"),
        {"run": (times, found)},
        {"exact bending modes": (times, exact)},
    )
    touching = ball["force"] > 0.0
    top = nodes[f"{name} top uz"][touching]
    assert ball["displacement"][touching] == pytest.approx(top, abs=DIGITS)
