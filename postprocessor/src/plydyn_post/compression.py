"""A test of a plate: stress over end shortening, strain gauges, strength, and what ended it.

In a tension test the end is pulled, and the shortening is an elongation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plydyn_post.errors import ResultsError
from plydyn_post.header import read_header
from plydyn_post.profile import instants
from plydyn_post.results import Results
from plydyn_post.table import Table
from plydyn_post.vtkhdf import layout_of

#: The force has fallen, and the test ended, when it is below this share of the peak
FALLEN = 0.7
#: Energies of what breaks, with their names in print
EVENTS = {
    "fibre damage": "fibres",
    "matrix damage": "matrix",
    "delamination": "delamination",
}
#: A kinetic energy above this share of the internal one is not quasi-static
QUASI_STATIC = 0.05
#: Percent bending that ASTM D7137 allows
MOST_BENDING = 10.0
#: Profiles of gauges and of the middle in the template of ASTM D7137
GAUGES, MIDDLE = (2, 3), 4
#: Share of the peak stress from which kinetic energy and bending are judged
LOADED = 0.2


@dataclass(frozen=True)
class Places:
    """Numbers of the profiles at the loaded end, at the gauges and in the middle of the plate.

    Where gauges or the middle are not asked for, they are those of the template, if they are there.
    """

    end: int = 1
    gauges: tuple[int, ...] | None = None
    middle: int | None = None


@dataclass(frozen=True)
class Gauge:
    """Strain gauges back to back, counted from the start of the stage, positive along the load."""

    number: int
    bottom: np.ndarray  # (times,)
    top: np.ndarray  # (times,)

    @property
    def bending(self) -> np.ndarray:
        """Percent bending, (times,): difference over sum of both strains (ASTM D7137)."""
        total = self.bottom + self.top
        return 100.0 * np.divide(
            self.bottom - self.top, total, out=np.zeros_like(total), where=total != 0.0
        )


@dataclass(frozen=True)
class Compression:
    """Histories of a test at common times, (times,); units of the job."""

    job: Results
    axis: int  # of the load, 0 for x
    time: np.ndarray
    shortening: np.ndarray  # of the whole length
    stress: np.ndarray  # force over width and thickness
    gauges: tuple[Gauge, ...]
    faces: np.ndarray | None  # deflection of both faces in the middle, bottom and top, (times, 2)
    width: float
    thickness: float
    length: float
    units: dict[str, str]
    pulled: bool = False  # tension: shortening and strains are elongations

    @property
    def moved(self) -> str:
        """The word for the motion of the loaded end."""
        return "elongation" if self.pulled else "end shortening"

    @property
    def peak(self) -> int:
        """Place of the largest stress."""
        return int(np.argmax(self.stress))

    @property
    def strength(self) -> float:
        """Largest stress: peak force over width and thickness."""
        return float(self.stress[self.peak])

    @property
    def fallen(self) -> int | None:
        """Place at which the stress has fallen after the peak; nothing where it has not."""
        after = self.stress[self.peak :] < FALLEN * self.strength
        return self.peak + int(np.argmax(after)) if after.any() else None

    @property
    def strain(self) -> float:
        """Mean strain of the gauges at the peak, far from the damage."""
        if not self.gauges:
            return float(self.shortening[self.peak]) / self.length
        faces = [face[self.peak] for gauge in self.gauges for face in (gauge.bottom, gauge.top)]
        return float(np.mean(faces))

    @property
    def bending(self) -> float:
        """Largest percent bending of the gauges at the peak."""
        return max((abs(float(gauge.bending[self.peak])) for gauge in self.gauges), default=0.0)

    def loaded(self) -> np.ndarray:
        """Whether the test goes on, (times,): from a share of the peak stress up to the peak."""
        place = np.arange(len(self.stress))
        begun = int(np.argmax(self.stress >= LOADED * self.strength))
        return (place >= begun) & (place <= self.peak)

    def kinetic_share(self) -> float:
        """Largest kinetic energy over the internal one while the test goes on."""
        energy = self.job.energy()
        share = energy["kinetic"] / np.maximum(np.abs(energy["internal"]), 1e-300)
        times = self.time[self.loaded()]
        inside = (energy["time"] >= times[0]) & (energy["time"] <= times[-1])
        return float(share[inside].max(initial=0.0))

    def kinetic_at_peak(self) -> float:
        """Kinetic energy over the internal one at the peak."""
        energy = self.job.energy()
        row = self.fall(energy["time"])[0]
        return float(energy["kinetic"][row] / max(abs(energy["internal"][row]), 1e-300))

    def unbalance(self) -> float:
        """Difference of the forces of both ends over the load at the peak: what inertia carries."""
        supports = self.job.supports()
        whole = abs(float(supports[f"f{'xyz'[self.axis]}"][self.peak]))
        return whole / (self.strength * self.width * self.thickness)

    def broken(self) -> dict[str, float]:
        """Energy that each mechanism took while the stress fell from its peak."""
        energy = self.job.energy()
        first, last = self.fall(energy["time"])
        columns = {name: energy.get(name) for name in EVENTS}
        return {
            name: float(values[last] - values[first])
            for name, values in columns.items()
            if values is not None
        }

    def fall(self, times: np.ndarray) -> tuple[int, int]:
        """Rows of a history that enclose the fall: the last one before the peak, one after it.

        A collapse may take less time than lies between two rows, so that nothing is interpolated.
        """
        slack = 1e-9 * float(np.ptp(self.time))
        ended = self.time[-1] if self.fallen is None else self.time[self.fallen]
        first = int(np.searchsorted(times, self.time[self.peak] + slack, side="right")) - 1
        last = int(np.searchsorted(times, ended - slack))
        return max(first, 0), min(last, len(times) - 1)


def read_compression(job: Results, places: Places | None = None) -> Compression:
    """A test from the force of what moves the end, and the profiles at the places."""
    places = places or Places()
    _check_histories(job)
    supports = job.supports()
    time, (axis, force) = supports["time"], _pushing(supports, job)
    low, high, thickness = _extent(job)
    across = 1 - axis
    width, length = high[across] - low[across], high[axis] - low[axis]
    moved = _moved(job, places, time, axis)
    if np.all(moved == 0.0):
        raise ResultsError(f"{job.job}: profile {places.end} at the end does not move; see --end")
    gauges, middle = _chosen(job, places)
    pulled = _is_pulled(job, places, time, axis, force)
    faces = None if middle is None else np.stack(_faces(job, middle, "uz", time), axis=1)
    return Compression(
        job,
        axis,
        time,
        moved,
        force / (width * thickness),
        tuple(_gauge(job, number, axis, time, 1.0 if pulled else -1.0) for number in gauges),
        faces,
        float(width),
        thickness,
        float(length),
        read_header(job.fields).units,
        pulled,
    )


def _check_histories(job: Results) -> None:
    """Refuse a job without the histories that a strength is computed from."""
    if not job.has("supports"):
        raise ResultsError(
            f"{job.job} has no history of support forces, from which the strength is computed: give"
            " outputs.support_interval in the stage of the recipe (*DATABASE_SPCFORC in its deck)"
        )
    if not job.profiles:
        raise ResultsError(
            f"{job.job} has no profile, from which the end shortening is read: give"
            " [[outputs.profiles]] in the recipe (*DATABASE_PROFILE in its first deck)"
        )


def _chosen(job: Results, places: Places) -> tuple[tuple[int, ...], int | None]:
    """Profiles at the gauges and in the middle: what was asked for, else what is there."""
    gauges, middle = places.gauges, places.middle
    if gauges is None:
        gauges = tuple(number for number in GAUGES if number in job.profiles)
    if middle is None and MIDDLE in job.profiles:
        middle = MIDDLE
    return gauges, middle


def _is_pulled(
    job: Results, places: Places, time: np.ndarray, axis: int, force: np.ndarray
) -> bool:
    """Whether the loaded end is pulled: both faces together are longer at the largest force."""
    letter = "xyz"[axis]
    strain = np.sum(_faces(job, places.end, f"e{letter}{letter}", time), axis=0)
    return bool(strain[np.argmax(force)] > strain[0])


def _gauge(job: Results, number: int, axis: int, time: np.ndarray, sign: float) -> Gauge:
    """Strain along the load on both faces at a profile, times a sign."""
    letter = "xyz"[axis]
    bottom, top = _faces(job, number, f"e{letter}{letter}", time)
    return Gauge(number, sign * (bottom - bottom[0]), sign * (top - top[0]))


def _pushing(supports: Table, job: Results) -> tuple[int, np.ndarray]:
    """Axis and force, positive along the load, of the motion of the deck with the largest force."""
    names = [
        name
        for name in supports.names
        if name.startswith(("motion", "face motion")) and name.endswith(("fx", "fy"))
    ]
    if not names:
        raise ResultsError(f"{job.job} has no prescribed motion that loads it along x or y")
    largest = max(names, key=lambda name: float(np.max(np.abs(supports[name]))))
    force = supports[largest]
    if not np.any(force):
        raise ResultsError(f"{job.job}: nothing loads the plate")
    sign = np.sign(force[np.argmax(np.abs(force))])
    return "xy".index(largest[-1]), sign * force


def _extent(job: Results) -> tuple[np.ndarray, np.ndarray, float]:
    """Lower and upper corner of the plate, (3,), and its thickness."""
    points = layout_of(job.fields).points
    low, high = points.min(axis=0), points.max(axis=0)
    thickness = float(high[2] - low[2])
    if thickness <= 0.0:
        raise ResultsError(f"{job.fields}: the plate has no thickness")
    return low, high, thickness


def _moved(job: Results, places: Places, time: np.ndarray, axis: int) -> np.ndarray:
    """Shortening of the plate, (times,): mean motion of the loaded end since the first time."""
    faces = _faces(job, places.end, f"u{'xyz'[axis]}", time)
    mean = 0.5 * (faces[0] + faces[1])
    mean = mean - mean[0]
    return mean if mean[np.argmax(np.abs(mean))] > 0.0 else -mean


def _faces(job: Results, number: int, name: str, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A column of a profile on the bottom and the top face of the plate, at some times."""
    table = job.profile(number)
    times, starts = instants(table)
    values = table[name]
    return (
        np.interp(time, times, values[starts[:-1]]),
        np.interp(time, times, values[starts[1:] - 1]),
    )
