"""Times of the models of the paper's Table 7 on some threads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from plydyn_post.results import open_results

from studies.damage import MODELS, Model, read_answer
from studies.jobs import Effort, Job, kept_effort
from studies.markdown import table
from studies.times import NS, UNDISTURBED, processor


@dataclass(frozen=True)
class Timing:
    """A model and what it took on each number of threads, nothing where it has not run."""

    model: Model
    efforts: tuple[Effort | None, ...]
    step: float  # s, usual length of a step
    peak: float  # N, 20 µs mean


def collect(folder: Path, threads: Sequence[int]) -> list[Timing]:
    """What the models took whose results lie in a folder."""
    found = []
    for model in MODELS:
        jobs = [job_of(model, number) for number in threads]
        efforts = tuple(kept_effort(job, folder) for job in jobs)
        done = [job for job, effort in zip(jobs, efforts, strict=True) if effort]
        if not done:
            continue
        results = open_results(folder / done[0].name)
        step = float(np.median(results.energy()["step"]))
        found.append(Timing(model, efforts, step, read_answer(results).peak))
    return found


def job_of(model: Model, threads: int, overrides: Sequence[str] = ()) -> Job:
    """The job of a model on some threads."""
    return replace(model.job(overrides), name=f"{model.recipe}_on_{threads}")


def times_text(timings: Sequence[Timing], threads: Sequence[int], version: str) -> str:
    """The table, and how its numbers came about."""
    headings = [
        "model",
        "DOF",
        "steps",
        "step [ns]",
        *(f"wall time on {_cores(number)}" for number in threads),
        *(f"processor time, {_cores(number)}" for number in threads),
        "ns per DOF and step",
        "peak force [N]",
        "in the paper, six cores",
    ]
    text = table(headings, [_row(timing) for timing in timings])
    text += f"\nOn {processor()}, output included; times are h:mm:ss. {version}. "
    text += "The paper's times are those of its authors' desktop computer.\n"
    if any(_is_disturbed(timing, threads) for timing in timings):
        text += "\nOther work ran meanwhile: wall times are longer than on a quiet machine.\n"
    return text


def _cores(number: int) -> str:
    return "one core" if number == 1 else f"{number} cores"


def _is_disturbed(timing: Timing, threads: Sequence[int]) -> bool:
    """Whether a run on one core had less than its share of the processor."""
    return any(
        effort.processor < UNDISTURBED * effort.wall
        for effort, number in zip(timing.efforts, threads, strict=True)
        if number == 1 and effort
    )


def _row(timing: Timing) -> list[str]:
    first = next(effort for effort in timing.efforts if effort)
    return [
        timing.model.label,
        f"{first.freedoms:,}",
        f"{first.steps:,}",
        f"{NS * timing.step:.2f}",
        *(_clock(effort and effort.wall) for effort in timing.efforts),
        *(_clock(effort and effort.processor) for effort in timing.efforts),
        f"{NS * first.processor / (first.steps * first.freedoms):.2f}",
        f"{timing.peak:.0f}",
        timing.model.paper,
    ]


def _clock(seconds: float | None) -> str:
    """Seconds as h:mm:ss, a dash for nothing."""
    if seconds is None:
        return "–"
    whole = round(seconds)
    return f"{whole // 3600}:{whole % 3600 // 60:02d}:{whole % 60:02d}"
