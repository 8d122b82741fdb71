"""Quads seen from above: fine triangles for maps, areas, and the quad in which a place lies."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from plydyn_post.hexahedra import refine_faces, same

#: Finer parts of each side of a quad in a map
PARTS = 8
#: VTK's types of the quads, with the places of their nodes along the first and the second side
LATTICES = {
    9: np.array([[0, 3], [1, 2]]),
    28: np.array([[0, 7, 3], [4, 8, 6], [1, 5, 2]]),
}
_NEWTON_STEPS = 12


@dataclass(frozen=True)
class Sheet:
    """A field over quads as fine triangles."""

    places: np.ndarray  # (points, 2)
    triangles: np.ndarray  # (triangles, 3)
    values: np.ndarray  # (points,)


def sheet_of(places: np.ndarray, values: np.ndarray) -> Sheet:
    """A field at the nodes of quads, (quads, n, n, 2) and (quads, n, n).

    The values stay within those at the nodes of their quad, where the interpolation would not.
    """
    return sheets_of([(places, values)])[0]


def sheets_of(
    fields: Iterable[tuple[np.ndarray, np.ndarray]], parts: int = PARTS
) -> tuple[Sheet, ...]:
    """Fields as those of `sheet_of`; one over the quads of that before it shares their places."""
    sheets, known, finer = list[Sheet](), np.empty((0, 0, 0, 2)), np.empty((0, 0, 2))
    for places, values in fields:
        if not np.array_equal(places, known):
            known = places
            finer = np.ascontiguousarray(refine_faces(places, parts)).reshape(len(places), -1, 2)
        low, high = (end(values, axis=(1, 2))[:, None, None] for end in (np.min, np.max))
        between = np.clip(refine_faces(values[..., None], parts)[..., 0], low, high)
        sheets.append(sheet_of_points(finer, between.reshape(len(values), -1)))
    return tuple(sheets)


def in_window(sheet: Sheet, x: tuple[float, float], y: tuple[float, float]) -> Sheet:
    """The quads of a sheet that reach into a window; all of them where none does."""
    # of p parts: 2 p^2 triangles and (p + 1)^2 points for each quad
    share = np.sqrt(len(sheet.triangles) / (2 * len(sheet.values)))
    parts = round(share / (1.0 - share))
    places = sheet.places.reshape(-1, (parts + 1) ** 2, 2)
    low, high = np.sort([x, y], axis=1).T
    seen = np.all((places.min(axis=1) <= high) & (places.max(axis=1) >= low), axis=1)
    if np.all(seen) or not np.any(seen):
        return sheet
    return sheet_of_points(places[seen], sheet.values.reshape(len(places), -1)[seen])


def sheet_of_points(places: np.ndarray, values: np.ndarray) -> Sheet:
    """A field at the fine points of quads, (quads, points, 2) and (quads, points)."""
    parts = round(np.sqrt(values.shape[1])) - 1
    return Sheet(places.reshape(-1, 2), _triangles(len(values), parts), values.ravel())


@lru_cache(maxsize=4)
def _triangles(quads: int, parts: int) -> np.ndarray:
    """Triangles of grids of (parts + 1)^2 points each, (triangles, 3): one table for all fields."""
    count = quads * (parts + 1) ** 2
    number = np.arange(count, dtype=np.int32).reshape(quads, parts + 1, parts + 1)
    a, b = number[:, :-1, :-1].ravel(), number[:, 1:, :-1].ravel()
    c, d = number[:, 1:, 1:].ravel(), number[:, :-1, 1:].ravel()
    table = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    table.setflags(write=False)
    return table


def area_beyond(sheet: Sheet, level: float) -> float:
    """The area where a field is at or above a level, exact for the triangles."""
    return float(np.sum(areas_beyond(sheet, level)))


def areas_beyond(sheet: Sheet, level: float) -> np.ndarray:
    """That area of each triangle, (triangles,)."""
    corners = sheet.places[sheet.triangles]
    one, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = 0.5 * np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])
    a, b, c = np.sort(sheet.values[sheet.triangles], axis=1).T - level
    share = np.where(a >= 0.0, 1.0, 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        top = c**2 / ((c - a) * (c - b))
        cut = a**2 / ((a - b) * (a - c))
    share = np.where((c > 0.0) & (b <= 0.0), top, share)
    share = np.where((b > 0.0) & (a < 0.0), 1.0 - cut, share)
    return np.asarray(area * share)


def of_quads(values: np.ndarray, quads: int) -> np.ndarray:
    """Sums of values of triangles, (triangles,), over each quad of a sheet, (quads,)."""
    return np.asarray(values.reshape(2, quads, -1).sum(axis=(0, 2)))


def edges_of(places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Lines along the sides of quads, (lines, PARTS + 1, 2): those between quads, and the rim."""
    fine = refine_faces(places, PARTS)
    sides = np.concatenate([fine[:, :, 0], fine[:, :, -1], fine[:, 0, :], fine[:, -1, :]])
    size = float(np.ptp(places.reshape(-1, 2), axis=0).max())
    middle = np.rint(sides.mean(axis=1) / (1e-6 * size) + 0.1234567)
    first, _, count = same(middle)
    return sides[first[count > 1]], sides[first[count == 1]]


