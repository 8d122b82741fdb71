"""Compare two builds of the solver: every number of all test decks and recipes, bit by bit.

    .venv/bin/python tests/compare/compare.py OLD_PLYDYN NEW_PLYDYN [-k NAME] [--jobs 2] [--quick]

Both builds run each deck on one rank of two threads, on two ranks, and once more from the restart
file half-way, each from its own. Histories, fields and restart files must hold the same bits.
Headers and names of data may differ, which is reported. What is dropped or new, or is kept in other
pieces, goes into the tables of `known_names.py`. The listing is not compared. `--quick` takes a
selection for after every step of work. `-k` takes the cases whose name has this in it; `--list`
prints them. `--cache FOLDER` keeps the results of the old build for the same solver and deck.
`--verification tests/verification/patch` adds the first steps of what tests write, the first deck
of each. Results that differ stay under `--folder` (build/compare); a folder in memory such as
/dev/shm saves much of the time. The last line counts; the exit code is 1 if anything differs.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from subprocess import TimeoutExpired

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from cases import ROOT, THREADS, Case, all_cases, recorded_cases
from differences import compare_folders
from known_names import NEW_CASES, reason
from recorder import record
from report import Report
from runner import Build, RunError

#: Differences that are printed of one run
SHOWN = 8


@dataclass(frozen=True)
class Outcome:
    """What came of the runs of a case."""

    lines: list[str]
    notes: list[str]
    passed: int
    failed: int
    numbers: int


def main(words: Sequence[str] | None = None) -> int:
    """Compare, print, and give the exit code."""
    asked = _arguments().parse_args(words)
    folder = asked.folder.resolve()
    cases = list(all_cases())
    if asked.verification:
        decks = record(folder / "recorded", asked.verification, asked.jobs)
        cases += recorded_cases(decks)
    chosen = [case for case in cases if asked.name in case.name]
    if asked.quick:
        chosen = [replace(case, ways=case.quick) for case in chosen if case.quick]
    if asked.list:
        _say("\n".join(case.name for case in chosen))
        return 0
    old = Build(asked.old.resolve(), (asked.cache or folder / "old").resolve(), bool(asked.cache))
    new = Build(asked.new.resolve(), folder / "new")
    start = time.monotonic()
    outcomes = []
    with ThreadPoolExecutor(asked.jobs) as pool:
        for outcome in pool.map(lambda case: compare(case, old, new, folder), chosen):
            outcomes.append(outcome)
            _say("\n".join(outcome.lines))
    return _report_end(outcomes, time.monotonic() - start)


def _say(text: str) -> None:
    """Print at once."""
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def _arguments() -> argparse.ArgumentParser:
    """The words of the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("old", type=Path, help="solver of the old build")
    parser.add_argument("new", type=Path, help="solver of the new build")
    parser.add_argument("-k", dest="name", default="", help="part of the names of cases")
    parser.add_argument("--jobs", type=int, default=1, help="cases at a time")
    parser.add_argument("--quick", action="store_true", help="a selection")
    parser.add_argument("--verification", type=Path, help="a folder of tests, or one of them")
    parser.add_argument("--list", action="store_true", help="print the names of the cases")
    parser.add_argument("--cache", type=Path, help="folder that keeps results of the old build")
    parser.add_argument("--folder", type=Path, default=ROOT / "build/compare", help="for results")
    return parser


def compare(case: Case, old: Build, new: Build, folder: Path) -> Outcome:
    """Run a case with both builds in all its ways, and compare."""
    lines: list[str] = []
    notes: list[str] = []
    failed = numbers = 0
    deck = folder / "decks" / case.name.replace("/", ".")
    shutil.rmtree(deck, ignore_errors=True)
    deck.mkdir(parents=True)
    try:
        case.write(deck)
    except ValueError as error:
        return Outcome([f"FAILED {case.name}: {error}"], [], 0, len(case.ways), 0)
    if (why := reason(NEW_CASES, case.name)) and _is_refused(case, deck, old):
        shutil.rmtree(deck)
        return Outcome([f"new    {case.name}: {why}"], [], 0, 0, 0)
    for way in case.ways:
        report = _compare_way(case, deck, way, old, new)
        numbers += report.numbers
        notes += report.notes
        if report.differences:
            failed += 1
            lines.append(f"FAILED {case.name} {way}")
            lines += [f"    {difference}" for difference in report.differences[:SHOWN]]
            if len(report.differences) > SHOWN:
                lines.append(f"    and {len(report.differences) - SHOWN} more")
        else:
            counts = f"{report.files} files, {report.numbers} numbers"
            lines.append(f"passed {case.name} {way}: {counts}")
    if failed == 0:
        _clear(case, deck, old, new)
    return Outcome(lines, notes, len(case.ways) - failed, failed, numbers)


def _is_refused(case: Case, deck: Path, build: Build) -> bool:
    """Whether a build refuses the deck of a case."""
    try:
        build.results(case.name, deck, THREADS)
    except RunError as error:
        return "exit code 2" in str(error)
    return False


def _compare_way(case: Case, deck: Path, way: str, old: Build, new: Build) -> Report:
    """Run a case with both builds one way, and compare."""
    try:
        before = old.results(case.name, deck, way)
        after = new.results(case.name, deck, way)
        report = compare_folders(before, after, case.name)
    except (RunError, OSError, TimeoutExpired) as error:
        report = Report()
        report.differ(case.name, way, "", "a run", f"none: {error}")
        return report
    if case.damaged and way == THREADS and not dissipates(before):
        report.differ("job.energy.csv", "dissipated", "", "nothing", "the case shows no damage")
    return report


def dissipates(folder: Path) -> bool:
    """Whether energy is dissipated at the end of a run of the old build."""
    rows = (folder / "job.energy.csv").read_text().splitlines()
    names = [head.split("[")[0].strip() for head in rows[0].split(",")]
    return float(rows[-1].split(",")[names.index("dissipated")]) > 0.0


def _clear(case: Case, deck: Path, old: Build, new: Build) -> None:
    """Remove results that are alike."""
    shutil.rmtree(deck, ignore_errors=True)
    for build in (old, new):
        if not build.keeps:
            for way in case.ways:
                name = f"{case.name.replace('/', '.')}.{way}"
                shutil.rmtree(build.folder / name, ignore_errors=True)


def _report_end(outcomes: Sequence[Outcome], seconds: float) -> int:
    """Print changes of names, each once, and the count."""
    counts: dict[str, int] = {}
    for outcome in outcomes:
        for note in outcome.notes:
            counts[note] = counts.get(note, 0) + 1
    for note, count in sorted(counts.items()):
        _say(f"note ({count} times): {note}")
    passed = sum(outcome.passed for outcome in outcomes)
    failed = sum(outcome.failed for outcome in outcomes)
    numbers = sum(outcome.numbers for outcome in outcomes)
    _say(f"{len(outcomes)} cases, {numbers} numbers, {seconds:.0f} s")
    _say(f"{passed} passed, {failed} failed")
    return 0 if passed and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
