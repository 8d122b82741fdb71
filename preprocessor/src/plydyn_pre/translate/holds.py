"""Where over the thickness a plate is held, by what holds the nodes of its parts.

A node of a shell that is held along the plate and may turn is a hinge: points at its height are
held, and no others. One that may not turn holds them over the whole thickness, and so do all nodes
of a column together.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from plydyn_pre.translate.block import Block, Row
from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.model import Model
from plydyn_pre.translate.stack import Stack

#: Heights at which a column is held; None for the whole thickness
Heights = tuple[float, ...] | None
#: Directions along a plate in which a rotation moves the points over a node, and its field
TURNS = {"x": "DOFRY", "y": "DOFRX"}
#: Of the thickness by which a height may miss the points of the plate
_NEAR = 1e-3


def _by_axis() -> dict[str, set[int]]:
    return {axis: set() for axis in "xyz"}


@dataclass
class Holds:
    """What is known of the nodes of a plate."""

    model: Model
    bodies: Bodies
    stack: Stack
    held: dict[str, set[int]] = field(default_factory=_by_axis)  # nodes
    moved: dict[str, set[int]] = field(default_factory=_by_axis)
    # nodes of shells that may not turn, by the direction along which that moves points over them
    fixed: dict[str, set[int]] = field(default_factory=_by_axis)
    by: list[tuple[Block, Row, str, str, set[int]]] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Sort the nodes of the plate by their columns, and mid-sides by their ends."""
        layers = [layer for layer in self.stack.layers if layer.body.kind == "shell"]
        self.shells = {n for layer in layers for n in (*layer.nodes, *layer.middles.values())}
        self.nodes_of: dict[int, list[int]] = {}
        for node, column in self.stack.column_of.items():
            self.nodes_of.setdefault(column, []).append(node)
        self.ends_of = {middle: ends for ends, middle in self.stack.edges.items()}

    def hold(self, ids: Iterable[int], held: str) -> None:
        """Hold nodes along some of x, y and z."""
        for axis in held:
            self.held[axis].update(ids)

    def move(self, ids: Iterable[int], held: str) -> None:
        """Move nodes, or hold them for a time, which acts on the whole thickness."""
        for axis in held:
            self.moved[axis].update(ids)

    def fix(self, block: Block, row: Row, name: str, axis: str, ids: Iterable[int]) -> None:
        """Hold a rotation that moves points along an axis; told by a field."""
        found = set(ids) & self.shells
        self.fixed[axis] |= found
        self.by.append((block, row, name, axis, found))

    def heights(self, column: int, axis: str) -> Heights:
        """Where a column is held along an axis; nowhere for a mid-side whose ends differ."""
        nodes = self.nodes_of.get(column, [])
        found = [n for n in nodes if n in self.held[axis]]
        if not found and column in self.ends_of:
            first, last = (self.heights(end, axis) for end in self.ends_of[column])
            if first is None or last is None:
                return first or last
            return tuple(sorted({*first} & {*last}))
        turns = axis != "z" and set(found) & self.shells - self.fixed[axis]
        if found == nodes and not (turns and len(nodes) == 1):
            return None
        return tuple(sorted({round(self.bodies.nodes[n][2], 9) for n in found}))

    def level(self, height: float) -> float:
        """The height of the points that are nearest to one: those of order 2 in each ply."""
        levels = [self.stack.bottom]
        for ply in (ply for layer in self.stack.layers for ply in layer.plies):
            levels += [levels[-1] + 0.5 * ply.thickness, levels[-1] + ply.thickness]
        nearest = min(levels, key=lambda level: abs(level - height))
        if abs(nearest - height) > _NEAR * self.stack.thickness:
            self.model.notes.append(
                f"no points of the plate are at z = {height:g}, where nodes are held; those at"
                f" {nearest:g} are"
            )
        return nearest

    def check_turns(self) -> None:
        """Tell of rotations that are held where the points may move, and the plate turns."""
        loose: dict[tuple[Block, str, str], set[int]] = {}
        lines: dict[tuple[Block, str, str], int] = {}
        for block, row, name, axis, ids in self.by:
            key = (block, name, axis)
            loose.setdefault(key, set()).update(ids - self.held[axis] - self.moved[axis])
            lines.setdefault(key, row.line)
        for (block, name, axis), ids in loose.items():
            if ids:
                words = (
                    f"{len(ids)} nodes may not turn, but move along {axis}: points have no"
                    f" rotations, and the plate turns there unless {axis} is held, too"
                )
                block.lose(words, name, line=lines[block, name, axis])
        for axis in TURNS:
            turned = (self.moved[axis] - self.fixed[axis]) & self.shells
            if turned and len(self.stack.layers) == 1:
                self.model.notes.append(
                    f"{len(turned)} nodes of shells that may turn are moved along {axis}, or held"
                    " for a time: over the whole thickness, so that the plate does not turn there"
                )
