"""Differences of histories and of profiles, as shares of what they are compared with."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from plydyn_post.curves import Numbers, read_numbers, running_mean
from plydyn_post.profile import instants
from plydyn_post.results import Results

#: Window of the running mean of forces, and distance of the times they are compared at, s
WINDOW, STRIDE = 20e-6, 1e-6
#: Until then the plate answers as if it had no edges, s: bending waves are on their way
PLATEAU = 60e-6
#: Places in each ply at which profiles are compared; none lies where thirds of a ply meet
PLACES = 12


@dataclass(frozen=True)
class Profiles:
    """A component of stress through the thickness over time."""

    times: np.ndarray  # (times,)
    values: np.ndarray  # (times, places), as many places in each ply
    jumps: np.ndarray  # (times, faces between plies), sizes
    ends: np.ndarray  # (times, 2), at the bottom and the top


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


def read_component(results: Results, number: int, component: str) -> Profiles:
    """A component at the place of a profile, for all its instants."""
    table = results.profile(number)
    times, starts = instants(table)
    blocks = [slice(*ends) for ends in zip(starts[:-1], starts[1:], strict=True)]
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
