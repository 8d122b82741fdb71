"""Nodes, elements and parts of a deck, sorted by what they are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

from plydyn_pre.errors import PreError
from plydyn_pre.translate.block import IDLE, REPLACED, TAKEN, Block, Row
from plydyn_pre.translate.elements import Body, Element, with_options
from plydyn_pre.translate.laws import COHESIVE, ISOTROPIC, PLIES, angle_name
from plydyn_pre.translate.layups import check_shells, part_plies, section_plies
from plydyn_pre.translate.model import Model, Place
from plydyn_pre.translate.sets import Sets

_KINDS = {"ELEMENT_TSHELL": "tshell", "ELEMENT_SOLID": "solid"}
_PARTS = ("PART", "PART_INERTIA", "PART_CONTACT", "PART_INERTIA_CONTACT")
_OF_FIRST = "the first part of *CONSTRAINED_RIGID_BODIES has it"


class NoPlateError(PreError):
    """A deck without a plate."""


@dataclass
class Bodies:
    """What a deck is made of."""

    sets: Sets
    laws: dict[int, Block]  # keywords of materials by their numbers
    plates: list[Body] = field(default_factory=list)
    rigid: list[Body] = field(default_factory=list)
    cohesive: list[Body] = field(default_factory=list)

    @property
    def nodes(self) -> dict[int, Place]:
        """Places of all nodes."""
        return self.sets.nodes


def read_bodies(model: Model) -> Bodies:
    """Sort the parts of a deck."""
    nodes, by_part = nodes_and_elements(model)
    numbered = {
        (e.number if kind == "shell" else (kind, e.number)): (pid, e.nodes)
        for pid, (kind, elements) in by_part.items()
        for e in elements
    }
    laws = model.numbered("MID", {b.name for b in model.blocks if b.name.startswith("MAT_")})
    bodies = Bodies(Sets(model, nodes, numbered), laws)
    parts = {
        int(block.raw("PID", 0)): block for block in model.blocks if block.name.startswith("PART")
    }
    for pid, (kind, elements) in by_part.items():
        with model.gathered():
            if pid not in parts:
                words = f"there is no *PART {pid}"
                raise elements[0].block.fail("PID", words, elements[0].row.line)
            _sort(bodies, model, Body(pid, parts[pid], kind, elements))
    _join_rigid(model, bodies.rigid, bodies.laws)
    for pid, block in parts.items():
        if pid not in by_part and block.name in (*_PARTS, "PART_COMPOSITE", "PART_COMPOSITE_LONG"):
            model.notes.append(f"part {pid} of line {block.line} has no elements")
            block.mark("no effect here", "it has no elements", *_filled(block))
    if not bodies.plates and not model.problems:
        raise NoPlateError(
            f"{model.blocks[0].file}: no plate; *PART_COMPOSITE with shells is needed"
        )
    _mark_mesh(bodies, model)
    return bodies


def nodes_and_elements(
    model: Model,
) -> tuple[dict[int, Place], dict[int, tuple[str, list[Element]]]]:
    """Places of the nodes, and kind and elements of each part."""
    nodes = _nodes(model)
    return nodes, _elements(model, nodes)


def _filled(block: Block) -> set[str]:
    """Names of the filled fields."""
    return {name for row in block.rows for name in row.values}


def _sort(bodies: Bodies, model: Model, body: Body) -> None:
    """Put a part where it belongs."""
    block = body.block
    block.mark(TAKEN, "", "TITLE")
    block.mark(REPLACED, "numbered anew", "PID", "MID", "SECID")
    if block.name in _PARTS:
        body.material = block.whole("MID")
    law = bodies.laws[body.material].name if body.material in bodies.laws else ""
    if block.name.startswith("PART_COMPOSITE"):
        if (body.kind == "tshell") != (block.name == "PART_COMPOSITE_TSHELL"):
            raise block.fail("PID", f"part {body.pid} has elements of kind {body.kind}")
        body.reference = block.number("NLOC", 0.0) if body.kind == "shell" else 0.0
        body.plies = part_plies(block)
        if body.kind == "shell" and not block.label:
            check_shells(block)
            _note_single(model, body)
        block.lose_filled("shells have no mass of their own", "MAREA")
    elif law == "MAT_RIGID":
        bodies.rigid.append(body)
        return
    elif law in COHESIVE:
        if body.kind != "solid":
            raise block.fail(
                "MID", f"*{law} between shells: cohesive layers of bricks are translated"
            )
        bodies.cohesive.append(body)
        return
    elif law in PLIES:
        body.plies, body.reference = section_plies(model, block, body.kind, body.material)
    else:
        raise block.fail("MID", f"part {body.pid} is {_why_not(bodies, model, body.material)}")
    for each in with_options(body):
        _check_laws(bodies, model, each)
        bodies.plates.append(each)


def _note_single(model: Model, body: Body) -> None:
    """Tell of a part of one ply, which has one point through its thickness in LS-DYNA."""
    if len(body.plies) == 1:
        words = "has one ply, whose single point does not bend in LS-DYNA; here it bends"
        model.notes.append(f"part {body.pid} of line {body.block.line} {words}")


def _check_laws(bodies: Bodies, model: Model, body: Body) -> None:
    """Refuse plies of a material that is not there, or of a law that is not translated."""
    name = "MID" if body.block.name in (*_PARTS, "PART_COMPOSITE_LONG") else "MID1"
    for ply in body.plies:
        if ply.material not in bodies.laws or bodies.laws[ply.material].name not in PLIES:
            words = f"a ply of part {body.pid} is {_why_not(bodies, model, ply.material)}"
            raise body.block.fail(name, words, body.block.line_of(name))
        _check_angles(body, bodies.laws[ply.material])


def _check_angles(body: Body, law: Block) -> None:
    """Refuse an angle of elements where the axes of their law have one, too."""
    turned = next((each for each in body.elements if each.row.number("BETA")), None)
    name = angle_name(law)
    has_both = turned and law.name not in ISOTROPIC and law.raw(name, 0.0)
    if turned and has_both and law.raw("AOPT", 0.0) in (0.0, 3.0):
        words = f"it overrides {name} of {law.title}, line {law.line}: give one of both"
        raise turned.block.fail("BETA", words, turned.row.line)


def _why_not(bodies: Bodies, model: Model, mid: int) -> str:
    """Why a part is none of what is translated."""
    for block in model.blocks:
        if block.name.startswith("MAT_"):
            first = [row.values.get(f"card {n} field 1") for n, row in enumerate(block.rows, 1)]
            if bodies.laws.get(mid) is block or f"{mid}" in first[:2]:
                words = "no law that is translated for a ply, a bond or a rigid body"
                return f"of {block.title} (line {block.line}), {words}"
    return f"of material {mid}, which is not there"


def _nodes(model: Model) -> dict[int, Place]:
    """Places of the nodes."""
    nodes: dict[int, Place] = {}
    for block in model.find("NODE"):
        block.mark(TAKEN, "", "X", "Y")
        block.mark(REPLACED, "the plate has one plane, at the middle of its thickness", "Z")
        for row in block.rows:
            with model.gathered():
                nid = row.whole("NID")
                if nid < 1:
                    raise block.fail("NID", "missing", row.line)
                if nid in nodes:
                    raise block.fail("NID", f"node {nid} is defined twice", row.line)
                nodes[nid] = (row.number("X"), row.number("Y"), row.number("Z"))
    return nodes


def _elements(model: Model, nodes: dict[int, Place]) -> dict[int, tuple[str, list[Element]]]:
    """Kind and elements of each part."""
    found: dict[int, tuple[str, list[Element]]] = {}
    seen: set[tuple[str, int]] = set()
    for block in model.blocks:
        if block.name in _KINDS or block.name.startswith("ELEMENT_SHELL"):
            if block.rows and "PID" not in {n for row in block.rows for n in row.values}:
                continue  # an option that is not known, told elsewhere
            kind = _KINDS.get(block.name, "shell")
            for row in block.rows:
                with model.gathered():
                    element = _element(block, row, kind, nodes)
                    if (kind, element.number) in seen:
                        words = f"element {element.number} is defined twice"
                        raise block.fail("EID", words, row.line)
                    seen.add((kind, element.number))
                    known, elements = found.setdefault(row.whole("PID"), (kind, []))
                    if known != kind:
                        words = f"part {row.whole('PID')} has elements of two kinds"
                        raise block.fail("PID", words, row.line)
                    elements.append(element)
    return found


def _element(block: Block, row: Row, kind: str, nodes: dict[int, Place]) -> Element:
    """An element."""
    names = [f"N{n}" for n in range(1, 5 if kind == "shell" else 9)]
    ids = [row.whole(name) for name in names]
    if kind == "shell" and not ids[3]:
        ids[3] = ids[2]
    if kind == "solid" and ids[3] and (row.whole("N9") or not ids[4]):
        ids[4:] = ids[3:4] * 4  # a tetrahedron of ten nodes, or of four in their format
    for name, nid in zip(("PID", *names), (row.whole("PID"), *ids), strict=True):
        if not nid:
            raise block.fail(name, "missing", row.line)
        if name != "PID" and nid not in nodes:
            raise block.fail(name, f"there is no node {nid}", row.line)
    if kind == "solid" and len(set(ids)) == 4 and ids[3] == ids[7]:
        ids = [*ids[:3], ids[2], *ids[3:4] * 4]  # a tetrahedron: a brick whose top is one node
    return Element(row.whole("EID"), tuple(ids), block, row)


def _join_rigid(model: Model, rigid: list[Body], laws: Mapping[int, Block]) -> None:
    """Give the elements of parts to the part that they follow; its keywords hold for all."""
    for block in model.find("CONSTRAINED_RIGID_BODIES"):
        block.mark(TAKEN, "one body", "PIDM", "PIDS")
        for row in block.rows:
            with model.gathered():
                pair = []
                for name in ("PIDM", "PIDS"):
                    pid = row.whole(name)
                    found = next((body for body in rigid if body.pid == pid), None)
                    if found is None:
                        raise block.fail(name, f"there is no rigid part {pid}", row.line)
                    pair.append(found)
                first, other = pair
                if first is other or first.kind != other.kind:
                    words = "one part, or parts of shells and of bricks: not translated"
                    raise block.fail("PIDS", words, row.line)
                _join(first, other, laws)
                rigid.remove(other)


def _join(first: Body, other: Body, laws: Mapping[int, Block]) -> None:
    """Give a part the elements of another one."""
    first.shares = (first.shares or [replace(first)]) + (other.shares or [replace(other)])
    first.elements = first.elements + other.elements
    law = laws[other.material]
    if law is not laws[first.material]:
        law.mark(IDLE, _OF_FIRST, "MID", "RO", "CMO", "CON1", "CON2")
    if other.block.name.startswith("PART_INERTIA"):
        other.block.lose_filled("a velocity of a part that follows another", "VTX", "VTY", "VTZ")
        other.block.mark(IDLE, _OF_FIRST, "TM", "VRX", "VRY", "VRZ")


def _mark_mesh(bodies: Bodies, model: Model) -> None:
    """Tell what becomes of nodes and elements, by the bodies that they are of."""
    kinds = (
        (bodies.plates, "quads of nine nodes, for those of four are too stiff in bending"),
        (bodies.cohesive, "*INTERFACE_COHESIVE between plies"),
        (bodies.rigid, "an impactor or a fixture"),
    )
    for block in _element_blocks(bodies):
        pids = {row.values.get("PID") for row in block.rows}
        words = [text for some, text in kinds if pids & {body.pid for body in some}]
        block.mark(REPLACED, "; ".join(words), "EID", "PID", *(f"N{n}" for n in range(1, 11)))
    plate = {nid for body in bodies.plates for nid in body.nodes}
    for block in model.find("NODE"):
        ids = {row.values.get("NID") for row in block.rows}
        columns = "columns of points through the thickness, numbered as in the lowest layer"
        if not ids & plate:
            block.mark(REPLACED, "a rigid body or an interface", "NID", "X", "Y", "Z")
        else:
            block.mark(REPLACED, columns, "NID")


def _element_blocks(bodies: Bodies) -> Iterator[Block]:
    """Keywords of elements that are of some body."""
    seen: set[int] = set()
    for body in (*bodies.plates, *bodies.rigid, *bodies.cohesive):
        for element in body.elements:
            if id(element.block) not in seen:
                seen.add(id(element.block))
                yield element.block
