"""Plane meshes of quads, straight or distorted, and what can be integrated over them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from elasticity import Array

Integers = NDArray[np.int64]

# Places of the nodes of a quad in its own 3 x 3 grid: corners, mid-sides, centre
GRID = np.array([[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1], [1, 1]])


@dataclass(frozen=True)
class Mesh:
    """Points (n, 2) and quads (m, 4 or 9), nodes from 0."""

    points: Array
    quads: Integers

    def at(self, x: float, y: float) -> int:
        """Node nearest to a place."""
        return int(np.argmin(np.hypot(self.points[:, 0] - x, self.points[:, 1] - y)))

    def where(self, x: float | None = None, y: float | None = None) -> list[int]:
        """Nodes on a line x = const or y = const, or on the crossing of two."""
        chosen = np.ones(len(self.points), bool)
        for k, value in enumerate((x, y)):
            if value is not None:
                chosen &= np.abs(self.points[:, k] - value) < 1e-9
        return [int(node) for node in np.flatnonzero(chosen)]

    def boundary(self) -> list[int]:
        """Nodes on the edges of the rectangle that the mesh fills."""
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        outer = (np.abs(self.points - low) < 1e-9) | (np.abs(self.points - high) < 1e-9)
        return [int(node) for node in np.flatnonzero(outer.any(axis=1))]


def rectangle(xs: Array, ys: Array, nodes: int) -> Mesh:
    """Quads of 4 or 9 nodes between the lines x = xs and y = ys."""
    if nodes == 9:
        grid_x, grid_y = _halved(xs), _halved(ys)
        places, step = GRID, 2
    else:
        grid_x, grid_y = np.asarray(xs, float), np.asarray(ys, float)
        places, step = GRID[:4] // 2, 1
    points = np.array([(x, y) for y in grid_y for x in grid_x])
    quads = [
        [(j * step + b) * len(grid_x) + i * step + a for a, b in places]
        for j in range(len(ys) - 1)
        for i in range(len(xs) - 1)
    ]
    return Mesh(points, np.array(quads))


def regular(length: float, width: float, nx: int, ny: int, nodes: int) -> Mesh:
    """A rectangle from the origin with nx by ny equal quads."""
    return rectangle(np.linspace(0.0, length, nx + 1), np.linspace(0.0, width, ny + 1), nodes)


def without(mesh: Mesh, cut: NDArray[np.bool_]) -> Mesh:
    """What is left when some quads, (m,), are cut out; nodes that no quad has go with them."""
    quads = mesh.quads[~cut]
    used, number = np.unique(quads, return_inverse=True)
    return Mesh(mesh.points[used], number.reshape(quads.shape))


def disc(n: int, rings: int, radius: float, core: float, outer: Sequence[float] = ()) -> Mesh:
    """A square core of n x n quads of nine nodes, rings of 4 n quads up to the circle.

    More rings of 4 n quads end at the radii `outer`.
    """
    places: dict[tuple[float, float], int] = {}
    quads: list[list[int]] = []

    def number(point: Array) -> int:
        return places.setdefault((round(point[0], 9), round(point[1], 9)), len(places))

    def block(at: object, across: int, along: int) -> None:
        lines = [
            [number(at(i / (2 * across), j / (2 * along))) for j in range(2 * along + 1)]
            for i in range(2 * across + 1)
        ]
        for i in range(across):
            for j in range(along):
                quads.append([lines[2 * i + a][2 * j + b] for a, b in GRID])

    block(lambda s, t: core * np.array([s - 0.5, t - 0.5]), n, n)
    for quarter in range(4):
        turn = np.linalg.matrix_power(np.array([[0, -1], [1, 0]]), quarter)

        def between(s: float, t: float, turn: Array = turn) -> Array:
            angle = 0.5 * np.pi * (t - 0.5)
            outer = radius * np.array([np.cos(angle), np.sin(angle)])
            return turn @ ((1.0 - s) * core * np.array([0.5, t - 0.5]) + s * outer)

        block(between, rings, n)
        for inner, end in pairwise((radius, *outer)):

            def around(s: float, t: float, turn: Array = turn, ring: Array = (inner, end)) -> Array:
                angle = 0.5 * np.pi * (t - 0.5)
                here = ring[0] + s * (ring[1] - ring[0])
                return turn @ (here * np.array([np.cos(angle), np.sin(angle)]))

            block(around, 1, n)
    return Mesh(np.array(list(places)), np.array(quads))


def distorted(mesh: Mesh, shift: float, seed: int = 1) -> Mesh:
    """Shift every node inside by up to `shift` in x and y, mid-sides and centres too."""
    random = np.random.default_rng(seed)
    points = mesh.points + random.uniform(-shift, shift, mesh.points.shape)
    edge = mesh.boundary()
    points[edge] = mesh.points[edge]
    return Mesh(points, mesh.quads)


def _halved(lines: Array) -> Array:
    """The lines with their mid-lines."""
    lines = np.asarray(lines, float)
    both = np.empty(2 * len(lines) - 1)
    both[::2] = lines
    both[1::2] = 0.5 * (lines[1:] + lines[:-1])
    return both


def shapes(nodes: int, xi: float, eta: float) -> tuple[Array, Array]:
    """Shape functions (nodes,) and their derivatives (nodes, 2) at a point of a quad."""
    if nodes == 4:
        values = [np.array([1.0 - s, 1.0 + s]) / 2.0 for s in (xi, eta)]
        slopes = [np.array([-0.5, 0.5])] * 2
        places = GRID[:4] // 2
    else:
        values = [
            np.array([s * (s - 1.0) / 2.0, 1.0 - s * s, s * (s + 1.0) / 2.0]) for s in (xi, eta)
        ]
        slopes = [np.array([s - 0.5, -2.0 * s, s + 0.5]) for s in (xi, eta)]
        places = GRID
    a, b = places.T
    derivatives = np.stack([slopes[0][a] * values[1][b], values[0][a] * slopes[1][b]], axis=1)
    return values[0][a] * values[1][b], derivatives


def consistent_forces(mesh: Mesh, pressure: object) -> Array:
    """Nodal forces (nodes,) that do the work of a pressure(x, y), by 4 x 4 Gauss points."""
    forces = np.zeros(len(mesh.points))
    places, weights = np.polynomial.legendre.leggauss(4)
    for quad in mesh.quads:
        for xi, u in zip(places, weights, strict=True):
            for eta, v in zip(places, weights, strict=True):
                values, slopes = shapes(len(quad), xi, eta)
                x, y = values @ mesh.points[quad]
                area = np.linalg.det(slopes.T @ mesh.points[quad])
                forces[quad] += u * v * area * values * pressure(x, y)
    return forces


def plane_weights(mesh: Mesh) -> Array:
    """Area of every node (nodes,) when mass is integrated at the nodes themselves."""
    areas = np.zeros(len(mesh.points))
    line = {4: np.array([1.0, 1.0]), 9: np.array([1.0, 4.0, 1.0]) / 3.0}[mesh.quads.shape[1]]
    places = np.linspace(-1.0, 1.0, len(line))
    grid = GRID if len(line) == 3 else GRID[:4] // 2
    for quad in mesh.quads:
        for node, (a, b) in zip(quad, grid, strict=True):
            slopes = shapes(len(quad), places[a], places[b])[1]
            areas[node] += line[a] * line[b] * np.linalg.det(slopes.T @ mesh.points[quad])
    return areas
