"""Keywords of impactors and fixtures."""

from __future__ import annotations

from collections.abc import Iterator

from plydyn_pre.deck.cards import Card, keyword, titled
from plydyn_pre.translate.deck import Curves, Plate
from plydyn_pre.translate.loads import Gravity
from plydyn_pre.translate.rigid import Rigid

_IMPACTORS = {"bar": "CYLINDER"}
_FIXTURES = {"cylinder": "PUNCH"}
_RECTANGLE, _CIRCLE = 1, 2


def rigid_lines(plate: Plate, curves: Curves) -> Iterator[str]:
    """The impactors with their contacts, and the fixtures."""
    impactors = [rigid for rigid in plate.rigid if rigid.moves]
    part = 1 if len(plate.laminates) == 1 else 0  # 0 for all
    for number, rigid in enumerate(impactors, start=1):
        yield _impactor(rigid, number, curves, plate.gravity)
        pair = {"cid": number, "iid": number, "pid": part, "face": 1 if rigid.above else -1}
        cards: list[Card] = [pair | {"method": 2, "spacing": 0.0}]
        if rigid.friction[0] > 0.0:
            cards.append(dict(zip(("fs", "fd", "dc"), rigid.friction, strict=True)))
        yield keyword("CONTACT_IMPACTOR", *cards)
    fixtures = [rigid for rigid in plate.rigid if not rigid.moves]
    for number, rigid in enumerate(fixtures, start=1):
        yield _fixture(rigid, number, curves)


def _impactor(rigid: Rigid, number: int, curves: Curves, gravity: list[Gravity]) -> str:
    """The keyword of an impactor."""
    shape = rigid.shape
    x, y, z = shape.centre
    if shape.kind == "cylinder":
        z += 0.5 * shape.length * (1.0 if rigid.above else -1.0)
    place = {"iid": number, "radius": shape.radius, "mass": rigid.mass, "xc": x, "yc": y, "zc": z}
    motion = dict(zip(("vx", "vy", "vz"), map(float, rigid.velocity), strict=True))
    weight = {f"grav{axis}": 0.0 for axis in "xyz"}
    for each in gravity:
        weight[f"grav{each.axis}"] = -each.factor * each.points[0][1]
    motion |= {"dof": rigid.freedom, "gravz": weight.pop("gravz")}
    lcids = {f"lc{a}": curves.new(rigid.curves[a]) if a in rigid.curves else 0 for a in "xyz"}
    rest: Card = {**weight, **lcids, "vad": rigid.quantity}
    if shape.kind == "sphere":
        cards: list[Card] = [place, {**motion, "shape": 0}]
        rest = {"inertia": rigid.inertia, **rest}
    else:
        cards = [place, _sizes(rigid), motion]
    cards += [rest] if any(rest.values()) else []
    return titled(f"IMPACTOR_{_IMPACTORS.get(shape.kind, shape.kind.upper())}", "impactor", *cards)


def _sizes(rigid: Rigid) -> Card:
    """The sizes of a body that is no sphere."""
    shape = rigid.shape
    axis = dict(zip(("ax", "ay", "az"), map(float, shape.axis), strict=True))
    match shape.kind:
        case "tup":
            return {"length": shape.length} | axis
        case "cone":
            return {"angle": shape.angle, "tip": shape.tip, "length": shape.length} | axis
    return {"length": shape.length, "edge": shape.edge} | axis


def _fixture(rigid: Rigid, number: int, curves: Curves) -> str:
    """The keyword of a fixture."""
    shape = rigid.shape
    rub = dict(zip(("fs", "fd", "dc"), rigid.friction, strict=True))
    head: Card = {"fid": number, "face": 1 if rigid.above else -1, "gap": rigid.gap}
    x, y = shape.centre[:2]
    place = {"xc": x, "yc": y}
    size = {"lx": shape.sides[0], "ly": shape.sides[1], "radius": 0.0}
    cards: list[Card]
    match shape.kind:
        case "bar":
            half = [0.5 * shape.length * a for a in shape.axis[:2]]
            ends = {"x1": x - half[0], "y1": y - half[1], "x2": x + half[0], "y2": y + half[1]}
            cards = [{**head, "radius": shape.radius, **rub}, ends]
        case "ring":
            cards = [{**head, "edge": 0.0, **rub}, {**place, "ri": shape.inner, "ro": shape.radius}]
        case "plane":
            window = _RECTANGLE if shape.sides[0] else 0
            cards = [{**head, "edge": 0.0, **rub}, {"window": window, **place, **size}]
        case "punch":
            cards = [{**head, "edge": 0.0, **rub}, {"shape": _RECTANGLE, **place, **size}]
        case _:
            size["radius"] = shape.radius
            cards = [{**head, "edge": shape.edge, **rub}, {"shape": _CIRCLE, **place, **size}]
    if rigid.curves:
        lcids = {a: curves.new(rigid.curves[a]) if a in rigid.curves else 0 for a in "xyz"}
        cards.append({f"lc{axis}": lcid for axis, lcid in lcids.items()})
    return keyword(f"FIXTURE_{_FIXTURES.get(shape.kind, shape.kind.upper())}", *cards)
