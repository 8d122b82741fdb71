"""Balls that slide, roll and rebound: the closed forms of rigid bodies with Coulomb friction."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck, Ply, Sphere
from elasticity import isotropic
from meshes import Mesh, regular
from runs import DIGITS, Table, run

STEEL = isotropic(7.85e-9, 210.0e3, 0.3)
RADIUS, MASS = 8.0, 1.0e-5
INERTIA = 0.4 * MASS * RADIUS**2
GRAVITY, SPEED, FRICTION = 1.0e7, 1000.0, 0.3
SIDE, THICKNESS = 8.0, 1.0


def held_plate(end: float, quads: int = 4) -> tuple[Deck, Mesh]:
    """A plate whose points are all held: a rigid floor."""
    mesh = regular(SIDE, SIDE, quads, quads, 9)
    deck = Deck("a ball on a floor", end)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(STEEL, THICKNESS)], 1)
    deck.hold(range(len(mesh.points)), "xyz")
    deck.intervals(glstat=0.0, impactor=0.0)
    return deck, mesh


def ball(**changes: object) -> Sphere:
    """A ball that touches the floor at its middle."""
    centre = (0.5 * SIDE + 0.3, 0.5 * SIDE - 0.1, RADIUS + 0.5 * THICKNESS)
    return replace(Sphere(RADIUS, MASS, centre, method=1, friction=(FRICTION,)), **changes)


def balanced(energy: Table) -> None:
    """The energy balance closes, and nothing is gained by contact or friction."""
    assert np.abs(energy["error"]).max() < 1.0e-12
    largest = max(energy["impactor"].max(), np.abs(energy["external"]).max())
    for name in ("contact friction", "contact"):
        assert np.all(np.diff(energy[name]) >= -1.0e-9 * largest), name


def test_ball_that_cannot_rotate_slides_until_it_stops(compare: Comparison, tmp_path: Path) -> None:
    """F1: after v / mu g and v^2 / 2 mu g; friction has all of the energy."""
    stop = SPEED / (FRICTION * GRAVITY)
    deck, _ = held_plate(1.2 * stop)
    deck.sphere(ball(velocity=(SPEED, 0.0, 0.0), gravity=-GRAVITY, rotates=False))
    results = run(deck, tmp_path)
    sphere, energy = results.table("impactor_1"), results.table("energy")
    step = np.diff(sphere["time"]).max()
    stopped = sphere["time"][np.argmax(sphere["velocity x"] < 1.0e-9 * SPEED)]
    compare.number("time until it stops", stopped, stop, unit="s", abs=2.0 * step)
    way, close = sphere["displacement x"][-1], 2.0 * step * SPEED
    compare.number("way until it stops", way, 0.5 * SPEED * stop, unit="mm", abs=close)
    assert sphere["velocity x"][-1] == pytest.approx(0.0, abs=1.0e-12 * SPEED)
    kinetic = 0.5 * MASS * SPEED**2
    assert sphere["friction"][-1] == pytest.approx(kinetic, rel=2.0 * step / stop)
    assert energy["contact friction"] == pytest.approx(sphere["friction"], rel=DIGITS)
    balanced(energy)


def test_ball_slides_until_it_rolls(compare: Comparison, tmp_path: Path) -> None:
    """F2: after 2 v / 7 mu g at 5/7 v; friction has 2/7 of the energy, and takes no more."""
    rolls = 2.0 * SPEED / (7.0 * FRICTION * GRAVITY)
    deck, _ = held_plate(2.0 * rolls)
    deck.sphere(ball(velocity=(0.6 * SPEED, -0.8 * SPEED, 0.0), gravity=-GRAVITY))
    results = run(deck, tmp_path)
    sphere, energy = results.table("impactor_1"), results.table("energy")
    step = np.diff(sphere["time"]).max()
    share = step / rolls
    # friction acts where the trial position of a step is, which gravity brings below the floor
    digits = 2.0 * GRAVITY * step**2 / RADIUS
    rolling = sphere["velocity x"][-1]
    compare.number("speed of rolling", rolling, 0.6 * 5.0 / 7.0 * SPEED, unit="mm/s", rel=digits)
    assert sphere["velocity y"][-1] == pytest.approx(-0.8 * 5.0 / 7.0 * SPEED, rel=digits)
    assert RADIUS * sphere["angular velocity y"][-1] == pytest.approx(
        sphere["velocity x"][-1], rel=digits
    )
    assert RADIUS * sphere["angular velocity x"][-1] == pytest.approx(
        -sphere["velocity y"][-1], rel=digits
    )
    lost = 2.0 / 7.0 * 0.5 * MASS * SPEED**2
    rubbed = sphere["friction"][-1]
    compare.number("work until it rolls", rubbed, lost, unit="mJ", rel=2.0 * share)
    times = sphere["time"]
    slowed = np.maximum(0.6 * (SPEED - FRICTION * GRAVITY * times), 0.6 * 5.0 / 7.0 * SPEED)
    compare.curves(
        "ball that slides until it rolls",
        ("time [µs]", "velocity along x [mm/s]"),
        {"run": (1e6 * times, sphere["velocity x"])},
        {"theory": (1e6 * times, slowed)},
    )
    half = sphere["time"] < 0.5 * rolls
    assert np.hypot(sphere["force x"], sphere["force y"])[1:][half[1:]] == pytest.approx(
        FRICTION * sphere["force"][1:][half[1:]], rel=DIGITS
    )
    late = sphere["time"] > 1.1 * rolls
    assert np.ptp(sphere["friction"][late]) == 0.0
    balanced(energy)


@pytest.mark.parametrize(
    ("degrees", "friction", "along", "spin"),
    [(30.0, 0.2, 5.0 / 7.0, 5.0 / 7.0), (30.0, 0.1, None, None), (45.0, 0.2, None, None)],
)
def test_ball_on_an_incline(
    degrees: float,
    friction: float,
    along: float | None,
    spin: float | None,
    compare: Comparison,
    tmp_path: Path,
) -> None:
    """F3: rolls with 5/7 g sin if tan <= 3.5 mu; else slides with g (sin - mu cos)."""
    end = 1.0e-4
    sine, cosine = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
    deck, _ = held_plate(end)
    deck.sphere(ball(gravity=-GRAVITY * cosine, weight=(GRAVITY * sine, 0.0), friction=(friction,)))
    results = run(deck, tmp_path)
    sphere, energy = results.table("impactor_1"), results.table("energy")
    if along is None:
        assert np.tan(np.radians(degrees)) > 3.5 * friction
        speed, surface = sine - friction * cosine, 2.5 * friction * cosine
    else:
        assert np.tan(np.radians(degrees)) <= 3.5 * friction
        speed = surface = along * sine
    time = sphere["time"][-1] - 0.5 * np.diff(sphere["time"])[-1]  # velocities are of half steps
    found, theory = sphere["velocity x"][-1], speed * GRAVITY * time
    compare.number("speed of a ball on an incline", found, theory, unit="mm/s", rel=1.0e-3)
    assert RADIUS * sphere["angular velocity y"][-1] == pytest.approx(
        surface * GRAVITY * time, rel=1.0e-3
    )
    if along is not None:
        assert sphere["friction"][-1] == 0.0
    assert np.abs(energy["error"]).max() < 1.0e-12
