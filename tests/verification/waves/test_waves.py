"""Plane waves in bars of uniaxial strain: stress rho c v, speed c, and a rigid striker."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck, Ply, Sphere
from elasticity import STEEL, stiffness
from meshes import Mesh, regular
from runs import DIGITS, run

SPEED = float(np.sqrt(stiffness(STEEL)[0, 0] / STEEL.density))


LENGTH, WIDTH, THICKNESS = 50.0, 1.0, 1.0


def bar(quads: int, nodes: int, time: float) -> tuple[Deck, Mesh]:
    """A bar along x that moves along x only."""
    mesh = regular(LENGTH, WIDTH, quads, 1, nodes)
    deck = Deck("bar", time)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(STEEL, THICKNESS)], 1)
    deck.hold(range(len(mesh.points)), "yz")
    return deck, mesh


@pytest.mark.parametrize("nodes", [4, 9])
def test_bar_on_a_wall(nodes: int, compare: Comparison, tmp_path: Path) -> None:
    """A bar flies against a wall that holds it: the force is rho c v A until 2 L / c.

    The front rings over a few elements, its mean does not: 0.5 % over the middle of the time. The
    impulse has turned the bar round by 2 L / c, but for what its last elements ring: 1 %.
    """
    velocity, there_and_back = 5.0e3, 2.0 * LENGTH / SPEED
    deck, mesh = bar(100, nodes, there_and_back)
    deck.hold(mesh.where(x=0.0), "x")
    deck.velocity(range(len(mesh.points)), (-velocity, 0.0, 0.0))
    deck.intervals(spcforc=0.0)
    supports = run(deck, tmp_path).table("supports")

    area = WIDTH * THICKNESS
    force = STEEL.density * SPEED * velocity * area
    steady = (supports["time"] > 0.2 * there_and_back) & (supports["time"] < 0.8 * there_and_back)
    found = supports["fx"][steady].mean()
    compare.number("force of a bar on a wall", found, force, unit="N", rel=5.0e-3)
    impulse = np.trapezoid(supports["fx"], supports["time"])
    turned = 2.0 * STEEL.density * area * LENGTH * velocity
    compare.number("impulse of a bar on a wall", impulse, turned, unit="N s", rel=1.0e-2)
    times = np.array([0.0, 0.0, there_and_back])
    compare.curves(
        f"bar on a wall, quads of {nodes} nodes",
        ("time [µs]", "force [N]"),
        {"run": (1e6 * supports["time"], supports["fx"])},
        {"rho c v A": (1e6 * times, np.array([0.0, force, force]))},
    )


def pulse_error(quads: int, nodes: int, folder: Path) -> tuple[float, float]:
    """Largest error of a pulse after L / 2, as a share of it, and what dispersion predicts.

    A bell of velocity parts in two halves that run left and right and keep their shape
    (d'Alembert). Linear elements of length h with lumped masses and central differences of step dt
    delay a wave of number k by c t k^3 (h^2 - c^2 dt^2) / 24, quadratic ones by
    -c t k^3 c^2 dt^2 / 24: the error is that length times the third derivative of the bell.
    """
    way, start, sigma = 0.5 * LENGTH, 0.25 * LENGTH, 3.0
    deck, mesh = bar(quads, nodes, 1.3 * way / SPEED)  # before the left half comes back
    bell = np.exp(-0.5 * ((mesh.points[:, 0] - start) / sigma) ** 2)
    deck.velocities(np.outer(2.0e3 * bell, [1.0, 0.0, 0.0]))
    there = mesh.at(start + way, 0.0)
    deck.histories([there], 0.0)
    deck.intervals(glstat=0.0)
    results = run(deck, folder)
    history = results.table("nodes")
    travelled = SPEED * history["time"]
    place = (travelled - way) / sigma
    exact = np.exp(-0.5 * place**2)
    size = LENGTH / quads if nodes == 4 else 0.0
    step = SPEED * float(np.median(results.table("energy")["step"]))
    third = (3.0 * place - place**3) * exact / sigma**3
    predicted = np.abs(travelled * (size**2 - step**2) / 24.0 * third).max()
    error = np.abs(history[f"n{there + 1} top vx"] / 1.0e3 - exact).max()
    return float(error), float(predicted)


@pytest.mark.parametrize("quads", [100, 200])
@pytest.mark.parametrize("nodes", [4, 9])
def test_pulse_travels_at_the_speed_of_sound(
    nodes: int, quads: int, compare: Comparison, tmp_path: Path
) -> None:
    """What is wrong after half the bar is the dispersion of the scheme, below 0.5 %.

    The prediction is its first term; the next one is smaller by (k h)^2, 3 % here.
    """
    error, predicted = pulse_error(quads, nodes, tmp_path)
    assert predicted < 5.0e-3
    compare.number("error of a pulse, beside the dispersion", error, predicted, rel=0.03)


@pytest.mark.parametrize(("order", "layers"), [(1, 100), (2, 50), (3, 30), (4, 25)])
def test_rigid_mass_on_a_free_bar(
    order: int, layers: int, compare: Comparison, tmp_path: Path
) -> None:
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
    close = 1.0e-2 * velocity
    compare.values("velocity of a mass on a bar", found[during], exact[during], abs=close)
    if order == 2:
        compare.curves(
            "rigid mass on a free bar",
            ("time [µs]", "velocity [m/s]"),
            {"run": (1e6 * time, 1e-3 * found)},
            {"exp(-Z t / M)": (1e6 * time[during], 1e-3 * exact[during])},
        )
    last = -velocity * np.exp(-2.0 * mass / striker)
    assert found[-1] == pytest.approx(last, abs=1.0e-2 * velocity)
    assert history["force"][-1] == 0.0
    momentum = results.table("energy")["momentum z"]
    exact = np.full(len(momentum), -striker * velocity)
    assert momentum == pytest.approx(exact, rel=DIGITS)
