"""The dent that an impact leaves, and its parts: bending, plies that are thinner, and gaps.

The struck face is as deep below the plate around as the opposite face bulges, less the gaps that
are left between plies, plus what the plies below the impact have lost of their thickness. Crushing
and shear across the thickness thin the plies; debris and slip hold gaps open.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plydyn_post.body import Body
from plydyn_post.dent import faces_below
from plydyn_post.grid import has_point_field, read_displacement, read_times
from plydyn_post.header import read_header
from plydyn_post.interfaces import read_interfaces
from plydyn_post.results import Results
from plydyn_post.sheets import find


@dataclass(frozen=True)
class PermanentDent:
    """Depths at the last state below a body, away from where it came; in the unit of the fields."""

    struck: float  # of the face that was hit, below the plate around
    bulge: float  # of the opposite face
    gaps: float | None  # between the plies, all together; nothing where the results do not tell
    length: str

    @property
    def thinner(self) -> float | None:
        """What the plies have lost of their thickness."""
        return None if self.gaps is None else self.struck - self.bulge + self.gaps


def read_permanent_dent(results: Results, body: Body) -> PermanentDent | None:
    """The dent below a body that struck in this stage or an earlier one, at the last state."""
    path = results.fields
    if not has_point_field(path, "displacement"):
        return None
    _, above, faces = faces_below(results, body)
    moved = -above * read_displacement(path, len(read_times(path)) - 1)[:, 2]
    struck, bulge = (face.depth(moved) for face in faces)
    gaps = _gaps(results, np.array(body.centre[:2]))
    return PermanentDent(struck, bulge, gaps, read_header(path).units.get("length", ""))


def _gaps(results: Results, place: np.ndarray) -> float | None:
    """Sum of the gaps at a place at the last state; 0 where all plies are tied."""
    path = results.interface_fields
    if not path.is_file():
        return 0.0
    if not has_point_field(path, "opening"):
        return None
    total = 0.0
    for one in read_interfaces(results).each:
        found = find(one.places, place[None, :])
        if found.quad[0] >= 0 and one.gap is not None:
            total += float(np.sum(found.weights[0] * one.gap[found.quad[0]]))
    return total
