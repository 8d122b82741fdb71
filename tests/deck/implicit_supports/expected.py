"""The energy balance closes over supports that share the inertia of columns; steps are long."""

import numpy as np
import pytest

from runs import Results

STIFFNESS, DENSITY, PLY = 70000.0, 2.0e-9, 1.0
# that a wave needs through a ply: explicit steps with order 2 are shorter than half of it
PASSAGE = PLY * np.sqrt(DENSITY / STIFFNESS)
BIRTH, PULL = 2.0e-5, 100.0 - 2.0 * 300.0


def check(results: Results) -> None:
    """The balance is an identity of the scheme; before the motion, supports give the momentum."""
    energy, supports = results.table("energy"), results.table("supports")
    assert energy["step"][1:-1].min() > 2.0 * PASSAGE
    assert energy["external"].max() > 0.0
    assert np.abs(energy["error"]).max() < 1.0e-9

    free = energy["time"] <= BIRTH
    time, force = energy["time"][free], supports["fz"][free] + PULL
    impulse = np.concatenate([[0.0], np.cumsum(np.diff(time) * 0.5 * (force[1:] + force[:-1]))])
    momentum = energy["momentum z"][free]
    assert momentum == pytest.approx(impulse, abs=1.0e-8 * np.abs(impulse).max())
