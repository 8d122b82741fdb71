"""Facets of a face, and the closest point on them: inside, on all sides and at all corners."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from elasticity import Array
from meshes import GRID, Integers

#: Sides of a quad from corner to corner: the coordinate that is fixed, and where
SIDES = ((1, -1.0), (0, 1.0), (1, 1.0), (0, -1.0))
#: Where Newton's method may start, along either coordinate
STARTS = np.linspace(-0.9, 0.9, 4)


@dataclass(frozen=True)
class Face:
    """Facets of a face, and the sides (facet, 0 to 3) that no other facet has."""

    quads: Integers
    border: set[tuple[int, int]]


@dataclass(frozen=True)
class Foot:
    """Closest point of a face: its facet, its place there, and from it to the point."""

    facet: int
    local: Array
    arm: Array


def face_of(quads: Integers) -> Face:
    """Find the border of some facets."""
    pairs = [frozenset((quad[s], quad[(s + 1) % 4])) for quad in quads.tolist() for s in range(4)]
    return Face(quads, {divmod(k, 4) for k, pair in enumerate(pairs) if pairs.count(pair) == 1})


def closest(points: Array, quads: Integers, place: Array) -> Foot:
    """Closest point of all facets; boxes around them tell which need not be looked at."""
    low, high = points[quads].min(axis=1), points[quads].max(axis=1)
    slack = 0.15 * (high - low)
    outside = np.maximum(np.maximum(low - slack - place, place - high - slack), 0.0)
    bounds = np.linalg.norm(outside, axis=1)
    best, least = Foot(-1, np.zeros(2), np.zeros(3)), np.inf
    for facet in np.argsort(bounds, kind="stable"):
        if bounds[facet] >= least:
            break
        corners = points[quads[facet]] - place
        for local in _candidates(corners):
            arm = -shape(len(corners), local) @ corners
            distance = float(np.linalg.norm(arm))
            if distance < least * (1.0 - 1.0e-13):
                best, least = Foot(int(facet), local, arm), distance
    return best


def closest_on_side(corners: Array, side: int) -> tuple[Array, Array]:
    """Place on a side of a facet that is closest to the origin, and from there to the origin."""
    places = _side(corners, side)
    arms = [-shape(len(corners), local) @ corners for local in places]
    best = int(np.argmin(np.linalg.norm(arms, axis=1)))
    return places[best], arms[best]


def normal_at_fold(points: Array, face: Face, facet: int, local: Array, side: int) -> Array:
    """Mean of the normals of all facets that have a point of a side or a corner.

    Those at the border count together with their images in the vertical plane through the border.
    """
    here = shape(face.quads.shape[1], local) @ points[face.quads[facet]]
    size = np.ptp(points[face.quads[facet]], axis=0).max()
    total, images = np.zeros(3), []
    corners = set(face.quads[facet, :4].tolist())
    for other in np.flatnonzero([bool(corners & set(quad[:4])) for quad in face.quads.tolist()]):
        quad = points[face.quads[other]]
        places = {s: closest_on_side(quad - here, s) for s in range(4)}
        touched = {s: at for s, (at, arm) in places.items() if np.linalg.norm(arm) < 1e-9 * size}
        if not touched:
            continue
        normal = side * np.cross(*tangents(quad, next(iter(touched.values()))))
        total += normal / np.linalg.norm(normal)
        for s, at in touched.items():
            if (int(other), s) in face.border:
                along = tangents(quad, at)[1 - SIDES[s][0]]
                images.append(np.array([along[1], -along[0], 0.0]) / np.hypot(*along[:2]))
    for across in images:
        total = total - (total @ across) * across
    return total / np.linalg.norm(total)


def shape(nodes: int, local: Array) -> Array:
    """Shape functions at a place."""
    return _products(nodes, local, 0, 0)


def tangents(corners: Array, local: Array) -> Array:
    """Derivatives of the place along xi and eta, (2, 3)."""
    return np.array(
        [_products(len(corners), local, *times) @ corners for times in ((1, 0), (0, 1))]
    )


def _candidates(corners: Array) -> list[Array]:
    """Places where a facet may be closest to the origin: one inside, else on its sides."""
    inside = _inside(corners)
    if inside is not None:
        return [inside]
    return [local for side in range(4) for local in _side(corners, side)]


def _inside(corners: Array) -> Array | None:
    """Newton's method from the best start, free to leave the facet; None if it does."""
    values = _shapes_of_starts(len(corners)) @ corners
    local = np.array(np.divmod(np.argmin((values**2).sum(axis=1)), len(STARTS)))
    local = STARTS[local.astype(int)]
    for _ in range(30):
        step = _newton(corners, local)
        local = local + step
        if np.abs(local).max() > 2.0:
            return None
        if np.abs(step).max() < 1.0e-14:
            break
    return local if np.abs(local).max() < 1.0 else None


def _newton(corners: Array, local: Array) -> Array:
    """Step towards a facet's closest point to the origin; downhill where that is not convex."""
    value, along = shape(len(corners), local) @ corners, tangents(corners, local)
    bends = [_products(len(corners), local, *times) @ corners @ value for times in _SECONDS]
    metric = along @ along.T
    curve = metric + np.array([[bends[0], bends[1]], [bends[1], bends[2]]])
    if curve[0, 0] <= 0.0 or np.linalg.det(curve) <= 0.0:
        curve = metric
    return -np.linalg.solve(curve, along @ value)


_SECONDS = ((2, 0), (1, 1), (0, 2))


@cache
def _shapes_of_starts(nodes: int) -> Array:
    """Shape functions at the starts of Newton's method, (starts, nodes)."""
    return np.array([shape(nodes, np.array([x, y])) for x in STARTS for y in STARTS])


def _side(corners: Array, side: int) -> list[Array]:
    """Places on a side where the distance from the origin is stationary, and its ends."""
    axis, end = SIDES[side]

    def local(along: float) -> Array:
        return np.array([end, along] if axis == 0 else [along, end])

    first, middle, last = (shape(len(corners), local(t)) @ corners for t in (-1.0, 0.0, 1.0))
    linear, square = 0.5 * (last - first), 0.5 * (first + last) - middle
    # half the derivative of the squared distance, the constant first
    slope = np.polynomial.Polynomial(
        [
            middle @ linear,
            linear @ linear + 2.0 * middle @ square,
            3.0 * linear @ square,
            2.0 * square @ square,
        ]
    )
    slope = slope.trim(1.0e-14 * np.abs(slope.coef).max())
    roots = [float(root.real) for root in slope.roots() if abs(root.imag) < 1.0e-9]
    roots = [root - slope(root) / slope.deriv()(root) for root in roots if abs(root) < 1.0]
    return [local(along) for along in [*roots, -1.0, 1.0]]


def _products(nodes: int, local: Array, first: int, second: int) -> Array:
    """Derivatives of the shape functions, so often along xi and eta, (nodes,)."""
    tables = []
    for s, times in zip(local, (first, second), strict=True):
        if nodes == 4:
            table = [[0.5 - 0.5 * s, 0.5 + 0.5 * s], [-0.5, 0.5], [0.0, 0.0]]
        else:
            table = [
                [0.5 * s * (s - 1.0), 1.0 - s * s, 0.5 * s * (s + 1.0)],
                [s - 0.5, -2.0 * s, s + 0.5],
                [1.0, -2.0, 1.0],
            ]
        tables.append(np.array(table[times]))
    a, b = (GRID[:4] // 2 if nodes == 4 else GRID).T
    return tables[0][a] * tables[1][b]
