"""States of a VTKHDF file: everything is checked here before anything is made of it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pyvista as pv
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray

from plydyn_post.errors import ResultsError
from plydyn_post.table import LARGEST

# Nodes of the cells that the solver writes, by VTK's types
NODES = {3: 2, 9: 4, 12: 8, 28: 9, 29: 27}
# A point is no farther from the origin, and moves no farther, than so many sides of the plate
FARTHEST = 1e6
# What h5py raises on files whose bytes are not what HDF5 expects
HDF5_ERRORS = (
    OSError,
    RuntimeError,
    LookupError,
    ValueError,
    TypeError,
    AttributeError,
    ArithmeticError,
    MemoryError,
)


@dataclass(frozen=True)
class Layout:
    """The grid, which stands still, and what is known of the states."""

    times: np.ndarray  # (states,)
    points: np.ndarray  # (points, 3)
    connectivity: np.ndarray  # points of all cells, one cell after the other
    offsets: np.ndarray  # (cells + 1,) where each cell begins in it
    types: np.ndarray  # (cells,)
    point_fields: tuple[str, ...]
    cell_fields: tuple[str, ...]

    @property
    def side(self) -> float:
        """The larger side of the plate in its plane."""
        return float(np.max(np.ptp(self.points[:, :2], axis=0)))


def _require_file(path: Path) -> None:
    """Refuse a file that is missing, with what a run needs to write it."""
    if path.is_file():
        return
    why = ""
    if path.name.endswith(".interfaces.vtkhdf"):
        why = "; a run writes it where plies are joined by an interface material"
    elif path.name.endswith(".cracks.vtkhdf"):
        why = "; a run writes it where plies crack along lines"
    raise ResultsError(f"{path}: there is no such file{why}")


@contextmanager
def opened(path: Path) -> Iterator[h5py.File]:
    """Open a file of fields; whatever HDF5 cannot read in it is told with its name."""
    _require_file(path)
    try:
        # without a lock, results can be read while the solver still writes them
        with h5py.File(path, "r", locking=False) as file:
            if not isinstance(file.get("VTKHDF"), h5py.Group):
                raise ResultsError(f"{path} is no VTKHDF file: it has no group VTKHDF")
            yield file
    except HDF5_ERRORS as error:
        if isinstance(error, ResultsError):
            raise
        words = " ".join(str(error).split()) or type(error).__name__
        raise ResultsError(f"{path} cannot be read: {words}") from error


def array(group: h5py.Group, name: str, kinds: str, first: int = 0, count: int = -1) -> np.ndarray:
    """Rows of a dataset of numbers whose kinds are letters of numpy, all finite."""
    data, path = group.get(name), group.file.filename
    if not isinstance(data, h5py.Dataset) or data.ndim == 0:
        raise ResultsError(f"{path} has no dataset {group.name}/{name}")
    if data.dtype.kind not in kinds or data.nbytes > group.file.id.get_filesize():
        raise ResultsError(f"{path}: dataset {data.name} is damaged: {data.dtype} {data.shape}")
    last = len(data) if count < 0 else first + count
    if not 0 <= first <= last <= len(data):
        raise ResultsError(
            f"{path}: dataset {data.name} has {len(data)} rows, but rows {first + 1} to {last}"
            " are needed"
        )
    values = data[first:last]
    with np.errstate(invalid="ignore"):  # of numbers that are none
        finite = np.abs(values.astype(float)) <= LARGEST
    if not np.all(finite):
        row = int(np.argmin(finite.reshape(len(values), -1).all(axis=1)))
        raise ResultsError(
            f"{path}: dataset {data.name}, row {first + row + 1}: not a finite number"
        )
    return values


def layout_of(path: Path) -> Layout:
    """The grid and the times of a file, read again only when the file has changed."""
    _require_file(path)
    changed = path.stat()
    return _layout(path, (changed.st_mtime_ns, changed.st_size))


@lru_cache(maxsize=8)
def _layout(path: Path, stamp: tuple[int, int]) -> Layout:
    """The grid and the times; the stamp tells one version of the file from another."""
    with opened(path) as file:
        root = file["VTKHDF"]
        times = _times(root)
        points = array(root, "Points", "f").astype(float)
        connectivity = array(root, "Connectivity", "iu").astype(np.int64)
        offsets = array(root, "Offsets", "iu").astype(np.int64)
        types = array(root, "Types", "iu").astype(np.int64)
        counts = {
            "NumberOfPoints": len(points),
            "NumberOfCells": len(types),
            "NumberOfConnectivityIds": len(connectivity),
        }
        for name, count in counts.items():
            told = array(root, name, "iu")
            if told.ravel().tolist() != [count]:
                raise ResultsError(f"{path}: {name} is {told.ravel().tolist()}, not {count}")
        fields = [tuple(sorted(_group(root, name))) for name in ("PointData", "CellData")]
    layout = Layout(times, points, connectivity, offsets, types, fields[0], fields[1])
    _check_grid(path, layout)
    for values in (times, points, connectivity, offsets, types):
        values.setflags(write=False)
    return layout


def _group(root: h5py.Group, name: str) -> Any:  # noqa: ANN401 - h5py has no types
    """A group; an empty table where there is none."""
    found = root.get(name)
    if found is None:
        return {}
    if not isinstance(found, h5py.Group):
        raise ResultsError(f"{root.file.filename}: {found.name} is no group")
    return found


def _times(root: h5py.Group) -> np.ndarray:
    """Times of the states that are whole, (states,)."""
    path, steps = root.file.filename, _group(root, "Steps")
    values = array(steps, "Values", "f").astype(float) if steps else np.array([])
    told = steps.attrs.get("NSteps", len(values)) if steps else 0
    if np.size(told) != 1 or np.asarray(told).dtype.kind not in "iu":
        raise ResultsError(f"{path}: attribute NSteps is {told!r}, not a number of states")
    written = int(np.ravel(told)[0])
    if values.ndim != 1 or not 0 <= written <= len(values):
        raise ResultsError(f"{path} tells of {written} states, but has the times of {len(values)}")
    if written == 0:
        raise ResultsError(f"{path} holds no state yet")
    times = values[:written]
    falls = np.flatnonzero(np.diff(times) < 0.0)
    if len(falls):
        state = int(falls[0])
        raise ResultsError(
            f"{path}: time falls from {times[state]:g} to {times[state + 1]:g} at state {state + 2}"
        )
    return times


def _check_grid(path: Path, layout: Layout) -> None:
    """Refuse a grid that no solver writes."""
    points, cells = layout.points, len(layout.types)
    if points.ndim != 2 or points.shape[1:] != (3,):
        raise ResultsError(f"{path}: Points are {points.shape}, not three numbers a point")
    if cells == 0:
        raise ResultsError(f"{path} holds no cells")
    unknown = set(layout.types.ravel().tolist()) - NODES.keys()
    if layout.types.ndim != 1 or unknown:
        raise ResultsError(
            f"{path} has cells of types {sorted(unknown)};"
            " expected hexahedra or quads of the solver"
        )
    sizes = np.array([NODES[kind] for kind in layout.types.tolist()])
    ends = np.concatenate([[0], np.cumsum(sizes)])
    if layout.connectivity.shape != (ends[-1],) or not np.array_equal(layout.offsets, ends):
        raise ResultsError(f"{path}: Offsets and Connectivity do not fit the types of the cells")
    if not 0 <= layout.connectivity.min() <= layout.connectivity.max() < len(points):
        raise ResultsError(f"{path}: Connectivity names points that are not there")
    for kind in np.unique(layout.types):
        first = ends[:-1][layout.types == kind]
        nodes = np.sort(layout.connectivity[first[:, None] + np.arange(NODES[int(kind)])], axis=1)
        if np.any(nodes[:, 1:] == nodes[:, :-1]):
            raise ResultsError(f"{path}: a cell of Connectivity has a point twice")
    if not np.all(np.ptp(points[:, :2], axis=0) > 0.0):
        raise ResultsError(f"{path}: Points span no area")
    if np.any(np.abs(points) > FARTHEST * layout.side):
        raise ResultsError(f"{path}: Points reach as far as {np.abs(points).max():g}")


def read_point_field(path: Path, name: str, step: int) -> np.ndarray:
    """A field at the points at a state, (points,) or (points, components)."""
    layout = layout_of(path)
    if name not in layout.point_fields:
        listed = ", ".join(layout.point_fields) or "none"
        raise ResultsError(
            f"{path} has no field {name!r}; it has {listed}. Fields are asked for in the deck"
            " with *DATABASE_FIELD"
        )
    with opened(path) as file:
        return _rows(file["VTKHDF"], "PointData", name, step, len(layout.points)).astype(float)


def _rows(root: h5py.Group, kind: str, name: str, step: int, count: int) -> np.ndarray:
    """Rows of a field at a state."""
    offsets = f"Steps/{kind}Offsets/{name}"
    start = int(np.ravel(array(root, offsets, "iu", step, 1))[0])
    return array(root[kind], name, "fiu", start, count)


def read_grid(path: Path, step: int) -> pv.UnstructuredGrid:
    """A state with all its fields."""
    layout = layout_of(path)
    grid = grid_of(layout.points, layout.offsets, layout.connectivity, layout.types)
    with opened(path) as file:
        root = file["VTKHDF"]
        for name in layout.point_fields:
            grid.point_data[name] = _rows(root, "PointData", name, step, len(layout.points))
        for name in layout.cell_fields:
            grid.cell_data[name] = _rows(root, "CellData", name, step, len(layout.types))
    return grid


def grid_of(
    points: np.ndarray, offsets: np.ndarray, connectivity: np.ndarray, types: np.ndarray
) -> pv.UnstructuredGrid:
    """A grid of copies of arrays as those of a layout."""
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(offsets.astype(np.int64), deep=True),
        numpy_to_vtkIdTypeArray(connectivity.astype(np.int64), deep=True),
    )
    grid = pv.UnstructuredGrid()
    grid.points = points.copy()
    grid.SetCells(numpy_to_vtk(types.astype(np.uint8), deep=True), cells)
    return grid


def nodes_of(grid: pv.UnstructuredGrid, kind: int) -> np.ndarray:
    """Nodes of the cells of a kind, (cells, nodes)."""
    return np.asarray(grid.cells_dict[np.uint8(kind)])


def cells_of(grid: pv.UnstructuredGrid) -> tuple[np.ndarray, np.ndarray]:
    """Offsets, (cells + 1,), and points of all cells of a grid."""
    cells = grid.GetCells()
    return vtk_to_numpy(cells.GetOffsetsArray()), vtk_to_numpy(cells.GetConnectivityArray())
