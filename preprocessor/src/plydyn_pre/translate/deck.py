"""The deck of a translation."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from plydyn_pre.deck.cards import Card, coordinate_text, id_cards, keyword, title_line, titled
from plydyn_pre.deck.conditions import curve_text, set_card
from plydyn_pre.deck.materials import material_text
from plydyn_pre.keywords import Card as SolverCard
from plydyn_pre.keywords import keywords
from plydyn_pre.study import PlyCodam2
from plydyn_pre.study.materials import Material
from plydyn_pre.translate.block import IDLE, REPLACED, TAKEN, Block, Value
from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.joints import Joint
from plydyn_pre.translate.laws import METALS
from plydyn_pre.translate.loads import Force, Gravity, Pressure
from plydyn_pre.translate.model import Model, Place
from plydyn_pre.translate.plies import Like, axis_angle, ply_material
from plydyn_pre.translate.rigid import Rigid
from plydyn_pre.translate.shears import shear_points
from plydyn_pre.translate.stack import Stack, Zone
from plydyn_pre.translate.supports import Support

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
_AXES = {"XP", "YP", "ZP", "A3", "V1", "V2", "V3", "D1", "D3", "BETA", "A2", "MACF"}
_ELFORM = {"elform": 0, "shrf": 1.0, "nloc": 0, "marea": 0.0, "hgid": 0, "adpopt": 0}
#: What asks for an effect of the rate: of MAT_024 and of MAT_098
_RATES = {"MAT_PIECEWISE_LINEAR_PLASTICITY": "P", "MAT_SIMPLIFIED_JOHNSON_COOK": "C"}
#: Law, thickness and angle of a ply
PlyRow = tuple[int, float, float]


@dataclass(frozen=True)
class Plate:
    """All that a deck is written from."""

    model: Model
    bodies: Bodies
    stack: Stack
    joints: list[Joint]
    rigid: list[Rigid]
    supports: list[Support]
    forces: list[Force]
    pressures: list[Pressure]
    gravity: list[Gravity]
    velocities: dict[Place, list[int]]  # nodes of the plane by their velocity
    history: list[int]
    like: Like
    made: dict[int, Material] = field(default_factory=dict)  # laws of plies by their numbers
    laminates: list[tuple[PlyRow, ...]] = field(default_factory=list)  # of the parts
    part_of: list[int] = field(default_factory=list)  # of each quad, from 1


class Curves:
    """The curves of a deck: those of the user by their numbers, and others that are made."""

    def __init__(self, model: Model) -> None:
        """Begin behind the numbers of the user."""
        self.model = model
        self.used: dict[int, list[tuple[float, float]]] = {}
        taken = (int(block.raw("LCID", 0)) for block in model.find("DEFINE_CURVE"))
        self.next = max(taken, default=0) + 1

    def own(self, lcid: int) -> int:
        """A curve of the user; 0 stands for one that is always zero."""
        if lcid == 0:
            return self.new([(0.0, 0.0), (1.0, 0.0)])
        block = next(b for b in self.model.find("DEFINE_CURVE") if b.raw("LCID", 0) == lcid)
        self.used[lcid] = self.model.curve(block, lcid)
        return lcid

    def taken(self, block: Block, lcid: int) -> int:
        """A curve of the user that a field names; 0 for none."""
        if lcid:
            self.used[lcid] = self.model.curve(block, lcid, block.line_of("LCSS"))
        return lcid

    def new(self, points: list[tuple[float, float]]) -> int:
        """A curve that is made."""
        for lcid, known in self.used.items():
            if known == points:
                return lcid
        self.used[self.next] = points
        self.next += 1
        return self.next - 1

    def lines(self) -> Iterator[str]:
        """Their keywords."""
        for lcid, points in sorted(self.used.items()):
            yield curve_text(f"curve {lcid}", lcid, points)


def laminate_lines(plate: Plate, curves: Curves) -> Iterator[str]:
    """The plies of each part, their materials and what joins them."""
    numbers: dict[int, int] = {}
    texts: list[str] = []
    for layer in plate.stack.layers:
        for ply in (ply for zone in layer.zones for ply in zone.plies):
            with plate.model.gathered():
                if ply.material not in numbers:
                    numbers[ply.material] = len(numbers) + 1
                    block = plate.bodies.laws[ply.material]
                    texts.append(_material(plate, block, numbers[ply.material], curves))
    _divide(plate)
    many = len(plate.laminates) > 1
    for pid, plies in enumerate(plate.laminates, start=1):
        rows: list[Card] = [
            {"mid": numbers[mid], "thick": thickness, "b": angle, "tmid": 0, "plyid": n}
            | {"shrfac": 0.0}
            for n, (mid, thickness, angle) in enumerate(plies, start=1)
        ]
        title = title_line(f"plate {pid}" if many else "plate")
        yield keyword("PART_COMPOSITE_LONG", title, {"pid": pid, **_ELFORM, "thshel": 0}, *rows)
    yield from texts
    yield from _joint_lines(plate, len(numbers))


def _divide(plate: Plate) -> None:
    """Give each quad a part by its plies."""
    stack, seen = plate.stack, dict[tuple[int, ...], int]()
    for zones in stack.zones:
        if zones not in seen:
            chosen = [layer.zones[n] for layer, n in zip(stack.layers, zones, strict=True)]
            rows = tuple(row for zone in chosen for row in _rows(plate, zone))
            if rows not in plate.laminates:
                plate.laminates.append(rows)
            seen[zones] = plate.laminates.index(rows) + 1
        plate.part_of.append(seen[zones])


def _rows(plate: Plate, zone: Zone) -> Iterator[PlyRow]:
    """The plies of a zone with their angles from x."""
    for ply in zone.plies:
        with plate.model.gathered():
            block = plate.bodies.laws[ply.material]
            base = axis_angle(plate.model, block, zone)
            angle = round(90.0 - (90.0 - zone.angle(base, ply)) % 180.0, 9)
            yield ply.material, ply.thickness, angle or 0.0


def _joint_lines(plate: Plate, count: int) -> Iterator[str]:
    """The laws of interfaces, and where they are."""
    laws: list[object] = []
    for joint in plate.joints:
        if joint.law is not None and joint.law not in laws:
            laws.append(joint.law)
            mid = count + len(laws)
            yield material_text(joint.law, f"interface {joint.interface}", mid, lambda _: 0)
    cards: list[Card] = []
    for pid in range(1, len(plate.laminates) + 1):
        for joint in plate.joints:
            mid = count + laws.index(joint.law) + 1 if joint.law else -1
            place = {"pid": pid, "ifac1": joint.interface, "ifac2": joint.interface}
            rub = {"close": 0, "fric": joint.friction} if joint.friction else {}
            cards.append({**place, "mid": mid, "nq": 0, **rub})
    if cards:
        yield keyword("INTERFACE_COHESIVE", *cards)


def _material(plate: Plate, block: Block, number: int, curves: Curves) -> str:
    """The keyword of a ply material, with its axes along x and y."""
    if block.name in METALS:
        return _metal_text(block, number, lambda lcid: curves.taken(block, lcid))
    if block.name != "MAT_CODAM2":
        mid = int(block.raw("MID"))
        made = plate.made[mid] = ply_material(plate.model, block, plate.like)
        points = shear_points(plate.model, block)
        lcid = curves.new(points) if isinstance(made, PlyCodam2) and made.shear_curve else 0
        return material_text(made, f"material {mid}", number, lambda _: lcid)
    if block.raw("AOPT", 0.0) not in (0.0, 2.0):
        raise block.fail("AOPT", f"{block.raw('AOPT'):g} is not translated; 0 and 2 are")
    block.mark(REPLACED, "2, with the axes x and y", "AOPT", "A1", "A2", "D1", "D2")
    block.mark(REPLACED, "numbered anew", "MID")
    block.lose_filled("one layer is translated", *(f"ANGLE{n}" for n in range(2, 9)))
    own = {"MID": number, "AOPT": 2.0, "A1": 1.0, "D2": 1.0} | dict.fromkeys(_AXES, 0.0)
    cards = []
    for names in _CODAM2_CARDS:
        card = {}
        for name in names.split():
            value = own[name] if name in own else block.number(name, 0.0)
            card[name.lower()] = int(value) if name in _WHOLE else float(value)
        cards.append(card)
    return keyword("MAT_CODAM2", *cards)


def _metal_text(block: Block, number: int, curve: Callable[[int], int]) -> str:
    """The keyword of a metal with the number of its material and of its curve."""
    if block.raw(_RATES[block.name], 0.0) and block.raw("VP", 0.0) != 1.0:
        words = "0 with an effect of the rate is that of the whole strain, which is not"
        block.lose(f"{words} translated; 1 is that of plastic strain", "VP")
    own: dict[str, Value] = {"MID": number, "VP": float(block.raw("VP", 0.0))}
    if block.has("LCSS"):
        own["LCSS"] = curve(int(block.raw("LCSS")))
    cards = [_metal_card(block, card, own) for card in keywords()[block.name].cards]
    while not any(cards[-1].values()):
        cards.pop()
    return keyword(block.name, *cards)


def _metal_card(block: Block, card: SolverCard, own: dict[str, Value]) -> dict[str, Value]:
    """The values of a card; fields that the solver has not are zero, or told as lost."""
    found: dict[str, Value] = {}
    for one in card.fields:
        value = block.raw(one.name, 0.0)
        if one.supported:
            block.mark(TAKEN, "", one.name) if one.name not in block.fates else None
            found[one.name.lower()] = own.get(one.name, value)
            continue
        found[one.name.lower()] = 0.0
        if value in one.allowed:
            block.mark(IDLE, "it stands for none", one.name)
        elif value:
            words = "no metal is deleted" if "FAIL" in one.name else f"{value} is not translated"
            block.lose(words, one.name, line=block.line_of(one.name))
    return found


def condition_lines(plate: Plate, curves: Curves) -> Iterator[str]:
    """Held and moved nodes, loads, velocities, and nodes with a history."""
    yield from _supports(plate, curves)
    yield from _loads(plate, curves)
    for sid, (velocity, ids) in enumerate(plate.velocities.items(), start=len(plate.supports) + 1):
        yield titled("SET_NODE_LIST", "nodes that move", set_card(sid), *id_cards(ids))
        others = dict.fromkeys(("nsidex", "boxid", "irigid", "icid"), 0)
        motion = dict(zip(("vx", "vy", "vz"), velocity, strict=True))
        yield keyword("INITIAL_VELOCITY", {"nsid": sid} | others, motion)
    if plate.history:
        yield keyword("DATABASE_HISTORY_NODE", *id_cards(plate.history))


def _supports(plate: Plate, curves: Curves) -> Iterator[str]:
    """Held and moved nodes."""
    for sid, support in enumerate(plate.supports, start=1):
        yield titled("SET_NODE_LIST", support.title, set_card(sid), *id_cards(support.ids))
        if support.lcid < 0:
            held = {f"dof{axis}": int(axis in support.held) for axis in "xyz"}
            if support.height is not None:
                place = {"nsid": sid, "face": 0, "z": support.height - plate.stack.middle}
                yield keyword("BOUNDARY_FACE", {**place, **held})
                continue
            turns = {"dofrx": 0, "dofry": 0, "dofrz": 0}
            yield keyword("BOUNDARY_SPC_SET", {"nsid": sid, "cid": 0} | held | turns)
            continue
        card = {"nsid": sid, "dof": "xyz".index(support.held) + 1, "vad": support.quantity}
        motion = {"lcid": curves.own(support.lcid), "sf": support.factor, "vid": 0}
        times = {"death": support.death, "birth": support.birth}
        yield keyword("BOUNDARY_PRESCRIBED_MOTION_SET", {**card, **motion, **times})


def _loads(plate: Plate, curves: Curves) -> Iterator[str]:
    """Forces, pressures and gravity."""
    rows = [
        {"nid": nid, "dof": force.dof, "lcid": curves.own(force.lcid), "sf": force.factor}
        for force in plate.forces
        for nid in force.ids
    ]
    if rows:
        yield keyword("LOAD_NODE_POINT", *rows)
    for ssid, load in enumerate(plate.pressures, start=1):
        yield titled("SET_SHELL_LIST", "pressed", set_card(ssid), *id_cards(load.quads))
        card = {"ssid": ssid, "face": load.face, "lcid": curves.own(load.lcid), "sf": load.factor}
        yield keyword("LOAD_FACE_PRESSURE", card)
    for each in plate.gravity:
        card = {"lcid": curves.own(each.lcid), "sf": each.factor}
        yield keyword(f"LOAD_BODY_{each.axis.upper()}", card)


def mesh_lines(plate: Plate) -> Iterator[str]:
    """Nodes and quads."""
    stack = plate.stack
    yield "*NODE"
    z = f"{coordinate_text(stack.middle):>16}{0:8d}{0:8d}"
    for nid, (x, y) in sorted(stack.places.items()):
        yield f"{nid:8d}{coordinate_text(x):>16}{coordinate_text(y):>16}{z}"
    yield "*ELEMENT_PLATE_Q9"
    for eid, (quad, pid) in enumerate(zip(stack.quads, plate.part_of, strict=True), start=1):
        yield f"{eid:8d}{pid:8d}"
        yield "".join(f"{nid:8d}" for nid in quad)
