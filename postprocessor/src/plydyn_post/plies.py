"""Plies of a state: its hexahedra sorted into plies and columns, and the stress through one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pyvista as pv

from plydyn_post.errors import ResultsError
from plydyn_post.grid import PLY_TENSOR, TENSOR, nearest, read_times
from plydyn_post.hexahedra import lattice
from plydyn_post.results import Results
from plydyn_post.sheets import find
from plydyn_post.surface import blocks_of
from plydyn_post.symmetry import read_whole
from plydyn_post.vtkhdf import nodes_of


@dataclass(frozen=True)
class PlyCells:
    """The cells of a ply; layers of a column lie above each other."""

    number: int  # from the bottom, from 1
    angle: float  # degrees, nan where not known
    nodes: np.ndarray  # (columns, layers, n, n, n) points of the grid, from the bottom up


@dataclass(frozen=True)
class Stack:
    """All plies at an instant, from the bottom up, with columns in the same order."""

    time: float
    grid: pv.UnstructuredGrid
    plies: tuple[PlyCells, ...]

    @property
    def places(self) -> np.ndarray:
        """The quads of the columns at time zero, (columns, n, n, 2)."""
        return np.asarray(self.grid.points)[self.plies[0].nodes[:, 0, :, :, 0], :2].astype(float)

    def values(self, ply: PlyCells, name: str) -> np.ndarray:
        """A field at the nodes of a ply, (columns, layers, n, n, n) or with components."""
        return np.asarray(self.grid.point_data[name], dtype=float)[ply.nodes]


def read_stack(results: Results, time: float | None = None) -> Stack:
    """The plies at the state nearest to a time, at the last one without."""
    times = read_times(results.fields)
    step = len(times) - 1 if time is None else nearest(times, time, results.fields)
    grid = read_whole(results, results.fields, step)
    blocks = blocks_of(grid)
    if len(blocks) != 1:
        raise ResultsError(f"{results.fields} mixes kinds of hexahedra; maps need one kind")
    data = grid.cell_data
    ply = np.asarray(data["ply"]).astype(int) if "ply" in data else np.ones(grid.n_cells, int)
    angle = np.asarray(data["angle"], float) if "angle" in data else np.full(grid.n_cells, np.nan)
    nodes = nodes_of(grid, blocks[0].kind)[:, lattice(blocks[0].kind)]
    element = _element(grid, nodes)
    order = _columns(grid, nodes, element)
    everywhere = len(np.unique(element))
    plies: list[PlyCells] = []
    for number in np.unique(ply):
        own = order[ply[order] == number]
        quads, layers = np.unique(element[own], return_counts=True)
        if len(quads) < everywhere or np.ptp(layers) > 0:
            raise ResultsError(
                f"{results.fields}: ply {number} covers {len(quads)} of {everywhere} quads;"
                " maps need plies that cover all, with as many cells over each"
            )
        shaped = nodes[own].reshape(len(quads), layers[0], *nodes.shape[1:])
        plies.append(PlyCells(int(number), float(angle[own[0]]), shaped))
    return Stack(float(times[step]), grid, tuple(plies))


def _element(grid: pv.UnstructuredGrid, nodes: np.ndarray) -> np.ndarray:
    """The quad above or below which each cell lies, (cells,)."""
    if "element" in grid.cell_data:
        return np.asarray(grid.cell_data["element"]).astype(int)
    middle = np.asarray(grid.points)[nodes[:, :, :, 0]][..., :2].mean(axis=(1, 2))
    return np.unique(np.round(middle, 6), axis=0, return_inverse=True)[1].ravel()


def _columns(grid: pv.UnstructuredGrid, nodes: np.ndarray, element: np.ndarray) -> np.ndarray:
    """Cells column by column, each from the bottom up, (cells,)."""
    height = np.asarray(grid.points)[nodes[:, 0, 0, 0], 2]
    return np.lexsort((height, element))


@dataclass(frozen=True)
class PlyStress:
    """Stresses at the heights of the nodes of a ply, from the bottom up.

    A ply of several numerical layers has two rows where they meet.
    """

    ply: int  # from the bottom, from 1
    angle: float  # degrees
    time: float
    z: np.ndarray  # (heights,) at time zero
    stress: dict[str, np.ndarray]  # (heights,) each: sxx to sxz of the plate, s11 to s13 of the ply


def read_ply_stress(
    results: Results, ply: int, x: float, y: float, time: float | None = None
) -> PlyStress:
    """The stress of a ply over a point, at the state nearest to a time or at the last one."""
    stack = read_stack(results, time)
    chosen = {one.number: one for one in stack.plies}.get(ply)
    if chosen is None:
        raise ResultsError(f"{results.fields} has no ply {ply}; it has {len(stack.plies)}")
    found = find(stack.places, np.array([[x, y]]))
    column = int(found.quad[0])
    if column < 0:
        raise ResultsError(f"{results.fields}: the plate has no point at x {x:g}, y {y:g}")
    in_ply = "stress" not in stack.grid.point_data
    name = "stress_ply" if in_ply else "stress"
    if name not in stack.grid.point_data:
        raise ResultsError(f"{results.fields} has no stress; ask for it with *DATABASE_FIELD")
    points = np.asarray(stack.grid.points, dtype=float)[chosen.nodes[column]]
    values = stack.values(chosen, name)[column]
    z = np.einsum("ij,lijk->lk", found.weights[0], points[..., 2]).ravel()
    given = np.einsum("ij,lijkc->lkc", found.weights[0], values).reshape(-1, 6)
    plate = turned(given, -chosen.angle) if in_ply else given
    own = given if in_ply else turned(given, chosen.angle)
    stress = {f"s{name}": plate[:, place] for place, name in enumerate(TENSOR)}
    stress |= {f"s{name}": own[:, place] for place, name in enumerate(PLY_TENSOR)}
    return PlyStress(ply, chosen.angle, stack.time, z, stress)


def turned(stress: np.ndarray, angle: float) -> np.ndarray:
    """Stresses in axes turned about z by an angle in degrees, (n, 6) in the order of VTK."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    xx, yy, zz, xy, yz, xz = stress.T
    return np.column_stack(
        [
            c * c * xx + s * s * yy + 2.0 * c * s * xy,
            s * s * xx + c * c * yy - 2.0 * c * s * xy,
            zz,
            c * s * (yy - xx) + (c * c - s * s) * xy,
            c * yz - s * xz,
            s * yz + c * xz,
        ]
    )
