"""Supports and motions of the plate."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from plydyn_pre.translate.block import REPLACED, TAKEN, Block, Row
from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.frames import axes_of, held_along, motion_along
from plydyn_pre.translate.holds import TURNS, Heights, Holds
from plydyn_pre.translate.model import Model
from plydyn_pre.translate.stack import Stack, with_mid_sides

_DIRECTIONS = ("DOFX", "DOFY", "DOFZ")
_ROTATIONS = ("DOFRX", "DOFRY", "DOFRZ")
#: What TC of *NODE holds, and RC of rotations
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
    height: float | None = None  # where it holds; None for the whole thickness
    place: tuple[Block, int] | None = None  # keyword and line of a motion

    @property
    def motion(self) -> tuple[float, ...]:
        """What tells it from another motion."""
        return self.lcid, self.factor, self.quantity, self.birth, self.death


def read_supports(model: Model, bodies: Bodies, stack: Stack) -> list[Support]:
    """All supports and motions of the plate."""
    found: list[Support] = []
    single: dict[str, set[int]] = {}
    holds = Holds(model, bodies, stack)
    for block in model.blocks:
        if block.name.startswith("BOUNDARY_SPC_") and block.name.split("_")[2] in ("SET", "NODE"):
            for row in block.rows:
                with model.gathered():
                    found += _spc(holds, block, row, single)
        elif block.name in ("BOUNDARY_PRESCRIBED_MOTION_SET", "BOUNDARY_PRESCRIBED_MOTION_NODE"):
            for row in block.rows:
                with model.gathered():
                    found += _motion(holds, block, row)
    _codes(holds, single)
    holds.check_turns()
    for held, ids in single.items():
        found.append(Support("single nodes", tuple(with_mid_sides(stack, ids)), held))
    where = [each for support in found for each in _by_heights(holds, support)]
    return list(_once(model, where))


def _by_heights(holds: Holds, support: Support) -> Iterator[Support]:
    """A support, or those into which it falls by where over the thickness they hold."""
    if support.lcid >= 0:
        yield support
        return
    groups: dict[tuple[Heights, tuple[int, ...]], str] = {}
    for axis in support.held:
        columns: dict[Heights, list[int]] = {}
        for column in support.ids:
            columns.setdefault(holds.heights(column, axis), []).append(column)
        for heights, found in columns.items():
            key = (heights, tuple(found))
            groups[key] = groups.get(key, "") + axis
    for (heights, ids), held in groups.items():
        if heights is None:
            yield replace(support, ids=ids, held=held)
        for height in heights or ():
            level = holds.level(height)
            holds.model.notes.append(
                f"{support.title}: {len(ids)} points are held along {' and '.join(held)} at"
                f" z = {level:g} alone, about which the plate may turn"
            )
            yield replace(support, ids=ids, held=held, height=level)


def _once(model: Model, supports: list[Support]) -> Iterator[Support]:
    """Supports that hold or move each point once along an axis; a motion wins over a hold."""
    taken: dict[str, set[tuple[int, float | None]]] = {axis: set() for axis in "xyz"}
    moved: set[int] = set()
    motions: dict[tuple[str, int], Support] = {}
    for support in sorted(supports, key=lambda each: each.lcid < 0):
        groups: dict[tuple[int, ...], str] = {}
        _check_motions(support, motions)
        for axis in support.held:
            where = (None, support.height)
            ids = tuple(n for n in support.ids if not any((n, z) in taken[axis] for z in where))
            first = {n for n, _ in taken[axis]} & moved
            if support.lcid < 0 and len(ids) < len(support.ids) and first:
                model.notes.append(
                    f"{support.title}: {len(support.ids) - len(ids)} points that it holds along"
                    f" {axis} have a prescribed motion there, which wins"
                )
            groups[ids] = groups.get(ids, "") + axis
            taken[axis].update((n, support.height) for n in ids)
        moved.update(support.ids if support.lcid >= 0 else ())
        for ids, held in groups.items():
            if ids:
                yield replace(support, ids=ids, held=held)


def _check_motions(support: Support, motions: dict[tuple[str, int], Support]) -> None:
    """Refuse another motion of points along an axis along which they move already."""
    if support.lcid < 0:
        return
    others = [motions.setdefault((support.held, n), support) for n in support.ids]
    count = sum(each.motion != support.motion for each in others)
    if count and support.place:
        block, line = support.place
        words = f"{support.title}: {count} points have another motion along {support.held} already"
        block.lose(f"{words}: one is translated", "DOF", line=line)


def _nodes(bodies: Bodies, block: Block, row: Row) -> tuple[str, set[int]]:
    """The title and the nodes of a row."""
    if "_NODE" in block.name:
        block.mark(TAKEN, "", "NID")
        nid = row.whole("NID")
        if nid not in bodies.nodes:
            raise block.fail("NID", f"there is no node {nid}", row.line)
        return f"node {nid}", {nid}
    block.mark(REPLACED, "numbered anew", "NSID")
    sid = row.whole("NSID")
    return f"set {sid}", bodies.sets.node_set(sid, block, row.line)


def _of_plate(holds: Holds, block: Block, row: Row) -> tuple[str, set[int]]:
    """The title and the nodes that are of the plate; others are told."""
    model, bodies = holds.model, holds.bodies
    title, ids = _nodes(bodies, block, row)
    inside = ids & holds.stack.column_of.keys()
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


def _spc(holds: Holds, block: Block, row: Row, single: dict[str, set[int]]) -> list[Support]:
    """A row of supports; single nodes are gathered by what holds them."""
    block.mark(TAKEN, "", *_DIRECTIONS, "BIRTH", "DEATH")
    block.mark(TAKEN, "whether a shell may turn, and is held at its height alone", *TURNS.values())
    if not {*_DIRECTIONS, "NID", "NSID"} & row.values.keys():
        return []
    for name in (*_DIRECTIONS, *_ROTATIONS):
        if row.whole(name) not in (0, 1):
            raise block.fail(name, "0 or 1 is needed", row.line)
    model, stack = holds.model, holds.stack
    title, ids = _of_plate(holds, block, row)
    held, fixed = (_held(model, block, row, names) for names in (_DIRECTIONS, _ROTATIONS))
    for axis, name in TURNS.items():
        if name[-1].lower() in fixed:
            holds.fix(block, row, name, axis, ids)
    if not held:
        return []
    birth, death = row.number("BIRTH"), row.number("DEATH")
    if birth > 0.0 or 0.0 < death < min(model.end, _EVER):
        holds.move(ids, held)
        nodes = tuple(with_mid_sides(stack, ids))
        times: dict[str, Any] = {"birth": birth, "death": death if death < _EVER else 0.0}
        times |= {"place": (block, row.line)}
        return [Support(title, nodes, axis, lcid=0, **times) for axis in held] if nodes else []
    holds.hold(ids, held)
    if block.name == "BOUNDARY_SPC_NODE":
        single.setdefault(held, set()).update(ids)
        return []
    return [Support(title, tuple(with_mid_sides(stack, ids)), held)] if ids else []


def _held(model: Model, block: Block, row: Row, names: tuple[str, ...]) -> str:
    """The directions that a row of supports holds, or those about which."""
    held = "".join(axis for axis, name in zip("xyz", names, strict=True) if row.whole(name))
    block.mark(TAKEN, "the axes of the support", "CID")
    if not (cid := row.whole("CID")):
        return held
    found = held_along(axes_of(model, block, "CID", cid, row.line), held)
    if found is None:
        words = f"{cid} has other axes than x, y and z: such a support is not translated"
        raise block.fail("CID", words, row.line)
    return found


def _codes(holds: Holds, single: dict[str, set[int]]) -> None:
    """What TC and RC of *NODE hold."""
    for block in holds.model.find("NODE"):
        if not block.has("TC") and not block.has("RC"):
            continue
        block.mark(TAKEN, "", "TC")
        block.mark(TAKEN, "whether a shell may turn, and is held at its height alone", "RC")
        for row in block.rows:
            nid = row.whole("NID")
            if nid not in holds.stack.column_of:
                continue
            held, fixed = (_coded(block, row, name) for name in ("TC", "RC"))
            for axis, name in TURNS.items():
                if name[-1].lower() in fixed:
                    holds.fix(block, row, "RC", axis, {nid})
            if held:
                holds.hold({nid}, held)
                single.setdefault(held, set()).add(nid)


def _coded(block: Block, row: Row, name: str) -> str:
    """The directions of a code of a node."""
    code = row.whole(name)
    if code and code not in _CODES:
        block.lose(f"{code} is none of 1 to 7", name, line=row.line)
    return "".join(sorted(_CODES.get(code, "")))


def _motion(holds: Holds, block: Block, row: Row) -> list[Support]:
    """A row of motions."""
    block.mark(TAKEN, "over the whole thickness", "DOF", "VAD", "LCID", "SF", "BIRTH", "DEATH")
    model = holds.model
    if (motion := motion_along(model, block, row)) is None:
        return []
    axis, factor = motion
    title, ids = _of_plate(holds, block, row)
    model.history(block, row.whole("LCID"), row.line)
    holds.move(ids, axis)
    nodes = tuple(with_mid_sides(holds.stack, ids))
    if not nodes:
        return []
    if row.number("BIRTH") > 0.0:
        model.notes.append(
            f"{title}: its curve is taken at the time of the run, not from BIRTH on as LS-DYNA may"
        )
    death = row.number("DEATH")
    times: dict[str, Any] = {"birth": row.number("BIRTH"), "death": death if death < _EVER else 0.0}
    times |= {"place": (block, row.line)}
    vad = row.whole("VAD")
    return [Support(title, nodes, axis, row.whole("LCID"), factor, vad, **times)]
