"""Sections of an Abaqus file as parts with their elements."""

from __future__ import annotations

from plydyn_pre.translate.abaqus.lines import Keyword
from plydyn_pre.translate.abaqus.materials import Materials
from plydyn_pre.translate.abaqus.mesh import Element, Mesh
from plydyn_pre.translate.block import Row, Value
from plydyn_pre.translate.numbers import number_of

_SECTIONS = ("SHELL SECTION", "SOLID SECTION", "COHESIVE SECTION")
_ELEMENTS = {"shell": "ELEMENT_SHELL", "tshell": "ELEMENT_TSHELL"}
#: What messages call fields of the model
_NAMES = {"MID1": "material", "THICK1": "thickness", "B1": "angle", "MID": "MATERIAL"}
_NAMES |= {"PID": "ELSET", "N1": "node 1", "N4": "node 4", "N5": "node 5"}
#: OFFSET by its names, of the thickness
_OFFSETS = {"SPOS": 0.5, "SNEG": -0.5}

#: Kinds of elements by their section
_OF = {
    "SHELL SECTION": ("shell", "tshell"),
    "SOLID SECTION": ("solid",),
    "COHESIVE SECTION": ("cohesive",),
}

Card = dict[str, Value]


def put_parts(mesh: Mesh, materials: Materials, rigid: set[int]) -> dict[int, int]:
    """Add the parts of all sections but those of rigid elements; the part of each element."""
    part_of: dict[int, int] = {}
    for keyword in mesh.each(*_SECTIONS):
        with mesh.source.gathered():
            ids = mesh.element_ids(keyword, keyword.option("ELSET"), keyword.block.line)
            members = [mesh.elements[eid] for eid in ids if eid not in rigid]
            if not members:
                continue
            if doubled := [element for element in members if element.number in part_of]:
                words = f"element {doubled[0].number} is in two sections"
                raise keyword.fail("ELSET", words)
            pid = mesh.source.number("PART", (keyword.space, keyword.block))
            part_of |= {element.number: pid for element in members}
            _part(mesh, materials, keyword, members, pid)
    for element in mesh.elements.values():
        if element.number not in part_of and element.number not in rigid:
            _homeless(element)
    return part_of


def _homeless(element: Element) -> None:
    """Refuse an element without a section, once for each keyword."""
    block = element.keyword.block
    if element.kind != "point" and not block.losses:
        words = f"element {element.number} has no section and is of no rigid body"
        block.lose(words, line=element.line)


def _part(
    mesh: Mesh, materials: Materials, keyword: Keyword, members: list[Element], pid: int
) -> None:
    """Add a part with its elements."""
    kinds = {element.kind for element in members}
    if len(kinds) > 1:
        raise keyword.fail("ELSET", "it has elements of several kinds")
    kind = kinds.pop()
    if kind not in _OF[keyword.name]:
        raise keyword.fail("ELSET", f"its elements are of kind {kind}")
    if kind in ("tshell", "cohesive"):
        keyword.kind("STACK DIRECTION", "3", "3")
    put = mesh.source.put
    if kind == "cohesive":
        bond = {"PID": pid, "MID": _bond(mesh, materials, keyword, members)}
        put("PART", keyword.block, bond, names=_NAMES)
    elif kind == "solid":
        _solid(mesh, materials, keyword, pid)
    else:
        name = "PART_COMPOSITE" if kind == "shell" else "PART_COMPOSITE_TSHELL"
        rows = _plies(materials, keyword)
        card: Card = {"PID": pid}
        if kind == "shell":
            card["NLOC"] = 2.0 * _offset(keyword)
        put(name, keyword.block, card, *rows, names=_NAMES)
    put_elements(mesh, members, pid)


def put_elements(mesh: Mesh, members: list[Element], pid: int) -> None:
    """Add elements of a part, one keyword for each of the file."""
    rows: dict[int, list[Element]] = {}
    for element in members:
        rows.setdefault(id(element.keyword), []).append(element)
    for group in rows.values():
        name = _ELEMENTS.get(group[0].kind, "ELEMENT_SOLID")
        block = mesh.source.put(name, group[0].keyword.block, names=_NAMES)
        for element in group:
            nodes = (*element.corners(), *element.middles)
            card: Card = {f"N{n}": nid for n, nid in enumerate(nodes, start=1)}
            block.rows.append(Row(element.line, {"EID": element.number, "PID": pid} | card))


def _plies(materials: Materials, keyword: Keyword) -> list[Row]:
    """The plies of a shell section."""
    orientation = keyword.options.get("ORIENTATION", "")
    rows = []
    if "COMPOSITE" not in keyword.options:
        line, words = keyword.data[0] if keyword.data else (keyword.block.line, [""])
        thickness = keyword.numbers("thickness", words[:1], line)[0]
        mid = materials.ply(keyword, keyword.option("MATERIAL"), orientation, line)
        return [Row(line, {"MID1": mid, "THICK1": thickness})]
    for line, words in keyword.data:
        thick, _, name, turn, *_ = (*words, "", "", "", "")
        angle = number_of(turn) if turn else 0.0
        axis = orientation if angle is not None else turn
        mid = materials.ply(keyword, name, axis, line)
        size = keyword.numbers("thickness", [thick], line)[0]
        rows.append(Row(line, {"MID1": mid, "THICK1": size, "B1": angle or 0.0}))
    return rows + rows[::-1] if "SYMMETRIC" in keyword.options else rows


def _offset(keyword: Keyword) -> float:
    """Where the nodes are, from the middle, as a share of the thickness."""
    word = keyword.options.get("OFFSET", "0").upper()
    if word in _OFFSETS:
        return _OFFSETS[word]
    return keyword.numbers("OFFSET", [word], keyword.block.line)[0]


def _solid(mesh: Mesh, materials: Materials, keyword: Keyword, pid: int) -> None:
    """Add a part of bricks."""
    if "COMPOSITE" in keyword.options:
        words = "plies inside a brick are not translated: one brick or more a ply, or SC8R, is"
        raise keyword.fail("COMPOSITE", words)
    name, orientation = keyword.option("MATERIAL"), keyword.options.get("ORIENTATION", "")
    mid = materials.ply(keyword, name, orientation, keyword.block.line)
    mesh.source.put("PART", keyword.block, {"PID": pid, "MID": mid}, names=_NAMES)


def _bond(mesh: Mesh, materials: Materials, keyword: Keyword, members: list[Element]) -> int:
    """The law of a cohesive layer."""
    keyword.kind("RESPONSE", "", "TRACTION SEPARATION")
    line, words = keyword.data[0] if keyword.data else (keyword.block.line, [])
    kind = keyword.kind("THICKNESS", "SPECIFIED", "SPECIFIED", "GEOMETRY")
    thickness = keyword.numbers("thickness", words[:1] or ["1"], line)[0] or 1.0
    if kind == "GEOMETRY":
        corners = members[0].corners()
        thickness = abs(mesh.nodes[corners[4]][2] - mesh.nodes[corners[0]][2])
        if thickness <= 0.0:
            raise keyword.fail("THICKNESS", "GEOMETRY of elements without a thickness", line)
    return materials.bond(keyword, keyword.option("MATERIAL"), thickness, line)
