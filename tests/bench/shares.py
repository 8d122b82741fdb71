"""What ranks have of a panel: memory that the system measures and that the listing counts.

    .venv/bin/python tests/bench/shares.py [--ranks 1,2,4] [--launcher "srun -n"] [--into PAGE]

Prints a table, or puts it into a page between its marks. Needs build/release and the preprocessor.
No test: nothing is compared with anything.
"""

from __future__ import annotations

import argparse
import os
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))

import jobs  # noqa: E402
import paper  # noqa: E402
from run import BUILD, machine, publish, table  # noqa: E402

SOLVER = BUILD / "plydyn"
MARKS = ("<!-- shares -->", "<!-- /shares -->")
ANYHOW = "mpirun --oversubscribe --allow-run-as-root --bind-to none -n"
# where no time is measured there may be more ranks than cores: those that wait give way
PATIENT = {"OMPI_MCA_mpi_yield_when_idle": "1", "OMP_WAIT_POLICY": "passive"}
# quads along a side of a panel; a few steps are enough
PANELS, STEPS = (80, 156), 3
MEGA = 1.0e-6


def launcher_of(words: str, ranks: int) -> list[str]:
    """What comes before the program; nothing for one rank."""
    return [] if ranks == 1 else [*shlex.split(words), str(ranks)]


def patient() -> dict[str, str]:
    """The environment of ranks that wait for each other on few cores."""
    return {**os.environ, **PATIENT}


def numbers(words: str) -> list[int]:
    """Numbers with commas between them."""
    return [int(word) for word in words.split(",")]


def freedoms_of(quads: int, folder: Path) -> int:
    """Degrees of freedom of a panel."""
    words = [SOLVER, "check", jobs.panel_deck(quads, folder)]
    listing = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    return int(jobs.number(listing, r"degrees of freedom\s+(\d+)"))


def memory(
    quads: int, folder: Path, ranks: list[int], launcher: str
) -> tuple[list[list[str]], paper.Bytes]:
    """Memory of ranks on a panel, a row for each number, and what follows for all but the root."""
    deck = jobs.stopped(jobs.panel_deck(quads, folder), STEPS)
    dump = f"*DATABASE_BINARY_RUNRSF\n{STEPS}\n*END"
    deck.write_text(deck.read_text().replace("*END", dump))
    rows, each = [], {}
    for count in ranks:
        most = jobs.memory(SOLVER, deck, launcher_of(launcher, count), patient())
        counted = paper.counted_memory(deck.with_suffix(".out").read_text())
        if count > 1:
            each[count] = most[1]
        cells = (most[0], most[1] if count > 1 else None, max(counted), sum(counted))
        rows.append(
            [f"{quads} x {quads} quads", f"{count}"]
            + ["–" if x is None else f"{x:.0f}" for x in cells]
        )
    return rows, paper.split_memory(each, MEGA * freedoms_of(quads, folder))


def tables(options: argparse.Namespace) -> str:
    """Measure all panels."""
    heads = ["panel", "ranks", "most, root", "most, others", "counted, a rank", "counted, all"]
    rows, sizes = [], []
    with tempfile.TemporaryDirectory() as name:
        for quads in PANELS:
            rows += memory(quads, Path(name), options.ranks, options.launcher)[0]
            sizes.append(f"{MEGA * freedoms_of(quads, Path(name)):.1f}")
    said = f"Memory of a rank [MB]; {' and '.join(sizes)} million degrees of freedom."
    return "\n\n".join([machine(), said, table(heads, rows)])


def main() -> None:
    """Measure, and print or write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ranks", type=numbers, default=[1, 2, 4, 8])
    parser.add_argument("--launcher", default=ANYHOW, help='the number follows, as "srun -n"')
    parser.add_argument("--into", type=Path, help=f"page with {MARKS[0]} and {MARKS[1]}")
    options = parser.parse_args()
    publish(tables(options), options.into, MARKS)


if __name__ == "__main__":
    main()
