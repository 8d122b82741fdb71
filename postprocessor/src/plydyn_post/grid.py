"""Fields of a job: which states there are, and one of them as a grid."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyvista as pv

from plydyn_post.errors import ResultsError
from plydyn_post.vtkhdf import FARTHEST, layout_of, read_grid, read_point_field

# Our names of tensor components in the order of VTK's symmetric tensors
TENSOR = ("xx", "yy", "zz", "xy", "yz", "xz")
PLY_TENSOR = ("11", "22", "33", "12", "23", "13")
# Numbers at a point of the fields that the solver writes, 0 for one number
COMPONENTS = {
    **dict.fromkeys(("displacement", "velocity", "opening"), 3),
    **dict.fromkeys(("stress", "strain", "stress_ply", "strain_ply"), 6),
    **dict.fromkeys(("damage", "damage_fibre", "damage_matrix", "damage_shear"), 0),
    **dict.fromkeys(("dissipated", "plastic_strain", "mode_mixity", "energy_share"), 0),
}
# Fields of one number at a cell
CELL_NUMBERS = ("angle", "angle_above", "angle_below", "element", "interface", "ply")
# Share of a run by which an instant may lie outside: the end of a run as people write it
ROUNDING = 0.01


def read_times(path: Path) -> np.ndarray:
    """Times of the states, (states,)."""
    return layout_of(path).times


def has_point_field(path: Path, name: str) -> bool:
    """Whether a file of fields is there and has a field at its points."""
    return path.is_file() and name in layout_of(path).point_fields


def largest_deflection(path: Path) -> int:
    """The state at which a point has moved farthest along z."""
    moved = [
        float(np.max(np.abs(read_displacement(path, step)[:, 2]), initial=0.0))
        for step in range(len(read_times(path)))
    ]
    return int(np.argmax(moved))


def read_displacement(path: Path, step: int) -> np.ndarray:
    """Displacement of the points at a state, (points, 3)."""
    values = read_point_field(path, "displacement", step)
    _check(path, "displacement", values)
    return values


def _check(path: Path, name: str, values: np.ndarray) -> None:
    """Refuse a field that has not the numbers at a point that its name promises."""
    wanted = (COMPONENTS[name],) if COMPONENTS.get(name) else ()
    if values.shape[1:] != wanted:
        raise ResultsError(
            f"{path}: field {name!r} has {values.shape[1:] or 1} numbers at a point, not"
            f" {COMPONENTS.get(name) or 1}"
        )
    if name == "displacement" and np.any(
        np.abs(values.astype(float)) > FARTHEST * layout_of(path).side
    ):
        raise ResultsError(f"{path}: a point moves by {np.abs(values).max():g}")


def nearest(times: np.ndarray, time: float, where: Path) -> int:
    """The state of a file nearest to a time asked for; refused where the run was not."""
    first, last = float(times[0]), float(times[-1])
    room = ROUNDING * (last - first)
    if not first - room <= time <= last + room:
        words = f"is not between {first:g} and {last:g}, in the unit of the job"
        raise ResultsError(f"{where}: the time {time:g} {words}")
    return int(np.argmin(np.abs(times - time)))


def read_state(path: Path, step: int) -> pv.UnstructuredGrid:
    """A state of the fields, each with the numbers that its name promises."""
    grid = read_grid(path, step)
    for name in grid.point_data.keys() & COMPONENTS.keys():
        _check(path, name, grid.point_data[name])
    for name, values in grid.cell_data.items():
        if name in CELL_NUMBERS:
            _check(path, name, values)
    return grid
