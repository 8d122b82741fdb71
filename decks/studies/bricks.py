"""Bricks against layers: the paper's Tables 2 and 4."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from plydyn_post.curves import read_numbers
from plydyn_post.results import open_results

from studies.jobs import ROOT, Effort, Job, Tools, run_job
from studies.markdown import table
from studies.times import UNDISTURBED, processor


@dataclass(frozen=True)
class Row:
    """A model of a table: its recipe, its name in the paper and its time there, h:mm:ss."""

    recipe: str
    name: str
    paper: str

    def job(self, overrides: Sequence[str]) -> Job:
        """The job of the model, without the figures' fields."""
        return Job(self.recipe.replace("/", "_"), ROOT / f"decks/{self.recipe}.toml", (*overrides,))


#: Table 2: the elastic plate; the finest bricks last
TABLE_2 = (
    Row("elastic_impact/le1", "LE1", "0:10:29"),
    Row("elastic_impact/le2", "LE2", "0:37:55"),
    Row("elastic_impact/le3", "LE3", "1:30:46"),
    Row("elastic_impact/3le1", "3LE1", "1:38:53"),
    Row("elastic_impact/bricks_1", "1 brick per ply", "0:09:04"),
    Row("elastic_impact/bricks_3", "3 bricks per ply", "1:15:06"),
    Row("elastic_impact/bricks_5", "5 bricks per ply", "3:16:33"),
)
#: Table 4: the bimetallic plate
TABLE_4 = (
    Row("bimetal_impact/le1", "LE1", "0:31:29"),
    Row("bimetal_impact/le2", "LE2", "-"),
    Row("bimetal_impact/bricks_1", "1 brick per ply", "0:24:18"),
    Row("bimetal_impact/bricks_2", "2 bricks per ply", "1:55:12"),
)


@dataclass(frozen=True)
class Outcome:
    """What a model took and what it found."""

    row: Row
    effort: Effort
    peak: float  # N
    force: np.ndarray  # N, at common times


def measure(
    tools: Tools,
    folder: Path,
    rows: Sequence[Row],
    core: int,
    overrides: Sequence[str],
    tick: Callable[[str, float], None],
) -> list[Outcome]:
    """Run the models one after the other on one core."""
    found = []
    for place, row in enumerate(rows):
        job = row.job(overrides)

        def follow(share: float, name: str = row.name, done: int = place) -> None:
            tick(name, done + share)

        effort = run_job(tools, job, folder, follow, core)
        results = open_results(folder / job.name)
        history = results.impactor()
        times = np.linspace(0.0, float(history["time"][-1]), 200)
        force = np.interp(times, history["time"], history["force"])
        found.append(Outcome(row, effort, read_numbers(results).peak_force, force))
    return found


def bricks_text(found: Sequence[Outcome], version: str) -> str:
    """The table; the last model is what the others differ from."""
    last = found[-1]
    headings = (
        "model",
        "DOF",
        "steps",
        "processor time [h:mm:ss]",
        "peak force [N]",
        f"force off {last.row.name} [%]",
        "DOF over the last",
        "time over the last",
        "in the paper [h:mm:ss]",
    )
    text = table(headings, [_cells(one, last) for one in found])
    text += (
        f"\nOne core of {processor()}, processor time with output. {version}. The difference of "
    )
    text += "the force is the root of its mean square over that of the last model. The paper's "
    text += "times are those of its authors' desktop computer, one core.\n"
    if any(one.effort.processor < UNDISTURBED * one.effort.wall for one in found):
        text += "\nOther work ran meanwhile, which lengthens processor times too.\n"
    return text


def _cells(one: Outcome, last: Outcome) -> list[str]:
    """One line of the table."""
    off = np.sqrt(np.mean((one.force - last.force) ** 2) / np.mean(last.force**2))
    return [
        one.row.name,
        f"{one.effort.freedoms:,}",
        f"{one.effort.steps:,}",
        _clock(one.effort.processor),
        f"{one.peak:.0f}",
        "-" if one is last else f"{100.0 * off:.1f}",
        f"1/{last.effort.freedoms / one.effort.freedoms:.1f}",
        f"1/{last.effort.processor / one.effort.processor:.1f}",
        one.row.paper,
    ]


def _clock(seconds: float) -> str:
    """Seconds as h:mm:ss."""
    whole = round(seconds)
    return f"{whole // 3600}:{whole % 3600 // 60:02d}:{whole % 60:02d}"
