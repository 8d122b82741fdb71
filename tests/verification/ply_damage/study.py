"""Cracks of a ply whose flaw is opened, on a mesh along x and y: direction and energy, as a table.

.venv/bin/python tests/verification/ply_damage/study.py [FOLDER]

Rows are printed as they come; a run takes from seconds to a minute, the whole some minutes.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/support"))

from damage import BAND, POINT  # noqa: E402
from off_axis import SIDE, Tear, torn  # noqa: E402

# Sides of the quads, such that a row of them lies in the middle
QUAD, FINE = SIDE / 25.0, SIDE / 41.0
HEAD = "| fibres [degrees] | quad [mm] | choice | crack [degrees] | width [mm] | energy |"
# Other openings of the flaw
OPENINGS = (0.12, 0.14)
# An ellipse along the fibres, and a width of bands for it
RADII, WIDTH = (2.9, 0.64), 1.0


def variants() -> Iterator[tuple[str, Tear]]:
    """What is chosen, and how the ply is torn."""
    for angle in (0.0, 30.0, 45.0):
        yield "`LRULE` 0, length of the quad", Tear(angle, QUAD, BAND)
        yield "the same on a line of quads", Tear(angle, QUAD, BAND, line=True)
        yield "`LRULE` 1, length of the point", Tear(angle, QUAD, POINT)
    name = f"`R1` {RADII[0]}, `R2` {RADII[1]}, `LSTAR` {WIDTH}"
    yield name, Tear(30.0, QUAD, radii=RADII, band=WIDTH)
    for angle in (30.0, 45.0):
        yield "`LRULE` 0, smaller quads", Tear(angle, FINE, BAND)
        for opening in OPENINGS:
            for quad in (QUAD, FINE):
                name = f"`LRULE` 0, opening of {opening:g} mm"
                yield name, Tear(angle, quad, BAND, opening=opening)


def rows(folder: Path) -> Iterator[str]:
    """The table row by row; energy over toughness times area."""
    folder.mkdir(parents=True, exist_ok=True)
    yield HEAD
    yield "|" + " ---: | ---: | --- |" + " ---: |" * 3
    for name, tear in variants():
        crack = torn(tear, folder)
        found = f"{crack.angle:.1f} | {crack.width:.2f} | {crack.energy:.2f}"
        found = found.replace("nan", "none")
        yield f"| {tear.angle:g} | {tear.quad:.2f} | {name} | {found} |"


if __name__ == "__main__":
    place = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "results/study/ply_damage"
    for line in rows(place):
        sys.stdout.write(line + "\n")
        sys.stdout.flush()
