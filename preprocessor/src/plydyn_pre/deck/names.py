"""Numbers of things that a study calls by name, given out as they are used."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from plydyn_pre.errors import RecipeError, require
from plydyn_pre.mesh.grid import Integers, Mesh, Reals, node_near
from plydyn_pre.mesh.region import in_box, in_ring
from plydyn_pre.study import REGIONS, PlaceSet, Study
from plydyn_pre.study.sets import ALL
from plydyn_pre.suggest import suggestion

# share of the size of the mesh by which a place may lie beside a region
_NEAR = 1e-6


@dataclass
class Names:
    """A study with its mesh, and the numbers given out so far; each kind counts from `first`."""

    study: Study
    mesh: Mesh
    first: int = 1  # of sets and curves; a stage leaves those of the decks before alone
    node_sets: dict[str, int] = field(default_factory=dict)
    quad_sets: dict[str, int] = field(default_factory=dict)
    curves: dict[str, int] = field(default_factory=dict)
    materials: dict[str, int] = field(default_factory=dict)
    parts: dict[str, int] = field(default_factory=dict)
    regions: dict[str, Integers] = field(default_factory=dict)  # quads of sets without a name

    def __post_init__(self) -> None:
        """Number the parts of the mesh; refuse laminates of others and sets that are there."""
        self.mesh = _with_parts(self.mesh, self.study.parts)
        known = {ALL, *self.mesh.node_sets, *self.mesh.quad_sets, *self.mesh.parts}
        for name in self.study.sets:
            taken = name in known
            require(not taken, f"sets.{name}", "the mesh has a set of this name; take another one")
        for name in self.study.laminates:
            hint = suggestion(name, self.mesh.parts)
            require(name in self.mesh.parts, f"laminates.{name}", f"no part of the mesh; {hint}")
        for name in self.mesh.parts:
            self.study.laminate_of(name)
            _number(self.parts, name)

    def part(self, name: str, path: str) -> str:
        """Name of a part, of the only one where none is given."""
        known = list(self.mesh.parts)
        if not name and len(known) == 1:
            return known[0]
        require(bool(name), path, f"missing; the mesh has the parts {', '.join(known)}")
        require(name in known, path, f"{name!r} is no part of the mesh; {suggestion(name, known)}")
        return name

    def material(self, name: str) -> int:
        """Number of a material."""
        return _number(self.materials, name)

    def curve(self, name: str) -> int:
        """Number of a curve, 0 for the constant 1."""
        return _number(self.curves, name, self.first) if name else 0

    def written_curve(self, name: str) -> int:
        """Number of a curve for keywords that know no constant."""
        return _number(self.curves, name, self.first)

    def node_set(self, name: str, path: str) -> int:
        """Number of a node set; `path` holds the keys that name it."""
        self.nodes_of(name, path)
        return _number(self.node_sets, name, self.first)

    def quad_set(self, name: str, path: str) -> int:
        """Number of a set of quads, 0 for all."""
        if name == ALL:
            return 0
        self.quads_of(name, path)
        return _number(self.quad_sets, name, self.first)

    def region(self, rule: PlaceSet, part: str, path: str) -> int:
        """Number of the quads of a part in a region that has no name; its keys stand for one."""
        found = np.intersect1d(_quads_at(self.mesh, rule, path), self.mesh.parts[part])
        rule_of_part = f"no quad of the part {part!r} has its middle in it"
        require(len(found) > 0, f"{path}.{rule.key}", rule_of_part)
        self.regions[path] = found
        return _number(self.quad_sets, path, self.first)

    def nodes_of(self, name: str, path: str) -> Integers:
        """Nodes of a set, as indices."""
        if name == ALL:
            return np.arange(len(self.mesh.nodes))
        if name in self.study.sets:
            return _nodes_at(self.mesh, self.study.sets[name], f"sets.{name}")
        return _member(self.mesh.node_sets, name, path, "a node set", self.study.sets)

    def members_of(self, name: str) -> tuple[Integers, Integers]:
        """Nodes and quads of a set of the recipe, as indices; there may be none of one kind."""
        rule = self.study.sets[name]
        if rule.key not in REGIONS:
            return self.nodes_of(name, ""), np.empty(0, dtype=int)
        nodes = np.flatnonzero(_inside(self.mesh, rule, self.mesh.nodes))
        quads = np.flatnonzero(_inside(self.mesh, rule, _middles(self.mesh)))
        none = "neither a node nor the middle of a quad lies in it"
        require(len(nodes) + len(quads) > 0, f"sets.{name}.{rule.key}", none)
        return nodes, quads

    def quads_of(self, name: str, path: str) -> Integers:
        """Quads of a set or a part, as indices."""
        if name in self.regions:
            return self.regions[name]
        if name in self.study.sets:
            return _quads_at(self.mesh, self.study.sets[name], f"sets.{name}")
        known = {**self.mesh.parts, **self.mesh.quad_sets}
        return _member(known, name, path, "a part or a set of quads", self.study.sets)


def _with_parts(mesh: Mesh, rules: dict[str, PlaceSet]) -> Mesh:
    """The mesh with some quads in parts of their own; all nodes, quads and sets stay."""
    parts = dict(mesh.parts)
    for name, rule in rules.items():
        path = f"parts.{name}"
        require(name not in parts, path, "the mesh has a part of this name; take another one")
        inside = _quads_at(mesh, rule, path)
        for other, quads in parts.items():
            parts[other] = np.setdiff1d(quads, inside)
            require(len(parts[other]) > 0, path, f"leaves no quad to the part {other!r}")
        parts[name] = inside
    return replace(mesh, parts=parts)


def _number(numbers: dict[str, int], name: str, first: int = 1) -> int:
    """The number of a name, the next one for a new name."""
    return numbers.setdefault(name, len(numbers) + first)


def _member(
    known: dict[str, Integers], name: str, path: str, what: str, others: Iterable[str]
) -> Integers:
    """Members of a set, by its name."""
    if name not in known:
        hint = suggestion(name, [*known, *others, ALL])
        raise RecipeError(path, f"{name!r} is not {what} of this mesh; {hint}")
    return known[name]


def _nodes_at(mesh: Mesh, rule: PlaceSet, path: str) -> Integers:
    """Nodes of a set by their place."""
    slack = _NEAR * mesh.size
    if rule.at is not None:
        node, distance = node_near(mesh, rule.at)
        x, y = mesh.nodes[node]
        near = f"no node at {list(rule.at)}; the nearest is at [{x:.9g}, {y:.9g}]"
        require(distance <= slack, f"{path}.at", near)
        return np.array([node])
    if rule.line is not None:
        return _mesh_line(mesh, rule.line, path)
    found = np.flatnonzero(_inside(mesh, rule, mesh.nodes))
    require(len(found) > 0, f"{path}.{rule.key}", "no node lies in it")
    return found


def _quads_at(mesh: Mesh, rule: PlaceSet, path: str) -> Integers:
    """Quads of a set, by the place of their middle."""
    nodes_only = f"a set by {rule.key!r} has nodes only; quads need box, circle or ring"
    require(rule.key in REGIONS, f"{path}.{rule.key}", nodes_only)
    found = np.flatnonzero(_inside(mesh, rule, _middles(mesh)))
    require(len(found) > 0, f"{path}.{rule.key}", "no quad has its middle in it")
    return found


def _middles(mesh: Mesh) -> Reals:
    """Middles of the corners of all quads, (quads, 2)."""
    return mesh.nodes[mesh.quads[:, :4]].mean(axis=1)


def _inside(mesh: Mesh, rule: PlaceSet, places: Reals) -> NDArray[np.bool_]:
    """Which of some places, (places, 2), lie in a box, a circle or a ring."""
    slack = _NEAR * mesh.size
    if rule.box is not None:
        return in_box(places, rule.box, slack)
    x, y, radius = rule.circle or (0.0, 0.0, 0.0)
    return in_ring(places, rule.ring or (x, y, 0.0, radius), slack)


def _mesh_line(mesh: Mesh, ends: tuple[float, float, float, float], path: str) -> Integers:
    """Nodes of the mesh line next to a line along x or y, between its ends."""
    slack = _NEAR * mesh.size
    x1, y1, x2, y2 = ends
    along, across = (0, 1) if y1 == y2 else (1, 0)
    place, (low, high) = (y1, sorted((x1, x2))) if along == 0 else (x1, sorted((y1, y2)))
    between = (mesh.nodes[:, along] >= low - slack) & (mesh.nodes[:, along] <= high + slack)
    require(bool(between.any()), f"{path}.line", "no node lies beside it")
    off = np.where(between, np.abs(mesh.nodes[:, across] - place), np.inf)
    nearest = mesh.nodes[np.argmin(off), across]
    return np.flatnonzero(between & (np.abs(mesh.nodes[:, across] - nearest) <= slack))
