"""Bricks against layers: the paper's Tables 2 and 4."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from plydyn_post.results import open_results

from studies.differences import mean_force
from studies.jobs import ROOT, STOPPED, Effort, Job, Tools, kept_effort, run_job
from studies.markdown import table
from studies.times import UNDISTURBED, processor

#: Share of the time from which on a run is whole
WHOLE = 0.999


@dataclass(frozen=True)
class Row:
    """A model of a table: its recipe, its name in the paper and its time there, h:mm:ss."""

    recipe: str
    name: str
    paper: str
    variant: str = ""  # word for a model that the paper does not have
    overrides: tuple[str, ...] = ()

    @property
    def key(self) -> str:
        """What a user calls it."""
        return self.recipe.split("/")[1] + (f"_{self.variant}" if self.variant else "")

    def job(self, overrides: Sequence[str]) -> Job:
        """The job of the model."""
        name = f"{self.recipe.split('/')[0]}_{self.key}"
        return Job(name, ROOT / f"decks/{self.recipe}.toml", (*self.overrides, *overrides))


#: Quads that are short enough, in every direction, for the waves on their way to the edges
EIGHT = ("mesh.rings=8",)
#: Table 2: the elastic plate; the finest bricks last
TABLE_2 = (
    Row("elastic_impact/le1", "LE1", "0:10:29"),
    Row("elastic_impact/le2", "LE2", "0:37:55"),
    Row("elastic_impact/le3", "LE3", "1:30:46"),
    Row("elastic_impact/3le1", "3LE1", "1:38:53"),
    Row("elastic_impact/le1", "LE1, 144 Q9", "-", "rings", EIGHT),
    Row("elastic_impact/le2", "LE2, 144 Q9", "-", "rings", EIGHT),
    Row("elastic_impact/bricks_1", "1 brick per ply", "0:09:04"),
    Row("elastic_impact/bricks_3", "3 bricks per ply", "1:15:06"),
    Row("elastic_impact/bricks_5", "5 bricks per ply", "3:16:33"),
)
#: Table 4: the bimetallic plate
TABLE_4 = (
    Row("bimetal_impact/le1", "LE1", "0:31:29"),
    Row("bimetal_impact/le2", "LE2", "-"),
    Row("bimetal_impact/le1", "LE1, 144 Q9", "-", "rings", EIGHT),
    Row("bimetal_impact/bricks_1", "1 brick per ply", "0:24:18"),
    Row("bimetal_impact/bricks_2", "2 bricks per ply", "1:55:12"),
)


@dataclass(frozen=True)
class Claim:
    """What the paper says of a model against the finest bricks."""

    name: str
    freedoms: float  # how many times fewer
    time: float  # how many times shorter


#: By the name of the finest bricks: of LE2 in Table 2, of LE1 in Table 4
CLAIMS = {
    "5 bricks per ply": Claim("LE2", 76.0, 5.2),
    "2 bricks per ply": Claim("LE1", 80.0, 3.6),
}


@dataclass(frozen=True)
class Outcome:
    """What a model took and what it found."""

    row: Row
    effort: Effort
    peak: float  # N
    time: np.ndarray  # s
    force: np.ndarray  # N, mean over some time around
    share: float = 1.0  # of the time of the event that was run
    dissipated: float = 0.0  # mJ

    @property
    def processor(self) -> float:
        """Time on the processor of the whole event, s; in proportion if it was stopped."""
        return self.effort.processor / self.share

    def off(self, other: Outcome) -> float:
        """Difference of the force from that of another, over the time that both have."""
        times = np.linspace(0.0, min(self.time[-1], other.time[-1]), 200)
        own, its = (np.interp(times, one.time, one.force) for one in (self, other))
        return float(np.sqrt(np.mean((own - its) ** 2) / np.mean(its**2)))


def measure(
    tools: Tools,
    folder: Path,
    rows: Sequence[Row],
    core: int | None,
    overrides: Sequence[str],
    tick: Callable[[str, float], None],
) -> None:
    """Run the models one after the other, each with one thread, on one core if it is given.

    A run that takes too long may be stopped by its file of requests.
    """
    for place, row in enumerate(rows):

        def follow(share: float, name: str = row.name, done: int = place) -> None:
            tick(name, done + share)

        run_job(tools, row.job(overrides), folder, follow, core, good=(0, STOPPED))


def collect(folder: Path, rows: Sequence[Row]) -> list[Outcome]:
    """What the models found whose results lie in a folder."""
    found = []
    for row in rows:
        job = row.job(())
        effort = kept_effort(job, folder)
        if effort is None:
            continue
        results = open_results(folder / job.name)
        time, force = mean_force(results)
        lost = float(results.energy()["dissipated"][-1])
        found.append(Outcome(row, effort, float(force.max()), time, force, dissipated=lost))
    end = max((one.time[-1] for one in found), default=0.0)
    return [replace(one, share=min(1.0, one.time[-1] / end)) for one in found]


def bricks_text(found: Sequence[Outcome], version: str) -> str:
    """The table; the last model is what the others differ from."""
    last = found[-1]
    headings = (
        "model",
        "DOF",
        "steps",
        "processor time [h:mm:ss]",
        "peak force, 20 µs mean [N]",
        "dissipated [mJ]",
        f"force off {last.row.name} [%]",
        "DOF over the last",
        "time over the last",
        "in the paper [h:mm:ss]",
    )
    text = table(headings, [_cells(one, last) for one in found])
    text += (
        f"\nOne thread on one core of {processor()}, processor time with output. {version}. "
        "The difference of the force, its mean over 20 µs, is the root of the mean square over "
        "that of the last model. "
        "The paper's times are those of its authors' desktop computer, one core.\n"
    )
    for one in found:
        if one.share < WHOLE:
            text += (
                f"\n{one.row.name} was stopped at {100.0 * one.share:.0f} % of the time, after "
                f"{one.effort.steps:,} steps; steps and time of the whole are in proportion, and "
                "forces are compared up to there.\n"
            )
    if any(one.effort.processor < UNDISTURBED * one.effort.wall for one in found):
        text += (
            "\nOther work ran meanwhile: processor time leaves out what that work took, but not "
            "what sharing caches and memory with it costs.\n"
        )
    return text + _claim_text(found, last)


def _claim_text(found: Sequence[Outcome], last: Outcome) -> str:
    """What the paper claims beside what came out; nothing without the finest bricks."""
    claim = CLAIMS.get(last.row.name)
    one = next((one for one in found if claim and one.row.name == claim.name), None)
    if claim is None or one is None:
        return ""
    return (
        f"\n{claim.name} against {last.row.name}: the paper claims {claim.freedoms:g} times fewer "
        f"DOF and {claim.time:g} times less time; here it is "
        f"{last.effort.freedoms / one.effort.freedoms:.0f} and "
        f"{last.processor / one.processor:.0f} times, with a peak force "
        f"{round(100.0 * (one.peak / last.peak - 1.0)):+d} % off.\n"
    )


def _cells(one: Outcome, last: Outcome) -> list[str]:
    """One line of the table."""
    return [
        one.row.name,
        f"{one.effort.freedoms:,}",
        f"{one.effort.steps / one.share:,.0f}",
        _clock(one.processor),
        f"{one.peak:.0f}",
        f"{one.dissipated:.1f}",
        "-" if one is last else f"{100.0 * one.off(last):.1f}",
        f"1/{last.effort.freedoms / one.effort.freedoms:.1f}",
        f"1/{last.processor / one.processor:.1f}",
        one.row.paper,
    ]


def _clock(seconds: float) -> str:
    """Seconds as h:mm:ss."""
    whole = round(seconds)
    return f"{whole // 3600}:{whole % 3600 // 60:02d}:{whole % 60:02d}"
