"""Times of the models of the paper's Tables 2 and 7."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median
from typing import Annotated

import numpy as np
import typer

from readings.damage import MODELS, read_impact
from readings.differences import impact_numbers
from runner.cases import Effort, Run, builds
from runner.commands import Study, command
from runner.jobs import processor
from runner.pages import Quantity, clock, one_section, tabulate
from studies.bricks import TABLE_2

#: LE1, LE2, LE3 and 3LE1 of Table 2
ELASTIC = TABLE_2[:4]


@dataclass(frozen=True)
class Timing:
    """A model and what its runs took, nothing where it has not run."""

    label: str
    paper: str  # time of the paper, h:mm:ss
    efforts: tuple[Effort | None, ...]
    step: float  # s, usual length of a step
    peak: float  # N, largest contact force

    @property
    def done(self) -> list[Effort]:
        """What was run, by wall time."""
        return sorted((one for one in self.efforts if one), key=lambda effort: effort.wall)

    @property
    def middle(self) -> Effort:
        """The run of the middle wall time."""
        return self.done[(len(self.done) - 1) // 2]

    @property
    def first(self) -> Effort:
        """The first that was run."""
        return next(effort for effort in self.efforts if effort)


@command()
def times(
    repeats: Annotated[int, typer.Option(help="Runs of each model.", min=1)] = 3,
    core: Annotated[int, typer.Option(help="Core to run on.")] = 0,
) -> Study:
    """Wall times of LE1, LE2, LE3 and 3LE1 on one core; wants a quiet machine."""
    # in turns, so that a disturbance hits all models alike
    cases = [
        replace(model, name=f"{model.key}_{turn}")
        for turn in range(1, repeats + 1)
        for model in ELASTIC
    ]
    return Study(cases, one_section("Times", _elastic_text), True, is_timed=True, core=core)


def _elastic_text(runs: list[Run]) -> str:
    found = []
    for model in ELASTIC:
        own = [run for run in runs if run.case.recipe == model.recipe]
        peak = impact_numbers(own[-1].results).peak_force
        efforts = tuple(run.effort for run in own)
        found.append(Timing(model.label, model.paper, efforts, usual_step(own[-1]), peak))
    return elastic_text(found, builds(runs, lines=3))


def usual_step(run: Run) -> float:
    """Median length of the steps of a run, s."""
    return float(np.median(run.results.energy()["step"]))


STEP = Quantity("step [ns]", lambda one: one.step, ".2f", 1e9)
PEAK = Quantity("peak force [N]", lambda one: one.peak, ".0f")


def elastic_text(timings: Sequence[Timing], version: str) -> str:
    """The table of Table 2, and how its numbers came about."""
    columns = (
        Quantity("model", lambda one: one.label),
        Quantity("DOF", lambda one: one.middle.dofs, ","),
        Quantity("steps", lambda one: one.middle.steps, ","),
        STEP,
        Quantity("wall time [s]", lambda one: median(it.wall for it in one.done), ".1f"),
        Quantity("all runs [s]", lambda one: ", ".join(f"{it.wall:.1f}" for it in one.efforts)),
        Quantity("ns per DOF and step", lambda one: one.middle.ns_per_dof_step, ".2f"),
        PEAK,
        Quantity("in the paper [h:mm:ss]", lambda one: one.paper),
    )
    text = tabulate(columns, timings)
    text += f"\nMedian of {len(timings[0].efforts)} runs, each on one core of {processor()}, "
    text += f"output included. {version}. "
    text += "The paper's times are those of its authors' desktop computer, one core.\n"
    if any(effort and effort.is_disturbed for one in timings for effort in one.efforts):
        text += "\nThe machine was busy with other work: these times are not to be published.\n"
    return text


@command()
def table7(
    models: Annotated[str, typer.Option(help="Recipes, separated by commas.")] = "",
    threads: Annotated[str, typer.Option(help="Numbers of threads.")] = "1,2",
) -> Study:
    """Steps and times of the models of Table 7; wants a quiet machine. Rows that lie there stay."""
    numbers = [int(number) for number in threads.split(",")]
    cases = [
        replace(model, name=f"{model.name}_on_{number}", threads=number)
        for number in numbers
        for model in MODELS
    ]
    chosen = [case for case in cases if not models or Path(case.recipe).name in models.split(",")]

    def text(runs: list[Run]) -> str:
        return damage_text(_timings(runs, numbers), numbers, builds(runs, lines=3))

    return Study(cases, one_section("Table 7", text), chosen=chosen, is_timed=True)


def _timings(runs: Sequence[Run], threads: Sequence[int]) -> list[Timing]:
    """What the models took on each number of threads."""
    found = []
    for model in MODELS:
        own = {run.case.threads: run for run in runs if run.case.recipe == model.recipe}
        done = [own.get(number) for number in threads]
        first = next((run for run in done if run), None)
        if first:
            efforts = tuple(run.effort if run else None for run in done)
            peak = read_impact(first).peak
            found.append(Timing(model.label, model.paper, efforts, usual_step(first), peak))
    return found


def damage_text(timings: Sequence[Timing], threads: Sequence[int], version: str) -> str:
    """The table of Table 7, and how its numbers came about."""
    columns = (
        Quantity("model", lambda one: one.label),
        Quantity("DOF", lambda one: one.first.dofs, ","),
        Quantity("steps", lambda one: one.first.steps, ","),
        STEP,
        *(_clock(f"wall time on {_cores(n)}", "wall", k) for k, n in enumerate(threads)),
        *(_clock(f"processor time, {_cores(n)}", "processor", k) for k, n in enumerate(threads)),
        Quantity("ns per DOF and step", lambda one: _processor_ns(one.first), ".2f"),
        PEAK,
        Quantity("in the paper, six cores", lambda one: one.paper),
    )
    text = tabulate(columns, timings)
    text += f"\nOn {processor()}, output included; times are h:mm:ss. {version}. "
    text += "The paper's times are those of its authors' desktop computer.\n"
    pairs = [zip(one.efforts, threads, strict=True) for one in timings]
    if any(n == 1 and effort and effort.is_disturbed for own in pairs for effort, n in own):
        text += "\nOther work ran meanwhile: wall times are longer than on a quiet machine.\n"
    return text


def _cores(number: int) -> str:
    return "one core" if number == 1 else f"{number} cores"


def _clock(heading: str, name: str, place: int) -> Quantity:
    """A column of times of the runs on a number of threads."""
    return Quantity(heading, lambda one: clock(getattr(one.efforts[place], name, None)))


def _processor_ns(effort: Effort) -> float:
    """Time on the processor per degree of freedom and step, ns."""
    return 1e9 * effort.processor / (effort.steps * effort.dofs)
