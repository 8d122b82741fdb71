"""Oblique rebound of a ball: what Newton and Coulomb say of rigid bodies."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, Deck, Ply, Sphere
from elasticity import isotropic
from meshes import regular
from runs import DIGITS, run

RADIUS, MASS = 8.0, 1.0e-5
SIDE, THICKNESS = 9.0, 1.0
FALL, FRICTION = 3830.0, 0.3
#: Some half periods of the ball on the column of plate below a quad, E A / h
YOUNG = 210.0e3
END = 3.0 * np.pi * np.sqrt(MASS * THICKNESS / (YOUNG * 9.0))


@pytest.mark.parametrize("method", [1, 2], ids=["nodes on sphere", "points of plate"])
@pytest.mark.parametrize("rotates", [False, True], ids=["no rotation", "solid ball"])
@pytest.mark.parametrize("along", [1.0e4, 2.0e3], ids=["slides", "sticks"])
def test_oblique_rebound(
    method: int, rotates: bool, along: float, compare: Comparison, tmp_path: Path
) -> None:
    """F4 and F5: mu (1 + e) v_n or none of it is left; a ball that sticks rolls with 5/7.

    All points of the face are held along it, so that it is elastic along z only, as the theory of
    rigid bodies has it. The coefficient of restitution is that of the run.
    """
    mesh = regular(SIDE, SIDE, 3, 3, 9)
    deck = Deck("oblique rebound", END)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(7.85e-9, YOUNG, 0.3), THICKNESS)], 2)
    deck.hold(range(len(mesh.points)), "xy")
    deck.hold_face(range(len(mesh.points)), BOTTOM, "z")
    deck.intervals(glstat=0.0, impactor=0.0)
    centre = (0.5 * SIDE, 0.5 * SIDE, RADIUS + 0.5 * THICKNESS)
    deck.sphere(
        Sphere(
            RADIUS,
            MASS,
            centre,
            (0.0, along, -FALL),
            method=method,
            friction=(FRICTION,),
            rotates=rotates,
        )
    )
    results = run(deck, tmp_path)
    ball, energy = results.table("impactor_1"), results.table("energy")
    assert ball["force"][-1] == 0.0
    back, left = ball["velocity"][-1], ball["velocity y"][-1]
    assert 0.9 * FALL < back < 1.01 * FALL
    surface = -RADIUS * ball["angular velocity x"][-1]
    slips = FRICTION * (FALL + back)
    limit = 3.5 * slips if rotates else slips
    assert (along > limit) == (along == 1.0e4)
    if along > limit:
        expected, rolling = along - slips, 2.5 * slips if rotates else 0.0
    else:
        expected = rolling = 5.0 / 7.0 * along if rotates else 0.0
    # the ball moves over the face in contact, whose normal tilts under it
    close = 0.01 * along
    compare.number("speed along the face after rebound", left, expected, unit="mm/s", abs=close)
    assert surface == pytest.approx(rolling, abs=close)
    lost = 0.5 * MASS * (along**2 + FALL**2 - left**2 - back**2 - 0.4 * surface**2)
    left_in_plate = energy["kinetic"][-1] + energy["internal"][-1]
    assert ball["friction"][-1] == pytest.approx(lost - left_in_plate, rel=0.01)
    speeds = [ball[f"velocity{axis}"] for axis in ("", " x", " y")]
    spins = [ball[f"angular velocity {axis}"] for axis in "xyz"]
    kinetic = 0.5 * MASS * np.square(speeds).sum(axis=0)
    kinetic += 0.5 * 0.4 * MASS * RADIUS**2 * np.square(spins).sum(axis=0)
    assert ball["kinetic"] == pytest.approx(kinetic, rel=10 * DIGITS)
    assert ball["absorbed"] == pytest.approx(kinetic[0] - kinetic, abs=DIGITS * kinetic[0])
    assert energy["contact friction"] == pytest.approx(ball["friction"], rel=DIGITS)
    assert np.abs(energy["error"]).max() < 1.0e-12
    for axis in "xyz":
        column = "velocity" if axis == "z" else f"velocity {axis}"
        gained = MASS * (ball[column] - ball[column][0])
        assert ball[f"impulse {axis}"] == pytest.approx(gained, abs=1.0e-8 * MASS * FALL)
