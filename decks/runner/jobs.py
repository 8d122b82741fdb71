"""Jobs: the deck of a case, and its run by the solver, some at a time."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn

from plydyn_pre.errors import PreError
from plydyn_pre.runs.process import follow, share_done
from plydyn_pre.runs.programs import chain_of, find_program
from runner.cases import (
    ROOT,
    Case,
    Spent,
    StudyError,
    effort_file,
    is_of,
    is_whole,
    keep_spent,
    read_spent,
)

#: Exit codes of the solver at the end of a run, and where it was stopped on request
ENDED, STOPPED = 0, 4
console = Console(highlight=False)


@dataclass(frozen=True)
class Tools:
    """The programs."""

    pre: Path
    solver: Path

    @cached_property
    def version(self) -> str:
        """The first line of what the solver prints of its build."""
        words: list[str | Path] = [self.solver, "--version"]
        return subprocess.run(words, capture_output=True, text=True, check=True).stdout.split("\n")[
            0
        ]


def find_tools(solver: Path | None = None) -> Tools:
    """The programs of this checkout, else those on PATH."""
    try:
        pre = find_program("plydyn-pre")
        return Tools(pre, solver or find_program("plydyn", ROOT / "build/release"))
    except PreError as error:
        raise StudyError(f"{error}; decks/quickstart.sh makes it") from error


def processor() -> str:
    """Name of the processor, as lscpu prints it."""
    try:
        printed = subprocess.run(["lscpu"], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return "a processor without a name"
    lines = dict(line.split(":", 1) for line in printed.splitlines() if ":" in line)
    return lines.get("Model name", "a processor without a name").strip()


@dataclass(frozen=True)
class Queue:
    """How cases are run: where, how many at a time, and on which core."""

    tools: Tools
    folder: Path
    parallel: int = 1
    again: bool = False  # also what the same build has run to its end already
    core: int | None = None  # any without a number
    may_stop: bool = False  # a run that was stopped on request is no error

    def run(self, cases: Sequence[Case]) -> list[str]:
        """Run all cases, those of several threads alone; gives what went wrong with any."""
        failed: list[str] = []
        columns = BarColumn(), TaskProgressColumn(), TimeElapsedColumn()
        words = TextColumn("{task.description}", markup=False)
        with Progress(*columns, words, console=console, transient=True) as bars:
            whole = bars.add_task("all", total=len(cases))

            def work(case: Case) -> None:
                try:
                    self._run_case(case, bars)
                except StudyError as error:
                    failed.append(str(error))
                bars.advance(whole)

            for threads, group in groupby(cases, key=lambda case: case.threads):
                at_once = min(self.parallel, os.cpu_count() or 1) if threads == 1 else 1
                _run_group(work, list(group), at_once)
        return failed

    def _run_case(self, case: Case, bars: Progress) -> None:
        """Make the decks of a case, and run them unless that has been done."""
        same = make_decks(self.tools, case, self.folder)
        if same and not self.again and is_whole(case, self.folder, self.tools.version):
            return
        if self.again or not same or not is_of(case, self.folder, self.tools.version):
            _clear(case, self.folder)
        bar = bars.add_task(case.name, total=1.0)
        try:
            wall = self._solve(case, lambda share: bars.update(bar, completed=share))
        finally:
            bars.remove_task(bar)
        console.print(f"{case.name}: {wall:.0f} s", markup=False)

    def _solve(self, case: Case, tick: Callable[[float], None]) -> float:
        """Run a case or go on with it, and keep what that took; gives the time of all parts, s."""
        if self.tools.solver.name != "plydyn":
            raise StudyError(f"{case.name}: the solver must have the name plydyn")
        chain, environment = chain_of(self.tools.solver, case.threads)
        words: list[str | Path] = [chain, self.folder, *_decks(case, self.folder)]
        if self.core is not None and shutil.which("taskset"):
            words = ["taskset", "-c", str(self.core), *words]
        before = read_spent(case, self.folder)
        keep_spent(case, self.folder, before, is_whole=False)

        def told(line: str) -> None:
            share = share_done(line)
            if share is not None:
                tick(share)

        ended = follow(words, told, self.folder / f"{case.name}.screen", environment)
        spent = before.wall + ended.wall, before.processor + ended.processor
        good = ended.code == ENDED or (self.may_stop and ended.code == STOPPED)
        keep_spent(case, self.folder, Spent(*spent), is_whole=good)
        if not good:
            raise StudyError(f"{case.name}: the solver left with {ended.code}: {ended.last}")
        return spent[0]


def _clear(case: Case, folder: Path) -> None:
    """Remove what another build or another deck left of a case, so that it begins anew."""
    effort_file(case, folder).unlink(missing_ok=True)
    for job in case.jobs:
        for ending in ("out", "sum", "dump*", "runrsf*"):
            for path in folder.glob(f"{job}.{ending}"):
                path.unlink()


def _decks(case: Case, folder: Path) -> list[Path]:
    """The decks of a case."""
    return [folder / f"{job}.k" for job in case.jobs]


def _run_group(work: Callable[[Case], None], cases: Sequence[Case], at_once: int) -> None:
    """Run cases, some at a time; an interrupt leaves out those that have not begun."""
    with ThreadPoolExecutor(at_once) as pool:
        try:
            for _ in pool.map(work, cases):
                pass
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def make_decks(tools: Tools, case: Case, folder: Path) -> bool:
    """Write the decks of a case; gives whether the same ones were there already."""
    folder.mkdir(parents=True, exist_ok=True)
    decks = _decks(case, folder)
    before = [deck.read_bytes() if deck.is_file() else b"" for deck in decks]
    replaced = [word for override in case.overrides for word in ("--set", override)]
    words: list[str | Path] = [tools.pre, "deck", case.path, "-o", decks[0], *replaced]
    made = subprocess.run(words, capture_output=True, text=True, check=False)
    if made.returncode:
        raise StudyError(f"{case.name}: {made.stderr.strip() or made.stdout.strip()}")
    return [deck.read_bytes() for deck in decks] == before
