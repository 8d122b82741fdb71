"""The command of plydyn-post about compression after impact."""

from __future__ import annotations

from typing import Annotated

import typer
from rich.table import Table as PrintedTable

from plydyn_post.commands import Folder, Measured, app, beside, console, progress, tells_errors
from plydyn_post.compression import Places, read_compression
from plydyn_post.compression_report import compression_report, report_tasks, strength_table
from plydyn_post.page import PageTable
from plydyn_post.plan import Plan
from plydyn_post.results import open_results

Stages = Annotated[
    list[str], typer.Argument(help="Jobs of the stages in their order; the last is the test.")
]


@app.command()
@tells_errors
def compression(
    jobs: Stages,
    output: Folder = None,
    pristine: Annotated[
        str | None, typer.Option("--pristine", help="Job of the same test without an impact.")
    ] = None,
    end: Annotated[int, typer.Option("--end", help="Profile at the loaded end.")] = 1,
    gauge: Annotated[
        list[int] | None,
        typer.Option("--gauge", help="Profile at strain gauges; may be given again.  [2, 3]"),
    ] = None,
    middle: Annotated[
        int | None, typer.Option("--middle", help="Profile at the centre of the plate.  [4]")
    ] = None,
    measured: Measured = None,
    plain: Annotated[
        bool, typer.Option("--plain", help="Draw pictures with matplotlib, not VTK.")
    ] = False,
) -> None:
    """Strength after impact: one page over all stages, and the strength as a CSV."""
    found = tuple(open_results(job) for job in jobs)
    places = Places(end, tuple(gauge) if gauge else None, middle)
    test = read_compression(found[-1], places)
    sound = read_compression(open_results(pristine), places) if pristine else None
    plan = Plan(found, output or beside(found[-1], "report"), tuple(measured or ()), plain=plain)
    with progress(len(report_tasks(plan, test, sound))) as tick:
        made = compression_report(plan, test, sound, tick)
    _print(strength_table(test, sound))
    for note in made.notes:
        console.print(f"note: {note}", markup=False)
    for path in (*made.files, plan.folder / "strength.csv", made.page):
        console.print(str(path), markup=False)


def _print(table: PageTable) -> None:
    """Print a table and the sentence below."""
    printed = PrintedTable(box=None, pad_edge=False)
    printed.add_column("")
    for heading in table.headings[1:]:
        printed.add_column(heading, justify="right")
    for row in table.rows:
        printed.add_row(*row)
    console.print(printed)
    console.print(table.words, markup=False)
