"""Sets of nodes, parts, shells and segments in every form that LS-DYNA has for them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from plydyn_pre.translate.block import TAKEN, Block, Row
from plydyn_pre.translate.model import Model, Place

Segment = tuple[int, ...]
#: Parts and nodes by numbers of shells, and by kind and number of others
Elements = dict[Any, tuple[int, tuple[int, ...]]]
_FORMS = ("LIST", "LIST_GENERATE", "LIST_GENERATE_INCREMENT", "COLUMN", "GENERAL", "ADD", "")
_MOST = 10_000_000  # numbers from a first to a last one
_FACES = ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


@dataclass
class Sets:
    """The sets of a deck."""

    model: Model
    nodes: dict[int, Place]
    elements: Elements

    def node_set(self, sid: int, by: Block, line: int = 0) -> set[int]:
        """Nodes of a set."""
        return self._set("NODE", sid, by, line)

    def part_set(self, sid: int, by: Block, line: int = 0) -> set[int]:
        """Parts of a set."""
        return self._set("PART", sid, by, line)

    def shell_set(self, sid: int, by: Block, line: int = 0) -> set[int]:
        """Elements of a set."""
        return self._set("SHELL", sid, by, line)

    def segments(self, sid: int, by: Block, line: int = 0) -> list[Segment]:
        """Segments of a set, each by its nodes."""
        found: list[Segment] = []
        for block in self._blocks("SEGMENT", sid, by, line):
            block.mark(TAKEN, "", "SID", "N1", "N2", "N3", "N4", "OPTION", "E1", "E2", "E3", "E4")
            for row in block.rows:
                if "N1" in row.values:
                    found.append(tuple(row.whole(f"N{n}") for n in range(1, 5)))
                elif "OPTION" in row.values:
                    found += self._segments_of(block, row)
        return found

    def nodes_of_parts(self, pids: Iterable[int]) -> set[int]:
        """Nodes of the elements of some parts."""
        pids = set(pids)
        return {n for pid, nodes in self.elements.values() if pid in pids for n in nodes}

    def box(self, number: int, by: Block, line: int = 0) -> set[int]:
        """Nodes in a box."""
        for block in self.model.find("DEFINE_BOX"):
            if block.raw("BOXID", 0) == number:
                names = ("XMN", "XMX", "YMN", "YMX", "ZMN", "ZMX")
                x0, x1, y0, y1, z0, z1 = (block.number(name, 0.0) for name in names)
                block.mark(TAKEN, "", "BOXID")
                for name, low, high in zip(names[1::2], (x0, y0, z0), (x1, y1, z1), strict=True):
                    if high < low:
                        raise block.fail(name, f"{high:g} is below {low:g}: the box is empty")
                return {
                    n
                    for n, (x, y, z) in self.nodes.items()
                    if x0 <= x <= x1 and y0 <= y <= y1 and z0 <= z <= z1
                }
        words = self.model.other_form("DEFINE_BOX_", number)
        raise by.fail("BOXID", words or f"there is no *DEFINE_BOX {number}", line)

    def _blocks(self, kind: str, sid: int, by: Block, line: int) -> list[Block]:
        """The keywords of a set."""
        names = [f"SET_{kind}_{form}".rstrip("_") for form in _FORMS]
        found = [block for block in self.model.find(*names) if block.raw("SID", 0) == sid]
        if not found:
            words = {"NODE": "nodes", "PART": "parts", "SHELL": "shells", "SEGMENT": "segments"}
            name = next((n for n in ("NSID", "SSID", "ESID", "SID") if by.has(n)), "")
            other = self.model.other_form(f"SET_{kind}_", sid)
            raise by.fail(name, other or f"there is no set of {words[kind]} {sid}", line)
        return found

    def _set(self, kind: str, sid: int, by: Block, line: int, deep: int = 0) -> set[int]:
        """Numbers of a set."""
        if deep > 20:
            raise by.fail("", f"set {sid} is made of itself", line)
        found: set[int] = set()
        for block in self._blocks(kind, sid, by, line):
            block.mark(TAKEN, "", "SID")
            if block.name.endswith("_GENERAL"):
                found |= self._general(kind, block)
            elif block.name.endswith("_ADD"):
                for each in block.ids("ID"):
                    found |= self._set(kind, each, block, block.line, deep + 1)
            elif block.name.endswith("_GENERATE"):
                found |= _generated(block)
            elif block.name.endswith("_INCREMENT"):
                found |= _stepped(block)
            else:
                name = {"NODE": "NID", "PART": "PID", "SHELL": "EID"}[kind]
                found |= self._listed(block, kind, name)
        return found

    def _listed(self, block: Block, kind: str, name: str) -> set[int]:
        """Numbers one by one; those of nodes that are not there are told."""
        found = set(block.ids(name))
        missing = sorted(found - self.nodes.keys()) if kind == "NODE" and not block.label else []
        if missing and not block.losses:
            block.lose(f"there is no node {missing[0]}", f"{name}1")
        return found

    def _general(self, kind: str, block: Block) -> set[int]:
        """Numbers by rules, of which those that begin with D take away."""
        block.mark(TAKEN, "", "OPTION", *(f"E{n}" for n in range(1, 8)))
        found: set[int] = set()
        for row in block.rows:
            option = str(row.values.get("OPTION", "")).upper()
            if not option:
                continue
            away = option[0] == "D" and option[1:] in self._rules(kind)
            rule = self._rules(kind).get(option[1:] if away else option)
            if rule is None:
                raise block.fail("OPTION", f"{option} is not translated", row.line)
            numbers = rule(row.numbers("E"), block, row)
            found = found - numbers if away else found | numbers
        return found

    def _rules(self, kind: str) -> dict[str, Callable[[list[int], Block, Row], set[int]]]:
        """What the options of a general set stand for."""

        def by_sets(of: str) -> Callable[[list[int], Block, Row], set[int]]:
            return lambda ids, block, row: set().union(
                *(self._set(of, sid, block, row.line, 1) for sid in ids)
            )

        if kind == "PART":
            return {"ALL": lambda *_: {p for p, _ in self.elements.values()}, "PART": _same}
        if kind == "SHELL":
            return {
                "ALL": lambda *_: set(self.elements),
                "ELEM": _same,
                "PART": lambda ids, *_: {e for e, (p, _) in self.elements.items() if p in ids},
                "SET_SHELL": by_sets("SHELL"),
            }
        return {
            "ALL": lambda *_: set(self.nodes),
            "NODE": _same,
            "PART": lambda ids, *_: self.nodes_of_parts(ids),
            "BOX": lambda ids, block, row: set().union(
                *(self.box(b, block, row.line) for b in ids)
            ),
            "SHELL": lambda ids, *_: {
                n for e in ids if e in self.elements for n in self.elements[e][1]
            },
            "SET_NODE": by_sets("NODE"),
            "SET_NOD": by_sets("NODE"),
            "SET_PART": lambda ids, block, row: self.nodes_of_parts(
                by_sets("PART")(ids, block, row)
            ),
        }

    def _segments_of(self, block: Block, row: Row) -> list[Segment]:
        """Segments by a rule."""
        option, ids = str(row.values["OPTION"]).upper(), row.numbers("E")
        if option == "SEG":
            return [tuple(ids[:4])]
        if option == "SET_SEGM":
            return [segment for sid in ids for segment in self.segments(sid, block, row.line)]
        if option not in ("PART", "SHELL", "ALL"):
            raise block.fail("OPTION", f"{option} is not translated", row.line)
        chosen = [
            nodes
            for number, (pid, nodes) in self.elements.items()
            if option == "ALL" or (pid if option == "PART" else number) in ids
        ]
        return [face for nodes in chosen for face in faces_of(nodes)]


def faces_of(nodes: tuple[int, ...]) -> list[Segment]:
    """The faces of a shell or a brick."""
    if len(nodes) < 8:
        return [nodes]
    return [tuple(nodes[i] for i in face) for face in _FACES]


def _same(ids: list[int], *_: object) -> set[int]:
    """The numbers themselves."""
    return set(ids)


def _generated(block: Block) -> set[int]:
    """Numbers from first to last ones."""
    found: set[int] = set()
    for n in range(1, 5):
        block.mark(TAKEN, "", f"B{n}BEG", f"B{n}END")
        for row in block.rows:
            first, last = row.whole(f"B{n}BEG"), row.whole(f"B{n}END")
            if first:
                if last and last < first:
                    words = f"{last} is below {first}: numbers run from low to high"
                    raise block.fail(f"B{n}END", words, row.line)
                if last - first > _MOST:
                    raise block.fail(f"B{n}END", f"{last} is too far", row.line)
                found |= set(range(first, (last or first) + 1))
    return found


def _stepped(block: Block) -> set[int]:
    """Numbers from first to last ones in steps."""
    block.mark(TAKEN, "", "BBEG", "BEND", "INCR")
    found: set[int] = set()
    for row in block.rows:
        first, last, step = (row.whole(name) for name in ("BBEG", "BEND", "INCR"))
        if first:
            if last - first > _MOST:
                raise block.fail("BEND", f"{last} is too far", row.line)
            if last and last < first:
                words = f"{last} is below {first}: numbers run from low to high"
                raise block.fail("BEND", words, row.line)
            if step < 0:
                raise block.fail("INCR", f"{step} is no step from low to high", row.line)
            found |= set(range(first, (last or first) + 1, step or 1))
    return found
