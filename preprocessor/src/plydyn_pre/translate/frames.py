"""Coordinate systems and vectors of a deck, which other keywords name by a number."""

from __future__ import annotations

from math import sqrt

from plydyn_pre.translate.block import TAKEN, Block, Row
from plydyn_pre.translate.model import Model, Place, triple

_ALONG = 1e-3  # of a unit vector by which one along an axis may lean
_MOTION_ALONG = 4  # DOF of a motion along VID

Axes = tuple[Place, Place, Place]


def axes_of(model: Model, by: Block, name: str, cid: int, line: int = 0) -> Axes:
    """The unit vectors of a coordinate system that a field of a keyword names."""
    for block in model.find("DEFINE_COORDINATE_SYSTEM", "DEFINE_COORDINATE_VECTOR"):
        if block.raw("CID", 0) == cid:
            if block.name.endswith("_VECTOR"):
                return _axes(block, _place(block, "XX YX ZX"), _place(block, "XV YV ZV"))
            origin = _place(block, "XO YO ZO")
            first, other = _place(block, "XL YL ZL"), _place(block, "XP YP ZP")
            return _axes(block, _minus(first, origin), _minus(other, origin))
    for block in model.find("DEFINE_COORDINATE_NODES"):
        if block.raw("CID", 0) == cid:
            return _of_nodes(model, block)
    words = model.other_form("DEFINE_COORDINATE_", cid)
    raise by.fail(name, words or f"there is no *DEFINE_COORDINATE_SYSTEM {cid}", line)


def along(axes: Axes, vector: Place) -> Place:
    """A vector along x, y and z that is given along the axes of a system."""
    return triple(
        sum(part * axis[i] for part, axis in zip(vector, axes, strict=True)) for i in range(3)
    )


def held_along(axes: Axes, held: str) -> str | None:
    """Which of x, y and z are held where a system's own are; None where others are, too."""
    own = [axis for axis, name in zip(axes, "xyz", strict=True) if name in held]
    shares = [
        [sum(axis[i] * axis[j] for axis in own) - (i == j) * (i in _whole(own)) for j in range(3)]
        for i in range(3)
    ]
    if any(abs(share) > _ALONG for row in shares for share in row):
        return None
    return "".join("xyz"[i] for i in sorted(_whole(own)))


def _whole(own: list[Place]) -> set[int]:
    """The axes of which more than half is held."""
    return {i for i in range(3) if sum(axis[i] ** 2 for axis in own) > 0.5}


def motion_along(model: Model, block: Block, row: Row) -> tuple[str, float] | None:
    """Axis (x, y or z) and factor of a row of motions; None for a motion that is told as lost."""
    (dof, sense), vad = _axis_along(model, block, row), row.whole("VAD")
    if dof in (1, 2, 3) and vad in (0, 1, 2):
        return "xyz"[dof - 1], sense * (row.number("SF", 1.0) or 1.0)
    words = f"DOF {dof} with VAD {vad}: 1 to 4 with 0 to 2 are translated"
    block.lose(words, "DOF", "VAD", line=row.line)
    return None


def _axis_along(model: Model, block: Block, row: Row) -> tuple[int, float]:
    """Axis (1 to 3) and sense of the translation of a row of motions; DOF as it is for others."""
    block.mark(TAKEN, "the direction of DOF 4", "VID")
    dof, vid = row.whole("DOF"), row.whole("VID")
    if dof != _MOTION_ALONG:
        return dof, 1.0
    for each in model.find("DEFINE_VECTOR"):
        if each.raw("VID", 0) == vid:
            each.mark(TAKEN, "a direction of motion", "VID")
            way = _unit(each, _minus(_place(each, "XH YH ZH"), _place(each, "XT YT ZT")))
            axis = max(range(3), key=lambda i: abs(way[i]))
            if abs(way[axis]) >= 1.0 - _ALONG:
                return axis + 1, 1.0 if way[axis] > 0.0 else -1.0
            words = f"vector {vid} is not along x, y or z: such a motion is not translated"
            raise block.fail("VID", words, row.line)
    raise block.fail("VID", f"there is no *DEFINE_VECTOR {vid}", row.line)


def _place(block: Block, names: str) -> Place:
    """Three fields."""
    return triple(block.number(name, 0.0) for name in names.split())


def _minus(a: Place, b: Place) -> Place:
    """The difference of two places."""
    return triple(x - y for x, y in zip(a, b, strict=True))


def _unit(block: Block, vector: Place) -> Place:
    """A vector of length one."""
    size = sqrt(sum(x * x for x in vector))
    if size == 0.0:
        raise block.fail("", "two of its points are one, or all lie on a line")
    return triple(x / size for x in vector)


def _cross(a: Place, b: Place) -> Place:
    """The cross product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _axes(block: Block, first: Place, other: Place) -> Axes:
    """The axes of a system from its x and a vector in its plane x-y."""
    block.mark(TAKEN, "the axes of what names it", "CID")
    x = _unit(block, first)
    z = _unit(block, _cross(x, other))
    return x, _cross(z, x), z


def _of_nodes(model: Model, block: Block) -> Axes:
    """The axes of a system by three nodes, where they are at the start."""
    if str(block.raw("DIR", "X")).upper() != "X":
        raise block.fail("DIR", f"{block.raw('DIR')} is not translated; X is")
    block.mark(TAKEN, "", "DIR")
    names = ("N1", "N2", "N3")
    ids = [block.whole(name) for name in names]
    places = {
        row.whole("NID"): triple(row.number(name) for name in "XYZ")
        for nodes in model.find("NODE")
        for row in nodes.rows
        if row.whole("NID") in ids
    }
    for name, nid in zip(names, ids, strict=True):
        if nid not in places:
            raise block.fail(name, f"there is no node {nid}")
    origin, first, other = (places[nid] for nid in ids)
    return _axes(block, _minus(first, origin), _minus(other, origin))
