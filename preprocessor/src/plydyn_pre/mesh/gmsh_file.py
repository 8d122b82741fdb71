"""Meshes of the user, from gmsh's files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import ClassVar

from plydyn_pre.errors import MeshError, PreError
from plydyn_pre.files import is_file
from plydyn_pre.mesh.deck_file import mesh_of_deck
from plydyn_pre.mesh.grid import Mesh, with_centre
from plydyn_pre.mesh.session import collect, session

_MESHES = (".msh", ".unv", ".med", ".bdf", ".nas", ".vtk")
#: Formats of meshes without names of groups, whose surfaces are parts by their numbers
_UNGROUPED = (".bdf", ".nas", ".vtk")
_DECKS = (".inp", ".k", ".key")
_PREFIX = {0: "point", 1: "curve", 2: "surface"}


@dataclass(frozen=True)
class GmshFile:
    """A mesh (.msh, .unv, .med, .bdf, .inp, .k) or a geometry (.geo) with physical groups.

    Surface groups are parts, groups of curves and points are node sets. Numbers of nodes and
    quads are kept; the set ``centre`` is added where a node lies in the middle.
    """

    kind: ClassVar[str] = "gmsh"

    file: Path  # relative to the recipe


def mesh_gmsh_file(shape: GmshFile) -> Mesh:
    """Read a mesh, or read a geometry and mesh it as it says itself."""
    if not is_file(shape.file):
        raise MeshError(f"there is no file {shape.file}")
    suffix = shape.file.suffix.lower()
    try:
        if suffix in _DECKS:
            mesh = mesh_of_deck(shape.file)
            return mesh if "centre" in mesh.node_sets else with_centre(mesh)
        with session() as gmsh:
            _merge(gmsh, shape.file)
            return _read(gmsh, grouped=suffix not in _UNGROUPED)
    except PreError as error:
        raise MeshError(f"{shape.file}: {error}") from error


def _merge(gmsh: ModuleType, path: Path) -> None:
    """Read a file, and mesh a geometry."""
    try:
        gmsh.merge(str(path))
        if path.suffix.lower() not in _MESHES:
            gmsh.option.setNumber("Mesh.SecondOrderIncomplete", 0)
            gmsh.model.mesh.generate(2)
    except Exception as error:  # gmsh raises nothing narrower
        known = ", ".join(sorted({*_MESHES, *_DECKS}))
        raise MeshError(f"gmsh cannot use it: {error}; meshes are read from {known}") from error


def _read(gmsh: ModuleType, grouped: bool) -> Mesh:
    """The mesh of the model's physical groups."""
    groups: dict[int, dict[str, list[int]]] = {0: {}, 1: {}, 2: {}}
    for dimension, tag in gmsh.model.getPhysicalGroups():
        name = gmsh.model.getPhysicalName(dimension, tag).strip()
        if dimension in groups:
            entities = gmsh.model.getEntitiesForPhysicalGroup(dimension, tag)
            groups[dimension][name or f"{_PREFIX[dimension]}_{tag}"] = [int(e) for e in entities]
    if not grouped and not groups[2]:
        for dimension, tag in gmsh.model.getEntities():
            if dimension in (1, 2):
                groups[dimension][f"{_PREFIX[dimension]}_{tag}"] = [tag]
    if not groups[2]:
        raise MeshError("no physical surface group: name one, and it becomes a part")
    twice = set(groups[0]) & set(groups[1])
    if twice:
        raise MeshError(f"a group of points and one of curves are both called {min(twice)!r}")
    mesh = collect(gmsh, groups[2], groups[1], groups[0])
    return mesh if "centre" in mesh.node_sets else with_centre(mesh)
