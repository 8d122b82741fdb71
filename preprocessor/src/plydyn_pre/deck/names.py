"""Numbers of things that a study calls by name, given out as they are used."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from plydyn_pre.errors import RecipeError, require
from plydyn_pre.mesh.grid import Integers, Mesh, node_near
from plydyn_pre.study import NodeSet, Study
from plydyn_pre.suggest import suggestion

ALL = "all"


@dataclass
class Names:
    """A study with its mesh, and the numbers given out so far; each kind counts from 1."""

    study: Study
    mesh: Mesh
    node_sets: dict[str, int] = field(default_factory=dict)
    quad_sets: dict[str, int] = field(default_factory=dict)
    curves: dict[str, int] = field(default_factory=dict)
    materials: dict[str, int] = field(default_factory=dict)
    parts: dict[str, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Number the parts of the mesh; refuse laminates of others and sets that are there."""
        for name in self.study.sets:
            taken = name == ALL or name in self.mesh.node_sets
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
        return _number(self.curves, name) if name else 0

    def written_curve(self, name: str) -> int:
        """Number of a curve for keywords that know no constant."""
        return _number(self.curves, name)

    def node_set(self, name: str, path: str) -> int:
        """Number of a node set; `path` holds the keys that name it."""
        self.nodes_of(name, path)
        return _number(self.node_sets, name)

    def quad_set(self, name: str, path: str) -> int:
        """Number of a set of quads, 0 for all."""
        if name == ALL:
            return 0
        self.quads_of(name, path)
        return _number(self.quad_sets, name)

    def nodes_of(self, name: str, path: str) -> Integers:
        """Nodes of a set, as indices."""
        if name == ALL:
            return np.arange(len(self.mesh.nodes))
        if name in self.study.sets:
            return _nodes_at(self.mesh, self.study.sets[name], f"sets.{name}")
        return _member(self.mesh.node_sets, name, path, "a node set", self.study.sets)

    def quads_of(self, name: str, path: str) -> Integers:
        """Quads of a set or a part, as indices."""
        known = {**self.mesh.parts, **self.mesh.quad_sets}
        return _member(known, name, path, "a part or another set of quads", ())


def _number(numbers: dict[str, int], name: str) -> int:
    """The number of a name, the next one for a new name."""
    return numbers.setdefault(name, len(numbers) + 1)


def _member(
    known: dict[str, Integers], name: str, path: str, what: str, others: tuple[str, ...] | dict
) -> Integers:
    """Members of a set, by its name."""
    if name not in known:
        hint = suggestion(name, [*known, *others, ALL])
        raise RecipeError(path, f"{name!r} is not {what} of this mesh; {hint}")
    return known[name]


def _nodes_at(mesh: Mesh, rule: NodeSet, path: str) -> Integers:
    """Nodes of a set by their place."""
    slack = 1e-6 * mesh.size
    if rule.at is not None:
        node, distance = node_near(mesh, rule.at)
        x, y = mesh.nodes[node]
        near = f"no node at {list(rule.at)}; the nearest is at [{x:.9g}, {y:.9g}]"
        require(distance <= slack, f"{path}.at", near)
        return np.array([node])
    low_x, high_x, low_y, high_y = rule.box or (0.0, 0.0, 0.0, 0.0)
    low, high = np.array([low_x, low_y]) - slack, np.array([high_x, high_y]) + slack
    found = np.flatnonzero(np.all((mesh.nodes >= low) & (mesh.nodes <= high), axis=1))
    require(len(found) > 0, f"{path}.box", "no node lies in it")
    return found
