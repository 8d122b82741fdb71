"""A free plate stays behind a frame that accelerates: - a t^2 / 2."""

import pytest

from runs import DIGITS, Results

ACCELERATION = 3.0e8


def check(results: Results) -> None:
    """Central differences are exact for a constant acceleration; nothing is strained."""
    nodes = results.table("nodes")
    left = -0.5 * ACCELERATION * nodes["time"] ** 2
    for name in ("n1 bottom uz", "n1 top uz", "n9 bottom uz", "n9 top uz"):
        assert nodes[name] == pytest.approx(left, rel=3.0 * DIGITS, abs=1e-15)
    energy = results.table("energy")
    assert energy["internal"].max() < 1e-9 * energy["kinetic"].max()
