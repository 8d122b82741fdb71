"""Stress through the thickness, and how the profiles of one run compare with those of another."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from plydyn_post.profile import instants
from plydyn_post.results import Results
from readings.differences import norm_share, peak_share, peak_time
from runner.pages import Quantity, percent

#: Places in each ply at which profiles are compared; none lies where thirds of a ply meet
PLACES = 12


@dataclass(frozen=True)
class Profiles:
    """A component of stress through the thickness over time."""

    times: np.ndarray  # (times,)
    values: np.ndarray  # (times, places), as many places in each ply
    jumps: np.ndarray  # (times, faces between plies), sizes
    ends: np.ndarray  # (times, 2), at the bottom and the top


def read_component(results: Results, number: int, component: str) -> Profiles:
    """A component at the place of a profile, for all its instants."""
    table = results.profile(number)
    times, starts = instants(table)
    blocks = [slice(*ends) for ends in itertools.pairwise(starts)]
    z, ply, values = table["z"], table["ply"], table[component]
    faces = [np.flatnonzero(np.diff(ply[block])) for block in blocks]
    return Profiles(
        times,
        np.array([_sampled(z[block], ply[block], values[block]) for block in blocks]),
        np.array(
            [
                np.abs(np.diff(values[block])[face])
                for block, face in zip(blocks, faces, strict=True)
            ]
        ),
        np.array([values[block][[0, -1]] for block in blocks]),
    )


def _sampled(z: np.ndarray, ply: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values at the same places of each ply, however the rows are spaced."""
    share = (np.arange(PLACES) + 0.5) / PLACES
    rows = [ply == one for one in np.unique(ply)]
    return np.concatenate(
        [
            np.interp(z[own][0] + share * (z[own][-1] - z[own][0]), z[own], values[own])
            for own in rows
        ]
    )


def ply_means(values: np.ndarray) -> np.ndarray:
    """Means over the plies of values at an instant, (plies,)."""
    return values.reshape(-1, PLACES).mean(axis=1)


def block_at(times: np.ndarray, time: float) -> int:
    """Which instant is nearest to a time."""
    return int(np.argmin(np.abs(times - time)))


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
