"""What the solver says about a job in group /plydyn of its fields."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from plydyn_post.body import Body
from plydyn_post.errors import ResultsError
from plydyn_post.table import split_header
from plydyn_post.vtkhdf import array, opened

# Attributes that name the units
UNIT_KINDS = ("length", "time", "mass", "force", "stress", "energy")


@dataclass(frozen=True)
class Header:
    """What the solver says about a job in group /plydyn."""

    version: str = ""
    title: str = ""
    deck: str = ""
    units: dict[str, str] = field(default_factory=dict)
    impactors: dict[int, Body] = field(default_factory=dict)
    plies: tuple[dict[str, float], ...] = ()
    planes: tuple[tuple[int, float], ...] = ()  # of symmetry: axis and place


def read_header(path: Path) -> Header:
    """What group /plydyn says; empty where the file or an attribute is missing."""
    if not path.is_file():
        return Header()
    with opened(path) as file:
        group = file.get("plydyn")
        if not isinstance(group, h5py.Group):
            return Header()
        words = {name: _text(group, name) for name in group.attrs if _is_text(group.attrs[name])}
        return Header(
            version=words.get("version", ""),
            title=words.get("title", ""),
            deck=words.get("deck", ""),
            units={kind: words[kind] for kind in UNIT_KINDS if kind in words},
            impactors=_impactors(group),
            plies=_rows(group, "plies"),
            planes=_planes(path, words.get("symmetry", "")),
        )


def _planes(path: Path, words: str) -> tuple[tuple[int, float], ...]:
    """Planes of symmetry from words such as ``x=0 y=0``."""
    pairs = [word.split("=") for word in words.split()]
    try:
        return tuple(("xy".index(axis), float(place)) for axis, place in pairs)
    except ValueError:
        raise ResultsError(f"{path}: {words!r} are no planes of symmetry") from None


def _is_text(value: object) -> bool:
    return np.asarray(value).dtype.kind in "SUO"


def _text(thing: h5py.Group | h5py.Dataset, name: str) -> str:
    """Text of an attribute, a string or an array of strings."""
    parts = np.atleast_1d(np.asarray(thing.attrs[name])).ravel()
    words = [part.decode() if isinstance(part, bytes) else str(part) for part in parts]
    text = " ".join(word.strip() for word in words)
    if not text.isprintable():
        raise ResultsError(f"{thing.file.filename}: attribute {name} of {thing.name} is no text")
    return text


def _rows(group: h5py.Group, name: str) -> tuple[dict[str, float], ...]:
    """Rows of a table of numbers with the names of its columns as attribute ``columns``."""
    data = group.get(name)
    if not isinstance(data, h5py.Dataset) or "columns" not in data.attrs:
        return ()
    names = [split_header(column)[0] for column in _text(data, "columns").split(",")]
    values = array(group, name, "fiu")
    if values.ndim != 2 or values.shape[1] != len(names):
        raise ResultsError(
            f"{group.file.filename}: table {data.name} is {values.shape}, but has the columns"
            f" {', '.join(names)}"
        )
    return tuple(dict(zip(names, map(float, row), strict=True)) for row in values)


def _impactors(group: h5py.Group) -> dict[int, Body]:
    """Bodies from the table ``impactors``, with the outlines of those that are no spheres."""
    wanted = {"id", "radius", "x", "y", "z"}
    outlines = _rows(group, "impactor_outlines")
    bodies = {}
    for row in _rows(group, "impactors"):
        if wanted <= row.keys():
            if row["radius"] <= 0.0:
                raise ResultsError(f"{group.file.filename}: an impactor has no radius")
            number, centre = int(row["id"]), (row["x"], row["y"], row["z"])
            corners = [corner for corner in outlines if corner.get("id") == row["id"]]
            bodies[number] = _body(row["radius"], centre, corners)
    return bodies


def _body(
    radius: float, centre: tuple[float, float, float], corners: list[dict[str, float]]
) -> Body:
    """A body whose core has some corners; a sphere without any and without an axis."""
    wanted = {"rounding", "axis x", "axis y", "axis z", "back", "along", "across"}
    if not corners or not all(wanted <= corner.keys() for corner in corners):
        return Body(radius, centre)
    first = corners[0]
    axis = (first["axis x"], first["axis y"], first["axis z"])
    if not np.isclose(np.hypot(axis[0], axis[1]), np.sqrt(max(0.0, 1.0 - axis[2] ** 2)), atol=1e-9):
        return Body(radius, centre)
    core = tuple((corner["along"], corner["across"]) for corner in corners)
    return Body(radius, centre, axis, first["rounding"], core, first["back"])
