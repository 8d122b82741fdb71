"""The commands of plydyn-post about chains of stages and compression after impact."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from plydyn_post.commands import (
    Folder,
    Measured,
    Plain,
    app,
    beside,
    console,
    note,
    print_table,
    progress,
    tell,
    tells_errors,
)
from plydyn_post.errors import ResultsError
from plydyn_post.results import Results, open_results

if TYPE_CHECKING:
    from plydyn_post.compression import Compression
    from plydyn_post.page import PageTable
    from plydyn_post.plan import Plan
    from plydyn_post.report import Report

Stages = Annotated[
    list[str], typer.Argument(help="Jobs of the stages in their order; the last is the test.")
]
Pristine = Annotated[
    str | None, typer.Option("--pristine", help="Job of the same test without an impact.")
]


@app.command()
@tells_errors
def compression(
    jobs: Stages,
    output: Folder = None,
    pristine: Pristine = None,
    end: Annotated[int, typer.Option("--end", help="Profile at the loaded end.")] = 1,
    gauge: Annotated[
        list[int] | None,
        typer.Option("--gauge", help="Profile at strain gauges; may be given again.  [2, 3]"),
    ] = None,
    middle: Annotated[
        int | None, typer.Option("--middle", help="Profile at the centre of the plate.  [4]")
    ] = None,
    measured: Measured = None,
    plain: Plain = False,
) -> None:
    """Strength after impact, in compression or tension: one page over all stages, and a CSV."""
    from plydyn_post.compression import Places, read_compression
    from plydyn_post.plan import Plan

    found = tuple(open_results(job) for job in jobs)
    places = Places(end, tuple(gauge) if gauge else None, middle)
    test = read_compression(found[-1], places)
    sound = read_compression(open_results(pristine), places) if pristine else None
    plan = Plan(found, output or beside(found[-1], "report"), tuple(measured or ()), plain=plain)
    _report_test(plan, test, sound)


@app.command()
@tells_errors
def stages(
    jobs: Annotated[list[str], typer.Argument(help="Jobs of the stages in their order.")],
    output: Folder = None,
    pristine: Pristine = None,
    measured: Measured = None,
    plain: Plain = False,
) -> None:
    """One page over the stages of any chain; of a test in compression or tension the strength."""
    from plydyn_post.compression import read_compression
    from plydyn_post.plan import Plan
    from plydyn_post.stages_report import stage_table, stages_report, stages_tasks

    found = tuple(open_results(job) for job in jobs)
    plan = Plan(found, output or beside(found[0], "report"), tuple(measured or ()), plain=plain)
    test, why = _test_of(found[-1])
    if test is not None:
        sound = read_compression(open_results(pristine)) if pristine else None
        _report_test(plan, test, sound)
        return
    if pristine:
        raise ResultsError(f"--pristine needs a test of strength as the last stage: {why}")
    notes = () if len(found) == 1 or found[-1].impactors else (f"no strength is computed: {why}",)
    with progress(len(stages_tasks(plan))) as tick:
        made = stages_report(plan, notes, tick)
    _print(stage_table(found))
    _print_files(made)


def _test_of(job: Results) -> tuple[Compression | None, str]:
    """The compression or tension test of a job, or why it is none."""
    from plydyn_post.compression import read_compression

    try:
        return read_compression(job), ""
    except ResultsError as error:
        return None, str(error)


def _report_test(plan: Plan, test: Compression, sound: Compression | None) -> None:
    """Make the page of a test, and print its numbers."""
    from plydyn_post.compression_report import compression_report, judge, report_tasks
    from plydyn_post.ending import ending_words
    from plydyn_post.strength import strength_table

    judged = judge(plan, test, sound)
    with progress(len(report_tasks(judged))) as tick:
        made = compression_report(judged, tick)
    _print(strength_table(test, sound, " ".join(ending_words(test, judged.ending))))
    _print_files(made, [plan.folder / "strength.csv"])


def _print_files(made: Report, more: Sequence[Path] = ()) -> None:
    """Print notes and the names of what was made."""
    note(made.notes)
    for path in (*made.files, *more, made.page):
        tell(path)


def _print(table: PageTable) -> None:
    """Print a table and the sentence below."""
    print_table(("", *table.headings[1:]), table.rows)
    console.print(table.words, markup=False)
