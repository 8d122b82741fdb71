"""Quads seen from above: fine triangles for maps, areas, and the quad in which a place lies."""

from __future__ import annotations

from dataclasses import dataclass

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


def sheet_of(places: np.ndarray, values: np.ndarray, parts: int = PARTS) -> Sheet:
    """A field at the nodes of quads, (quads, n, n, 2) and (quads, n, n).

    The values stay within those at the nodes of their quad, where the interpolation would not.
    """
    fine = refine_faces(np.concatenate([places, values[..., None]], axis=3), parts)
    low, high = (end(values, axis=(1, 2))[:, None, None] for end in (np.min, np.max))
    between = np.clip(fine[..., 2], low, high)
    return sheet_of_points(fine[..., :2].reshape(len(fine), -1, 2), between.reshape(len(fine), -1))


def sheet_of_points(places: np.ndarray, values: np.ndarray) -> Sheet:
    """A field at the fine points of quads, (quads, points, 2) and (quads, points)."""
    parts = round(np.sqrt(values.shape[1])) - 1
    return Sheet(places.reshape(-1, 2), _triangles(len(values), parts), values.ravel())


def _triangles(quads: int, parts: int) -> np.ndarray:
    """Triangles of grids of (parts + 1)^2 points each, (triangles, 3)."""
    number = np.arange(quads * (parts + 1) ** 2).reshape(quads, parts + 1, parts + 1)
    a, b = number[:, :-1, :-1].ravel(), number[:, 1:, :-1].ravel()
    c, d = number[:, 1:, 1:].ravel(), number[:, :-1, 1:].ravel()
    return np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


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


def edges_of(places: np.ndarray, parts: int = PARTS) -> tuple[np.ndarray, np.ndarray]:
    """Lines along the sides of quads, (lines, parts + 1, 2): those between quads, and the rim."""
    fine = refine_faces(places, parts)
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
    if len(quads) == 0:
        return Found(owner, weights)
    slack = 1e-6 * float(np.ptp(quads.reshape(-1, 2), axis=0).max())
    for number, nodes in enumerate(quads):
        low, high = nodes.min(axis=(0, 1)) - slack, nodes.max(axis=(0, 1)) + slack
        near = np.flatnonzero((owner < 0) & np.all((places >= low) & (places <= high), axis=1))
        if len(near) == 0:
            continue
        inside, table = _inverse(nodes, places[near])
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
