"""Keywords of the impactor, supports, loads, curves and sets."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from plydyn_pre.deck.cards import Card, id_cards, keyword, titled
from plydyn_pre.deck.names import Names
from plydyn_pre.errors import RecipeError
from plydyn_pre.mesh.grid import Integers
from plydyn_pre.study import (
    Contact,
    Force,
    FrameAcceleration,
    Impactor,
    InitialVelocity,
    Laminate,
    Lever,
    LineForce,
    Load,
    Motion,
    Pressure,
    Support,
)

_FACES = {"bottom": -1, "plane": 0, "top": 1, "all": 2}
DIRECTIONS = {"x": 1, "y": 2, "z": 3}
QUANTITIES = {"velocity": 0, "acceleration": 1, "displacement": 2}
_METHODS = {"nodes_on_impactor": 1, "points_on_plate": 2}
# share of the size of the mesh by which the lines of a lever may be no copies of each other
_APART = 1.0e-6
#: Constraints of the lever that is load n have numbers above n times this
_NUMBERS = 100_000


def impactor_keywords(names: Names, number: int = 1) -> Iterator[str]:
    """The impactor of a number and its contact."""
    if names.study.impactor is None:
        return
    given = names.study.touch.part
    if names.study.parts and not given:
        # parts of the recipe have one thickness: the impactor may meet any of them
        part, pid = next(iter(names.parts)), 0
    else:
        part = names.part(given, "contact.part")
        pid = names.parts[part]
    yield from impactor_on(names, names.study.laminate_of(part), pid, number)


def impactor_on(names: Names, laminate: Laminate, pid: int, number: int = 1) -> Iterator[str]:
    """The impactor and its contact with a part."""
    impactor, contact = names.study.impactor, names.study.touch
    if impactor is None:
        return
    yield _impactor(names, impactor, _height(impactor, contact, laminate), number)
    face, method = _FACES[contact.face], _METHODS[contact.method]
    pair = {"cid": number, "iid": number, "pid": pid, "face": face, "method": method}
    cards = [pair | {"spacing": contact.spacing}]
    if contact.friction > 0.0 or contact.dynamic_friction > 0.0:
        rub = {"fs": contact.friction, "fd": contact.dynamic_friction, "dc": contact.decay}
        cards.append(rub)
    yield keyword("CONTACT_IMPACTOR", *cards)


def _impactor(names: Names, impactor: Impactor, height: float, number: int) -> str:
    """The keyword of an impactor whose centre is at a height above the nodes."""
    x, y = impactor.position or names.mesh.middle
    place = {"iid": number, "radius": impactor.radius, "mass": impactor.mass * names.study.share}
    place |= {"xc": x, "yc": y, "zc": height + names.mesh.height}
    motion = dict(zip(("vx", "vy", "vz"), map(float, impactor.start), strict=True))
    motion |= {"dof": int(impactor.guided), "gravz": impactor.gravity}
    weight = {"gravx": 0.0, "gravy": 0.0}
    if impactor.kind == "sphere":
        cards: list[Card] = [place, motion | {"shape": int(impactor.hemisphere)}]
        weight = {"inertia": 0.0, **weight}
    else:
        cards = [place, _shape(impactor), motion]
    if impactor.motion_z:
        curves = {"lcx": 0, "lcy": 0, "lcz": names.curve(impactor.motion_z)}
        cards.append({**weight, **curves, "vad": QUANTITIES[impactor.motion]})
    return titled(f"IMPACTOR_{impactor.kind.upper()}", impactor.title, *cards)


def _shape(impactor: Impactor) -> Card:
    """The card with the sizes of a body that is no sphere."""
    sizes = {"tup": ("length",), "cylinder": ("length", "edge"), "cone": ("angle", "tip", "length")}
    axis = zip(("ax", "ay", "az"), impactor.axis or (), strict=bool(impactor.axis))
    return {key: getattr(impactor, key) for key in sizes[impactor.kind]} | dict(axis)


def support_keywords(names: Names) -> Iterator[str]:
    """What holds the plate."""
    for number, support in enumerate(names.study.held, start=1):
        nsid = names.node_set(support.set, f"supports[{number}].set")
        yield _support(support, nsid)


def load_keywords(names: Names) -> Iterator[str]:
    """What drives the plate."""
    for number, load in enumerate(names.study.loads, start=1):
        if isinstance(load, Lever):
            yield from _lever(names, load, number)
        else:
            yield _load(names, load, f"loads[{number}].set")


def curve_keywords(names: Names) -> Iterator[str]:
    """The curves that are used."""
    for name, lcid in names.curves.items():
        if name:
            curve = names.study.curves[name]
            pairs = list(zip(curve.time, curve.value, strict=True))
        else:
            pairs = [(0.0, 1.0), (names.study.control.end_time, 1.0)]
        yield curve_text(name or "constant", lcid, pairs)


def curve_text(title: str, lcid: int, pairs: Iterable[tuple[float, float]]) -> str:
    """The keyword of a curve."""
    card = {"lcid": lcid, "sfa": 1.0, "sfo": 1.0, "offa": 0.0, "offo": 0.0}
    points = [f"{float(time):>20.12g}{float(value):>20.12g}" for time, value in pairs]
    header = f"$#{'a1':>18}{'o1':>20}"
    return titled("DEFINE_CURVE", title, card, header, *points)


def set_keywords(names: Names) -> Iterator[str]:
    """The sets that are used."""
    for name, sid in names.node_sets.items():
        ids = names.mesh.node_ids[names.nodes_of(name, "")]
        yield titled("SET_NODE_LIST", name, set_card(sid), *id_cards(ids))
    for name, sid in names.quad_sets.items():
        ids = names.mesh.quad_ids[names.quads_of(name, "")]
        yield titled("SET_SHELL_LIST", name, set_card(sid), *id_cards(ids))


def _height(impactor: Impactor, contact: Contact, laminate: Laminate) -> float:
    """Height of the impactor's centre above the nodes at time zero."""
    reach = impactor.gap + impactor.reach
    if contact.face == "top":
        return laminate.bottom + laminate.total + reach
    return laminate.bottom - reach


