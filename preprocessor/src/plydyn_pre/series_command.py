"""The command `plydyn-pre study`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
)

from plydyn_pre.errors import PreError
from plydyn_pre.runs.chain import print_line
from plydyn_pre.runs.process import follow
from plydyn_pre.runs.programs import find_program
from plydyn_pre.series.folders import Written, write_cases, written_cases
from plydyn_pre.series.plan import Series, read_series
from plydyn_pre.series.pool import last_line, run_cases

_COLUMNS = (BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())


def study(
    file: Annotated[Path, typer.Argument(help="The study, a TOML file.", show_default=False)],
    folder: Annotated[
        Path | None, typer.Argument(help="Folder of the cases. Default: the name of the study.")
    ] = None,
    run: Annotated[bool, typer.Option("--run", help="Run the cases on this machine.")] = False,
    at_once: Annotated[int, typer.Option(min=1, help="Cases that run side by side.")] = 2,
    threads: Annotated[int, typer.Option(min=1, help="Threads of the solver in each case.")] = 1,
    table: Annotated[
        bool, typer.Option("--table", help="Make the table and the figure, by plydyn-post.")
    ] = False,
) -> None:
    """Make the decks of a parameter study: a recipe with lists of values.

    Each combination of values has a folder; cases.csv lists them, and study.slurm is an array job.
    With --run the cases run here; the same command goes on where it was interrupted. --table alone
    takes the cases as they are. The exit code is that of the first case that failed.
    """
    series = read_series(file)
    folder = folder or Path(file.stem)
    cases = written_cases(folder) if table and not run else _write(series, folder)
    code = _run(cases, at_once, threads) if run else 0
    if table:
        words: list[str | Path] = [find_program("plydyn-post"), "study"]
        ended = follow([*words, folder, "--show", series.show], print_line)
        if ended.code:
            raise PreError(f"plydyn-post ended with {ended.code}: {ended.last}")
    if code:
        raise typer.Exit(code)


def _write(series: Series, folder: Path) -> list[Written]:
    """Write the decks, with a bar where there is a screen."""
    with _bar() as bar:
        task = bar.add_task("", total=len(series.cases))
        cases = write_cases(
            series, folder, lambda name: bar.update(task, advance=1, description=name)
        )
    for words in (f"cases            {len(cases)}", f"folder           {folder}"):
        print_line(words)
    return cases


def _run(cases: list[Written], at_once: int, threads: int) -> int:
    """Run the cases with a bar; tell which failed."""
    with _bar() as bar:
        task = bar.add_task("", total=len(cases))
        codes = run_cases(
            cases,
            at_once,
            threads,
            told=lambda done, words: bar.update(task, completed=done, description=words),
        )
    failed = [case for case in cases if codes.get(case.name)]
    for case in failed:
        print_line(f"case {case.name} ended with {codes[case.name]}: {last_line(case)}")
    ended = sum(code == 0 for code in codes.values())
    print_line(f"ended            {ended} of {len(cases)}")
    return codes[failed[0].name] if failed else 0


def _bar() -> Progress:
    """A bar on the screen of errors."""
    screen = Console(stderr=True)
    columns = (*_COLUMNS, TextColumn("{task.description}", markup=False))
    return Progress(*columns, console=screen, transient=True, disable=not screen.is_terminal)
