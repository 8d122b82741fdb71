"""A ball leaves a dent: what it takes off the ball is dissipated, damped or locked in the ply."""

import h5py
import numpy as np
import pytest

from runs import Results

MASS, SPEED, THICKNESS = 4.0e-6, 5.0e3, 1.0
MECHANISMS = ("matrix damage", "ply plasticity", "friction")


def check(results: Results) -> None:
    """The dent is at rest and stays, and the energies are what the ball has lost."""
    energy = results.table("energy")
    struck = 0.5 * MASS * SPEED**2
    assert energy["impactor"][0] == pytest.approx(struck, rel=1.0e-9)
    # the step follows the pressed ply: what a change of it does is of second order
    assert np.abs(energy["error"]).max() < 1.0e-5
    for mechanism in MECHANISMS:
        assert energy[mechanism][-1] > 0.01 * struck
        assert np.diff(energy[mechanism]).min() > -1.0e-6 * struck
    total = sum(energy[mechanism] for mechanism in (*MECHANISMS, "fibre damage"))
    assert energy["dissipated"] == pytest.approx(total, abs=1.0e-8 * struck)
    assert np.all(energy["internal"] > energy["dissipated"] - 1.0e-9 * struck)
    with h5py.File(results.folder / f"{results.job}.vtkhdf") as file:
        root = file["VTKHDF"]
        offsets = root["Steps/PointDataOffsets/displacement"][:]
        rows = root["PointData/displacement"][:, 2]
        count = len(rows) // len(offsets)
        lowest = np.array([rows[start : start + count].min() for start in offsets])
    sunk = results.table("impactor_1")["displacement"].min()
    dent = -lowest[-1]
    # at rest since half of the time, and shallower than the ball has been deep
    assert dent == pytest.approx(-lowest[len(lowest) // 2], rel=1.0e-3)
    assert 0.02 * THICKNESS < dent < -sunk
    # at rest the ply keeps what is locked in: less than the elastic energy of the deepest state
    locked = energy["internal"][-1] - energy["dissipated"][-1]
    assert 0.0 < locked < (energy["internal"] - energy["dissipated"]).max()
    for name in ("damage_matrix", "plastic_strain", "dissipated"):
        assert results.field(name).max() > 0.0
