"""Energy that failed faces give to a plate as they open and close, as a table for the manual.

.venv/bin/python tests/verification/reclosing/study.py [FOLDER]
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/support"))

from reclosing import BOND, WHOLE, Course, energies, mean_kinetic  # noqa: E402

SHARES = (0.5, 0.7, 0.9)
LONG = 1.0e-3


def rows(folder: Path) -> Iterator[str]:
    """Mean kinetic energy over that of a small step; energy lost in failing likewise."""
    folder.mkdir(parents=True, exist_ok=True)
    yield "| penalty | share of the step | kinetic, all failed | lost, intact first |"
    yield "| --- | --- | --- | --- |"
    for bond, name in ((BOND, "falls to 10 %"), (WHOLE, "stays whole")):
        free = mean_kinetic(energies(Course(bond, 0.25, LONG), folder))
        hit = lost(Course(bond, 0.25, intact=True, pressure=100.0), folder)
        for share in SHARES:
            gain = mean_kinetic(energies(Course(bond, share, LONG), folder)) / free
            more = lost(Course(bond, share, intact=True, pressure=100.0), folder) / hit
            yield f"| {name} | {share} | {gain:.3f} | {more:.3f} |"


def lost(course: Course, folder: Path) -> float:
    """Energy that the interfaces spent."""
    return float(energies(course, folder)["delamination"][-1])


if __name__ == "__main__":
    place = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "results/study/reclosing"
    for line in rows(place):
        sys.stdout.write(line + "\n")
        sys.stdout.flush()
