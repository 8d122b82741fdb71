"""A ply torn across its fibres cracks along them, whatever the lines of its mesh."""

from __future__ import annotations

from pathlib import Path

import pytest

from comparison import Comparison
from damage import BAND
from off_axis import FLAW, SIDE, Tear, torn

# A row of quads in the middle
QUAD = SIDE / 25.0


@pytest.mark.parametrize("angle", [30.0, 45.0])
def test_crack_follows_the_fibres(angle: float, compare: Comparison, tmp_path: Path) -> None:
    """The direction is that of the fibres within 5 degrees, half a quad at the end of the crack.

    The crack is 8 quads long at either side of the flaw; half a quad aside is 4 degrees.
    """
    crack = torn(Tear(angle, QUAD, BAND), tmp_path)
    compare.number("direction of a crack", crack.angle, angle, unit="degrees", abs=5.0)
    assert crack.length > 2.0 * FLAW
