"""Lines of quads that grow from a fine end to a coarse one."""

from __future__ import annotations

import numpy as np

from plydyn_pre.mesh.grid import Reals

_MOST_SCALE = 1.1


def growing_line(length: float, first: float, growth: float, largest: float) -> Reals:
    """Ends of quads on a line from 0, (quads + 1,), each at most `growth` times the one before.

    They start near `first` and grow to `largest` at most; all are scaled to fill the length, up by
    a tenth at most.
    """
    sizes = [min(first, largest)]
    while _MOST_SCALE * sum(sizes) < length:
        sizes.append(min(growth * sizes[-1], largest))
    places = np.concatenate([[0.0], np.cumsum(sizes)])
    return places * (length / places[-1])


def last_size(line: Reals) -> float:
    """Size of the last quad on a line."""
    return float(line[-1] - line[-2])
