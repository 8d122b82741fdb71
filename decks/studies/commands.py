"""What the commands of study.py share: options, bars of progress, and how results are told."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn

from studies.jobs import ROOT, Job, StudyError, Tick, Tools, is_done, run_job
from studies.markdown import write

app = typer.Typer(
    help="Studies of the impacts of the paper: times, profiles, convergence, damage.",
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
Kept = Annotated[bool, typer.Option("--kept", help="Run nothing: print what lies there.")]
DEFAULT = ROOT / "results/study"


def run_all(
    tools: Tools, jobs: Sequence[Job], folder: Path, parallel: int, again: bool, threads: int = 1
) -> None:
    """Run jobs, some at a time, but for those that are done; an error tells of all that failed."""
    complain(run_most(tools, jobs, folder, parallel, again, threads))


def run_most(
    tools: Tools, jobs: Sequence[Job], folder: Path, parallel: int, again: bool, threads: int = 1
) -> list[str]:
    """Run jobs, some at a time, but for those that are done; gives what went wrong with any."""
    failed: list[str] = []
    with progress() as bar, ThreadPoolExecutor(min(parallel, os.cpu_count() or 1)) as pool:
        whole = bar.add_task("all", total=len(jobs))

        def work(job: Job) -> None:
            try:
                if again or not is_done(tools, job, folder):
                    with _line(bar, job.name) as tick:
                        effort = run_job(tools, job, folder, tick, threads=threads)
                    console.print(f"{job.name}: {effort.wall:.0f} s", markup=False)
            except StudyError as error:
                failed.append(str(error))
            bar.advance(whole)

        try:
            for _ in pool.map(work, jobs):
                pass
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return failed


def complain(failed: Sequence[str]) -> None:
    """Raise an error that tells what went wrong, if anything did."""
    if failed:
        raise StudyError("\n".join(failed))


@contextmanager
def _line(bar: Progress, name: str) -> Iterator[Tick]:
    """A line for a job at work."""
    line = bar.add_task(name, total=1.0)
    yield lambda share: bar.update(line, completed=share)
    bar.remove_task(line)


def progress() -> Progress:
    """Bars that go when they are done."""
    columns = (
        BarColumn(),
        TaskProgressColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.description}"),
    )
    return Progress(*columns, console=console, transient=True)


def tell(path: Path, sections: Sequence[tuple[str, str]]) -> None:
    """Write the tables and print them."""
    write(path, sections)
    console.print(path.read_text(encoding="utf-8"), markup=False, soft_wrap=True)
    console.print(str(path), markup=False)


def list_files(paths: Sequence[Path]) -> None:
    """Print the names of files."""
    for path in paths:
        console.print(str(path), markup=False)
