"""Systems of units, and how far one impact differs between them: as far as it scatters."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

#: An inch in mm, a slinch (lbf s2/in) in t, and a pound-force in N
INCH, SLINCH, POUND = 25.4, 0.1751268352, 4.448221615
#: Shares of the speed by which runs differ that show the scatter
SHARES = (-2.0e-8, -1.0e-8, 1.0e-8, 2.0e-8)
#: The force of single rows chatters, its mean over this time less
WINDOW, STEP = 5.0e-6, 1.0e-6
#: Columns of the history of an impactor
FORCE, SPEED, ABSORBED, IMPULSE = 1, 3, 5, 19


@dataclass(frozen=True)
class Units:
    """Units of length, time and mass in mm, s and t."""

    length: float = 1.0
    time: float = 1.0
    mass: float = 1.0

    @property
    def force(self) -> float:
        """That of force, in N."""
        return self.mass * self.length / self.time**2

    @property
    def stress(self) -> float:
        """That of stress, in MPa."""
        return self.force / self.length**2


METRIC = Units()


def measures(rows: np.ndarray, units: Units) -> np.ndarray:
    """In N, mm/s and mJ: the largest mean force, the last speed, and the energy absorbed."""
    time = rows[:, 0] * units.time
    impulse = np.abs(rows[:, IMPULSE]) * units.force * units.time
    passed = np.interp(np.arange(0.0, time[-1], STEP), time, impulse)
    steps = round(WINDOW / STEP)
    largest = np.max(passed[steps:] - passed[:-steps]) / WINDOW
    speed = np.abs(rows[-1, SPEED]) * units.length / units.time
    return np.array((largest, speed, rows[-1, ABSORBED] * units.force * units.length))


def check_within_scatter(own: list[np.ndarray], near: list[np.ndarray]) -> None:
    """Hold results in several systems to those of runs whose speed differs in the eighth digit.

    Round-off decides which point breaks first, as that digit does: the ranges of four runs are
    the measure. A number of a wrong unit changes results by more than a twentieth.
    """
    alike = np.array(near)
    middle, scatter = alike.mean(axis=0), np.ptp(alike, axis=0)
    assert np.all(scatter > 0.0) and np.all(scatter < 0.05 * middle), alike
    for each in own:
        assert np.all(np.abs(each - middle) < 4.0 * scatter), (each, alike)
