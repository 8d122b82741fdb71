"""Regions of the plane: boxes, circles and rings."""

from __future__ import annotations

from math import isclose

import numpy as np
from numpy.typing import NDArray

from plydyn_pre.errors import require
from plydyn_pre.mesh.grid import Reals

#: Smallest x, largest x, the same of y
Box = tuple[float, float, float, float]
#: x and y of the middle, radius
Circle = tuple[float, float, float]
#: x and y of the middle, inner and outer radius
Annulus = tuple[float, float, float, float]


def check_box(box: Box | None) -> None:
    """Refuse a box whose sides are the wrong way round."""
    x1, x2, y1, y2 = box or (0.0, 0.0, 0.0, 0.0)
    rule = f"{list(box or ())} must be [x1, x2, y1, y2] with x1 <= x2 and y1 <= y2"
    require(x1 <= x2 and y1 <= y2, "box", rule)


def check_circle(circle: Circle | None) -> None:
    """Refuse a circle without a radius."""
    rule = f"{list(circle or ())} must be [x, y, radius] with a radius above zero"
    require(circle is None or circle[2] > 0.0, "circle", rule)


def check_ring(ring: Annulus | None) -> None:
    """Refuse a ring whose radii are the wrong way round."""
    _, _, inner, outer = ring or (0.0, 0.0, 0.0, 1.0)
    rule = f"{list(ring or ())} must be [x, y, inner, outer] with 0 <= inner < outer"
    require(0.0 <= inner < outer and not isclose(inner, outer), "ring", rule)


def in_box(places: Reals, box: Box, slack: float) -> NDArray[np.bool_]:
    """Which of some places, (places, 2), lie in a box or next to its edge by a slack."""
    low, high = np.array([box[0], box[2]]) - slack, np.array([box[1], box[3]]) + slack
    return np.all((places >= low) & (places <= high), axis=1)


def in_ring(places: Reals, ring: Annulus, slack: float) -> NDArray[np.bool_]:
    """Which of some places, (places, 2), lie in a ring or next to its edges by a slack."""
    x, y, inner, outer = ring
    reach = np.hypot(*(places - (x, y)).T)
    return (reach >= inner - slack) & (reach <= outer + slack)
