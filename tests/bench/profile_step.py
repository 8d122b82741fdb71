"""Where the time of a step goes at coupon size, by the profiler of Linux.

    .venv/bin/python tests/bench/profile_step.py [--rows N] [--print]

Takes a minute; needs `perf` (linux-perf of Debian) and build/release. Samples of processor time are
those of two runs of the frozen deck of 25 J that end some rows of energies apart, one less the
other, so that setting up and writing fields do not count. Puts a table into manual/kernels.md
between its marks. No test: nothing is compared; `test_profile_step.py` tries what reads samples.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))

from coupon import ROW, STATES, thawed  # noqa: E402
from run import BUILD, KERNELS, machine, publish, table  # noqa: E402

DECK, FREQUENCY = "t700gc_25J_1mm", 2000
MARKS = ("<!-- profile -->", "<!-- /profile -->")
# parts of a step, by what the names of their procedures begin with; the first that fits
PARTS = (
    ("law of plies", r"law_ply_|law_law_"),
    ("columns of plies to points and back", r"element_plate_q\d_le\d_\w*?(gather|scatter)"),
    ("strain, flux and forces of plies", r"element_plate_q\d_le\d"),
    ("axes of interfaces and moments", r"element_interface_(axes|rotation)"),
    ("rows of energies", r"\w*(stored_energy|dissipation|dissipated|energ|losses|exact_sum)"),
    ("law and forces of interfaces", r"element_interface_|law_cohesive"),
    ("motion", r"method_central_difference|method_accelerations"),
    ("inertia of springs", r"method_implicit_"),
    ("forces of shared nodes", r"method_forces_MOD_add_shared"),
    ("fixtures", r"method_fixture_step|contact_bodies|contact_solve"),
    ("impactor", r"contact_|method_contact"),
    ("requests to the memory", r"prefetch"),
)


def part_of(symbol: str) -> str:
    """The part of a step that a procedure belongs to."""
    name = re.sub(r"^_*plydyn_", "", symbol)
    for part, beginning in PARTS:
        if re.match(beginning, name):
            return part
    return "other"


def read_samples(told: str) -> Counter[str]:
    """Samples of each part from what `perf report` prints."""
    found: Counter[str] = Counter()
    for line in told.splitlines():
        row = re.match(r"\s*[\d.]+%\s+(\d+)\s+\[(.)\]\s+(\S+)", line)
        if row:
            found["system" if row[2] == "k" else part_of(row[3])] += int(row[1])
    return found


def samples(deck: Path) -> Counter[str]:
    """Samples of a run of a deck on one thread."""
    data = deck.with_suffix(".perf")
    run = [BUILD / "plydyn", "run", deck, "-o", deck.parent, "ncpu=1"]
    subprocess.run(
        ["perf", "record", "-q", "-e", "cpu-clock", "-F", f"{FREQUENCY}", "-o", data, *run],
        check=True,
        capture_output=True,
    )
    words = ["perf", "report", "-i", data, "--stdio", "-n", "--sort", "symbol", "-g", "none"]
    return read_samples(
        subprocess.run(words, check=True, capture_output=True, text=True, errors="replace").stdout
    )


def shares(folder: Path, rows: int) -> list[list[str]]:
    """Share of each part in each state, the largest first."""
    columns = []
    for start, speed in STATES.values():
        short, long = (
            samples(thawed(DECK, folder, end, speed)) for end in (start, start + rows * ROW)
        )
        long.subtract(short)
        whole = sum(long.values())
        columns.append({part: 100.0 * count / whole for part, count in long.items()})
    parts = sorted({*columns[0], *columns[1]}, key=lambda part: -columns[0].get(part, 0.0))
    return [[part, *(f"{column.get(part, 0.0):.1f} %" for column in columns)] for part in parts]


def main() -> None:
    """Measure, and print or write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rows", type=int, default=2, help="rows of energies between both runs")
    parser.add_argument("--print", action="store_true", help="leave the page alone")
    chosen = parser.parse_args()
    if shutil.which("perf") is None:
        raise SystemExit("there is no perf: install linux-perf")
    with tempfile.TemporaryDirectory() as name:
        rows = shares(Path(name), chosen.rows)
    text = table(["part of a step of 25 J on quads of 1 mm", *STATES], rows)
    publish(f"{machine()}\n\n{text}", None if chosen.print else KERNELS, MARKS)


if __name__ == "__main__":
    main()
