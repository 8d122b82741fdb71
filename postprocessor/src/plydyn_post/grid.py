"""Fields of a job: states of the VTKHDF file, and what the solver says about them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np
import pyvista as pv
from vtkmodules.vtkIOHDF import vtkHDFReader

from plydyn_post.errors import ResultsError
from plydyn_post.table import split_header

# Our names of tensor components in the order of VTK's symmetric tensors
TENSOR = ("xx", "yy", "zz", "xy", "yz", "xz")
PLY_TENSOR = ("11", "22", "33", "12", "23", "13")
# Share of a run by which an instant may lie outside: the end of a run as people write it
ROUNDING = 0.01
# Attributes that name the units
UNIT_KINDS = ("length", "time", "mass", "force", "stress", "energy")


@dataclass(frozen=True)
class Sphere:
    """A rigid impactor at time zero."""

    radius: float
    centre: tuple[float, float, float]


@dataclass(frozen=True)
class Header:
    """What the solver says about a job in group /plydyn."""

    version: str = ""
    title: str = ""
    deck: str = ""
    units: dict[str, str] = field(default_factory=dict)
    impactors: dict[int, Sphere] = field(default_factory=dict)
    plies: tuple[dict[str, float], ...] = ()


@contextmanager
def opened(path: Path) -> Iterator[h5py.File]:
    """Open a file of fields, with errors that name it."""
    if not path.is_file():
        raise ResultsError(f"{path}: there is no such file")
    try:
        file = h5py.File(path, "r")
    except OSError as error:
        raise ResultsError(f"{path} cannot be read: {error}") from error
    with file:
        if "VTKHDF" not in file:
            raise ResultsError(f"{path} is no VTKHDF file: it has no group VTKHDF")
        yield file


def read_times(path: Path) -> np.ndarray:
    """Times of the states, (states,)."""
    with opened(path) as file:
        steps = file["VTKHDF"].get("Steps")
        times = np.array([]) if steps is None else np.asarray(steps["Values"], dtype=float)
        written = len(times) if steps is None else int(steps.attrs.get("NSteps", len(times)))
    if min(len(times), written) == 0:
        raise ResultsError(f"{path} holds no state yet")
    return times[:written]


def read_point_field(path: Path, name: str, step: int) -> np.ndarray:
    """A field at the points at a state, (points, components)."""
    with opened(path) as file:
        root = file["VTKHDF"]
        known = sorted(root.get("PointData", ()))
        if name not in known:
            listed = ", ".join(known) or "none"
            raise ResultsError(
                f"{path} has no field {name!r}; it has {listed}. Fields are asked for in the deck"
                " with *DATABASE_FIELD"
            )
        points = int(np.sum(root["NumberOfPoints"][:1]))
        offsets = root["Steps"].get("PointDataOffsets", {}).get(name)
        start = 0 if offsets is None else int(offsets[step])
        return np.asarray(root["PointData"][name][start : start + points], dtype=float)


def has_point_field(path: Path, name: str) -> bool:
    """Whether a file of fields is there and has a field at its points."""
    if not path.is_file():
        return False
    with opened(path) as file:
        return name in file["VTKHDF"].get("PointData", ())


def largest_deflection(path: Path) -> int:
    """The state at which a point has moved farthest along z."""
    moved = [
        float(np.max(np.abs(read_point_field(path, "displacement", step)[:, 2]), initial=0.0))
        for step in range(len(read_times(path)))
    ]
    return int(np.argmax(moved))


def nearest(times: np.ndarray, time: float) -> int:
    """The state nearest to a time that somebody asks for; refused where the run was not."""
    first, last = float(times[0]), float(times[-1])
    room = ROUNDING * (last - first)
    if not first - room <= time <= last + room:
        raise ResultsError(f"--time {time:g} is not between {first:g} and {last:g}")
    return int(np.argmin(np.abs(times - time)))


def read_state(path: Path, step: int) -> pv.UnstructuredGrid:
    """A state of the fields, by VTK's own reader; pyvista's takes no step."""
    with opened(path):
        reader = vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    reader.SetStep(step)
    reader.Update()
    grid = pv.wrap(reader.GetOutputDataObject(0))
    if not isinstance(grid, pv.UnstructuredGrid) or grid.n_cells == 0:
        raise ResultsError(f"{path} holds no cells at state {step + 1}")
    return grid


def read_header(path: Path) -> Header:
    """What group /plydyn says; empty where the file or an attribute is missing."""
    if not path.is_file():
        return Header()
    with opened(path) as file:
        group = file.get("plydyn")
        if group is None:
            return Header()
        words = {key: _text(value) for key, value in group.attrs.items() if _is_text(value)}
        return Header(
            version=words.get("version", ""),
            title=words.get("title", ""),
            deck=words.get("deck", ""),
            units={kind: words[kind] for kind in UNIT_KINDS if kind in words},
            impactors=_impactors(group),
            plies=_rows(group, "plies"),
        )


def _is_text(value: object) -> bool:
    kind = np.asarray(value).dtype.kind
    return kind in "SUO"


def _text(value: object) -> str:
    """Text of an attribute, a string or an array of strings."""
    parts = np.atleast_1d(np.asarray(value)).ravel()
    words = [part.decode() if isinstance(part, bytes) else str(part) for part in parts]
    return " ".join(word.strip() for word in words)


def _rows(group: h5py.Group, name: str) -> tuple[dict[str, float], ...]:
    """Rows of a table of numbers with the names of its columns as attribute ``columns``."""
    data = group.get(name)
    if not isinstance(data, h5py.Dataset) or "columns" not in data.attrs:
        return ()
    names = [column.strip() for column in _text(data.attrs["columns"]).split(",")]
    values = np.asarray(data, dtype=float).reshape(-1, len(names))
    return tuple(dict(zip(names, map(float, row), strict=True)) for row in values)


def _impactors(group: h5py.Group) -> dict[int, Sphere]:
    """Spheres from the table ``impactors`` with the columns id, radius, x, y and z."""
    wanted = {"id", "radius", "x", "y", "z"}
    rows = (
        {split_header(name)[0]: one for name, one in row.items()}
        for row in _rows(group, "impactors")
    )
    return {
        int(row["id"]): Sphere(row["radius"], (row["x"], row["y"], row["z"]))
        for row in rows
        if wanted <= row.keys()
    }
