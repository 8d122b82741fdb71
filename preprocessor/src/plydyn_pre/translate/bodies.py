"""Nodes, elements and parts of a deck, sorted by what they are."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from plydyn_pre.errors import PreError
from plydyn_pre.translate.reader import REPLACED, TAKEN, Block, Row

_KINDS = {"ELEMENT_SHELL": "shell", "ELEMENT_TSHELL": "tshell", "ELEMENT_SOLID": "solid"}
_COMPOSITES = ("PART_COMPOSITE", "PART_COMPOSITE_LONG", "PART_COMPOSITE_TSHELL")
_COHESIVE = ("MAT_COHESIVE_MIXED_MODE", "MAT_COHESIVE_MIXED_MODE_ELASTOPLASTIC_RATE")

Place = tuple[float, float, float]


@dataclass(frozen=True)
class Ply:
    """A ply of a part."""

    material: int
    thickness: float
    angle: float


@dataclass
class Body:
    """A part with its elements."""

    pid: int
    block: Block
    kind: str  # shell, tshell or solid
    elements: list[tuple[int, ...]]  # nodes of each
    plies: list[Ply] = field(default_factory=list)
    reference: float = 0.0  # where the nodes of shells are: -1 bottom, 0 middle, 1 top
    material: int = 0  # of a part that is no composite

    @property
    def nodes(self) -> set[int]:
        """Nodes of all elements."""
        return {node for element in self.elements for node in element}

    @property
    def thickness(self) -> float:
        """Of all plies."""
        return sum(ply.thickness for ply in self.plies)


@dataclass
class Bodies:
    """What a deck is made of."""

    nodes: dict[int, Place]
    plates: list[Body]
    rigid: list[Body]
    cohesive: list[Body]


def find(blocks: Iterable[Block], *names: str) -> Iterator[Block]:
    """Keywords of some names."""
    return (block for block in blocks if block.name in names)


def materials(blocks: Iterable[Block]) -> dict[int, Block]:
    """Keywords of materials by their numbers."""
    found: dict[int, Block] = {}
    for block in blocks:
        if block.name.startswith("MAT_") and block.has("MID"):
            mid = block.whole("MID")
            if mid in found:
                raise block.fail("MID", f"material {mid} is defined twice")
            found[mid] = block
    return found


def read_bodies(blocks: list[Block]) -> Bodies:
    """Sort the parts of a deck."""
    nodes = _nodes(blocks)
    elements = _elements(blocks, nodes)
    known = materials(blocks)
    bodies = Bodies(nodes, [], [], [])
    for block, rows in _parts(blocks):
        body = _body(block, rows, elements)
        law = known[body.material].name if body.material in known else ""
        if block.name.startswith("PART_COMPOSITE"):
            bodies.plates.append(body)
        elif law == "MAT_RIGID":
            bodies.rigid.append(body)
        elif law in _COHESIVE and body.kind == "solid":
            bodies.cohesive.append(body)
        elif body.kind == "shell" and body.material in known:
            _single_ply(body, blocks)
            bodies.plates.append(body)
        else:
            words = "no part of a plate, rigid body or cohesive layer that plydyn knows"
            raise block.fail("MID", f"part {body.pid} is {words}")
    if not bodies.plates:
        raise PreError(f"{blocks[0].file}: no plate; *PART_COMPOSITE with shells is needed")
    _mark_mesh(bodies, blocks)
    return bodies


def _mark_mesh(bodies: Bodies, blocks: list[Block]) -> None:
    """Tell what becomes of nodes and elements, by the bodies that they are of."""
    kinds = (
        (bodies.plates, "quads of nine nodes, for those of four are too stiff in bending"),
        (bodies.cohesive, "*INTERFACE_COHESIVE between plies"),
        (bodies.rigid, "*IMPACTOR_SPHERE"),
    )
    fields = [f"N{n}" for n in range(1, 9)]
    for block in find(blocks, *_KINDS):
        pids = {row.values.get("PID") for row in block.rows}
        words = [text for some, text in kinds if pids & {body.pid for body in some}]
        block.mark(REPLACED, "; ".join(words), "EID", "PID", *fields)
    plate = {nid for body in bodies.plates for nid in body.nodes}
    for block in find(blocks, "NODE"):
        ids = {row.values.get("NID") for row in block.rows}
        words = "columns of points through the thickness, numbered as in the lowest layer"
        if not ids & plate:
            block.mark(REPLACED, "*IMPACTOR_SPHERE or an interface", "NID", "X", "Y", "Z")
        else:
            block.mark(REPLACED, words, "NID")


def _nodes(blocks: list[Block]) -> dict[int, Place]:
    """Places of the nodes."""
    nodes: dict[int, Place] = {}
    for block in find(blocks, "NODE"):
        block.mark(TAKEN, "", "X", "Y")
        block.mark(REPLACED, "the plate has one plane, at the middle of its thickness", "Z")
        for row in block.rows:
            values = row.values
            if "NID" not in values:
                raise block.fail("NID", "missing", row.line)
            nid = int(values["NID"])
            if nid in nodes:
                raise block.fail("NID", f"node {nid} is defined twice", row.line)
            nodes[nid] = tuple(float(values.get(axis, 0.0)) for axis in ("X", "Y", "Z"))
    return nodes


def _elements(
    blocks: list[Block], nodes: dict[int, Place]
) -> dict[int, tuple[str, list[tuple[int, ...]]]]:
    """Kind and elements of each part."""
    found: dict[int, tuple[str, list[tuple[int, ...]]]] = {}
    for block in find(blocks, *_KINDS):
        kind = _KINDS[block.name]
        names = [f"N{n}" for n in range(1, 5 if kind == "shell" else 9)]
        for row in block.rows:
            pid, element = _element(block, row, names, nodes)
            known, elements = found.setdefault(pid, (kind, []))
            if known != kind:
                raise block.fail("PID", f"part {pid} has elements of two kinds", row.line)
            elements.append(element)
    return found


def _element(
    block: Block, row: Row, names: list[str], nodes: dict[int, Place]
) -> tuple[int, tuple[int, ...]]:
    """Part and nodes of an element."""
    ids = []
    for name in ("PID", *names):
        if name not in row.values:
            raise block.fail(name, "missing", row.line)
        ids.append(int(row.values[name]))
    for name, nid in zip(names, ids[1:], strict=True):
        if nid not in nodes:
            raise block.fail(name, f"there is no node {nid}", row.line)
    return ids[0], tuple(ids[1:])


def _parts(blocks: list[Block]) -> Iterator[tuple[Block, list[Row]]]:
    """Parts with their rows; a *PART holds one."""
    for block in find(blocks, "PART", "PART_INERTIA", *_COMPOSITES):
        yield block, block.rows


def _body(
    block: Block, rows: list[Row], elements: dict[int, tuple[str, list[tuple[int, ...]]]]
) -> Body:
    """A part."""
    pid = block.whole("PID")
    if pid not in elements:
        raise block.fail("PID", f"part {pid} has no elements")
    kind, members = elements[pid]
    body = Body(pid, block, kind, members)
    block.mark(TAKEN, "", "HEADING")
    if block.name in ("PART", "PART_INERTIA"):
        body.material = block.whole("MID")
        return body
    if (kind == "tshell") != (block.name == "PART_COMPOSITE_TSHELL"):
        raise block.fail("PID", f"part {pid} has elements of kind {kind}")
    body.reference = block.number("NLOC", 0.0) if kind == "shell" else 0.0
    block.mark(REPLACED, "0: nodes in the middle of the laminate, at a z of their own", "NLOC")
    words = "plates are layer-wise: *SECTION_LAYERWISE, order 2 in each ply"
    block.mark(REPLACED, words, "ELFORM", "SHRF", "TSHEAR")
    for row in rows:
        body.plies += list(_plies(block, row))
    if not body.plies:
        raise block.fail("MID1", "the part has no plies")
    return body


def _plies(block: Block, row: Row) -> Iterator[Ply]:
    """Plies of a card."""
    for n in (1, 2):
        block.mark(TAKEN, "", f"THICK{n}", f"B{n}", f"PLYID{n}")
        block.mark(REPLACED, "numbered anew", f"MID{n}", "PID")
        if f"MID{n}" not in row.values or not int(row.values[f"MID{n}"]):
            continue
        thickness = float(row.values.get(f"THICK{n}", 0.0))
        if thickness <= 0.0:
            raise block.fail(f"THICK{n}", f"{thickness:g} must be above zero", row.line)
        angle = float(row.values.get(f"B{n}", 0.0))
        yield Ply(int(row.values[f"MID{n}"]), thickness, angle)


def _single_ply(body: Body, blocks: list[Block]) -> None:
    """The ply of shells that are no composite."""
    secid = body.block.whole("SECID")
    for section in find(blocks, "SECTION_SHELL"):
        if section.raw("SECID") == secid:
            section.mark(TAKEN, "", "SECID")
            body.plies = [Ply(body.material, section.positive("T1"), 0.0)]
            body.reference = section.number("NLOC", 0.0)
            return
    raise body.block.fail("SECID", f"there is no *SECTION_SHELL {secid}")
