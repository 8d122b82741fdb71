"""Stress through the thickness of the elastic plate: the paper's figures 4 and 5."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from plydyn_post.profile import INTERLAMINAR, draw_profiles, read_profiles
from plydyn_post.results import Results

from runner.cases import Case, Run
from runner.commands import Study, command
from runner.pages import Page, Quantity, Section, percent, tabulate
from studies.differences import (
    Profiles,
    block_at,
    norm_share,
    peak_share,
    peak_time,
    ply_means,
    read_component,
)

#: Models of the paper's figures; the one that the others are compared with
MODELS, REFERENCE = ("le1", "le2", "le3", "3le1"), "le3"
#: Fewer and smaller states than in the recipes, more profiles
OUTPUTS = (
    "outputs.field_interval=1.0",
    "outputs.profiles=[{at=[48.0,48.0],interval=5.0e-6},{at=[40.0,40.0],interval=5.0e-6}]",
)
#: Number of the profile, its place, component: figures 4a, 4b and 5
SHOWN = ((1, "(48, 48)", "sxx", "4a"), (1, "(48, 48)", "sxy", "4b"), (2, "(40, 40)", "syz", "5"))
#: Number of the profile, components and name of each picture
FIGURES = ((1, ("sxx", "sxy"), "figure_4_at_48_48"), (2, ("sxz", "syz"), "figure_5_at_40_40"))


@command()
def profiles() -> Study:
    """Stress through the thickness: the paper's figures 4 and 5 in numbers."""
    cases = [Case(name, f"elastic_impact/{name}", common=OUTPUTS) for name in MODELS]
    return Study(cases, _report, needs_all=True)


def _report(runs: list[Run], folder: Path) -> list[Page]:
    found = {run.case.name: run.results for run in runs}
    time = peak_time(found[REFERENCE])
    drawn = [
        draw_profiles(read_profiles(found.values(), number, time), names, folder / f"{name}.png")
        for number, names, name in FIGURES
    ]
    pictures = {f"elastic_{one.name}": one for one in drawn}
    return [Page("profiles", [Section("Profiles", _text(found), "profiles")], drawn, pictures)]


@dataclass(frozen=True)
class Agreement:
    """How the profile of a run compares with that of the reference, as shares of its size."""

    name: str
    largest: float  # difference at the instant, largest over largest
    size: float  # difference at the instant, root of squares
    whole: float  # difference over all instants, root of squares
    jump: float  # largest jump across a face of plies at the instant, over the largest stress
    end: float  # larger of the values at the bottom and the top, over the largest stress
    means: float  # difference of the means of the plies at the instant, root of squares
    peak: float  # largest stress at the instant


NAME = Quantity("model", lambda one: one.name.upper())
PEAK = Quantity("largest [MPa]", lambda one: one.peak, ".4g")
LARGEST = Quantity("largest difference", lambda one: percent(one.largest))
SIZE = Quantity("relative L2", lambda one: percent(one.size))
WHOLE = Quantity("over the run", lambda one: percent(one.whole))
MEANS = Quantity("means of plies, L2", lambda one: percent(one.means))
JUMP = Quantity("largest jump between plies", lambda one: percent(one.jump))
END = Quantity("on the free faces", lambda one: percent(one.end))


def agreement(name: str, ours: Profiles, reference: Profiles, time: float) -> Agreement:
    """Compare profiles with those of the reference at an instant and over all of them."""
    rows = min(len(ours.times), len(reference.times))
    gap = ours.values[:rows] - reference.values[:rows]
    k = block_at(reference.times[:rows], time)
    largest = float(np.max(np.abs(reference.values[k])))
    return Agreement(
        name,
        largest=peak_share(gap[k], reference.values[k]),
        size=norm_share(gap[k], reference.values[k]),
        whole=norm_share(gap, reference.values[:rows]),
        jump=float(np.max(ours.jumps[k])) / largest,
        end=float(np.max(np.abs(ours.ends[k]))) / largest,
        means=norm_share(ply_means(gap[k]), ply_means(reference.values[k])),
        peak=float(np.max(np.abs(ours.values[k]))),
    )


def agreements(
    found: dict[str, Results], reference: str, number: int, component: str
) -> list[Agreement]:
    """The comparison of all results with one of them, at the peak of its mean force."""
    base, time = read_component(found[reference], number, component), peak_time(found[reference])
    return [
        agreement(name, read_component(results, number, component), base, time)
        for name, results in found.items()
    ]


def _text(found: dict[str, Results]) -> str:
    """One table for each of the figures; jumps only of components that should have none."""
    name, time = REFERENCE.upper(), peak_time(found[REFERENCE])
    parts = [
        f"At {1e6 * time:.0f} µs, the peak of the 20 µs mean of the contact force of {name}."
        f" Differences are to {name}: the largest as a share of its largest stress, relative L2 as"
        " a share of its size through the thickness, or through the thickness and all instants.\n"
    ]
    for number, place, component, figure in SHOWN:
        columns: Sequence[Quantity] = (NAME, PEAK, LARGEST, SIZE, WHOLE, MEANS)
        if component in INTERLAMINAR:
            columns = (*columns, JUMP, END)
        parts.append(f"Figure {figure}, `{component}` at {place}:\n")
        parts.append(tabulate(columns, agreements(found, REFERENCE, number, component)))
    return "\n".join(parts)
