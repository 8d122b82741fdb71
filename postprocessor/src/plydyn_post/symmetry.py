"""Planes of symmetry: halves and quarters of a plate are drawn whole."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache, lru_cache
from pathlib import Path

import numpy as np
import pyvista as pv

from plydyn_post.errors import ResultsError
from plydyn_post.grid import PLY_TENSOR, TENSOR, read_state
from plydyn_post.header import read_header
from plydyn_post.hexahedra import LINEAR, QUADRATIC, lattice
from plydyn_post.results import Results
from plydyn_post.sheets import LATTICES
from plydyn_post.table import whole_words
from plydyn_post.vtkhdf import cells_of, grid_of, layout_of

VECTORS = ("displacement", "velocity", "opening")
TENSORS, PLY_TENSORS = ("stress", "strain"), ("stress_ply", "strain_ply")


@dataclass(frozen=True)
class Plane:
    """A plane of symmetry across x (axis 0) or y (axis 1)."""

    axis: int
    place: float


def planes_of(results: Results) -> tuple[Plane, ...]:
    """The planes about which the pictures of a job are mirrored: those of its model, or chosen.

    Chosen ones are the sides of the plate that are nearer to the impactor.
    """
    path = results.fields if results.fields.is_file() else results.interface_fields
    if results.mirror == "none" or not path.is_file():
        return ()
    changed = path.stat()
    return _planes(path, results.mirror, (changed.st_mtime_ns, changed.st_size))


@lru_cache(maxsize=8)
def _planes(path: Path, mirror: str, stamp: tuple[int, int]) -> tuple[Plane, ...]:
    """The planes; the stamp tells one version of the file from another."""
    header = read_header(path)
    if mirror == "auto":
        return tuple(Plane(axis, place) for axis, place in header.planes)
    centres = [body.centre for body in header.impactors.values()]
    centre = np.array(centres[0][:2] if centres else (0.0, 0.0))
    points = layout_of(path).points
    return tuple(_nearest_side(points, centre, "xy".index(axis)) for axis in mirror)


def _nearest_side(points: np.ndarray, centre: np.ndarray, axis: int) -> Plane:
    """The end of the plate along an axis that is nearer to the impactor."""
    ends = [float(end(points[:, axis])) for end in (np.min, np.max)]
    return Plane(axis, min(ends, key=lambda place: abs(place - centre[axis])))


def read_whole(results: Results, path: Path, step: int) -> pv.UnstructuredGrid:
    """A state of a file of fields of a job, mirrored about its planes of symmetry."""
    grid = read_state(path, step)
    for plane in planes_of(results):
        grid = mirrored(grid, plane)
    return grid


def part_of(results: Results) -> str:
    """What numbers of a job are marked with: how often the plate holds the model.

    Histories go without their fields: what is wrong with these is told where they are drawn.
    """
    try:
        planes = planes_of(replace(results, mirror="auto"))
    except ResultsError:
        return ""
    return whole_words(1 << len(planes))


def words_of(results: Results) -> str:
    """What was mirrored, for print; empty where nothing was."""
    planes = [f"{'xy'[plane.axis]} = {plane.place:g}" for plane in planes_of(results)]
    return f"mirrored about {' and '.join(planes)}" if planes else ""


def mirrored(grid: pv.UnstructuredGrid, plane: Plane) -> pv.UnstructuredGrid:
    """A grid together with its image about a plane."""
    points = np.asarray(grid.points)
    image = points.copy()
    image[:, plane.axis] = 2.0 * plane.place - points[:, plane.axis]
    offsets, connectivity = cells_of(grid)
    turned = np.empty_like(connectivity)
    for kind in np.unique(grid.celltypes):
        order = _turned(int(kind))
        starts = offsets[:-1][grid.celltypes == kind]
        turned[starts[:, None] + np.arange(len(order))] = connectivity[starts[:, None] + order]
    whole = grid_of(
        np.concatenate([points, image]),
        np.concatenate([offsets, offsets[1:] + len(connectivity)]),
        np.concatenate([connectivity, turned + len(points)]),
        np.concatenate([grid.celltypes, grid.celltypes]),
    )
    for name, values in grid.point_data.items():
        own = np.asarray(values)
        whole.point_data[name] = np.concatenate([own, own * _signs(grid, name, plane.axis)])
    for name, values in grid.cell_data.items():
        own = np.asarray(values)
        whole.cell_data[name] = np.concatenate([own, own])
    if "element" in grid.cell_data:  # those of the image are others
        own = np.asarray(grid.cell_data["element"]).astype(np.int64)
        whole.cell_data["element"] = np.concatenate([own, own + np.ptp(own) + 1])
    return whole


@cache
def _turned(kind: int) -> np.ndarray:
    """Nodes of a cell in the order in which its image has to name them to look the same way."""
    table = lattice(kind) if kind in (LINEAR, QUADRATIC) else LATTICES[kind]
    order = np.empty(table.size, dtype=int)
    order[table.ravel()] = table[::-1].ravel()
    return order


def _signs(grid: pv.UnstructuredGrid, name: str, axis: int) -> np.ndarray:
    """By what the components of a field are multiplied in the image."""
    if name in VECTORS:
        return np.where(np.arange(3) == axis, -1.0, 1.0)
    if name in TENSORS:
        return _odd(TENSOR, "xy"[axis])
    if name in PLY_TENSORS:
        along = np.abs(np.cos(np.radians(_angles(grid) - 90.0 * axis))) >= np.sqrt(0.5)
        return np.where(along[:, None], _odd(PLY_TENSOR, "1"), _odd(PLY_TENSOR, "2"))
    return np.array(1.0)


def _odd(components: tuple[str, ...], index: str) -> np.ndarray:
    """-1 for the components that have an index once, (components,)."""
    return np.array([-1.0 if name.count(index) == 1 else 1.0 for name in components])


def _angles(grid: pv.UnstructuredGrid) -> np.ndarray:
    """Angle of the ply of each point, degrees; 0 where the file has none."""
    angles = np.zeros(grid.n_points)
    if "angle" in grid.cell_data:
        offsets, connectivity = cells_of(grid)
        angles[connectivity] = np.repeat(np.asarray(grid.cell_data["angle"]), np.diff(offsets))
    return angles
