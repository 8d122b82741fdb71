"""Supports and motions of the plate."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from plydyn_pre.translate.block import IDLE, REPLACED, TAKEN, Block, Row
from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.frames import axes_of, held_along, motion_along
from plydyn_pre.translate.model import Model
from plydyn_pre.translate.stack import Stack, with_mid_sides

_DIRECTIONS = ("DOFX", "DOFY", "DOFZ")
#: What TC of *NODE holds
_CODES = {1: "x", 2: "y", 3: "z", 4: "xy", 5: "yz", 6: "zx", 7: "xyz"}
_EVER = 1.0e19


@dataclass(frozen=True)
class Support:
    """Nodes that are held, or moved along a curve."""

    title: str
    ids: tuple[int, ...]
    held: str  # x, y, z
    lcid: int = -1  # of a motion; 0 for one that stands still
    factor: float = 1.0
    quantity: int = 0  # what the curve gives: 0 velocity, 1 acceleration, 2 displacement
    birth: float = 0.0
    death: float = 0.0


def read_supports(model: Model, bodies: Bodies, stack: Stack) -> list[Support]:
    """All supports and motions of the plate."""
    found: list[Support] = []
    single: dict[str, set[int]] = {}
    for block in model.blocks:
        if block.name.startswith("BOUNDARY_SPC_") and block.name.split("_")[2] in ("SET", "NODE"):
            for row in block.rows:
                with model.gathered():
                    found += _spc(model, bodies, stack, block, row, single)
        elif block.name in ("BOUNDARY_PRESCRIBED_MOTION_SET", "BOUNDARY_PRESCRIBED_MOTION_NODE"):
            for row in block.rows:
                with model.gathered():
                    found += _motion(model, bodies, stack, block, row)
    _codes(model, stack, single)
    for held, ids in single.items():
        found.append(Support("single nodes", tuple(with_mid_sides(stack, ids)), held))
    return list(_once(model, found))


def _once(model: Model, supports: list[Support]) -> Iterator[Support]:
    """Supports that hold or move each point once along an axis; a motion wins over a hold."""
    taken: dict[str, set[int]] = {axis: set() for axis in "xyz"}
    moved: set[int] = set()
    for support in sorted(supports, key=lambda each: each.lcid < 0):
        groups: dict[tuple[int, ...], str] = {}
        for axis in support.held:
            ids = tuple(n for n in support.ids if n not in taken[axis])
            if support.lcid < 0 and len(ids) < len(support.ids) and taken[axis] & moved:
                model.notes.append(
                    f"{support.title}: {len(support.ids) - len(ids)} points that it holds along"
                    f" {axis} have a prescribed motion there, which wins"
                )
            groups[ids] = groups.get(ids, "") + axis
            taken[axis].update(ids)
        moved.update(support.ids if support.lcid >= 0 else ())
        for ids, held in groups.items():
            if ids:
                yield replace(support, ids=ids, held=held)


def _nodes(bodies: Bodies, block: Block, row: Row) -> tuple[str, set[int]]:
    """The title and the nodes of a row."""
    if "_NODE" in block.name:
        block.mark(TAKEN, "over the whole thickness", "NID")
        nid = row.whole("NID")
        if nid not in bodies.nodes:
            raise block.fail("NID", f"there is no node {nid}", row.line)
        return f"node {nid}", {nid}
    block.mark(REPLACED, "numbered anew", "NSID")
    sid = row.whole("NSID")
    return f"set {sid}", bodies.sets.node_set(sid, block, row.line)


def _of_plate(
    model: Model, bodies: Bodies, stack: Stack, block: Block, row: Row
) -> tuple[str, set[int]]:
    """The title and the nodes that are of the plate; others are told."""
    title, ids = _nodes(bodies, block, row)
    inside = ids & stack.column_of.keys()
    rigid = {n for body in bodies.rigid for n in body.nodes} & ids
    if rigid:
        words = f"{title}: {len(rigid)} nodes of rigid parts"
        if "MOTION" in block.name:
            words = f"{words} move by *BOUNDARY_PRESCRIBED_MOTION_RIGID only"
            block.lose(words, "DOF", line=row.line)
        else:
            model.notes.append(f"{words}, which CON1 and CON2 of *MAT_RIGID hold, not this keyword")
    elif not inside:
        words = "holds" if "SPC" in block.name else "moves"
        block.lose(
            f"{title} {words} no node of the plate",
            "NSID" if "SET" in title else "NID",
            line=row.line,
        )
    return title, inside


def _spc(
    model: Model, bodies: Bodies, stack: Stack, block: Block, row: Row, single: dict[str, set[int]]
) -> list[Support]:
    """A row of supports; single nodes are gathered by what holds them."""
    block.mark(TAKEN, "over the whole thickness", *_DIRECTIONS, "BIRTH", "DEATH")
    if not {*_DIRECTIONS, "NID", "NSID"} & row.values.keys():
        return []
    for name in _DIRECTIONS:
        if row.whole(name) not in (0, 1):
            raise block.fail(name, "0 or 1 is needed", row.line)
    title, ids = _of_plate(model, bodies, stack, block, row)
    held = _held(model, block, row)
    if not held:
        model.notes.append(
            f"{block.title}, line {row.line}, holds rotations only, which points do not have:"
            " a clamp holds x, y and z"
        )
        return []
    birth, death = row.number("BIRTH"), row.number("DEATH")
    if birth > 0.0 or 0.0 < death < min(model.end, _EVER):
        nodes = tuple(with_mid_sides(stack, ids))
        times: dict[str, Any] = {"birth": birth, "death": death if death < _EVER else 0.0}
        return [Support(title, nodes, axis, lcid=0, **times) for axis in held] if nodes else []
    if block.name == "BOUNDARY_SPC_NODE":
        single.setdefault(held, set()).update(ids)
        return []
    return [Support(title, tuple(with_mid_sides(stack, ids)), held)] if ids else []


def _held(model: Model, block: Block, row: Row) -> str:
    """The directions that a row of supports holds."""
    held = "".join(axis for axis, name in zip("xyz", _DIRECTIONS, strict=True) if row.whole(name))
    block.mark(TAKEN, "the axes of the support", "CID")
    if not (cid := row.whole("CID")):
        return held
    found = held_along(axes_of(model, block, "CID", cid, row.line), held)
    if found is None:
        words = f"{cid} has other axes than x, y and z: such a support is not translated"
        raise block.fail("CID", words, row.line)
    return found


def _codes(model: Model, stack: Stack, single: dict[str, set[int]]) -> None:
    """What TC of *NODE holds."""
    for block in model.find("NODE"):
        if not block.has("TC") and not block.has("RC"):
            continue
        block.mark(TAKEN, "over the whole thickness", "TC")
        block.mark(IDLE, "points have no rotations; a clamp holds x, y and z", "RC")
        for row in block.rows:
            code, nid = row.whole("TC"), row.whole("NID")
            if code and nid in stack.column_of:
                if code not in _CODES:
                    block.lose(f"{code} is none of 1 to 7", "TC", line=row.line)
                    continue
                single.setdefault("".join(sorted(_CODES[code])), set()).add(nid)


def _motion(model: Model, bodies: Bodies, stack: Stack, block: Block, row: Row) -> list[Support]:
    """A row of motions."""
    block.mark(TAKEN, "over the whole thickness", "DOF", "VAD", "LCID", "SF", "BIRTH", "DEATH")
    (dof, sense), vad = motion_along(model, block, row), row.whole("VAD")
    if dof not in (1, 2, 3) or vad not in (0, 1, 2):
        words = f"DOF {dof} with VAD {vad}: 1 to 4 with 0 to 2 are translated"
        block.lose(words, "DOF", "VAD", line=row.line)
        return []
    title, ids = _of_plate(model, bodies, stack, block, row)
    model.curve(block, row.whole("LCID"), row.line)
    nodes = tuple(with_mid_sides(stack, ids))
    if not nodes:
        return []
    death = row.number("DEATH")
    times = {"birth": row.number("BIRTH"), "death": death if death < _EVER else 0.0}
    factor = sense * (row.number("SF", 1.0) or 1.0)
    return [Support(title, nodes, "xyz"[dof - 1], row.whole("LCID"), factor, vad, **times)]
