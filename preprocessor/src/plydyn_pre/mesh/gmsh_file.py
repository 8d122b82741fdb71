"""Meshes of the user, from gmsh's files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import ClassVar

from plydyn_pre.errors import MeshError
from plydyn_pre.files import is_file
from plydyn_pre.mesh.grid import Mesh, with_centre
from plydyn_pre.mesh.session import collect, generate, session

_PREFIX = {0: "point", 1: "curve", 2: "surface"}


@dataclass(frozen=True)
class GmshFile:
    """A mesh (.msh) or a geometry (.geo) with physical groups.

    Surface groups are parts, groups of curves and points are node sets. Numbers of nodes and
    quads are kept; the set ``centre`` is added where a node lies in the middle.
    """

    kind: ClassVar[str] = "gmsh"

    file: Path  # relative to the recipe


def mesh_gmsh_file(shape: GmshFile) -> Mesh:
    """Read a mesh, or read a geometry and mesh it as it says itself."""
    if not is_file(shape.file):
        raise MeshError(f"there is no file {shape.file}")
    with session() as gmsh:
        try:
            gmsh.merge(str(shape.file))
            if shape.file.suffix != ".msh":
                generate(gmsh, order=1)
        except Exception as error:  # gmsh raises nothing narrower
            raise MeshError(f"gmsh cannot use {shape.file}: {error}") from error
        try:
            return _read(gmsh)
        except MeshError as error:
            raise MeshError(f"{shape.file}: {error}") from error


def _read(gmsh: ModuleType) -> Mesh:
    """The mesh of the model's physical groups."""
    groups: dict[int, dict[str, list[int]]] = {0: {}, 1: {}, 2: {}}
    for dimension, tag in gmsh.model.getPhysicalGroups():
        name = gmsh.model.getPhysicalName(dimension, tag)
        if dimension in groups:
            entities = gmsh.model.getEntitiesForPhysicalGroup(dimension, tag)
            groups[dimension][name or f"{_PREFIX[dimension]}_{tag}"] = [int(e) for e in entities]
    if not groups[2]:
        raise MeshError("no physical surface group: name one, and it becomes a part")
    twice = set(groups[0]) & set(groups[1])
    if twice:
        raise MeshError(f"a group of points and one of curves are both called {min(twice)!r}")
    mesh = collect(gmsh, groups[2], {}, groups[1], groups[0])
    return mesh if "centre" in mesh.node_sets else with_centre(mesh)
