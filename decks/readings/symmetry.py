"""How far a plate is from its mirror images, which it should be in all of these impacts."""

from __future__ import annotations

import h5py
import numpy as np

from plydyn_post.grid import read_times
from plydyn_post.results import Results
from plydyn_post.vtkhdf import read_point_field
from runner.cases import StudyError

#: Places are told apart down to this, mm
SAME = 1e-6


def asymmetry(results: Results) -> float:
    """How far the last displacements are from symmetry to the planes x = 0 and y = 0, mm."""
    path = results.fields
    with h5py.File(path) as file:
        points = np.array(file["VTKHDF/Points"])
        offsets = np.array(file["VTKHDF/Offsets"])
        cells = np.array(file["VTKHDF/Connectivity"]).reshape(-1, offsets[1] - offsets[0])
    moved = read_point_field(path, "displacement", len(read_times(path)) - 1)
    return off_symmetry(points, cells, moved)


def off_symmetry(points: np.ndarray, cells: np.ndarray, moved: np.ndarray) -> float:
    """The largest difference of displacements from their mirror images, mm.

    points and moved are (points, 3), cells (cells, nodes). Points at one place that belong to
    different layers are told apart by the height of the middle of their cells.
    """
    height = np.zeros(len(points))
    height[cells] = points[cells, 2].mean(axis=1)[:, None]
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0)) * (1.0, 1.0, 0.0)
    places = np.column_stack([points - middle, height])
    order = _order(places)
    worst = 0.0
    for axis in (0, 1):
        mirror = np.ones(4)
        mirror[axis] = -1.0
        partner = _order(places * mirror)
        if np.abs(places[order] - (places * mirror)[partner]).max() > 2.0 * SAME:
            raise StudyError("the mesh is not symmetric")
        worst = max(worst, float(np.abs(moved[order] - moved[partner] * mirror[:3]).max()))
    return worst


def _order(places: np.ndarray) -> np.ndarray:
    """The order of places by their coordinates."""
    return np.lexsort(np.round(places / SAME).T)
