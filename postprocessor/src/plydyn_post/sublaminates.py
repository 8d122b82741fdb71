"""Interfaces in a compression test: which ones open, when and where, and what they take."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from plydyn_post.compression import Compression
from plydyn_post.grid import has_point_field, read_times
from plydyn_post.interfaces import Interface, Interfaces, read_interfaces

#: A sublaminate is open where its gap has grown by this share of its thickness
OPEN = 0.1
#: An interface that took less than this share of the largest one in the fall had no part in it
PART = 0.1


@dataclass(frozen=True)
class StateTimes:
    """Times of states of a file: the first one, the one nearest to the peak, one after the fall."""

    first: float
    peak: float  # with the largest stress of all states before the fall
    after: float


@dataclass(frozen=True)
class OpenInterface:
    """An interface in the test; gaps are the largest ones over the plate, lengths of the job."""

    number: int  # from the bottom, from 1
    words: str  # angles of the plies below and above
    thickness: float  # of the thinner side, which buckles
    below: bool  # whether that is the lower one
    gaps: tuple[float, float, float]  # at the start of the stage, at the peak and after the fall
    place: tuple[float, float]  # of the largest gap at the peak
    opened: float | None  # stress from which on the gap had grown, before the peak
    energies: tuple[float, float] | None  # taken up to the peak, and in the fall

    @property
    def is_open(self) -> bool:
        """Whether the sublaminate has buckled at the peak."""
        return self.gaps[1] - self.gaps[0] > OPEN * self.thickness

    @property
    def opens(self) -> bool:
        """Whether it has buckled after the fall."""
        return self.gaps[2] - self.gaps[0] > OPEN * self.thickness


def states_of(test: Compression, path: Path) -> StateTimes:
    """The states of a file of fields from which a test is judged."""
    times = read_times(path)
    ended = test.time[-1] if test.fallen is None else test.time[test.fallen]
    before = times[times < ended] if np.any(times < ended) else times[:1]
    stress = np.interp(before, test.time, test.stress)
    later = times[times >= ended]
    last = later[0] if len(later) else times[-1]
    return StateTimes(float(times[0]), float(before[np.argmax(stress)]), float(last))


def open_interfaces(test: Compression) -> tuple[OpenInterface, ...]:
    """All interfaces from the bottom up; none where the results do not tell openings."""
    path = test.job.interface_fields
    if not has_point_field(path, "opening"):
        return ()
    chosen = states_of(test, path)
    times = [float(one) for one in read_times(path) if one <= chosen.peak]
    each = [read_interfaces(test.job, time) for time in times]
    after = read_interfaces(test.job, chosen.after)
    return tuple(_interface(test, number, times, each, after) for number in range(len(after.each)))


def _interface(
    test: Compression, place: int, times: list[float], each: list[Interfaces], after: Interfaces
) -> OpenInterface:
    """An interface by its place, from the states up to the peak and one after the fall."""
    one = each[-1].each[place]
    gaps = np.array([widest(state.each[place]) for state in each])
    low, high = _faces(after)
    sides = one.height - low, high - one.height
    grown = np.flatnonzero(gaps - gaps[0] > OPEN * min(sides))
    opened = float(np.interp(times[grown[0]], test.time, test.stress)) if len(grown) else None
    found = 0.0 if one.gap is None else one.gap
    where = one.places.reshape(-1, 2)[np.argmax(np.ravel(found))]
    return OpenInterface(
        one.number,
        one.words,
        min(sides),
        sides[0] <= sides[1],
        (float(gaps[0]), float(gaps[-1]), widest(after.each[place])),
        (float(where[0]), float(where[1])),
        opened,
        _energies(test, one.number),
    )


def widest(one: Interface) -> float:
    """The largest gap of an interface, 0 where its faces touch everywhere."""
    return 0.0 if one.gap is None else float(max(one.gap.max(), 0.0))


def _faces(state: Interfaces) -> tuple[float, float]:
    """Heights of the faces of the plate at time zero."""
    plies = state.header.plies
    heights = [one.height for one in state.each]
    low = min((ply["bottom"] for ply in plies if "bottom" in ply), default=min(heights))
    high = max((ply["top"] for ply in plies if "top" in ply), default=max(heights))
    return low, high


def _energies(test: Compression, number: int) -> tuple[float, float] | None:
    """What an interface took from the start of the stage to the peak, and in the fall."""
    if not test.job.has("delamination"):
        return None
    table = test.job.delamination()
    taken = table.get(f"interface {number} energy")
    if taken is None:
        return None
    first, last = test.fall(table["time"])
    return float(taken[first] - taken[0]), float(taken[last] - taken[first])


def grown_of(each: tuple[OpenInterface, ...]) -> OpenInterface | None:
    """The interface that took most energy in the fall; nothing where none took any."""
    taken = [one.energies[1] if one.energies else 0.0 for one in each]
    return each[int(np.argmax(taken))] if max(taken, default=0.0) > 0.0 else None


def opened_of(each: tuple[OpenInterface, ...], after: bool = False) -> OpenInterface | None:
    """The interface whose sublaminate buckles, at the peak or after the fall; nothing for none.

    Of several it is the one with the largest gap times the thickness that it takes from the load.
    A strip of an outer ply that buckles early and takes little in the fall is none, however wide.
    """
    known = [one for one in each if (one.opens if after else one.is_open)]
    known = [one for one in known if one not in harmless(each)]
    place = 2 if after else 1
    return max(known, key=lambda one: (one.gaps[place] - one.gaps[0]) * one.thickness, default=None)


def harmless(each: tuple[OpenInterface, ...]) -> tuple[OpenInterface, ...]:
    """Interfaces that opened before the peak and had no part in the fall."""
    most = max((one.energies[1] for one in each if one.energies), default=0.0)
    return tuple(
        one for one in each if one.is_open and one.energies and one.energies[1] < PART * most
    )
