"""A ball that moves as prescribed: quasi-static indentation of a plate."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from decks import Deck, Ply, Sphere
from elasticity import isotropic
from meshes import disc
from runs import DIGITS, run

DENSITY, YOUNG, POISSON = 7.85e-9, 210.0e3, 0.3
RADIUS, THICKNESS, SPEED, END = 40.0, 3.0, 200.0, 1.0e-3
BENDING = YOUNG * THICKNESS**3 / (12.0 * (1.0 - POISSON**2))


@pytest.mark.parametrize("quantity", [0, 2], ids=["velocity", "displacement"])
def test_indentation_of_a_clamped_disc(quantity: int, tmp_path: Path) -> None:
    """The force of a thin plate half-way to its rim, and the work of the ball.

    w = P R^2 / 16 pi D (1 - s^2 + 2 s^2 ln s) and P / 2 pi k G h ln(1 / s) of shear at r = s R.
    """
    mesh = disc(4, 6, RADIUS, 0.5 * RADIUS)
    deck = Deck("indentation", END)
    frequency = 10.2 / RADIUS**2 * np.sqrt(BENDING / (DENSITY * THICKNESS))
    deck.control(linear=True, damping=frequency)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(DENSITY, YOUNG, POISSON), THICKNESS)], 2)
    deck.hold(np.flatnonzero(np.hypot(*mesh.points.T) > 0.999 * RADIUS), "xyz")
    shares = np.linspace(0.0, 1.0, 41)
    # it starts, moves and comes to rest: damping bears nothing at the end
    moving = np.clip(5.0 * shares, 0.0, 1.0) - np.clip(5.0 * shares - 2.5, 0.0, 1.0)
    rise = 0.5 * (1.0 - np.cos(np.pi * moving))
    if quantity == 0:
        points = list(zip(END * shares, -SPEED * rise, strict=True))
    else:
        depth = np.append(0.0, np.cumsum(0.5 * (rise[1:] + rise[:-1]) * np.diff(shares)))
        points = list(zip(END * shares, -SPEED * END * depth, strict=True))
    curve = deck.curve([(float(t), float(value)) for t, value in points])
    half = mesh.at(0.5 * RADIUS, 0.0)
    deck.histories([half], 0.0)
    deck.intervals(impactor=0.0, glstat=0.01 * END)
    deck.sphere(
        Sphere(
            10.0,
            1.0e-6,
            (0.0, 0.0, 10.0 + 0.5 * THICKNESS),
            guided=True,
            method=1,
            friction=(0.3,),
            curves=(0, 0, curve),
            quantity=quantity,
        )
    )
    results = run(deck, tmp_path)
    ball, energy, nodes = (results.table(name) for name in ("impactor_1", "energy", "nodes"))
    assert ball["displacement"][-1] == pytest.approx(-0.5 * SPEED * END, rel=1.0e-6)
    late = ball["time"] > 0.9 * END
    force = (ball["impulse z"][-1] - ball["impulse z"][late][0]) / np.ptp(ball["time"][late])
    deflection = -nodes[f"n{half + 1} bottom uz"][late].mean()
    shear = 5.0 / 6.0 * YOUNG / (2.0 * (1.0 + POISSON)) * THICKNESS
    compliance = RADIUS**2 / (16.0 * np.pi * BENDING) * (0.75 + 0.5 * np.log(0.5))
    compliance += np.log(2.0) / (2.0 * np.pi * shear)
    assert deflection == pytest.approx(force * compliance, rel=0.02)
    # the impulse of a step acts at the mean of the velocities before and after
    speed = ball["velocity"]
    middle = np.append(0.0, 0.5 * (speed[1:] + speed[:-1]))
    work = -np.cumsum(np.diff(ball["impulse z"], prepend=0.0) * middle)
    assert ball["absorbed"] == pytest.approx(work, abs=1.0e-7 * work[-1])
    given = (ball["absorbed"] + ball["kinetic"])[np.isin(ball["time"], energy["time"])]
    assert energy["external"] == pytest.approx(given, abs=DIGITS * work[-1])
    # the last two steps are shorter, where damping in contact is not balanced to the last digit
    assert np.abs(energy["error"][:-2]).max() < 1.0e-12
