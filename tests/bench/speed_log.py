"""The speed of commits on a frozen coupon: a row for each in tests/bench/speed.csv.

    .venv/bin/python tests/bench/speed_log.py [COMMIT ...] [--repeats N]

Without a commit it is HEAD. Each is built in a work tree of its own below build/speed, where its
solver stays for the next time, and steps of 25 J on quads of 1 mm are measured as by `coupon.py`,
by turns with the commit whose recipe wrote the deck: rows of different days and machines can be
compared by that ratio. Prints the whole log as a table, too.
Takes some minutes for each commit that is not built yet. No test: nothing is compared with a limit;
`test_speed_log.py` tries the rows.
"""

from __future__ import annotations

import argparse
import csv
import subprocess
import sys
import tempfile
from datetime import UTC, datetime
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))

from coupon import MILLI, ROW, STATES, Crew, steps_of, thawed  # noqa: E402
from run import table  # noqa: E402

REFERENCE, DECK = "bd2c1ef", "t700gc_25J_1mm"
LOG, BUILDS = ROOT / "tests/bench/speed.csv", ROOT / "build/speed"
HEADS = ["commit", "of", "measured on", "processor"]
HEADS += [f"{what}, {state}" for state in STATES for what in ("ms per step", "times as fast")]


def git(*words: str) -> str:
    """What git says."""
    done = subprocess.run(["git", "-C", ROOT, *words], check=True, capture_output=True, text=True)
    return done.stdout.strip()


def solver_of(commit: str) -> Path:
    """The solver of a commit, built if it is not there."""
    kept = BUILDS / f"plydyn_{commit}"
    if kept.exists():
        return kept
    tree = BUILDS / commit
    if not tree.exists():
        git("worktree", "add", "--detach", str(tree), commit)
    for words in (
        ["--preset", "release"],
        ["--build", "--preset", "release", "--target", "plydyn"],
    ):
        subprocess.run(["cmake", *words], cwd=tree, check=True, stdout=subprocess.DEVNULL)
    (tree / "build/release/plydyn").rename(kept)
    git("worktree", "remove", "--force", str(tree))
    return kept


def processor() -> str:
    """The processor of this machine."""
    told = subprocess.run(["lscpu"], capture_output=True, text=True, check=True).stdout
    return next(line.split(":")[1].strip() for line in told.splitlines() if "Model name" in line)


def row_of(commit: str, times: list[tuple[float, float]]) -> list[str]:
    """A row: of each state, milliseconds of a step, and those of the reference over them.

    Times are seconds of a step of the commit and of the reference, for each state.
    """
    row = [commit, git("log", "-1", "--format=%cs", commit)]
    row += [datetime.now(UTC).date().isoformat(), processor()]
    for own, other in times:
        row += [f"{own / MILLI:.1f}", f"{other / own:.2f}"]
    return row


def measured(commit: str, repeats: int, folder: Path) -> list[tuple[float, float]]:
    """Seconds of a step of a commit and of the reference, by turns, in each state."""
    pair = Crew(solver_of(commit)), Crew(solver_of(REFERENCE))
    times = []
    for start, speed in STATES.values():
        short, long = (thawed(DECK, folder, end, speed) for end in (start, start + ROW))
        own, other = steps_of([(crew, (short, long)) for crew in pair], repeats)
        times.append((own, other))
    return times


def append(row: list[str], log: Path) -> list[list[str]]:
    """Add a row to a log, with its heads if it is new; all rows, without the heads."""
    is_new = not log.exists()
    with log.open("a", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if is_new:
            writer.writerow(HEADS)
        writer.writerow(row)
    with log.open(newline="") as file:
        return list(csv.reader(file))[1:]


def main() -> None:
    """Build, measure, and write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("commits", nargs="*", default=["HEAD"], help="what git calls a commit")
    parser.add_argument("--repeats", type=int, default=1, help="turns of each pair")
    chosen = parser.parse_args()
    BUILDS.mkdir(parents=True, exist_ok=True)
    for name in chosen.commits:
        commit = git("rev-parse", "--short=7", name)
        with tempfile.TemporaryDirectory() as folder:
            rows = append(row_of(commit, measured(commit, chosen.repeats, Path(folder))), LOG)
        sys.stdout.write(table(HEADS, rows) + "\n")


if __name__ == "__main__":
    main()
