"""Plane waves in bars of uniaxial strain: stress rho c v, arrival L / c, and a rigid striker."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from decks import Deck, Ply, Sphere
from elasticity import STEEL, stiffness
from meshes import regular
from runs import DIGITS, run

SPEED = float(np.sqrt(stiffness(STEEL)[0, 0] / STEEL.density))


@pytest.mark.parametrize("nodes", [4, 9])
def test_bar_on_a_wall(nodes: int, tmp_path: Path) -> None:
    """A bar flies against a wall that holds it: the force is rho c v A until 2 L / c.

    The front rings over a few elements, its mean does not: 0.5 % over the middle of the time.
    """
    length, width, thickness, velocity = 50.0, 1.0, 1.0, 5.0e3
    mesh = regular(length, width, 100, 1, nodes)
    there_and_back = 2.0 * length / SPEED
    deck = Deck("bar on a wall", there_and_back)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(STEEL, thickness)], 1)
    every = range(len(mesh.points))
    deck.hold(every, "yz")
    deck.hold(mesh.where(x=0.0), "x")
    deck.velocity(every, (-velocity, 0.0, 0.0))
    middle = mesh.at(0.5 * length, 0.0)
    deck.histories([middle], there_and_back / 2000.0)
    deck.intervals(spcforc=there_and_back / 2000.0)
    results = run(deck, tmp_path)

    area = width * thickness
    force = STEEL.density * SPEED * velocity * area
    supports = results.table("supports")
    steady = (supports["time"] > 0.2 * there_and_back) & (supports["time"] < 0.8 * there_and_back)
    assert supports["fx"][steady].mean() == pytest.approx(force, rel=5.0e-3)
    impulse = np.trapezoid(supports["fx"], supports["time"])
    assert impulse == pytest.approx(2.0 * STEEL.density * area * length * velocity, rel=1.0e-2)

    history = results.table("nodes")
    stopped = np.argmax(history[f"n{middle + 1} top vx"] > -0.5 * velocity)
    assert history["time"][stopped] == pytest.approx(0.5 * length / SPEED, rel=1.0e-2)


@pytest.mark.parametrize(("order", "layers"), [(1, 100), (2, 50), (3, 30), (4, 25)])
def test_rigid_mass_on_a_free_bar(order: int, layers: int, tmp_path: Path) -> None:
    """A central impact of two free bodies with a closed form.

    A rigid mass M strikes the end of a bar of mass m that stands along z: with Z = rho c A its
    velocity falls as exp(-Z t / M) until the wave is back from the free end, at 2 L / c, and parts
    them. A sphere of 100 m is flat over the bar: its nine points are hit within one step.
    """
    length, side, velocity, radius = 50.0, 1.0, 1.0e3, 1.0e5
    mass = STEEL.density * side * side * length
    striker = 2.0 * mass
    there_and_back = 2.0 * length / SPEED
    mesh = regular(side, side, 1, 1, 9)
    deck = Deck("rigid mass on a bar", 1.3 * there_and_back)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(STEEL, length)], order, layers)
    deck.hold(range(9), "xy")
    centre = (0.5 * side, 0.5 * side, 0.5 * length + radius)
    deck.sphere(Sphere(radius, striker, centre, (0.0, 0.0, -velocity)))
    deck.intervals(impactor=0.0, glstat=0.0)
    results = run(deck, tmp_path)

    history = results.table("impactor_1")
    time, found = history["time"], history["velocity"]
    impedance = STEEL.density * SPEED * side * side
    during = time < 0.98 * there_and_back
    exact = -velocity * np.exp(-impedance * time / striker)
    # the front is as wide as a few layers: 1 % of the velocity
    assert found[during] == pytest.approx(exact[during], abs=1.0e-2 * velocity)
    last = -velocity * np.exp(-2.0 * mass / striker)
    assert found[-1] == pytest.approx(last, abs=1.0e-2 * velocity)
    assert history["force"][-1] == 0.0
    momentum = results.table("energy")["momentum z"]
    exact = np.full(len(momentum), -striker * velocity)
    assert momentum == pytest.approx(exact, rel=DIGITS)