@dataclass(frozen=True)
class Found:
    """In which quads places lie, and where in them."""

    quad: np.ndarray  # (places,) -1 outside all quads
    weights: np.ndarray  # (places, n, n) shape functions there


def find(quads: np.ndarray, places: np.ndarray) -> Found:
    """Find places, (places, 2), in quads, (quads, n, n, 2); on a side the first quad is taken."""
    owner = np.full(len(places), -1)
    weights = np.zeros((len(places), *quads.shape[1:3]))
    if len(quads) == 0 or len(places) == 0:
        return Found(owner, weights)
    slack = 1e-6 * float(np.ptp(quads.reshape(-1, 2), axis=0).max())
    low, high = quads.min(axis=(1, 2)) - slack, quads.max(axis=(1, 2)) + slack
    # most places lie on a line, which few quads meet
    meets = np.all((low <= places.max(axis=0)) & (high >= places.min(axis=0)), axis=1)
    for number in np.flatnonzero(meets):
        here = np.all((places >= low[number]) & (places <= high[number]), axis=1)
        near = np.flatnonzero((owner < 0) & here)
        if len(near) == 0:
            continue
        inside, table = _inverse(quads[number], places[near])
        owner[near[inside]] = number
        weights[near[inside]] = table[inside]
    return Found(owner, weights)


def _inverse(nodes: np.ndarray, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Which places lie in a quad, by Newton's method, and its shape functions there."""
    at = np.full((len(places), 2), 0.5)
    for _ in range(_NEWTON_STEPS):
        x, y = _lagrange(at[:, 0], len(nodes)), _lagrange(at[:, 1], len(nodes))
        gap = places - np.einsum("pa,pb,abk->pk", x[0], y[0], nodes)
        columns = [np.einsum("pa,pb,abk->pk", x[1], y[0], nodes)]
        columns.append(np.einsum("pa,pb,abk->pk", x[0], y[1], nodes))
        at += np.linalg.solve(np.stack(columns, axis=2), gap[..., None])[..., 0].clip(-0.5, 0.5)
    inside = np.all((at >= -1e-6) & (at <= 1.0 + 1e-6), axis=1)
    x, y = (_lagrange(at[:, axis].clip(0.0, 1.0), len(nodes))[0] for axis in (0, 1))
    return inside, x[:, :, None] * y[:, None, :]


def _lagrange(at: np.ndarray, nodes: int) -> np.ndarray:
    """Lagrange functions of 2 or 3 nodes from 0 to 1, and their slopes, (2, places, nodes)."""
    one = np.ones_like(at)
    if nodes == 2:
        return np.stack([np.stack([1 - at, at], axis=1), np.stack([-one, one], axis=1)])
    values = [(2 * at - 1) * (at - 1), 4 * at * (1 - at), at * (2 * at - 1)]
    slopes = [4 * at - 3, 4 - 8 * at, 4 * at - 1]
    return np.stack([np.stack(values, axis=1), np.stack(slopes, axis=1)])
