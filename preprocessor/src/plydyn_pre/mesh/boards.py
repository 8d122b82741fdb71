"""Boards of quads: between straight lines, and in rings around a square core.

A board is a table of nodes, row by row; every second node of both is a corner where quads have
nine. So no mesher is needed, and nodes have their places to the last digit.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plydyn_pre.mesh.grid import Integers, Mesh, Reals
from plydyn_pre.mesh.lines import with_middles

#: Rows and columns of the nodes of a quad of nine, in half sides
_NODES = np.array([(0, 0), (0, 2), (2, 2), (2, 0), (0, 1), (1, 2), (2, 1), (1, 0), (1, 1)])
#: Sides of a board, counter-clockwise
_SIDES = ("bottom", "right", "top", "left")


def board_of_lines(x: Reals, y: Reals, order: int) -> Mesh:
    """Quads between lines at some x and y. Node sets: bottom, right, top, left, boundary."""
    x, y = with_middles(x, order), with_middles(y, order)
    table = np.arange(len(x) * len(y)).reshape(len(y), len(x))
    nodes = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    return _mesh(nodes, _quads(table, order), (table[0], table[:, -1], table[-1], table[:, 0]))


@dataclass(frozen=True)
class RingBoard:
    """A square core of n x n quads, with rings of 4 n quads around it."""

    n: int
    rings: int
    order: int  # 1 for quads of four nodes, 2 for quads of nine

    @cached_property
    def _core(self) -> Integers:
        """Nodes of the core, row by row from the bottom up."""
        steps = self.n * self.order + 1
        return np.arange(steps**2).reshape(steps, steps)

    @cached_property
    def _around(self) -> Integers:
        """Nodes on the edge of the core and on the circles around it, counter-clockwise."""
        core = self._core
        edge = np.concatenate([core[0, :-1], core[:-1, -1], core[-1, :0:-1], core[:0:-1, 0]])
        more = core.size + np.arange(self.rings * self.order * len(edge))
        return np.concatenate([edge[None], more.reshape(-1, len(edge))])

    @cached_property
    def unit(self) -> Reals:
        """Places on the core from -1 to 1; those on its edge of nodes in rings, (nodes, 2)."""
        steps = 2 // self.order * np.arange(self.n * self.order + 1)
        core = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
        edge = core[self._around[0]]
        rings = np.tile(edge, (self.rings * self.order, 1))
        return (np.concatenate([core, rings]) - self.n) / self.n

    @cached_property
    def ring(self) -> Reals:
        """Rings between the core and each node; half ones for mid-sides, (nodes,)."""
        steps = np.arange(1, self.rings * self.order + 1) / self.order
        return np.concatenate([np.zeros(self._core.size), steps.repeat(self._around.shape[1])])

    def mesh(self, places: Reals) -> Mesh:
        """The board with its nodes at places, (nodes, 2).

        Node sets: bottom, right, top, left, boundary, core; the quads of the core are a set, too.
        """
        closed = np.column_stack([self._around, self._around[:, 0]])
        core = _quads(self._core, self.order)
        rings = _quads(closed[::-1], self.order)
        starts = self.n * self.order * np.arange(4)
        sides = tuple(closed[-1, at : at + self.n * self.order + 1] for at in starts)
        mesh = _mesh(places, np.concatenate([core, rings]), sides)
        mesh.quad_sets["core"] = np.arange(len(core))
        mesh.node_sets["core"] = self._core.ravel()
        return mesh


def _quads(table: Integers, order: int) -> Integers:
    """Quads between the nodes of a table, (quads, 4 or 9)."""
    rows, columns = _NODES.T if order == 2 else _NODES[:4].T // 2
    tall, wide = (np.arange(0, size - 1, order) for size in table.shape)
    quads = table[tall[:, None, None] + rows, wide[:, None] + columns]
    return quads.reshape(-1, len(rows))


def _mesh(nodes: Reals, quads: Integers, sides: tuple[Integers, ...]) -> Mesh:
    """A mesh of one part with its four sides as node sets."""
    sets = {name: np.sort(side) for name, side in zip(_SIDES, sides, strict=True)}
    sets["boundary"] = np.unique(np.concatenate(sides))
    return Mesh(nodes, quads, {"plate": np.arange(len(quads))}, sets)
