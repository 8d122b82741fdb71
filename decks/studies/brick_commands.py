"""Commands of study.py that set bricks against layers."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer
from plydyn_post.results import open_results

from studies import bimetal_ladder, bricks
from studies.bimetal_figures import draw_bimetal
from studies.bricks import TABLE_2, TABLE_4, Row
from studies.commands import (
    DEFAULT,
    Again,
    Folder,
    Into,
    Kept,
    Overrides,
    Parallel,
    Solver,
    app,
    list_files,
    progress,
    run_all,
    tell,
)
from studies.jobs import StudyError, find_tools
from studies.markdown import insert

Models = Annotated[
    str, typer.Option("--models", help="Names of the recipes, such as le1,bricks_1; else all.")
]
Core = Annotated[
    int | None, typer.Option("--core", help="Core to run on; else any.", show_default=False)
]


@app.command()
def table2(
    output: Folder = DEFAULT / "table2",
    models: Models = "",
    kept: Kept = False,
    core: Core = None,
    into: Into = None,
    plydyn: Solver = None,
    overrides: Overrides = None,
) -> None:
    """The elastic plate of layers and of bricks; all models take about an hour on one core."""
    wanted = [] if kept else pick(TABLE_2, models)
    _compare("table2", (TABLE_2, wanted), (output, core, into, plydyn, overrides))


@app.command()
def table4(
    output: Folder = DEFAULT / "table4",
    models: Models = "",
    kept: Kept = False,
    core: Core = None,
    into: Into = None,
    plydyn: Solver = None,
    overrides: Overrides = None,
) -> None:
    """The bimetallic plate of layers and of bricks; all models take about an hour on one core."""
    wanted = [] if kept else pick(TABLE_4, models)
    _compare("table4", (TABLE_4, wanted), (output, core, into, plydyn, overrides))


@app.command()
def bimetal(
    output: Folder = DEFAULT / "bimetal",
    models: Models = "le1,le2,bricks_1",
    plydyn: Solver = None,
    parallel: Parallel = 1,
    overrides: Overrides = None,
    again: Again = False,
) -> None:
    """The paper's figures 6, 7 and 8: deflection and plastic strain, layers and bricks."""
    rows = pick(TABLE_4, models)
    jobs = [row.job(overrides or ()) for row in rows]
    run_all(find_tools(plydyn), jobs, output, parallel, again)
    found = [
        (row.name, open_results(output / job.name)) for row, job in zip(rows, jobs, strict=True)
    ]
    list_files(draw_bimetal(found, output))


@app.command("bimetal_ladder")
def bimetal_ladder_command(
    output: Folder = DEFAULT / "bimetal_ladder",
    kept: Kept = False,
    into: Into = None,
    plydyn: Solver = None,
    parallel: Parallel = 1,
    overrides: Overrides = None,
    again: Again = False,
) -> None:
    """Layers and bricks of the bimetallic plate on finer and finer meshes; takes an hour."""
    rungs = (*bimetal_ladder.RUNGS, *bimetal_ladder.CHOICES)
    if not kept:
        jobs = [rung.job(overrides or ()) for rung in rungs]
        run_all(find_tools(plydyn), jobs, output, parallel, again)
    found = bimetal_ladder.open_found(output, rungs)
    if not found:
        raise StudyError(f"no mesh of the ladder has run to its end in {output}")
    text = bimetal_ladder.ladder_text(found)
    tell(output / "bimetal_ladder.md", [("Ladder", text)])
    list_files([bimetal_ladder.draw_ladder(found, output)])
    list_files(draw_bimetal(bimetal_ladder.for_figures(found), output))
    if into:
        insert(into, "ladder", text)


def pick(rows: Sequence[Row], names: str) -> list[Row]:
    """Models by the names of their recipes, in the order of the table."""
    known = {row.key: row for row in rows}
    wanted = names.split(",") if names else list(known)
    unknown = [name for name in wanted if name not in known]
    if unknown:
        raise StudyError(f"there is no model {unknown[0]}; there are {', '.join(known)}")
    return [row for name, row in known.items() if name in wanted]


_Common = tuple[Path, int | None, Path | None, Path | None, list[str] | None]


def _compare(name: str, rows: tuple[Sequence[Row], Sequence[Row]], common: _Common) -> None:
    """Run the wanted models of a table, and tell what came out of all that have run."""
    output, core, into, plydyn, overrides = common
    table, wanted = rows
    tools = find_tools(plydyn)
    with progress() as bar:
        line = bar.add_task("", total=len(wanted))

        def tick(model: str, done: float) -> None:
            bar.update(line, completed=done, description=model)

        bricks.measure(tools, output, wanted, core, overrides or (), tick)
    found = bricks.collect(output, table)
    if not found:
        raise StudyError(f"no model of {name} has run to its end in {output}")
    text = bricks.bricks_text(found, tools.version())
    missing = [row.name for row in table if all(row != one.row for one in found)]
    if missing:
        text += f"\nNot run: {', '.join(missing)}.\n"
    tell(output / f"{name}.md", [(f"Table {name[-1]}", text)])
    if into:
        insert(into, f"table {name[-1]}", text)
