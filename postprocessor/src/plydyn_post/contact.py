"""When an impactor touches the plate, from the history of its force."""

from __future__ import annotations

import numpy as np

# Share of the peak force below which there is no contact
SILENT = 1e-3


def touching(force: np.ndarray) -> np.ndarray:
    """Samples in contact, (n,); between the first and the last it may be lost for a while."""
    return np.flatnonzero(np.abs(force) > SILENT * float(np.max(np.abs(force))))


def contact(time: np.ndarray, force: np.ndarray) -> tuple[float, float]:
    """First and last time of contact, between the samples; later contacts are counted in."""
    inside = touching(force)
    if len(inside) == 0:
        return float(time[0]), float(time[0])
    size = np.abs(force)
    level = SILENT * float(np.max(size))
    ends = []
    for within, outside in ((inside[0], inside[0] - 1), (inside[-1], inside[-1] + 1)):
        if not 0 <= outside < len(time):
            ends.append(float(time[within]))
            continue
        share = (level - size[outside]) / (size[within] - size[outside])
        ends.append(float(time[outside] + share * (time[within] - time[outside])))
    return ends[0], ends[1]
