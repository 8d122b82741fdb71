"""gmsh without a screen: a session, and what a meshed model holds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

from plydyn_pre.errors import MeshError
from plydyn_pre.mesh.grid import Integers, Mesh, counter_clockwise

if TYPE_CHECKING:
    from types import ModuleType

_WITHOUT_CENTRE = 8
_LINE_OF_THREE = 8  # gmsh's number of its type
#: Entities of a gmsh model by the name of their group
Groups = Mapping[str, Sequence[int]]

_QUADS = {3: 4, 10: 9, 16: 8}  # gmsh's number of an element type, nodes
_ADVICE = {
    2: "a triangle: recombine the surface (Recombine Surface, Mesh.RecombineAll = 1)",
    9: "a triangle of second order: recombine the surface (Recombine Surface)",
    36: "a quad of third order: set Mesh.ElementOrder to 1 or 2",
}
_LIBRARIES = "libglu1-mesa libgl1 libxcursor1 libxinerama1 libxft2 libxrender1 libgomp1"


def load_gmsh() -> ModuleType:
    """Import gmsh, which needs libraries that no Python package brings."""
    try:
        import gmsh
    except OSError as error:
        raise MeshError(f"gmsh cannot start ({error}); install {_LIBRARIES}") from error
    return gmsh


@contextmanager
def session() -> Iterator[ModuleType]:
    """A quiet gmsh with one empty model, ended in any case."""
    gmsh = load_gmsh()
    guest = bool(gmsh.isInitialized())
    if not guest:
        gmsh.initialize(readConfigFiles=False, interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.model.add("plydyn")
    try:
        yield gmsh
    finally:
        if guest:
            gmsh.model.remove()
        else:
            gmsh.finalize()


def collect(gmsh: ModuleType, parts: Groups, curves: Groups, points: Groups) -> Mesh:
    """The mesh of some surfaces; curves and points become node sets."""
    tags = {name: _quads_of(gmsh, name, surfaces) for name, surfaces in parts.items()}
    if len({quads.shape[1] for _, quads in tags.values()}) > 1:
        raise MeshError("quads of four and of nine nodes in one mesh: choose one order for all")
    quad_tags = np.concatenate([ids for ids, _ in tags.values()])
    quads = np.concatenate([quads for _, quads in tags.values()])
    _refuse_shared(quad_tags)
    node_tags, places = np.unique(quads, return_inverse=True)
    quads = places.reshape(len(quads), -1)
    nodes, height = _places(gmsh, node_tags)
    if quads.shape[1] == _WITHOUT_CENTRE:
        quads, nodes, node_tags = _with_centres(quads, nodes, node_tags)
    sizes = np.cumsum([len(ids) for ids, _ in tags.values()])
    ranges = np.split(np.arange(len(quads)), sizes[:-1])
    return Mesh(
        nodes=nodes,
        quads=counter_clockwise(nodes, quads),
        parts=dict(zip(parts, ranges, strict=True)),
        node_sets=_node_sets(gmsh, {1: curves, 0: points}, node_tags),
        node_ids=node_tags,
        quad_ids=quad_tags,
        height=height,
    )


def _with_centres(
    quads: Integers, nodes: np.ndarray, tags: Integers
) -> tuple[Integers, np.ndarray, Integers]:
    """Quads of eight nodes with a ninth in the middle, where their own shapes have it."""
    corners, sides = nodes[quads[:, :4]], nodes[quads[:, 4:]]
    middles = 0.5 * sides.sum(axis=1) - 0.25 * corners.sum(axis=1)
    new = np.arange(len(quads))
    numbers = np.concatenate([tags, tags.max() + 1 + new])
    return np.column_stack([quads, len(nodes) + new]), np.concatenate([nodes, middles]), numbers


def _quads_of(gmsh: ModuleType, name: str, surfaces: Sequence[int]) -> tuple[Integers, Integers]:
    """Tags of the quads of some surfaces, and the tags of their nodes, (quads, 4 or 9)."""
    found: dict[int, list[tuple[Integers, Integers]]] = {}
    for surface in surfaces:
        for kind, ids, nodes in zip(*gmsh.model.mesh.getElements(2, surface), strict=True):
            if kind not in _QUADS:
                what = _ADVICE.get(kind, f"of gmsh's type {kind}: only quads can be used")
                raise MeshError(f"element {ids[0]} of the group {name!r} is {what}")
            quads = np.asarray(nodes, np.int64).reshape(-1, _QUADS[kind])
            found.setdefault(kind, []).append((np.asarray(ids, np.int64), quads))
    if not found:
        raise MeshError(f"the group {name!r} has no elements")
    if len(found) > 1:
        raise MeshError(f"the group {name!r} has quads of four and of nine nodes: choose one")
    (blocks,) = found.values()
    return np.concatenate([ids for ids, _ in blocks]), np.concatenate(
        [quads for _, quads in blocks]
    )


def _refuse_shared(quad_tags: Integers) -> None:
    """Refuse a quad that is in two parts."""
    tags, times = np.unique(quad_tags, return_counts=True)
    if np.any(times > 1):
        tag = tags[np.argmax(times)]
        raise MeshError(f"quad {tag} is in two surface groups: each group is a part of its own")


def _places(gmsh: ModuleType, node_tags: Integers) -> tuple[np.ndarray, float]:
    """Places of some nodes in the plane, (nodes, 2), and the height of the plane."""
    tags, places, _ = gmsh.model.mesh.getNodes()
    order = np.argsort(tags)
    found = order[np.searchsorted(tags, node_tags, sorter=order)]
    places = np.asarray(places).reshape(-1, 3)[found]
    if np.ptp(places[:, 2]) > 1e-9 * np.ptp(places, axis=0).max():
        low, high = places[:, 2].min(), places[:, 2].max()
        raise MeshError(f"the nodes lie between z = {low:g} and {high:g}: all need the same z")
    return places[:, :2].copy(), float(places[0, 2])


def _node_sets(
    gmsh: ModuleType, groups: Mapping[int, Groups], node_tags: Integers
) -> dict[str, Integers]:
    """Node sets from groups of curves and of points, as indices."""
    sets = {}
    for dimension, named in groups.items():
        for name, entities in named.items():
            found = [nodes for e in entities for nodes in _nodes_on(gmsh, dimension, e, node_tags)]
            tags = np.unique(np.concatenate([*found, []]).astype(np.int64))
            if not len(tags) or not np.all(np.isin(tags, node_tags)):
                raise MeshError(f"the group {name!r} is not on a meshed surface group")
            sets[name] = np.searchsorted(node_tags, tags)
    return sets


def _nodes_on(
    gmsh: ModuleType, dimension: int, entity: int, node_tags: Integers
) -> Iterator[Integers]:
    """Nodes of the elements of a curve or point; only the ends of lines if no quad has more."""
    kinds, _, nodes = gmsh.model.mesh.getElements(dimension, entity)
    for kind, ids in zip(kinds, nodes, strict=True):
        rows = np.asarray(ids, np.int64)
        if kind == _LINE_OF_THREE:
            rows = rows.reshape(-1, 3)
            rows = rows if np.isin(rows[:, 2], node_tags).any() else rows[:, :2]
        yield rows.ravel()