def _support(support: Support, nsid: int) -> str:
    """The keyword of a support."""
    if support.face == "all":
        return held_set(support, nsid)
    place = {"nsid": nsid, "face": _FACES[support.face], "z": support.height}
    return keyword("BOUNDARY_FACE", {**place, **_held(support)})


def held_set(support: Support, nsid: int) -> str:
    """The keyword of nodes that are held."""
    turns = {"dofrx": 0, "dofry": 0, "dofrz": 0}
    return keyword("BOUNDARY_SPC_SET", {"nsid": nsid, **_held(support), **turns})


def _held(support: Support) -> dict[str, int]:
    """What a support holds."""
    return {f"dof{axis}": int(axis in support.hold) for axis in "xyz"}


def _load(names: Names, load: Load, path: str) -> str:
    """The keyword of a load."""
    match load:
        case Pressure():
            place: Card = {"ssid": names.quad_set(load.set, path), "face": _FACES[load.face]}
            return keyword("LOAD_FACE_PRESSURE", {**place, **_factor(names, load)})
        case Force():
            nodes = names.mesh.node_ids[names.nodes_of(load.set, path)]
            place = {"face": _FACES[load.face], "dof": DIRECTIONS[load.direction]}
            cards = [{"nid": int(nid), **place, **_factor(names, load)} for nid in nodes]
            return keyword("LOAD_FACE_POINT", *cards)
        case LineForce():
            place = {"nsid": names.node_set(load.set, path), "face": _FACES[load.face]}
            place |= {"dof": DIRECTIONS[load.direction]}
            return keyword("LOAD_FACE_LINE", {**place, **_factor(names, load)})
        case FrameAcceleration():
            return frame_acceleration(names, load)
        case Motion():
            place = {"nsid": names.node_set(load.set, path), "face": _FACES[load.face]}
            place |= {"dof": DIRECTIONS[load.direction], "vad": QUANTITIES[load.quantity]}
            return keyword("BOUNDARY_FACE_MOTION", {**place, **_factor(names, load)})
        case InitialVelocity():
            nsid = 0 if load.set == "all" else names.node_set(load.set, path)
            return initial_velocity(load, nsid)
        case Lever():
            raise TypeError("levers have constraints of their own")


def _lever(names: Names, lever: Lever, number: int) -> Iterator[str]:
    """One constraint for each pair of nodes, of the lever that is the so-manieth load."""
    hinges, fulcra, length = _lever_pairs(names, lever, f"loads[{number}]")
    turn = lever.arm / length
    right = {"vad": QUANTITIES[lever.quantity], "lcid": names.written_curve(lever.curve)}
    place = {"face": _FACES[lever.face], "dof": DIRECTIONS[lever.direction]}
    for k, pair in enumerate(zip(hinges, fulcra, strict=True), start=1):
        ids = names.mesh.node_ids[list(pair)]
        rows = [
            {"nid": int(nid), **place, "coef": coefficient}
            for nid, coefficient in zip(ids, (-turn, 1.0 + turn), strict=True)
        ]
        head = {"id": _NUMBERS * number + k, **right, "sf": lever.value}
        yield keyword("CONSTRAINED_FACE_LINEAR", head, *rows)


def _lever_pairs(names: Names, lever: Lever, path: str) -> tuple[Integers, Integers, float]:
    """Nodes at hinge and fulcrum in the same order, and how far these are apart."""
    ends = []
    for key in ("hinge", "fulcrum"):
        nodes = names.nodes_of(getattr(lever, key), f"{path}.{key}")
        x, y = names.mesh.nodes[nodes].T
        ends.append(nodes[np.lexsort((x, y))])
    hinges, fulcra = ends
    if len(hinges) != len(fulcra):
        rule = f"{len(fulcra)} nodes for {len(hinges)} at the hinge; a lever needs as many"
        raise RecipeError(f"{path}.fulcrum", rule)
    between = names.mesh.nodes[fulcra] - names.mesh.nodes[hinges]
    length = float(np.hypot(*between.mean(axis=0)))
    if length <= _APART * names.mesh.size or np.ptp(between, axis=0).max() > _APART * length:
        rule = "its nodes must lie like those of the hinge, some way off"
        raise RecipeError(f"{path}.fulcrum", rule)
    return hinges, fulcra, length


def frame_acceleration(names: Names, load: FrameAcceleration) -> str:
    """The keyword of an accelerated frame."""
    factor = {"lcid": names.written_curve(load.curve), "sf": load.value}
    return keyword(f"LOAD_BODY_{load.direction.upper()}", factor)


def initial_velocity(load: InitialVelocity, nsid: int) -> str:
    """The keyword of a velocity at time zero."""
    motion = dict(zip(("vx", "vy", "vz"), map(float, load.velocity), strict=True))
    return keyword("INITIAL_VELOCITY", {"nsid": nsid}, motion)


def _factor(names: Names, load: Pressure | Force | LineForce | Motion) -> Card:
    """Curve and factor of a load."""
    return {"lcid": names.curve(load.curve), "sf": load.value}


def set_card(sid: int) -> Card:
    """The first card of a set."""
    return {"sid": sid}
