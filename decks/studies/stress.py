"""Stress through the thickness at the points of the paper's figures 4 and 5."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from plydyn_post.profile import INTERLAMINAR, draw_profiles, read_profiles
from plydyn_post.results import Results

from studies.differences import (
    Section,
    block_at,
    norm_share,
    peak_share,
    peak_time,
    ply_means,
    section,
)
from studies.markdown import table

#: Models of the paper's figures; the one that the others are measured against
MODELS, REFERENCE = ("le1", "le2", "le3", "3le1"), "le3"
#: Number of the profile, its place, component: figures 4a, 4b and 5
SHOWN = ((1, "(48, 48)", "sxx", "4a"), (1, "(48, 48)", "sxy", "4b"), (2, "(40, 40)", "syz", "5"))
MICRO = 1e6


@dataclass(frozen=True)
class Agreement:
    """How a profile compares with that of the reference; shares of the reference's size."""

    largest: float  # difference at the instant, largest over largest
    size: float  # difference at the instant, root of squares
    whole: float  # difference over all instants, root of squares
    jump: float  # largest jump across a face of plies at the instant, over the largest stress
    end: float  # larger of the values at the bottom and the top, over the largest stress
    means: float  # difference of the means of the plies at the instant, root of squares
    peak: float  # largest stress at the instant


def agreement(ours: Section, reference: Section, time: float) -> Agreement:
    """Compare a profile with the reference at an instant and over all of them."""
    rows = min(len(ours.times), len(reference.times))
    gap = ours.values[:rows] - reference.values[:rows]
    k = block_at(reference.times[:rows], time)
    largest = float(np.max(np.abs(reference.values[k])))
    return Agreement(
        largest=peak_share(gap[k], reference.values[k]),
        size=norm_share(gap[k], reference.values[k]),
        whole=norm_share(gap, reference.values[:rows]),
        jump=float(np.max(ours.jumps[k])) / largest,
        end=float(np.max(np.abs(ours.ends[k]))) / largest,
        means=norm_share(ply_means(gap[k]), ply_means(reference.values[k])),
        peak=float(np.max(np.abs(ours.values[k]))),
    )


def agreements(
    jobs: dict[str, Results], reference: str, number: int, component: str
) -> dict[str, Agreement]:
    """The comparison of all jobs with one of them, at the peak of its mean force."""
    base = section(jobs[reference], number, component)
    time = peak_time(jobs[reference])
    return {
        name: agreement(section(job, number, component), base, time) for name, job in jobs.items()
    }


def stress_text(jobs: dict[str, Results]) -> str:
    """One table for each of the figures."""
    name, time = REFERENCE.upper(), peak_time(jobs[REFERENCE])
    first = (
        f"At {time * MICRO:.0f} µs, the peak of the 20 µs mean of the contact force of {name}."
        f" Differences are to {name}: the largest as a share of its largest stress, relative L2 as"
        " a share of its size through the thickness, or through the thickness and all instants.\n"
    )
    parts = [first]
    for number, place, component, figure in SHOWN:
        parts.append(f"Figure {figure}, `{component}` at {place}:\n")
        found = agreements(jobs, REFERENCE, number, component)
        parts.append(_table(found, component in INTERLAMINAR))
    return "\n".join(parts)


def _table(found: dict[str, Agreement], continuous: bool) -> str:
    """Differences; jumps only of a component that should have none."""
    headings = ["model", "largest [MPa]", "largest difference", "relative L2", "over the run"]
    headings += ["means of plies, L2"]
    if continuous:
        headings += ["largest jump between plies", "on the free faces"]
    rows = []
    for name, one in found.items():
        shares = [one.largest, one.size, one.whole, one.means]
        shares += [one.jump, one.end] if continuous else []
        rows.append([name.upper(), f"{one.peak:.4g}", *map(percent, shares)])
    return table(headings, rows)


def percent(share: float) -> str:
    """A share in print."""
    return f"{100.0 * share:.1f} %"


def draw_stress(jobs: Sequence[Results], folder: Path) -> list[Path]:
    """The paper's figures 4 and 5, all models at the same instant."""
    reference = next(job for job in jobs if job.job == REFERENCE)
    time = peak_time(reference)
    groups = ((1, ("sxx", "sxy"), "figure_4_at_48_48"), (2, ("sxz", "syz"), "figure_5_at_40_40"))
    return [
        draw_profiles(read_profiles(jobs, number, time), components, folder / f"{name}.png")
        for number, components, name in groups
    ]
