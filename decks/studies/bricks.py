"""Bricks against layers: the paper's Tables 2 and 4."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
import typer

from readings.differences import mean_force
from runner.cases import Case, Run, StudyError, builds
from runner.commands import Study, command
from runner.jobs import processor
from runner.pages import Column, Quantity, clock, one_section, tabulate

#: Share of the time from which on a run is whole
WHOLE = 0.999


@dataclass(frozen=True)
class PlateCase(Case):
    """A model of a table, and its time in the paper, h:mm:ss."""

    paper: str = "-"
    key: str = ""  # what --models calls it


def _row(recipe: str, label: str, paper: str = "-", rings: int = 0) -> PlateCase:
    """A model of the paper, or one with another number of rings of quads."""
    folder, _, name = recipe.partition("/")
    key = f"{name}_rings" if rings else name
    varied = (f"mesh.rings={rings}",) if rings else ()
    return PlateCase(f"{folder}_{key}", recipe, label, varied, paper=paper, key=key)


#: Table 2: the elastic plate; the finest bricks last. Quads of 8 rings are short enough, in every
#: direction, for the waves on their way to the edges
TABLE_2 = (
    _row("elastic_impact/le1", "LE1", "0:10:29"),
    _row("elastic_impact/le2", "LE2", "0:37:55"),
    _row("elastic_impact/le3", "LE3", "1:30:46"),
    _row("elastic_impact/3le1", "3LE1", "1:38:53"),
    _row("elastic_impact/le1", "LE1, 144 Q9", rings=8),
    _row("elastic_impact/le2", "LE2, 144 Q9", rings=8),
    _row("elastic_impact/bricks_1", "1 brick per ply", "0:09:04"),
    _row("elastic_impact/bricks_3", "3 bricks per ply", "1:15:06"),
    _row("elastic_impact/bricks_5", "5 bricks per ply", "3:16:33"),
)
#: Table 4: the bimetallic plate
TABLE_4 = (
    _row("bimetal_impact/le1", "LE1", "0:31:29"),
    _row("bimetal_impact/le2", "LE2"),
    _row("bimetal_impact/le1", "LE1, 144 Q9", rings=8),
    _row("bimetal_impact/bricks_1", "1 brick per ply", "0:24:18"),
    _row("bimetal_impact/bricks_2", "2 bricks per ply", "1:55:12"),
)
#: What the paper says of a model against the finest bricks: how many times fewer DOF and less time
CLAIMS = {"5 bricks per ply": ("LE2", 76.0, 5.2), "2 bricks per ply": ("LE1", 80.0, 3.6)}

Models = Annotated[str, typer.Option(help="Names of the recipes, such as le1,bricks_1; else all.")]
Core = Annotated[int | None, typer.Option(help="Core to run on; else any.", show_default=False)]


@command()
def table2(models: Models = "", core: Core = None) -> Study:
    """The elastic plate of layers and of bricks; all models take about an hour on one core."""
    return _study(2, TABLE_2, models, core)


@command()
def table4(models: Models = "", core: Core = None) -> Study:
    """The bimetallic plate of layers and of bricks; all models take about an hour on one core."""
    return _study(4, TABLE_4, models, core)


def pick(rows: Sequence[PlateCase], names: str) -> list[PlateCase]:
    """Models by the names of their recipes, in the order of the table; all without names."""
    known = {row.key: row for row in rows}
    wanted = names.split(",") if names else list(known)
    unknown = [name for name in wanted if name not in known]
    if unknown:
        raise StudyError(f"there is no model {unknown[0]}; there are {', '.join(known)}")
    return [row for name, row in known.items() if name in wanted]


def _study(number: int, rows: Sequence[PlateCase], models: str, core: int | None) -> Study:
    """The models of a table, some of which are run."""

    def text(runs: list[Run]) -> str:
        words = bricks_text(read_plates(runs), builds(runs, lines=3))
        done = [run.case.name for run in runs]
        missing = [row.label for row in rows if row.name not in done]
        return words + (f"\nNot run: {', '.join(missing)}.\n" if missing else "")

    report, chosen = one_section(f"Table {number}", text), pick(rows, models)
    return Study(rows, report, chosen=chosen, is_timed=True, core=core, may_stop=True)


@dataclass(frozen=True)
class Plate:
    """What a model took and what it found."""

    run: Run
    peak: float  # N
    time: np.ndarray  # s
    force: np.ndarray  # N, mean over some time around
    share: float = 1.0  # of the time of the event that was run
    dissipated: float = 0.0  # mJ

    @property
    def processor(self) -> float:
        """Time on the processor of the whole event, s; in proportion if it was stopped."""
        return self.run.effort.processor / self.share

    def off(self, other: Plate) -> float:
        """Difference of the force from that of another, over the time that both have."""
        times = np.linspace(0.0, min(self.time[-1], other.time[-1]), 200)
        own, its = (np.interp(times, one.time, one.force) for one in (self, other))
        return float(np.sqrt(np.mean((own - its) ** 2) / np.mean(its**2)))


def read_plates(runs: Sequence[Run]) -> list[Plate]:
    """What the models found."""
    found = []
    for run in runs:
        time, force = mean_force(run.results)
        lost = float(run.results.energy()["dissipated"][-1])
        found.append(Plate(run, float(force.max()), time, force, dissipated=lost))
    end = max(one.time[-1] for one in found)
    return [replace(one, share=min(1.0, one.time[-1] / end)) for one in found]


def bricks_text(found: Sequence[Plate], version: str) -> str:
    """The table; the last model is what the others differ from."""
    last = found[-1]
    name = last.run.case.label
    columns = (
        Quantity("model", lambda one: one.run.case.label),
        Quantity("DOF", lambda one: one.run.effort.dofs, ","),
        Quantity("steps", lambda one: one.run.effort.steps / one.share, ",.0f"),
        Quantity("processor time [h:mm:ss]", lambda one: clock(one.processor)),
        Quantity("peak force, 20 µs mean [N]", lambda one: one.peak, ".0f"),
        Quantity("dissipated [mJ]", lambda one: one.dissipated, ".1f"),
        Column(f"force off {name} [%]", _off),
        Column("DOF over the last", lambda one, last: f"1/{_dof_ratio(one, last):.1f}"),
        Column("time over the last", lambda one, last: f"1/{last.processor / one.processor:.1f}"),
        Quantity("in the paper [h:mm:ss]", lambda one: one.run.case.paper),
    )
    text = tabulate(columns, found, lambda _: last)
    text += (
        f"\nOne thread on one core of {processor()}, processor time with output. {version}. "
        "The difference of the force, its mean over 20 µs, is the root of the mean square over "
        "that of the last model. "
        "The paper's times are those of its authors' desktop computer, one core.\n"
    )
    for one in found:
        if one.share < WHOLE:
            text += (
                f"\n{one.run.case.label} was stopped at {100.0 * one.share:.0f} % of the time, "
                f"after {one.run.effort.steps:,} steps; steps and time of the whole are in "
                "proportion, and forces are compared up to there.\n"
            )
    if any(one.run.effort.is_disturbed for one in found):
        text += (
            "\nOther work ran meanwhile: processor time leaves out what that work took, but not "
            "what sharing caches and memory with it costs.\n"
        )
    return text + _claim_text(found, last)


def _off(one: Plate, last: Plate) -> str:
    return "-" if one is last else f"{100.0 * one.off(last):.1f}"


def _dof_ratio(one: Plate, last: Plate) -> float:
    return last.run.effort.dofs / one.run.effort.dofs


def _claim_text(found: Sequence[Plate], last: Plate) -> str:
    """What the paper claims beside what came out; nothing without the finest bricks."""
    name, dofs, time = CLAIMS.get(last.run.case.label, ("", 0.0, 0.0))
    one = next((one for one in found if one.run.case.label == name), None)
    if one is None:
        return ""
    return (
        f"\n{name} against {last.run.case.label}: the paper claims {dofs:g} times fewer "
        f"DOF and {time:g} times less time; here it is {_dof_ratio(one, last):.0f} and "
        f"{last.processor / one.processor:.0f} times, with a peak force "
        f"{round(100.0 * (one.peak / last.peak - 1.0)):+d} % off.\n"
    )
