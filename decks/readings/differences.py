"""Histories of an impact, and their differences as shares of what they are compared with."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np

from plydyn_post.curves import Numbers, read_numbers, running_mean
from plydyn_post.results import Results
from plydyn_post.style import WIDE, figure, look_of, save
from runner.cases import Run

#: Window of the running mean of forces, and distance of the times they are compared at, s
WINDOW, STRIDE = 20e-6, 1e-6
#: Until then the plate answers as if it had no edges, s: bending waves are on their way
PLATEAU = 60e-6


@cache
def impact_numbers(results: Results) -> Numbers:
    """The numbers of an impact, read once."""
    return read_numbers(results)


@cache
def mean_force(results: Results) -> tuple[np.ndarray, np.ndarray]:
    """Times at equal distances, and the mean of the contact force around each."""
    table = results.impactor()
    time = table["time"]
    even = np.arange(0.0, time[-1] + 0.5 * STRIDE, STRIDE)
    return even, np.interp(even, time, running_mean(time, table["force"], WINDOW))


def force_difference(results: Results, other: Results, end: float = np.inf) -> float:
    """The size of the difference of two mean forces up to a time, as a share of the other's."""
    (time, ours), (_, theirs) = mean_force(results), mean_force(other)
    rows = min(len(ours), len(theirs), int(np.searchsorted(time, end)))
    return norm_share(ours[:rows] - theirs[:rows], theirs[:rows])


def largest_force_difference(results: Results, other: Results) -> float:
    """The largest difference of two mean forces at any time, as a share of the other's largest."""
    (_, ours), (_, theirs) = mean_force(results), mean_force(other)
    rows = min(len(ours), len(theirs))
    return peak_share(ours[:rows] - theirs[:rows], theirs[:rows])


def velocity_difference(results: Results, other: Results) -> float:
    """The largest difference of the impactor's velocities, as a share of that at impact."""
    ours, theirs = results.impactor(), other.impactor()
    late = np.interp(theirs["time"], ours["time"], ours["velocity"])
    gap = np.max(np.abs(late - theirs["velocity"]))
    return float(gap / abs(theirs["velocity"][0]))


def norm_share(difference: np.ndarray, whole: np.ndarray) -> float:
    """Size of a difference over the size of the whole, root of squares."""
    return float(np.linalg.norm(difference) / np.linalg.norm(whole))


def peak_share(difference: np.ndarray, whole: np.ndarray) -> float:
    """Largest difference over the largest value of the whole."""
    return float(np.max(np.abs(difference)) / np.max(np.abs(whole)))


def peak_time(results: Results) -> float:
    """When the mean of the contact force is largest."""
    time, force = mean_force(results)
    return float(time[np.argmax(force)])


def draw_panels(panels: Mapping[str, Mapping[str, Run]], across: int, path: Path) -> Path:
    """Mean forces over each other in panels with titles, some of them beside each other."""
    rows = -(-len(panels) // across)
    size, shares = (WIDE, 0.4 + 2.5 * rows), {"sharex": True, "sharey": True, "squeeze": False}
    with figure(rows, across, size=size, **shares) as (made, grid):
        for axes in grid.flat[len(panels) :]:
            axes.set_visible(False)
        for axes, (title, runs) in zip(grid.flat, panels.items(), strict=False):
            for place, (label, run) in enumerate(runs.items()):
                time, force = mean_force(run.results)
                axes.plot(1e3 * time, force, label=label, **(look_of(place) | {"linewidth": 1.1}))
            axes.set_title(title, fontsize=7.5, loc="left")
            axes.set_xlabel("Time [ms]")
            axes.margins(x=0.0)
            axes.legend(fontsize=6, loc="upper right")
            axes.label_outer()
        made.supylabel("Contact force, 20 µs mean [N]", fontsize=9)
        return save(made, path)
