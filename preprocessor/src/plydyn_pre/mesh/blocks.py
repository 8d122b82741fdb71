"""Four-sided blocks of quads between points, by gmsh's transfinite meshing.

Blocks are meshed on a board where every quad is one by one, so that the place of a node tells its
row and column; the shapes then put the nodes where they belong, to the last digit.
"""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType

import numpy as np

from plydyn_pre.mesh.grid import Reals


class Blocks:
    """Points, lines and blocks of one gmsh model; a line is shared by the blocks beside it."""

    def __init__(self, gmsh: ModuleType) -> None:
        """Start with nothing."""
        self._geometry = gmsh.model.geo
        self._lines: dict[tuple[int, int], int] = {}

    def add_point(self, x: float, y: float) -> int:
        """A new point."""
        return self._geometry.addPoint(x, y, 0.0)

    def add_line(self, start: int, end: int, quads: int) -> int:
        """A new line of some quads."""
        line = self._geometry.addLine(start, end)
        self._geometry.mesh.setTransfiniteCurve(line, quads + 1)
        self._lines[start, end] = line
        self._lines[end, start] = -line
        return line

    def add_block(self, corners: Sequence[int]) -> int:
        """A new surface between four points whose lines are there, counter-clockwise."""
        sides = zip(corners, [*corners[1:], corners[0]], strict=True)
        loop = self._geometry.addCurveLoop([self._lines[side] for side in sides])
        surface = self._geometry.addPlaneSurface([loop])
        self._geometry.mesh.setTransfiniteSurface(surface, "Left", list(corners))
        self._geometry.mesh.setRecombine(2, surface)
        return surface

    def finish(self) -> None:
        """Hand all of it to the model."""
        self._geometry.synchronize()


def to_halves(places: Reals) -> Reals:
    """Places on the board, which are whole for corners and half for mid-sides, without noise."""
    return np.round(2.0 * places) / 2.0


def graded_line(length: float, quads: int, grading: float) -> Reals:
    """Ends of some quads on a line, (quads + 1,), the last one `grading` times the first."""
    steps = grading ** (np.arange(quads) / max(quads - 1, 1))
    places = np.concatenate([[0.0], np.cumsum(steps)])
    return places * (length / places[-1])


def place_on(line: Reals, halves: Reals) -> Reals:
    """Places along a line of corners for places on the board; mid-sides lie midway."""
    return np.interp(halves, np.arange(len(line)), line)
