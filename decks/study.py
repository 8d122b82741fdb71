"""Repeat the studies of the elastic impact, from a checkout after ``decks/quickstart.sh``.

    .venv/bin/python decks/study.py times --into decks/README.md
    .venv/bin/python decks/study.py profiles
    .venv/bin/python decks/study.py converge

Decks, results, tables and figures go to ``results/study``; ``--into`` puts a table into a page,
between its two marks.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from plydyn_post.errors import ResultsError
from plydyn_post.results import Results, open_results
from plydyn_pre.errors import PreError
from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn

from studies import ladder, stress, times
from studies.jobs import ROOT, Job, StudyError, Tick, Tools, find_tools, is_done, run_job
from studies.ladder_figures import draw_ladder
from studies.markdown import insert, write
from studies.rungs import ORDER, OUTPUTS, open_rungs, rungs

FAILED = 3

app = typer.Typer(
    help="Studies of the elastic impact: times, profiles, convergence.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
console = Console(highlight=False)

Folder = Annotated[Path, typer.Option("-o", "--output", help="Folder for everything made.")]
Solver = Annotated[Path | None, typer.Option("--plydyn", help="The solver.", show_default=False)]
Into = Annotated[
    Path | None,
    typer.Option("--into", help="Page that gets the tables between its marks.", show_default=False),
]
Overrides = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help="Replace a value of all recipes."),
]
Parallel = Annotated[int, typer.Option("--parallel", help="Jobs at a time.", min=1)]
Again = Annotated[bool, typer.Option("--again", help="Run also what has results already.")]
DEFAULT = ROOT / "results/study"


@app.command("times")
def times_command(
    output: Folder = DEFAULT / "times",
    repeats: Annotated[int, typer.Option("--repeats", help="Runs of each model.", min=1)] = 3,
    core: Annotated[int, typer.Option("--core", help="Core to run on.")] = 0,
    into: Into = None,
    plydyn: Solver = None,
    overrides: Overrides = None,
) -> None:
    """Wall times of LE1, LE2, LE3 and 3LE1 on one core; wants a quiet machine."""
    tools = find_tools(plydyn)
    with _progress() as bar:
        line = bar.add_task("", total=repeats * len(times.MODELS))

        def tick(name: str, turn: int, share: float) -> None:
            done = turn * len(times.MODELS) + [one[0] for one in times.MODELS].index(name) + share
            bar.update(line, completed=done, description=f"{name}, turn {turn + 1}")

        found = times.measure(tools, output, repeats, core, tuple(overrides or ()), tick)
    _tell(output / "times.md", [("Times", times.times_text(found, tools.version()))])
    if into:
        insert(into, "times", times.times_text(found, tools.version()))


@app.command()
def profiles(
    output: Folder = DEFAULT / "profiles",
    into: Into = None,
    plydyn: Solver = None,
    parallel: Parallel = 1,
    overrides: Overrides = None,
    again: Again = False,
) -> None:
    """Stress through the thickness: the paper's figures 4 and 5 in numbers."""
    replaced = (*OUTPUTS, *(overrides or ()))
    jobs = [
        Job(name, ROOT / f"decks/elastic_impact/{name}.toml", replaced) for name in stress.MODELS
    ]
    _run_all(find_tools(plydyn), jobs, output, parallel, again)
    found: dict[str, Results] = {job.name: open_results(output / job.name) for job in jobs}
    text = stress.stress_text(found)
    _tell(output / "profiles.md", [("Profiles", text)])
    _list(stress.draw_stress(list(found.values()), output))
    if into:
        insert(into, "profiles", text)


@app.command()
def converge(
    output: Folder = DEFAULT / "converge",
    orders: Annotated[str, typer.Option("--orders", help="Orders through a ply.")] = "1,2,3",
    into: Into = None,
    plydyn: Solver = None,
    parallel: Parallel = 1,
    overrides: Overrides = None,
    again: Again = False,
) -> None:
    """The ladder of meshes, both contact discretisations and orders; takes about an hour."""
    wanted = sorted(int(order) for order in orders.split(","))
    if ORDER not in wanted:
        raise StudyError(f"meshes are compared with order {ORDER}; --orders must name it")
    wished = rungs(wanted, overrides or ())
    _run_all(find_tools(plydyn), [rung.job for rung in wished], output, parallel, again)
    found = open_rungs(wished, output)
    sections = [
        ("Numbers", ladder.numbers_text(found)),
        ("Meshes and contact", ladder.meshes_text(found)),
        ("Orders", ladder.orders_text(found, wanted)),
    ]
    _tell(output / "converge.md", sections)
    _list(draw_ladder(found, wanted, output))
    if into:
        for heading, text in sections:
            insert(into, heading.lower(), text)


def _run_all(tools: Tools, jobs: Sequence[Job], folder: Path, parallel: int, again: bool) -> None:
    """Run jobs, some at a time, but for those that are done."""
    with _progress() as bar, ThreadPoolExecutor(min(parallel, os.cpu_count() or 1)) as pool:
        whole = bar.add_task("all", total=len(jobs))

        def work(job: Job) -> None:
            if again or not is_done(tools, job, folder):
                with _line(bar, job.name) as tick:
                    run_job(tools, job, folder, tick)
            bar.advance(whole)

        try:
            for _ in pool.map(work, jobs):
                pass
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


@contextmanager
def _line(bar: Progress, name: str) -> Iterator[Tick]:
    """A line for a job at work."""
    line = bar.add_task(name, total=1.0)
    yield lambda share: bar.update(line, completed=share)
    bar.remove_task(line)


def _progress() -> Progress:
    columns = (
        BarColumn(),
        TaskProgressColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.description}"),
    )
    return Progress(*columns, console=console, transient=True)


def _tell(path: Path, sections: Sequence[tuple[str, str]]) -> None:
    """Write the tables and print them."""
    write(path, sections)
    console.print(path.read_text(encoding="utf-8"), markup=False, soft_wrap=True)
    console.print(str(path), markup=False)


def _list(paths: Sequence[Path]) -> None:
    for path in paths:
        console.print(str(path), markup=False)


def main(command: Callable[[], None] = app) -> None:
    """Run the command; what goes wrong is told in words."""
    try:
        command()
    except (StudyError, ResultsError, PreError, OSError) as error:
        console.print(f"study: {error}", markup=False, soft_wrap=True)
        raise SystemExit(FAILED) from error


if __name__ == "__main__":
    main()
