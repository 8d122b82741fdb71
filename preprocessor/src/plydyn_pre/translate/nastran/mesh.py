"""Nodes and elements of a file of bulk data, and the axes of their plies."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import atan2, cos, degrees, radians, sin

import numpy as np

from plydyn_pre.translate.model import Place
from plydyn_pre.translate.nastran.lines import Card, Deck
from plydyn_pre.translate.source import Source, corners_of
from plydyn_pre.translate.twice import twice

SHELLS = {"CQUAD4": 4, "CQUADR": 4, "CQUAD8": 4, "CTRIA3": 3, "CTRIAR": 3}
BRICKS = {"CHEXA": 8, "CPENTA": 6, "CTETRA": 4}
#: Fields with the number of an entry, and the entries that share their numbers
_NUMBERS = {
    "MID": ("MAT1", "MAT8", "MATRIG"),
    "PID": ("PCOMP", "PCOMPG", "PSHELL", "PSOLID"),
    "CID": ("CORD2R",),
}
_ALIKE = 1.0  # degrees by which the axes of elements of a part may differ


@dataclass(frozen=True)
class Element:
    """An element."""

    number: int
    pid: int
    nodes: tuple[int, ...]  # corners
    middles: tuple[int, ...]
    card: Card

    @property
    def shell(self) -> bool:
        """Whether it is a shell."""
        return self.card.name in SHELLS

    def corners(self) -> tuple[int, ...]:
        """Four corners of a shell or eight of a brick, some of which may be the same node."""
        return corners_of(self.nodes, self.shell)


@dataclass
class Mesh:
    """What a file is made of."""

    source: Source
    deck: Deck
    nodes: dict[int, Place] = field(default_factory=dict)
    held: dict[int, str] = field(default_factory=dict)  # directions that PS of GRID holds
    elements: dict[int, Element] = field(default_factory=dict)
    axes: dict[int, Card] = field(default_factory=dict)  # coordinate systems

    def of_part(self, pid: int) -> list[Element]:
        """The elements of a property."""
        return [element for element in self.elements.values() if element.pid == pid]

    def check(self, card: Card, name: str, nid: int) -> int:
        """A node that must be there."""
        if nid not in self.nodes:
            raise card.fail(name, f"there is no node {nid}")
        return nid


def read_mesh(source: Source, deck: Deck) -> Mesh:
    """The mesh of a file."""
    mesh = Mesh(source, deck)
    for name, cards in _NUMBERS.items():
        source.problems += twice(
            (card.block, card.word(name), name, card.line) for card in deck.each(*cards)
        )
    mesh.axes = {card.whole("CID"): card for card in deck.each("CORD2R")}
    for card in deck.each("GRID"):
        with source.gathered():
            _node(mesh, card)
    for card in deck.each(*SHELLS, *BRICKS):
        with source.gathered():
            _element(mesh, card)
    return mesh


def _node(mesh: Mesh, card: Card) -> None:
    """Read a node."""
    nid = card.whole("ID", None)
    if nid in mesh.nodes:
        raise card.fail("ID", f"node {nid} is defined twice")
    if card.whole("CP"):
        raise card.fail("CP", "coordinates in a system of their own are not translated")
    if card.whole("CD"):
        card.lose("what holds and moves a node along axes of its own is not translated", "CD")
    mesh.nodes[nid] = (card.number("X1"), card.number("X2"), card.number("X3"))
    if card.word("PS"):
        mesh.held[nid] = card.word("PS")


def _element(mesh: Mesh, card: Card) -> None:
    """Read an element."""
    count = (SHELLS | BRICKS)[card.name]
    eid = card.whole("EID", None)
    if eid in mesh.elements:
        raise card.fail("EID", f"element {eid} is defined twice")
    names = [f"G{n}" for n in range(1, count + 1)]
    nodes = tuple(mesh.check(card, name, card.whole(name, None)) for name in names)
    middles: tuple[int, ...] = ()
    if card.name == "CQUAD8":
        found = [card.whole(f"G{n}") for n in range(5, 9)]
        middles = tuple(mesh.check(card, f"G{n}", nid) for n, nid in enumerate(found, 5) if nid)
        if len(middles) not in (0, 4):
            raise card.fail("G5", "all nodes between corners are needed, or none")
    mesh.elements[eid] = Element(eid, card.whole("PID", eid), nodes, middles, card)


def axis_of_part(mesh: Mesh, members: list[Element]) -> float:
    """Angle from x, degrees, of the axis from which the angles of the plies of a part count."""
    angles = [_axis(mesh, element) for element in members]
    for element, angle in zip(members, angles, strict=True):
        if abs((angle - angles[0] + 180.0) % 360.0 - 180.0) > _ALIKE:
            words = (
                f"the axis of element {element.number} is at {angle:.4g} degrees from x, that of"
            )
            words = f"{words} element {members[0].number} at {angles[0]:.4g}; a part needs one"
            raise element.card.fail("THETA", f"{words}: give a CORD2R as THETA")
    return round(angles[0], 9) + 0.0


def _axis(mesh: Mesh, element: Element) -> float:
    """Angle of the axis of an element from x."""
    word = element.card.word("THETA")
    corners = [np.array(mesh.nodes[n]) for n in element.nodes]
    if word and word.lstrip("+").isdigit():
        x = _first_axis(mesh, element.card, int(word))
        return degrees(atan2(x[1], x[0]))
    edge = corners[1] - corners[0]
    up = np.cross(corners[1] - corners[0], corners[-1] - corners[0])[2] > 0.0
    turn = element.card.number("THETA")
    return degrees(atan2(edge[1], edge[0])) + (turn if up else -turn)


def _first_axis(mesh: Mesh, card: Card, cid: int) -> np.ndarray:
    """The first axis of a coordinate system."""
    if cid == 0:
        return np.array([1.0, 0.0, 0.0])
    system = mesh.axes.get(cid)
    if system is None:
        raise card.fail("THETA", f"there is no CORD2R {cid}")
    if system.whole("RID"):
        raise system.fail("RID", "a system in another one is not translated")
    a, b, c = (
        np.array([system.number(f"{point}{n}") for n in (1, 2, 3)]) for point in ("A", "B", "C")
    )
    z = b - a
    x = np.cross(np.cross(z, c - a), z)
    if not np.linalg.norm(x[:2]) > 1e-6 * np.linalg.norm(x) > 0.0:
        raise system.fail("C1", "its first axis must not be across the plate")
    return x


def vector(angle: float) -> tuple[float, float]:
    """The direction of an angle from x."""
    return round(cos(radians(angle)), 15) + 0.0, round(sin(radians(angle)), 15) + 0.0
