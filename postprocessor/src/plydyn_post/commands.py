"""What the commands of plydyn-post share: options, errors in one line, a bar of progress."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import wraps
from math import isfinite
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn
from rich.table import Table as PrintedTable
from rich.text import Text
from typer.core import TyperGroup

from plydyn_post.errors import ResultsError
from plydyn_post.results import Results, notes_of_runs

# Options that must be above 0
ABOVE_NOTHING = ("zoom", "thickness", "rate")
# Exit codes of the house: input that cannot be used, output that cannot be written
INPUT, OUTPUT = 2, 5

# Commands that stand first in the help
FIRST = ("report", "numbers", "picture")


class Commands(TyperGroup):
    """The commands, those that most users need first."""

    def list_commands(self, ctx: Any) -> list[str]:  # noqa: ANN401 - whose click it is
        """Names in the order of the help."""
        return sorted(super().list_commands(ctx), key=lambda name: name not in FIRST)


app = typer.Typer(
    cls=Commands,
    help="Draw curves, profiles and pictures of plydyn results.",
    no_args_is_help=True,
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
        "--measured", "--test", help="CSV of a measurement, with a header line of names and units."
    ),
]
Window = Annotated[
    float | None,
    typer.Option("--mean", help="Time span of the running mean of a noisy force; 0 for none."),
]
Time = Annotated[
    float | None, typer.Option("--time", help="Time of the state, in the unit of the job.")
]
Whole = Annotated[bool, typer.Option("--whole", help="Show the whole plate, not only the damage.")]
Mirror = Annotated[
    str,
    typer.Option(
        "--mirror",
        help="Mirror a half or quarter model across x, y or xy, or draw only the model: none. The"
        " default finds the planes of symmetry from the fields.",
    ),
]
Limits = Annotated[
    tuple[float, float] | None, typer.Option("--limits", help="Limits of the colour bar.")
]
Plain = Annotated[bool, typer.Option("--plain", help="Draw pictures with matplotlib, not VTK.")]
Impactor = Annotated[int | None, typer.Option("--impactor", help="Number of the impactor.")]


def tells_errors(command: Callable[..., None]) -> Callable[..., None]:
    """Print what is wrong in one line, and leave with the exit code of the house."""

    @wraps(command)
    def guarded(*arguments: object, **options: object) -> None:
        try:
            check_numbers(options)
            command(*arguments, **options)
        except (ResultsError, OSError) as error:
            errors.print(f"plydyn-post: {error}", markup=False)
            raise typer.Exit(INPUT if isinstance(error, ResultsError) else OUTPUT) from error

    return guarded


def check_numbers(options: dict[str, object]) -> None:
    """Refuse what no option can be: no number, a zoom to nothing, a bar that ends before it begins.

    A thickness is a factor, a mean a span of time.
    """
    for name, value in options.items():
        numbers = value if isinstance(value, tuple | list) else [value]
        floats = [number for number in numbers if isinstance(number, float)]
        for number in floats:
            if not isfinite(number):
                raise ResultsError(f"--{name} cannot be {number}")
            if (name in ABOVE_NOTHING and number <= 0.0) or (name == "mean" and number < 0.0):
                raise ResultsError(f"--{name} cannot be {number:g}")
        if name == "limits" and floats and floats[0] >= floats[1]:
            raise ResultsError(f"--limits must rise, from {floats[0]:g} to more than that")


@contextmanager
def progress(total: int) -> Iterator[Callable[[str], None]]:
    """A bar; the function given moves it on and names what is at work."""
    columns = (BarColumn(), MofNCompleteColumn(), TextColumn("{task.description}", markup=False))
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("", total=total)
        done = 0

        def tick(name: str) -> None:
            nonlocal done
            bar.update(task, completed=done, description=name)
            done += 1

        yield tick


def print_table(headings: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Print a table as wide as it is: a narrow screen cuts no digits off, and units are no markup.

    Numbers stand below headings, words where there is none; those behind numbers are units.
    """
    table = PrintedTable(box=None, pad_edge=False)
    for place, heading in enumerate(headings):
        if heading:
            table.add_column(Text(heading), justify="right")
        else:
            table.add_column(style="dim" if place else "")
    for row in rows:
        table.add_row(*map(Text, row))
    wide = console.measure(table, options=console.options.update(width=10_000)).maximum
    Console(highlight=False, soft_wrap=True, width=max(wide, console.width)).print(table)


def note(words: Iterable[str]) -> None:
    """Print what is to be known of what was made."""
    for each in words:
        console.print(f"note: {each}", markup=False)


def tell_of(path: Path, *jobs: Results) -> None:
    """Print where results of jobs were drawn, and what is to be known of their runs."""
    note(notes_of_runs(jobs))
    tell(path)


def tell(path: Path) -> None:
    """Print where something was written."""
    console.print(str(path), markup=False)


def beside(job: Results, name: str) -> Path:
    """A path beside the results, named after the job."""
    return job.folder / f"{job.job}_{name}"
