"""Momentum of a free plate: pressure times area times time, downwards."""

import numpy as np
import pytest

from runs import DIGITS, Results

PRESSURE, AREA = 0.03, 16.0
DENSITY_PER_AREA = 2.0e-9 * 1.5


def check(results: Results) -> None:
    """Exact for a constant force; the faces swing about the mean by p h / E, 1e-3 of it here."""
    energy = results.table("energy")
    assert energy["time"][-1] == pytest.approx(1.0e-5, rel=DIGITS)
    exact = -PRESSURE * AREA * energy["time"]
    assert energy["momentum z"] == pytest.approx(exact, rel=3.0 * DIGITS, abs=1e-18)
    nodes = results.table("nodes")
    for name in ("n1", "n9"):
        mean = 0.5 * (nodes[f"{name} bottom uz"] + nodes[f"{name} top uz"])
        fallen = -0.5 * PRESSURE / DENSITY_PER_AREA * nodes["time"] ** 2
        assert mean == pytest.approx(fallen, abs=5e-3 * np.abs(fallen).max())
