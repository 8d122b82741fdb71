"""Times of the four models of the paper's Table 2 on one core."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np
from plydyn_post.curves import read_numbers
from plydyn_post.results import open_results

from studies.jobs import ROOT, Effort, Job, Tools, run_job
from studies.markdown import table

#: Recipe, name in the paper, and its time there, h:mm:ss
MODELS = (
    ("le1", "LE1", "0:10:29"),
    ("le2", "LE2", "0:37:55"),
    ("le3", "LE3", "1:30:46"),
    ("3le1", "3LE1", "1:38:53"),
)
#: A process that had less than this share of its time on the processor was disturbed
UNDISTURBED = 0.97
NS = 1e9


@dataclass(frozen=True)
class Timing:
    """A model and what its runs took."""

    name: str
    paper: str
    efforts: tuple[Effort, ...]
    step: float  # s, usual length of a step
    peak: float  # N, largest contact force

    @property
    def middle(self) -> Effort:
        """The run of the middle wall time."""
        return sorted(self.efforts, key=lambda effort: effort.wall)[(len(self.efforts) - 1) // 2]

    @property
    def wall(self) -> float:
        """Median of the wall times, s."""
        return median(effort.wall for effort in self.efforts)

    @property
    def is_disturbed(self) -> bool:
        """Whether the machine was busy with something else."""
        return any(effort.processor < UNDISTURBED * effort.wall for effort in self.efforts)


def measure(
    tools: Tools,
    folder: Path,
    repeats: int,
    core: int,
    overrides: tuple[str, ...],
    tick: Callable[[str, int, float], None],
) -> list[Timing]:
    """Run all models, in turns, so that a disturbance hits all alike."""
    jobs = [
        Job(recipe, ROOT / f"decks/elastic_impact/{recipe}.toml", overrides)
        for recipe, *_ in MODELS
    ]
    efforts: dict[str, list[Effort]] = {job.name: [] for job in jobs}
    for turn in range(repeats):
        for job in jobs:

            def follow(share: float, job: Job = job, turn: int = turn) -> None:
                tick(job.name, turn, share)

            efforts[job.name].append(run_job(tools, job, folder, follow, core))
    return [
        _timing(name, paper, efforts[recipe], folder / recipe) for recipe, name, paper in MODELS
    ]


def _timing(name: str, paper: str, efforts: list[Effort], job: Path) -> Timing:
    results = open_results(job)
    step = float(np.median(results.energy()["step"]))
    return Timing(name, paper, tuple(efforts), step, read_numbers(results).peak_force)


def processor() -> str:
    """Name of the processor, as lscpu tells it."""
    try:
        told = subprocess.run(["lscpu"], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return "a processor without a name"
    lines = dict(line.split(":", 1) for line in told.splitlines() if ":" in line)
    return lines.get("Model name", "a processor without a name").strip()


def times_text(timings: list[Timing], version: str) -> str:
    """The table, and how its numbers came about."""
    rows = [_row(timing) for timing in timings]
    headings = (
        "model",
        "DOF",
        "steps",
        "step [ns]",
        "wall time [s]",
        "all runs [s]",
        "ns per DOF and step",
        "peak force [N]",
        "in the paper [h:mm:ss]",
    )
    repeats = len(timings[0].efforts)
    text = table(headings, rows)
    text += f"\nMedian of {repeats} runs, each on one core of {processor()}, output included. "
    text += f"{version}. The paper's times are those of its authors' desktop computer, one core.\n"
    if any(timing.is_disturbed for timing in timings):
        text += "\nThe machine was busy with other work: these times are not to be published.\n"
    return text


def _row(timing: Timing) -> list[str]:
    effort = timing.middle
    return [
        timing.name,
        f"{effort.freedoms:,}",
        f"{effort.steps:,}",
        f"{timing.step * NS:.2f}",
        f"{timing.wall:.1f}",
        ", ".join(f"{one.wall:.1f}" for one in timing.efforts),
        f"{effort.grain:.2f}",
        f"{timing.peak:.0f}",
        timing.paper,
    ]
