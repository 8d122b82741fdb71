"""Where fibres broke in a compression test: at the ends, or in the plate."""

from __future__ import annotations

import numpy as np

from plydyn_post.compression import Compression
from plydyn_post.grid import has_point_field, read_times
from plydyn_post.vtkhdf import layout_of, read_point_field

#: Growth of damage that counts as broken
BROKEN = 0.5
#: Share of the length at either end that counts as the end
END = 0.1


def broken_places(test: Compression) -> np.ndarray:
    """Places of the points whose fibres broke in the stage, (points,).

    Along the load, 0 at one end of the plate and 1 at the other; from the first state to the one
    after the fall of the stress, or to the last one.
    """
    path = test.job.fields
    if not has_point_field(path, "damage_fibre"):
        return np.empty(0)
    times, points = read_times(path), layout_of(path).points
    ended = test.time[-1] if test.fallen is None else test.time[test.fallen]
    step = int(min(np.searchsorted(times, ended), len(times) - 1))
    first, last = (read_point_field(path, "damage_fibre", k) for k in (0, step))
    along = points[:, test.axis]
    share = (along - along.min()) / np.ptp(along)
    return share[last - first > BROKEN]


def place_words(test: Compression) -> str:
    """A sentence on where fibres broke; empty where none did."""
    places = broken_places(test)
    if len(places) == 0:
        return ""
    near = float(np.mean((places < END) | (places > 1.0 - END)))
    ends = "the plate broke at its ends" if test.pulled else "the ends were crushed"
    verdict = ends if near > 0.5 else "the plate failed between its ends"
    return f"{near:.0%} of the points with broken fibres lie within a tenth of an end: {verdict}."
