"""Hexahedra of 8 and 27 nodes as lattices of nodes: their faces, and finer points on them."""

from __future__ import annotations

from functools import cache

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkHexahedron, vtkTriQuadraticHexahedron

# Cell types of VTK
LINEAR, QUADRATIC = 12, 29
# Names of faces by place: four sides, bottom and top
SIDES, BOTTOM, TOP = (0, 1, 2, 3), 4, 5


@cache
def lattice(cell_type: int) -> np.ndarray:
    """Node at each place (along x, along y, up) of a cell, (2, 2, 2) or (3, 3, 3)."""
    cell = vtkHexahedron() if cell_type == LINEAR else vtkTriQuadraticHexahedron()
    nodes, last = (8, 1) if cell_type == LINEAR else (27, 2)
    places = np.array([cell.GetParametricCoords()[i] for i in range(3 * nodes)]).reshape(nodes, 3)
    table = np.empty((last + 1,) * 3, dtype=int)
    table[tuple(np.rint(last * places).astype(int).T)] = np.arange(nodes)
    return table


@cache
def faces(cell_type: int) -> np.ndarray:
    """Nodes of the six faces, (6, n, n), seen from outside counter-clockwise.

    On the sides the first axis runs along the edge and the second one up.
    """
    nodes = lattice(cell_type)
    return np.array(
        [
            nodes[:, 0, :],
            nodes[-1, :, :],
            nodes[::-1, -1, :],
            nodes[0, ::-1, :],
            nodes[:, ::-1, 0],
            nodes[:, :, -1],
        ]
    )


@cache
def finer(nodes: int, parts: int) -> np.ndarray:
    """Lagrange functions of an edge at the ends of its equal parts, (parts + 1, nodes)."""
    at = np.linspace(0.0, 1.0, parts + 1)
    places = np.linspace(0.0, 1.0, nodes)
    table = np.ones((parts + 1, nodes))
    for one in range(nodes):
        for other in set(range(nodes)) - {one}:
            table[:, one] *= (at - places[other]) / (places[one] - places[other])
    return table


def refine_faces(values: np.ndarray, parts: int) -> np.ndarray:
    """Values at the finer points of faces, (faces, n, n, k) to (faces, parts+1, parts+1, k)."""
    table = finer(values.shape[1], parts)
    return np.einsum("ai,bj,fijk->fabk", table, table, values, optimize=True)


def refine_edges(values: np.ndarray, parts: int) -> np.ndarray:
    """Values at the finer points of edges, (edges, n, k) to (edges, parts+1, k)."""
    return np.einsum("ai,eik->eak", finer(values.shape[1], parts), values, optimize=True)


def refine_cells(values: np.ndarray, parts: int) -> np.ndarray:
    """Values at the finer points of cells, (cells, n, n, n, k) to (cells, p+1, p+1, p+1, k)."""
    table = finer(values.shape[1], parts)
    return np.einsum("ai,bj,cl,eijlk->eabck", table, table, table, values, optimize=True)


def same(keys: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rows of whole numbers that are equal: (first of each kind, kind of each row, how many)."""
    keys = np.ascontiguousarray(keys, dtype=np.int64)
    weights = np.random.default_rng(1).integers(1, 2**62, size=keys.shape[1], dtype=np.int64)
    marks = (keys * weights).sum(axis=1)  # equal rows share a mark; others by chance of 2**-63
    _, first, kind, count = np.unique(
        marks, return_index=True, return_inverse=True, return_counts=True
    )
    return first, kind, count


def rounded(values: np.ndarray, step: float) -> np.ndarray:
    """Whole numbers of steps; the offset keeps usual coordinates off the limits of rounding."""
    return np.rint(values / step + 0.1234567).astype(np.int64)
