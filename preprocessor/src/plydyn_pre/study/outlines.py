"""Outlines of fixtures in the plane: rounded rectangles, circles, strips, and holes of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import atan2, cos, hypot, sin

import numpy as np

from plydyn_pre.mesh.grid import Mesh, Reals
from plydyn_pre.study.fixtures import Bar, Clamp, Fixture, Plane, Ring
from plydyn_pre.study.study import Study


@dataclass(frozen=True)
class Outline:
    """A rounded rectangle; a body lies inside of it, or outside of a hole."""

    centre: tuple[float, float]
    half: tuple[float, float]  # half of its sides
    corner: float  # radius; that of a circle is its own
    is_hole: bool = False
    turn: float = 0.0  # of its first side from x, radians

    def depth(self, places: Reals) -> Reals:
        """How far places, (n, 2), lie inside of the outline, below zero outside."""
        x, y = (np.atleast_2d(places) - np.array(self.centre)).T
        along = cos(self.turn) * x + sin(self.turn) * y
        across = cos(self.turn) * y - sin(self.turn) * x
        beyond = np.abs(np.stack((along, across))) - np.array(self.half)[:, None] + self.corner
        rounded = np.hypot(*np.maximum(beyond, 0.0)) + np.minimum(beyond.max(axis=0), 0.0)
        return self.corner - rounded


def outlines(study: Study, mesh: Mesh, fixture: Fixture) -> list[Outline]:
    """The outlines of a fixture on a mesh; a plane without a window has none."""
    return list(_outlines(study, mesh, fixture))


def _outlines(study: Study, mesh: Mesh, fixture: Fixture) -> Iterator[Outline]:
    """Outlines of each kind."""
    if isinstance(fixture, Bar):
        (x1, y1), (x2, y2) = fixture.start, fixture.end
        radius, length = fixture.radius, hypot(x2 - x1, y2 - y1)
        middle = (0.5 * (x1 + x2), 0.5 * (y1 + y2))
        half = (0.5 * length + radius, radius)
        yield Outline(middle, half, radius, turn=atan2(y2 - y1, x2 - x1))
        return
    centre = fixture.centre or mesh.middle
    if isinstance(fixture, Clamp | Ring):
        yield _circle(centre, fixture.outer)
        if fixture.inner > 0.0:
            yield _circle(centre, fixture.inner, is_hole=True)
        return
    size = study.window_of(fixture) if isinstance(fixture, Plane) else fixture.size
    is_hole = isinstance(fixture, Plane)
    if isinstance(size, tuple):
        yield Outline(centre, (0.5 * size[0], 0.5 * size[1]), fixture.corner, is_hole)
    elif size > 0.0:
        yield _circle(centre, 0.5 * size, is_hole=is_hole)


def _circle(centre: tuple[float, float], radius: float, *, is_hole: bool = False) -> Outline:
    """A circle."""
    return Outline(centre, (radius, radius), radius, is_hole)


def is_over(body: list[Outline], places: Reals) -> np.ndarray:
    """Which places, (n, 2), lie over a body; zero is the edge, with room for round-off."""
    over = np.ones(len(np.atleast_2d(places)), bool)
    for each in body:
        depth = each.depth(places)
        room = 1.0e-9 * max(each.half)
        over &= depth <= room if each.is_hole else depth >= -room
    return over


def way_to_edge(body: list[Outline], places: Reals) -> Reals:
    """Distance of places in a hole of a body from the edge of the hole, 0 elsewhere."""
    way = np.zeros(len(np.atleast_2d(places)))
    for each in body:
        if each.is_hole:
            way = np.maximum(way, each.depth(places))
    return way


def way_out(body: list[Outline], places: Reals) -> float:
    """Distance of the nearest of some places outside of a body from it, huge without outlines."""
    inside = [(-1.0 if each.is_hole else 1.0) * each.depth(places) for each in body]
    return float(-np.min(inside, axis=0).max()) if inside else float("inf")
