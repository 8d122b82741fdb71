"""Nodes, elements, sets and surfaces of an Abaqus file, with its instances in their places."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import dataclass, field
from math import cos, radians, sin

import numpy as np

from plydyn_pre.translate.abaqus.lines import Keyword
from plydyn_pre.translate.model import Place
from plydyn_pre.translate.source import Source, corners_of

#: Kinds of elements that are translated, by the names of LS-DYNA's, and their corners
SHELLS = dict.fromkeys(
    ("S4", "S4R", "S4RS", "S4RSW", "S8R", "S8R5", "S9R5", "S4R5", "R3D4", "M3D4", "M3D4R"), 4
) | dict.fromkeys(("S3", "S3R", "S3RS", "STRI3", "STRI65", "R3D3", "M3D3"), 3)
THICK = {"SC8R": 8, "SC6R": 6, "CSS8": 8}
SOLIDS = dict.fromkeys(["C3D8", "C3D8R", "C3D8I", "C3D8H", "C3D20", "C3D20R"], 8) | {
    name: corners
    for corners, names in ((6, "C3D6 C3D15"), (4, "C3D4 C3D10 C3D10M"))
    for name in names.split()
}
COHESIVE = {"COH3D8": 8, "COH3D6": 6}
POINTS = {"MASS": 1, "ROTARYI": 1}
KINDS = {"shell": SHELLS, "tshell": THICK, "solid": SOLIDS, "cohesive": COHESIVE, "point": POINTS}
#: Nodes of an element by its name, where they are more than its corners
_NODES = {"S8R": 8, "S8R5": 8, "S9R5": 9, "STRI65": 6, "C3D20": 20, "C3D20R": 20, "C3D15": 15}
_NODES |= {"C3D10": 10, "C3D10M": 10}
#: Faces of bricks from outside
_BRICK = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))

Ids = list[int]


@dataclass(frozen=True)
class Element:
    """An element."""

    number: int
    kind: str  # shell, tshell, solid, cohesive or point
    nodes: tuple[int, ...]  # corners
    middles: tuple[int, ...]  # nodes between the corners of a shell
    keyword: Keyword
    line: int

    def faces(self) -> list[tuple[int, ...]]:
        """Its faces from outside, by their numbers; that of a shell along its normal."""
        if self.kind == "shell":
            return [self.nodes]
        corners = self.corners()
        return [tuple(corners[i] for i in face) for face in _BRICK]

    def corners(self) -> tuple[int, ...]:
        """Four corners of a shell or eight of a brick, some of which may be the same node."""
        return corners_of(self.nodes, self.kind == "shell")


@dataclass
class Surface:
    """A surface: faces of elements, or nodes, or an analytical one."""

    keyword: Keyword
    faces: list[tuple[int, ...]] = field(default_factory=list)
    nodes: set[int] = field(default_factory=set)
    elements: set[int] = field(default_factory=set)

    @property
    def analytical(self) -> bool:
        """Whether it is a rigid profile."""
        return self.keyword.options.get("TYPE", "").upper() in ("REVOLUTION", "CYLINDER")


@dataclass
class Mesh:
    """What a file is made of, numbered through all instances."""

    source: Source
    nodes: dict[int, Place] = field(default_factory=dict)
    elements: dict[int, Element] = field(default_factory=dict)
    node_sets: dict[tuple[str, str], Ids] = field(default_factory=dict)
    element_sets: dict[tuple[str, str], Ids] = field(default_factory=dict)
    surfaces: dict[tuple[str, str], Surface] = field(default_factory=dict)
    keywords: list[Keyword] = field(default_factory=list)  # of all instances, in order
    places: dict[str, np.ndarray] = field(default_factory=dict)  # of instances: rows of a matrix
    first: dict[str, int] = field(default_factory=dict)  # what is added to numbers
    lost: set[int] = field(default_factory=set)  # elements of types that are not translated
    last: int = 0  # largest number of the quads that rigid surfaces became

    def each(self, *names: str) -> Iterator[Keyword]:
        """Keywords of some names."""
        return (keyword for keyword in self.keywords if keyword.name in names)

    def placed(self, space: str, place: Iterable[float]) -> Place:
        """A point of an instance in the assembly."""
        x, y, z = (*place, 0.0, 0.0, 0.0)[:3]
        if space not in self.places:
            return (x, y, z)
        x, y, z = map(float, self.places[space] @ np.array([x, y, z, 1.0]))
        return x, y, z

    def turned(self, space: str, direction: Iterable[float]) -> np.ndarray:
        """A direction of an instance in the assembly."""
        vector = np.array([*direction])
        return self.places[space][:, :3] @ vector if space in self.places else vector

    def offset(self, space: str) -> int:
        """What is added to the numbers of an instance."""
        last = max(max(self.nodes, default=0), max(self.elements, default=0))
        return self.first.setdefault(space, last)

    def node_ids(self, keyword: Keyword, word: str, line: int) -> Ids:
        """Nodes by a number or the name of a set."""
        return self._ids(keyword, word, line, self.node_sets, self.nodes, "node")

    def element_ids(self, keyword: Keyword, word: str, line: int) -> Ids:
        """Elements by a number or the name of a set."""
        return self._ids(keyword, word, line, self.element_sets, self.elements, "element")

    def surface(self, keyword: Keyword, word: str, line: int) -> Surface:
        """A surface by its name; the name of a set of nodes stands for its nodes."""
        for key in _keys(keyword.space, word):
            if key in self.surfaces:
                return self.surfaces[key]
        raise keyword.fail(word, "there is no such surface", line)

    def _ids(
        self,
        keyword: Keyword,
        word: str,
        line: int,
        sets: dict[tuple[str, str], Ids],
        known: Collection[int],
        what: str,
    ) -> Ids:
        """Numbers by a number or the name of a set."""
        space, _, last = word.rpartition(".")
        if last.isdigit():
            number = int(last) + self.first.get(space.upper() or keyword.space, 0)
            if known is self.elements and number in self.lost:
                return []
            if number not in known:
                raise keyword.fail("", f"there is no {what} {word}", line)
            return [number]
        for key in _keys(keyword.space, word):
            if key in sets:
                return sets[key]
        raise keyword.fail("", f"there is no set of {what}s {word}", line)


def _keys(space: str, word: str) -> Iterator[tuple[str, str]]:
    """Where a name is looked for: in the instance that it names or that names it, then outside."""
    yield space, word.upper()
    yield "", word.upper()
    head, _, last = word.upper().rpartition(".")
    if head:
        yield head, last


def read_mesh(source: Source, keywords: list[Keyword]) -> Mesh:
    """The mesh of a file."""
    mesh = Mesh(source)
    with source.gathered():
        mesh.keywords = _placed(mesh, keywords)
    for keyword in mesh.keywords:
        with source.gathered():
            match keyword.name:
                case "NODE":
                    _nodes(mesh, keyword)
                case "NGEN" | "NFILL" | "NCOPY" | "ELGEN" | "ELCOPY":
                    keyword.block.lose("nodes and elements by rules are not translated")
                case "ELEMENT":
                    _elements(mesh, keyword)
                case "NSET":
                    _set(mesh, keyword, mesh.node_sets, mesh.node_ids, "NSET")
                case "ELSET":
                    _set(mesh, keyword, mesh.element_sets, mesh.element_ids, "ELSET")
                case "SURFACE":
                    _surface(mesh, keyword)
    return mesh


def _placed(mesh: Mesh, keywords: list[Keyword]) -> list[Keyword]:
    """The keywords with those of parts where their instances stand."""
    parts: dict[str, list[Keyword]] = {}
    found: list[Keyword] = []
    part = space = ""
    for keyword in keywords:
        name = keyword.name
        if name == "PART":
            part = keyword.option("NAME").upper()
            parts[part] = []
        elif name == "END PART":
            part = ""
        elif name == "INSTANCE":
            space = keyword.option("NAME").upper()
            of = keyword.option("PART").upper()
            if of not in parts:
                raise keyword.fail("PART", f"there is no part {of}")
            mesh.places[space] = _matrix(keyword)
            found += [each.within(space) for each in parts[of]]
        elif name == "END INSTANCE":
            space = ""
        elif part:
            parts[part].append(keyword)
        elif name not in ("ASSEMBLY", "END ASSEMBLY"):
            found.append(keyword.within(space))
    return found


def _matrix(keyword: Keyword) -> np.ndarray:
    """Rotation and translation of an instance: three rows of four."""
    rows = [keyword.numbers("", words, line) for line, words in keyword.data]
    shift = np.array((*(rows[0] if rows else ()), 0.0, 0.0, 0.0)[:3])
    turn, start = np.eye(3), np.zeros(3)
    if len(rows) > 1:
        start, end = np.array(rows[1][:3]), np.array(rows[1][3:6])
        if len(rows[1]) < 7 or not np.linalg.norm(end - start):
            raise keyword.fail("", "a rotation has two points and an angle", keyword.data[1][0])
        x, y, z = (end - start) / np.linalg.norm(end - start)
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        angle = radians(rows[1][6])
        turn = np.eye(3) + sin(angle) * cross + (1.0 - cos(angle)) * cross @ cross
    # the translation comes first, then the rotation about the line
    moved = turn @ (shift - start) + start
    return np.column_stack([turn, moved])


def _nodes(mesh: Mesh, keyword: Keyword) -> None:
    """Read nodes."""
    if keyword.options.get("SYSTEM", "R").upper() != "R":
        raise keyword.fail("SYSTEM", "coordinates that are not rectangular are not translated")
    offset = mesh.offset(keyword.space)
    members = []
    for line, words in keyword.data:
        number, *place = keyword.numbers("", words, line)
        if number != int(number) or number < 1:
            raise keyword.fail("", f"{words[0]!r} is no number of a node", line)
        members.append(int(number) + offset)
        if members[-1] in mesh.nodes:
            raise keyword.fail("", f"node {int(number)} is defined twice", line)
        mesh.nodes[members[-1]] = mesh.placed(keyword.space, place)
    if name := keyword.options.get("NSET"):
        mesh.node_sets.setdefault((keyword.space, name.upper()), []).extend(members)


def _elements(mesh: Mesh, keyword: Keyword) -> None:
    """Read elements."""
    name = keyword.option("TYPE").upper()
    kind = next((kind for kind, names in KINDS.items() if name in names), "")
    if not kind:
        keyword.block.lose(f"elements of type {name} are not translated", "TYPE")
        offset = mesh.offset(keyword.space)
        firsts = [words[0] for _, words in keyword.data if words and words[0].isdigit()]
        mesh.lost.update(int(word) + offset for word in firsts)
        if set_name := keyword.options.get("ELSET"):
            mesh.element_sets.setdefault((keyword.space, set_name.upper()), [])
        return
    corners = KINDS[kind][name]
    count = _NODES.get(name, corners)
    offset = mesh.offset(keyword.space)
    members: Ids = []
    words: list[str] = []
    start = 0
    for line, more in keyword.data:
        start = start if words else line
        words += more
        if len(words) <= count:
            continue
        if len(words) > count + 1:
            raise keyword.fail("", f"{name} has {count} nodes, {len(words) - 1} are there", start)
        number = keyword.numbers("", words[:1], start)[0]
        ids = [n for word in words[1:] for n in mesh.node_ids(keyword, word, start)]
        eid = int(number) + offset
        if eid in mesh.elements:
            raise keyword.fail("", f"element {int(number)} is defined twice", start)
        middles = tuple(ids[4:8]) if kind == "shell" and corners == 4 and count >= 8 else ()
        mesh.elements[eid] = Element(eid, kind, tuple(ids[:corners]), middles, keyword, start)
        members.append(eid)
        words = []
    if words:
        raise keyword.fail("", f"{name} has {count} nodes, {len(words) - 1} are there", start)
    if chosen := keyword.options.get("ELSET"):
        mesh.element_sets.setdefault((keyword.space, chosen.upper()), []).extend(members)


def _set(
    mesh: Mesh,
    keyword: Keyword,
    sets: dict[tuple[str, str], Ids],
    find: Callable[..., Ids],
    option: str,
) -> None:
    """Read a set."""
    name = keyword.option(option).upper()
    inner = keyword.within(keyword.options.get("INSTANCE", keyword.space).upper())
    members: Ids = []
    if "GENERATE" in keyword.options:
        offset = mesh.first.get(inner.space, 0)
        for line, words in keyword.data:
            first, last, *step = (int(n) for n in keyword.numbers("", words, line))
            if last - first > 10_000_000 or (step and step[0] < 1):
                raise keyword.fail("", "the numbers of a rule run from low to high", line)
            members += range(first + offset, last + offset + 1, *step)
    elif "ELSET" in keyword.options and option == "NSET":
        of = mesh.element_ids(inner, keyword.options["ELSET"], keyword.block.line)
        members = sorted({n for eid in of for n in mesh.elements[eid].nodes})
    else:
        for line, words in keyword.data:
            for word in filter(None, words):
                members += find(inner, word, line)
    known = mesh.nodes if option == "NSET" else mesh.elements
    members = [member for member in members if member in known]
    sets.setdefault((keyword.space, name), []).extend(members)


def _surface(mesh: Mesh, keyword: Keyword) -> None:
    """Read a surface."""
    surface = Surface(keyword)
    kind = keyword.kind("TYPE", "ELEMENT", "ELEMENT", "NODE", "REVOLUTION", "CYLINDER")
    mesh.surfaces[keyword.space, keyword.option("NAME").upper()] = surface
    for line, words in keyword.data if not surface.analytical else ():
        if kind == "NODE":
            surface.nodes.update(mesh.node_ids(keyword, words[0], line))
            continue
        if not words[0]:
            surface.elements.update(mesh.elements)
            continue
        side = words[1].upper() if len(words) > 1 else ""
        for eid in mesh.element_ids(keyword, words[0], line):
            element = mesh.elements[eid]
            surface.elements.add(eid)
            surface.faces += _faces(keyword, element, side, line)


def _faces(keyword: Keyword, element: Element, side: str, line: int) -> list[tuple[int, ...]]:
    """The faces of an element on a side, seen from outside."""
    faces = element.faces()
    if element.kind == "shell":
        return [faces[0][::-1]] if side == "SNEG" else faces
    if not side:
        return faces
    if side[:1] != "S" or side[1:] not in "123456" or len(side) != 2:
        raise keyword.fail("", f"{side} is no face of element {element.number}", line)
    return [faces[int(side[1]) - 1]]
