"""Studies as commands: a function that declares a study becomes a command of study.py."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Annotated, Any

import typer

from runner.cases import ROOT, Case, StudyError, read_runs
from runner.jobs import Queue, console, find_tools
from runner.pages import Page

app = typer.Typer(
    help="Run studies of the cases: times, profiles, convergence, damage, validation.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
DEFAULT = ROOT / "results/study"


@dataclass(frozen=True)
class Options:
    """The options of all studies."""

    output: Annotated[Path, typer.Option("-o", "--output", help="Folder for everything made.")]
    kept: Annotated[
        bool, typer.Option("--kept", help="Run nothing, and print the tables of earlier results.")
    ] = False
    into: Annotated[
        Path | None,
        typer.Option(help="Page that gets the tables between its marks.", show_default=False),
    ] = None
    plydyn: Annotated[Path | None, typer.Option(help="The solver.", show_default=False)] = None
    parallel: Annotated[int, typer.Option(help="Jobs at a time.", min=1)] = 1
    given: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Replace a value of all recipes."),
    ] = None
    again: Annotated[bool, typer.Option("--again", help="Run also what has results already.")] = (
        False
    )


@dataclass(frozen=True)
class Study:
    """Cases that are run, and the pages that are made of their runs."""

    cases: Sequence[Case]
    report: Callable[[list[Any], Path], list[Page]]  # from runs, and the folder for figures
    needs_all: bool = False  # of the cases, else the report is on those that have run
    work: Callable[[Case], float] | None = None  # beside other cases; the longest is begun first
    chosen: Sequence[Case] | None = None  # to run; others are in the report if they have run
    is_timed: bool = False  # times are measured: whatever has run is run again
    core: int | None = None  # to run on, one case at a time
    may_stop: bool = False  # the report is also on runs that were stopped on request

    def carry_out(self, options: Options) -> None:
        """Run the cases that have not run, and write and print the pages."""
        cases = self._given(self.cases, options)
        failed = [] if options.kept else self._run(options)
        runs = read_runs(cases, options.output)
        try:
            if not runs or (self.needs_all and (failed or len(runs) < len(cases))):
                count = f"{len(runs)} of {len(cases)} cases have run" if runs else "no case has run"
                raise StudyError(f"{count} to the end in {options.output}")
            for page in self.report(runs, options.output):
                _publish(page, options)
        except StudyError as error:
            raise StudyError("\n".join([*failed, str(error)])) from error
        if failed:
            raise StudyError("\n".join(failed))

    def _given(self, cases: Sequence[Case], options: Options) -> list[Case]:
        return [replace(case, given=tuple(options.given or ())) for case in cases]

    def _run(self, options: Options) -> list[str]:
        cases = self._given(self.cases if self.chosen is None else self.chosen, options)
        ordered = sorted(cases, key=self.work, reverse=True) if self.work else cases
        queue = Queue(
            find_tools(options.plydyn),
            options.output,
            options.parallel if self.core is None else 1,
            options.again or self.is_timed,
            self.core,
            self.may_stop,
        )
        return queue.run(ordered)


def command(folder: str = "") -> Callable[[Callable[..., Study]], Callable[..., Study]]:
    """Make a function that declares a study a command of the same name.

    Its options are the arguments of the function and those of all studies; an argument ``given``
    gets what ``--set`` replaces. Results go to a folder of the name of the command, or another.
    """

    def register(declare: Callable[..., Study]) -> Callable[..., Study]:
        own = inspect.signature(declare, eval_str=True).parameters

        def run(**values: Any) -> None:  # noqa: ANN401 - options of any type
            options = Options(**{one.name: values[one.name] for one in fields(Options)})
            values["given"] = tuple(options.given or ())
            declare(**{name: values[name] for name in own}).carry_out(options)

        common = dict(inspect.signature(Options, eval_str=True).parameters)
        default = DEFAULT / (folder or declare.__name__)
        common["output"] = common["output"].replace(default=default)
        parameters = {**{name: one for name, one in own.items() if name != "given"}, **common}
        keyword = inspect.Parameter.KEYWORD_ONLY
        own_words = [one.replace(kind=keyword) for one in parameters.values()]
        vars(run)["__signature__"] = inspect.Signature(own_words)
        app.command(declare.__name__, help=declare.__doc__)(run)
        return declare

    return register


def _publish(page: Page, options: Options) -> None:
    """Write and print a page, and put it into another if there is one."""
    if page.sections:
        path = page.write(options.output)
        console.print(path.read_text(encoding="utf-8"), markup=False, soft_wrap=True)
        console.print(str(path), markup=False)
    for figure in page.figures:
        console.print(str(figure), markup=False)
    if options.into:
        page.put_into(options.into)
