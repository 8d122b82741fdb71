"""Figures of the forces of prescribed motions."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from plydyn_post.errors import ResultsError
from plydyn_post.results import Results
from plydyn_post.style import figure, legend_above, look_of, name_job, save
from plydyn_post.units import in_brackets, readable

#: What the columns of prescribed motions begin with
MOTIONS = ("motion", "face motion")


def moves(job: Results) -> list[str]:
    """Names of the columns of prescribed motions that a force acts on."""
    if not job.has("supports"):
        return []
    table = job.supports()
    return [name for name in table.names if name.startswith(MOTIONS) and np.any(table[name])]


def draw_motions(job: Results, path: Path) -> Path:
    """Draw the forces of prescribed motions over time."""
    names = moves(job)
    if not names:
        raise ResultsError(f"{job.job} has no prescribed motion with a force")
    table = job.supports()
    time = readable(table.unit("time"), float(table["time"][-1]))
    largest = max(float(np.max(np.abs(table[name]))) for name in names)
    force = readable(table.unit(names[0]), largest)
    with figure() as (made, axes):
        for place, name in enumerate(names):
            values = table[name] * force.factor
            axes.plot(table["time"] * time.factor, values, label=name, **look_of(place))
        axes.set_xlabel(in_brackets("Time", time.unit))
        axes.set_ylabel(in_brackets("Force", force.unit))
        legend_above(made, axes)
        name_job(made, job.job)
        return save(made, path)
