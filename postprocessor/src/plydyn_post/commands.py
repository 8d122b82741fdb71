"""What the commands of plydyn-post share: options, errors in one line, a bar of progress."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

from plydyn_post.errors import ResultsError
from plydyn_post.results import Results

# Exit codes of the house: input that cannot be used, output that cannot be written
INPUT, OUTPUT = 2, 5

app = typer.Typer(
    help="Curves, profiles and pictures of plydyn results.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
console = Console(highlight=False, soft_wrap=True)
errors = Console(highlight=False, soft_wrap=True, stderr=True)

Jobs = Annotated[
    list[str], typer.Argument(help="Job, one of its files, or a folder that holds one job.")
]
Job = Annotated[str, typer.Argument(help="Job, one of its files, or a folder that holds one job.")]
Output = Annotated[Path | None, typer.Option("-o", "--output", help="File to write.")]
Folder = Annotated[Path | None, typer.Option("-o", "--output", help="Folder to write to.")]
Measured = Annotated[
    list[Path] | None,
    typer.Option(
        "--measured", "--test", help="CSV of a test to lay over, with names and units on top."
    ),
]
Window = Annotated[
    float | None,
    typer.Option("--mean", help="Time spanned by the running mean of a noisy force; 0 for none."),
]
Time = Annotated[float | None, typer.Option("--time", help="Instant, in the job's unit of time.")]
Whole = Annotated[bool, typer.Option("--whole", help="Show the whole plate, not the damage only.")]
Impactor = Annotated[int | None, typer.Option("--impactor", help="Number of the impactor.")]


def tells_errors(command: Callable[..., None]) -> Callable[..., None]:
    """Print what is wrong in one line, and leave with the exit code of the house."""

    @wraps(command)
    def guarded(*arguments: object, **options: object) -> None:
        try:
            command(*arguments, **options)
        except (ResultsError, OSError) as error:
            errors.print(f"plydyn-post: {error}", markup=False)
            raise typer.Exit(INPUT if isinstance(error, ResultsError) else OUTPUT) from error

    return guarded


@contextmanager
def progress(total: int) -> Iterator[Callable[[str], None]]:
    """A bar; the function given moves it on and names what is at work."""
    columns = (BarColumn(), MofNCompleteColumn(), TextColumn("{task.description}"))
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("", total=total)
        done = 0

        def tick(name: str) -> None:
            nonlocal done
            bar.update(task, completed=done, description=name)
            done += 1

        yield tick


def beside(job: Results, name: str) -> Path:
    """A path beside the results, named after the job."""
    return job.folder / f"{job.job}_{name}"
