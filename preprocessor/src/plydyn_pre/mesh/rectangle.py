"""Rectangles of n x m quads."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Literal

import numpy as np

from plydyn_pre.errors import require, require_between
from plydyn_pre.mesh.boards import board_of_lines
from plydyn_pre.mesh.grid import Mesh, Reals, with_centre
from plydyn_pre.mesh.limits import LARGEST_GROWTH, require_few, require_grading
from plydyn_pre.mesh.lines import graded_line, zoned_line
from plydyn_pre.mesh.zones import Zone, check_zones, spans_of

#: What `growth` is by default
_GROWTH = 1.3


@dataclass(frozen=True)
class Rectangle:
    """A rectangle of quads. Node sets: left, right, bottom, top, boundary, centre."""

    kind: ClassVar[str] = "rectangle"

    sides: tuple[float, float]  # lengths along x and y
    quads: tuple[int, int]  # along x and y, as many as there are without zones
    grading: float = 1.0  # length of the quads at the edges over those in the middle
    order: Literal[1, 2] = 2  # quads of four or of nine nodes
    corner: tuple[float, float] = (0.0, 0.0)  # place of the corner with the smallest x and y
    zones: tuple[Zone, ...] = ()  # places of finer quads
    growth: float = _GROWTH  # size of a quad outside of a zone over that of the one before

    def __post_init__(self) -> None:
        """Refuse what cannot be meshed."""
        require(min(self.sides) > 0.0, "sides", f"{self.sides} must be above zero")
        require(min(self.quads) >= 1, "quads", f"{self.quads} must be 1 or more")
        require_few(self.quads[0] * self.quads[1], "quads")
        require_grading(self.grading)
        even = all(count % 2 == 0 for count in self.quads)
        rule = f"{self.quads} must be even: a grading is finest on both sides of the middle"
        require(self.grading == 1.0 or even, "quads", rule)
        require_between(self, 1.0, LARGEST_GROWTH, "growth")
        if self.zones:
            self._check_zones()

    @property
    def idle(self) -> tuple[str, ...]:
        """Keys that have no effect, by what else is chosen."""
        return () if self.zones or self.growth == _GROWTH else ("growth",)

    def _check_zones(self) -> None:
        """Refuse zones that there cannot be."""
        rule = "1 is needed with zones: they grade the mesh"
        require(self.grading == 1.0, "grading", rule)
        high = [self.corner[axis] + self.sides[axis] for axis in (0, 1)]
        check_zones(self.zones, self.corner, high, [_size(self, axis) for axis in (0, 1)])
        require_few((len(_line(self, 0)) - 1) * (len(_line(self, 1)) - 1), "zones")


def mesh_rectangle(shape: Rectangle) -> Mesh:
    """Mesh a rectangle."""
    board = board_of_lines(_line(shape, 0), _line(shape, 1), shape.order)
    return with_centre(replace(board, nodes=np.array(shape.corner) + board.nodes))


def _line(shape: Rectangle, axis: int) -> Reals:
    """Ends of the quads along an axis, finest in the middle or in zones."""
    length, quads = shape.sides[axis], shape.quads[axis]
    spans = spans_of(shape.zones, axis, _size(shape, axis), shape.corner[axis])
    if spans:
        return zoned_line((0.0, length), spans, shape.growth, _size(shape, axis))
    if shape.grading == 1.0:
        return np.linspace(0.0, length, quads + 1)
    half = graded_line(length / 2, quads // 2, shape.grading)
    return length / 2 + np.concatenate([-half[:0:-1], half])


def _size(shape: Rectangle, axis: int) -> float:
    """Size of the quads along an axis where no zone is."""
    return shape.sides[axis] / shape.quads[axis]
