"""Supports carry the frame's acceleration: each point once, for the first support that holds it."""

import pytest

from runs import DIGITS, Results

NODE = 2.0e-9 * 4.0 * 4.0 * 1.5 / 4.0  # mass above a node
# shares of it at the faces and in the middle of a ply of order 2, by Simpson's rule
FACE, MIDDLE = 1.0 / 6.0, 4.0 / 6.0
AX, AY, AZ = 1.0e7, 2.0e7, 4.0e7

# nodes whose mass each carries, and the share of the thickness
EXPECTED = {
    "spc 1 fz": 2 * NODE * AZ,
    "spc 2 fx": 3 * NODE * AX,
    "spc 2 fz": 2 * NODE * AZ,
    "face 3 z 0 fy": 4 * MIDDLE * NODE * AY,
    "spc 3 fy": 4 * 2 * FACE * NODE * AY,
    "face motion 4 bottom fx": FACE * NODE * AX,
    "face motion 4 top fx": FACE * NODE * AX,
    "fx": (3 + 2 * FACE) * NODE * AX,
    "fy": 4 * NODE * AY,
    "fz": 4 * NODE * AZ,
}


def check(results: Results) -> None:
    """At time zero nothing is strained: forces are mass times acceleration."""
    supports = results.table("supports")
    for name in supports.names[1:]:
        expected = EXPECTED.get(name, 0.0)
        assert supports[name][0] == pytest.approx(expected, rel=DIGITS, abs=0.0), name
    # the middle of node 1 alone is free along x: what the others share sums to the whole
    for axis in "xyz":
        shares = [supports[name] for name in supports.names if name.endswith(f" f{axis}")]
        assert sum(shares) == pytest.approx(supports[f"f{axis}"], rel=DIGITS, abs=DIGITS)
