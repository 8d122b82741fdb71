"""Who touches or holds whom: the two sides of a contact."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from plydyn_pre.translate.block import REPLACED, TAKEN, Block
from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.model import Model
from plydyn_pre.translate.sets import faces_of

BONDS = ("CONTACT_TIED", "CONTACT_TIEBREAK", "CONTACT_TIEBREAK_CLASSIC")
_SIDES = (("SSID", "SSTYP", "SBOXID"), ("MSID", "MSTYP", "MBOXID"))
#: FS from which on it means a table
_FRICTION_OF_TABLE = 2.0
#: BT and DT for never and for ever
_EVER = 1.0e19


@dataclass(frozen=True)
class Side:
    """One side of a contact."""

    everything: bool
    pids: frozenset[int]  # parts that it names or that have nodes in it
    nodes: frozenset[int] | None  # its nodes, where it is less than whole parts
    faces: int  # number of segments, where it is made of them


@dataclass(frozen=True)
class Contact:
    """A contact with both sides."""

    block: Block
    sides: tuple[Side, Side]

    def joins(self, first: Iterable[int], second: Iterable[int]) -> bool:
        """Whether its sides name some parts of both."""
        one, other = set(first), set(second)
        pairs = (self.sides, self.sides[::-1])
        return any(_names(a, one) and _names(b, other) for a, b in pairs)

    def friction(self) -> tuple[float, float, float]:
        """Static and dynamic coefficient and decay."""
        names = ("FS", "FD", "DC")
        static, dynamic, decay = (float(self.block.raw(name, 0.0)) for name in names)
        if static < 0.0 or static >= _FRICTION_OF_TABLE or dynamic > static:
            words = "a table, the friction of parts, or more at speed than at rest: not translated"
            self.block.lose(words, *names, line=self.block.line_of("FS"))
            return 0.0, 0.0, 0.0
        self.block.mark(TAKEN, "friction of the impactor", *names)
        scale = self.block.number("FSF", 0.0) or 1.0
        if static * scale > 0.0:
            words = "friction that is limited by VC times the area is not translated"
            self.block.lose_filled(words, "VC")
        return static * scale, dynamic * scale, decay


def read_contacts(model: Model, bodies: Bodies) -> list[Contact]:
    """The contacts of a deck."""
    found = []
    for block in model.find("CONTACT", *BONDS):
        with model.gathered():
            one, other = (_side(bodies, block, names) for names in _SIDES)
            if "SINGLE_SURFACE" in block.written or "GENERAL" in block.written:
                other = one
            found.append(Contact(block, (one, other)))
            _check_times(model, block)
            block.mark(REPLACED, "by what the contact became", *_SIDES[0][:2], *_SIDES[1][:2])
    return found


def _check_times(model: Model, block: Block) -> None:
    """Refuse a contact that begins late or ends early."""
    # below zero: without effect in the dynamic relaxation
    birth, death = float(block.raw("BT", 0.0)), abs(float(block.raw("DT", 0.0)))
    if birth > 0.0:
        block.lose("a contact that begins later is not translated", "BT", line=block.line_of("BT"))
    if 0.0 < death < model.end and death < _EVER:
        block.lose("a contact that ends early is not translated", "DT", line=block.line_of("DT"))
    block.mark(TAKEN, "at all times", *(n for n in ("BT", "DT") if n not in block.fates))


def _names(side: Side, pids: set[int]) -> bool:
    """Whether a side names one of some parts."""
    return side.everything or bool(side.pids & pids)


def _side(bodies: Bodies, block: Block, names: tuple[str, str, str]) -> Side:
    """A side of a contact."""
    number, kind = int(block.raw(names[0], 0)), int(block.raw(names[1], 0))
    line = block.line_of(names[0])
    if block.raw(names[2], 0):
        block.lose("a box that cuts a contact is not translated", names[2], line=line)
    sets = bodies.sets
    if number == 0 or kind == 5:
        return Side(True, frozenset(), None, 0)
    if kind == 3:
        return Side(False, frozenset({number}), None, 0)
    if kind == 2:
        return Side(False, frozenset(sets.part_set(number, block, line)), None, 0)
    if kind == 6:
        every = {pid for pid, _ in sets.elements.values()}
        return Side(False, frozenset(every - sets.part_set(number, block, line)), None, 0)
    if kind == 0:
        segments = sets.segments(number, block, line)
        return _side_of(
            bodies, {n for s in segments for n in s if n}, len({frozenset(s) for s in segments})
        )
    if kind == 1:
        chosen = sets.shell_set(number, block, line)
        faces = [nodes for e, (_, nodes) in sets.elements.items() if e in chosen]
        return _side_of(bodies, {n for face in faces for n in face}, len(faces))
    if kind == 4:
        return _side_of(bodies, sets.node_set(number, block, line), 0)
    raise block.fail(names[1], f"{kind} is not translated; 0 to 6 are", line)


def _side_of(bodies: Bodies, nodes: set[int], faces: int) -> Side:
    """A side of some nodes: parts that have a whole face in it, or nodes at least."""
    owners: set[int] = set()
    for pid, corners in bodies.sets.elements.values():
        if pid not in owners and any(set(face) <= nodes for face in faces_of(corners)):
            owners.add(pid)
    return Side(False, frozenset(owners), frozenset(nodes), faces)
