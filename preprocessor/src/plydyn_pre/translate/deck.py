"""The deck of a translation."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import isnan

from plydyn_pre.deck.cards import Card, coordinate_text, id_cards, keyword, title_line, titled
from plydyn_pre.deck.conditions import set_card
from plydyn_pre.deck.materials import material_text
from plydyn_pre.translate.impactor import Sphere
from plydyn_pre.translate.joints import Joint
from plydyn_pre.translate.plies import DAMAGED, axis_angle, ply_material
from plydyn_pre.translate.reader import REPLACED, Block
from plydyn_pre.translate.stack import Stack

_CODAM2_CARDS = (
    "MID RO EA EB UNUSED1 PRBA UNUSED2 PRCB",
    "GAB UNUSED3 UNUSED4 NLAYER R1 R2 NFREQ",
    "XP YP ZP A1 A2 A3 AOPT",
    "V1 V2 V3 D1 D2 D3 BETA MACF",
    "ANGLE1",
    "IMATT IFIBT ILOCT IDELT SMATT SFIBT SLOCT SDELT",
    "IMATC IFIBC ILOCC IDELC SMATC SFIBC SLOCC SDELC",
)
_WHOLE = {"MID", "NLAYER", "MACF"}


@dataclass
class Plate:
    """All that a deck is written from."""

    blocks: list[Block]
    known: dict[int, Block]
    stack: Stack
    joints: list[Joint]
    sphere: Sphere | None
    like: str
    notes: list[str]
    supports: list[tuple[str, list[int], tuple[int, int, int]]] = field(default_factory=list)
    history: list[int] = field(default_factory=list)
    friction: tuple[float, float, float] = (0.0, 0.0, 0.0)  # static, dynamic, decay
    control: list[str] = field(default_factory=list)


def deck_lines(plate: Plate) -> Iterator[str]:
    """The keywords of the deck."""
    yield "*KEYWORD"
    yield from plate.control
    yield from _laminate(plate)
    yield from _impactor(plate)
    yield from _supports(plate)
    yield from _mesh(plate)
    yield "*END"


def _laminate(plate: Plate) -> Iterator[str]:
    """The plies, their materials and what joins them."""
    numbers: dict[int, int] = {}
    turns: dict[int, float] = {}
    rows, texts = [], []
    for ply in (ply for layer in plate.stack.layers for ply in layer.body.plies):
        if ply.material not in numbers:
            numbers[ply.material] = len(numbers) + 1
            texts.append(_material(plate, ply.material, numbers[ply.material], turns))
        angle = 180.0 - (180.0 - ply.angle - turns[ply.material]) % 360.0
        place = {"tmid": 0, "plyid": len(rows) + 1, "shrfac": 0.0}
        card = {"mid": numbers[ply.material], "thick": ply.thickness, "b": angle or 0.0}
        rows.append(card | place)
    head = {"pid": 1, "elform": 0, "shrf": 1.0, "nloc": 0, "marea": 0.0}
    head |= {"hgid": 0, "adpopt": 0, "thshel": 0}
    yield keyword("PART_COMPOSITE_LONG", title_line("plate"), head, *rows)
    yield from texts
    laws: list[object] = []
    for joint in plate.joints:
        if joint.law is not None and joint.law not in laws:
            laws.append(joint.law)
            mid = len(numbers) + len(laws)
            yield material_text(joint.law, f"interface {joint.interface}", mid, lambda _: 0)
    cards = [
        {"pid": 1, "ifac1": joint.interface, "ifac2": joint.interface}
        | {"mid": len(numbers) + laws.index(joint.law) + 1 if joint.law else -1, "nq": 0}
        for joint in plate.joints
    ]
    if cards:
        yield keyword("INTERFACE_COHESIVE", *cards)


def _material(plate: Plate, mid: int, number: int, turns: dict[int, float]) -> str:
    """The keyword of a ply material; its axis angle goes to the plies."""
    if mid not in plate.known:
        block = plate.stack.layers[0].body.block
        known = f"*MAT_ELASTIC, *MAT_CODAM2, *{', *'.join(DAMAGED)}"
        raise block.fail("MID1", f"there is no material {mid} that is translated: {known}")
    block = plate.known[mid]
    by_element = isnan(plate.stack.first_edge) and block.raw("AOPT", 0.0) == 0.0
    if by_element and block.name not in ("MAT_ELASTIC", "MAT_CODAM2"):
        words = "0: the axes of the elements, which differ from element to element"
        raise block.fail("AOPT", f"{words}; give 2 with the vector A")
    edge = 0.0 if isnan(plate.stack.first_edge) else plate.stack.first_edge
    turns[mid] = axis_angle(block, edge)
    if block.name == "MAT_CODAM2":
        return _codam2(block, number)
    return material_text(ply_material(block, plate.like), f"material {mid}", number, lambda _: 0)


def _codam2(block: Block, number: int) -> str:
    """A material that plydyn reads as it stands, with its axes along x and y."""
    if block.raw("AOPT", 0.0) not in (0.0, 2.0):
        raise block.fail("AOPT", f"{block.raw('AOPT'):g} is not translated; 0 and 2 are")
    own = {"MID": number, "AOPT": 2.0}
    if block.raw("AOPT", 0.0) == 0.0:
        own |= {"A1": 1.0, "A2": 0.0, "A3": 0.0, "D1": 0.0, "D2": 1.0, "D3": 0.0}
        block.mark(REPLACED, "2, with the axes x and y", "AOPT")
    cards = []
    for names in _CODAM2_CARDS:
        card = {}
        for name in names.split():
            value = own.get(name, block.number(name, 0.0))
            card[name.lower()] = int(value) if name in _WHOLE else float(value)
        cards.append(card)
    return keyword("MAT_CODAM2", *cards)


def _impactor(plate: Plate) -> Iterator[str]:
    """The impactor and its contact."""
    sphere = plate.sphere
    if sphere is None:
        return
    x, y, z = sphere.centre
    place = {"iid": 1, "radius": sphere.radius, "mass": sphere.mass, "xc": x, "yc": y, "zc": z}
    motion = dict(zip(("vx", "vy", "vz"), map(float, sphere.velocity), strict=True))
    freedom = {"dof": sphere.freedom, "gravz": 0.0, "shape": 0}
    yield titled("IMPACTOR_SPHERE", "impactor", place, motion | freedom)
    pair = {"cid": 1, "iid": 1, "pid": 1, "face": 1 if sphere.above else -1}
    cards: list[Card] = [pair | {"method": 2, "spacing": 0.0}]
    if plate.friction[0] > 0.0:
        cards.append(dict(zip(("fs", "fd", "dc"), plate.friction, strict=True)))
    yield keyword("CONTACT_IMPACTOR", *cards)


def _supports(plate: Plate) -> Iterator[str]:
    """Held nodes, and those with a history."""
    for sid, (title, ids, held) in enumerate(plate.supports, start=1):
        yield titled("SET_NODE_LIST", title, set_card(sid), *id_cards(ids))
        axes = dict(zip(("dofx", "dofy", "dofz"), held, strict=True))
        turns = {"dofrx": 0, "dofry": 0, "dofrz": 0}
        yield keyword("BOUNDARY_SPC_SET", {"nsid": sid, "cid": 0} | axes | turns)
    if plate.history:
        yield keyword("DATABASE_HISTORY_NODE", *id_cards(plate.history))


def _mesh(plate: Plate) -> Iterator[str]:
    """Nodes and quads."""
    stack = plate.stack
    yield "*NODE"
    z = f"{coordinate_text(stack.middle):>16}{0:8d}{0:8d}"
    for nid, (x, y) in sorted(stack.places.items()):
        yield f"{nid:8d}{coordinate_text(x):>16}{coordinate_text(y):>16}{z}"
    yield "*ELEMENT_PLATE_Q9"
    for eid, quad in enumerate(stack.quads, start=1):
        yield f"{eid:8d}{1:8d}"
        yield "".join(f"{nid:8d}" for nid in quad)
