"""Plates drawn through their plies: nodes and bricks in place of layers."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from plydyn_pre.errors import RecipeError, require
from plydyn_pre.mesh import Mesh
from plydyn_pre.mesh.grid import Integers, Reals
from plydyn_pre.study import Laminate, Study

#: Nodes of a plate of bricks: its deck has some 1.6 GB
_MOST_NODES = 10_000_000
#: Corners of the four quads that a quad of nine nodes is divided into
_QUARTERS = ((0, 4, 8, 7), (4, 1, 5, 8), (8, 5, 2, 6), (7, 8, 6, 3))


@dataclass(frozen=True)
class Extrusion:
    """A plane mesh of four-node quads and the heights of its copies, from the bottom up."""

    plane: Mesh
    heights: Reals  # (levels,), above the nodes of the plane
    plies: Integers  # (levels - 1,), ply of each layer of bricks, from 0

    @property
    def nodes(self) -> int:
        """Nodes of all copies."""
        return len(self.heights) * len(self.plane.nodes)

    @property
    def bricks(self) -> int:
        """Bricks of all layers."""
        return len(self.plies) * len(self.plane.quads)

    def node_ids(self, nodes: Integers, levels: Integers) -> Integers:
        """Numbers of some nodes of the plane on some levels, level by level."""
        return (levels[:, None] * len(self.plane.nodes) + nodes + 1).ravel()

    def brick_nodes(self, layer: int) -> Integers:
        """Numbers of the nodes of a layer of bricks, (quads, 8)."""
        below = layer * len(self.plane.nodes) + self.plane.quads + 1
        return np.concatenate([below, below + len(self.plane.nodes)], axis=1)


def extrude(study: Study, mesh: Mesh) -> Extrusion:
    """Draw the plate of a study through its plies."""
    if study.bricks is None:
        raise RecipeError("bricks", "missing")
    laminate = laminate_of_all(study, mesh)
    levels = len(laminate.stack) * study.bricks.per_ply + 1
    nodes = levels * len(mesh.nodes)
    rule = f"{nodes:,} nodes would be made, at most {_MOST_NODES:,} can be; take fewer"
    require(nodes <= _MOST_NODES, "bricks", rule)
    per_ply = study.bricks.per_ply
    steps = [ply.thickness / per_ply for ply in laminate.stack for _ in range(per_ply)]
    heights = laminate.bottom + np.concatenate([[0.0], np.cumsum(steps)])
    plies = np.repeat(np.arange(len(laminate.stack)), per_ply)
    return Extrusion(quartered(mesh), heights, plies)


def laminate_of_all(study: Study, mesh: Mesh) -> Laminate:
    """The one laminate of a plate of bricks."""
    laminates = {id(laminate): laminate for laminate in map(study.laminate_of, mesh.parts)}
    if len(laminates) != 1:
        raise RecipeError("bricks", "a plate of bricks has one laminate for all parts of the mesh")
    (laminate,) = laminates.values()
    if not laminate.tied:
        raise RecipeError("bricks", "plies of bricks are tied; take laminate.interfaces = 'tied'")
    return laminate


def quartered(mesh: Mesh) -> Mesh:
    """A mesh of quads with four nodes: those of nine are divided in four."""
    if mesh.order == 1:
        return mesh
    quads = np.concatenate([mesh.quads[:, list(corners)] for corners in _QUARTERS])
    count = len(mesh.quads)

    def of_all(members: Integers) -> Integers:
        return np.concatenate([members + k * count for k in range(len(_QUARTERS))])

    return replace(
        mesh,
        quads=quads,
        parts={name: of_all(members) for name, members in mesh.parts.items()},
        quad_sets={name: of_all(members) for name, members in mesh.quad_sets.items()},
        quad_ids=np.arange(1, len(quads) + 1),
    )
