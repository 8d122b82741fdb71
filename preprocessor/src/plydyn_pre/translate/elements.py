"""Parts with their elements, and what shells have of their own."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import pairwise

from plydyn_pre.translate.block import TAKEN, Block, Row
from plydyn_pre.translate.layups import Ply, element_plies
from plydyn_pre.translate.model import Place

#: Thicknesses and offset, which are the same for a plate, and the share by which they may differ
_ALIKE, _SAME = ("THIC1", "THIC2", "THIC3", "THIC4", "OFFSET"), 1e-6


@dataclass(frozen=True)
class Element:
    """An element with the options of its keyword."""

    number: int
    nodes: tuple[int, ...]
    block: Block
    row: Row

    @property
    def triangle(self) -> bool:
        """Whether a shell has three corners."""
        return len(set(self.nodes[:4])) < 4

    def middles(self, nodes: dict[int, Place]) -> dict[frozenset[int], int]:
        """Nodes between the corners of a shell, by their two corners."""
        found = {}
        ends = (*self.nodes[:4], self.nodes[0])
        for n, pair in enumerate(pairwise(ends), start=5):
            if nid := self.row.whole(f"N{n}"):
                if nid not in nodes:
                    raise self.block.fail(f"N{n}", f"there is no node {nid}", self.row.line)
                found[frozenset(pair)] = nid
        return found


@dataclass
class Body:
    """A part with its elements."""

    pid: int
    block: Block
    kind: str  # shell, tshell or solid
    elements: list[Element]
    plies: list[Ply] = field(default_factory=list)
    reference: float = 0.0  # where the nodes of shells are: -1 bottom, 0 middle, 1 top
    offset: float = 0.0  # of the reference along the normal
    material: int = 0  # of a part that is no composite
    shares: list[Body] = field(default_factory=list)  # parts that a rigid body is joined of

    @property
    def pids(self) -> set[int]:
        """The part, and those that are joined to it."""
        return {self.pid, *(share.pid for share in self.shares)}

    @property
    def nodes(self) -> set[int]:
        """Nodes of all elements."""
        return {node for element in self.elements for node in element.nodes}

    @property
    def thickness(self) -> float:
        """Of all plies."""
        return sum(ply.thickness for ply in self.plies)


def with_options(body: Body) -> Iterator[Body]:
    """The part with the options of its elements, or one for each layup that they have."""
    if body.kind != "shell":
        yield body
        return
    for block in dict.fromkeys(element.block for element in body.elements):
        block.mark(TAKEN, "the same for all elements of a part", *_ALIKE)
        block.mark(TAKEN, "added to the angles of the plies", "BETA")
    thick, offset = _alike(body, *_ALIKE[:4]), _alike(body, "OFFSET")
    for (own, beta), elements in _by_layup(body).items():
        plies = list(own) or body.plies
        if not plies:
            raise body.block.fail("MID1", "the part has no plies")
        whole = sum(ply.thickness for ply in plies)
        share = thick / whole if thick > 0.0 else 1.0
        plies = [ply.turned(beta, share) for ply in plies]
        yield replace(body, elements=elements, plies=plies, offset=offset)


def _by_layup(body: Body) -> dict[tuple[tuple[Ply, ...], float], list[Element]]:
    """The elements by their own plies and angle."""
    found: dict[tuple[tuple[Ply, ...], float], list[Element]] = {}
    for element in body.elements:
        own = tuple(element_plies(element.block, element.row))
        found.setdefault((own, element.row.number("BETA")), []).append(element)
    return found


def _alike(body: Body, *names: str) -> float:
    """The value that fields of all elements of a part have in common."""
    first = body.elements[0].row.number(names[0])
    for element in body.elements:
        for name in names:
            value = element.row.number(name)
            if abs(value - first) > _SAME * abs(first):
                words = (
                    f"{value:g} at element {element.number}, {first:g} elsewhere in part {body.pid}"
                )
                words = f"{words}; a plate of plydyn has one thickness and one middle"
                raise element.block.fail(name, words, element.row.line)
    return first
