"""A face that meets a flat impactor all at once feels a uniform pressure, until a wave returns."""

import numpy as np
import pytest

from runs import Results

YOUNG, DENSITY, SPEED = 70000.0, 2.0e-9, 5000.0
RADIUS, AXIS = 2.0e7, (3.0, 5.0)
SIDE, TOP = 8.0, 0.5
AREA, POINTS = SIDE**2, 25

# The corner of the plate that is farthest from the axis lies below the sphere by this much
SAG = ((SIDE - AXIS[0]) ** 2 + AXIS[1] ** 2) / (2.0 * RADIUS)


def check(results: Results) -> None:
    """Area, rows, pressure of a plane wave, and a centre that is the plate's, not the axis."""
    contact = results.table("contact")
    sphere = results.table("impactor_7")
    time = contact["time"]
    assert np.array_equal(time, sphere["time"])
    area, rows, pressure, x, y, z = (
        contact[f"impactor 7 {name}"] for name in ("area", "rows", "pressure", "x", "y", "z")
    )
    assert not any(column[0] for column in (area, rows, pressure, x, y, z))
    assert area[1:] == pytest.approx(np.full(area.size - 1, AREA), rel=1.0e-9)
    assert np.all(rows[1:] == POINTS)
    assert np.array_equal(rows, sphere["contacts"])

    # points meet the sphere later by the sag than under its axis: a share of a step
    step = time[1]
    late = SAG / (SPEED * step)
    force = sphere["force"]
    mean = force[1:] / AREA
    assert np.all(pressure[1:] >= mean * (1.0 - 1.0e-9))
    assert np.all(pressure[1:] <= mean * (1.0 + late))
    for place in (x, y):
        assert place[1:] == pytest.approx(np.full(area.size - 1, 0.5 * SIDE), abs=0.5 * SIDE * late)
    assert z[1:] == pytest.approx(TOP + sphere["displacement"][1:], abs=SAG)

    # mean of what rings, with the front between two steps
    steps = np.diff(time)
    impulse = float(np.sum(mean * steps))
    wave = np.sqrt(YOUNG * DENSITY) * SPEED
    assert impulse / time[-1] == pytest.approx(wave, rel=(1.0 + late) * step / time[-1])
