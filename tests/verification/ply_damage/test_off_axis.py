"""A flaw that is opened along its fibres cracks the ply along them, whatever the mesh lines."""

from __future__ import annotations

from pathlib import Path

from comparison import Comparison
from damage import BAND
from off_axis import SIDE, Tear, torn

# A row of quads in the middle
QUAD = SIDE / 25.0


def test_crack_follows_the_fibres(compare: Comparison, tmp_path: Path) -> None:
    """Direction of the fibres within 5 degrees, and the toughness times the area of the crack.

    The crack is 18 to 24 mm long; its beginning and its end are known to half a quad, 5 %.
    """
    crack = torn(Tear(30.0, QUAD, BAND), tmp_path)
    compare.number("direction of a crack", crack.angle, 30.0, unit="degrees", abs=5.0)
    compare.number("energy of a crack over toughness times area", crack.energy, 1.0, rel=0.05)


def test_line_of_quads_keeps_the_direction(compare: Comparison, tmp_path: Path) -> None:
    """Where only the quads on a line may crack, the energy is that of a free crack.

    Half a quad aside at either end is 2 degrees.
    """
    crack = torn(Tear(30.0, QUAD, BAND, line=True), tmp_path)
    compare.number("direction on a line of quads", crack.angle, 30.0, unit="degrees", abs=2.0)
    compare.number("energy on a line of quads", crack.energy, 1.0, rel=0.05)
