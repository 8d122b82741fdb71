"""Cracks of a ply with a flaw on a mesh along x and y: direction and energy, as a table.

.venv/bin/python tests/verification/ply_damage/study.py [FOLDER]

Rows are printed as they come; a run takes from seconds to half a minute, the whole some minutes.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/support"))

from damage import BAND, POINT, ROOT_POINT, ROOT_QUAD  # noqa: E402
from off_axis import Tear, torn  # noqa: E402

# Side of the quads, such that a row of them lies in the middle
QUAD = 0.96
RULES = {
    BAND: "`LRULE` 0, length of the quad",
    POINT: "`LRULE` 1, length of the point",
    ROOT_POINT: "`LRULE` 2, root of the point",
    ROOT_QUAD: "`LRULE` 3, root of the quad",
}
DROPS = 2  # SNAP
RADII = (2.0, 0.4)
HEAD = "| fibres [degrees] | quad [mm] | choice | crack [degrees] | width [mm] | energy |"


def variants() -> Iterator[tuple[str, Tear]]:
    """What is chosen, and how the ply is torn."""
    for angle in (0.0, 30.0, 45.0):
        for rule, name in RULES.items():
            yield name, Tear(angle, QUAD, rule)
        yield f"{RULES[POINT]}, `SNAP` 2", Tear(angle, QUAD, POINT, DROPS)
        yield f"{RULES[POINT]}, `R1` 2, `R2` 0.4", Tear(angle, QUAD, POINT, radii=RADII)


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
