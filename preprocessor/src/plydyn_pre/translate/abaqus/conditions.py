"""Supports, motions, velocities and loads of an Abaqus file."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

from plydyn_pre.translate.abaqus.bodies import RigidBody
from plydyn_pre.translate.abaqus.lines import Keyword
from plydyn_pre.translate.abaqus.mesh import Mesh
from plydyn_pre.translate.source import corner_fields

#: Directions by their names
_NAMED = {
    "ENCASTRE": (1, 2, 3, 4, 5, 6),
    "PINNED": (1, 2, 3),
    "XSYMM": (1, 5, 6),
    "YSYMM": (2, 4, 6),
    "ZSYMM": (3, 4, 5),
    "XASYMM": (2, 3, 4),
    "YASYMM": (1, 3, 5),
    "ZASYMM": (1, 2, 6),
}
_QUANTITIES = {"VELOCITY": 0, "ACCELERATION": 1, "DISPLACEMENT": 2}
_SMOOTH = 20  # points of a smooth step
_NAMES = {"NSID": "set", "PID": "reference node", "NID": "node"}
_NAMES |= {"DOFRX": "first", "DOFRY": "first"}

Points = list[tuple[float, float]]


def put_supports(mesh: Mesh, bodies: list[RigidBody], end: float) -> None:
    """Add what holds and moves nodes, and tell the rigid bodies what holds and moves them."""
    for keyword in mesh.each("BOUNDARY"):
        if keyword.options.get("OP", "MOD").upper() == "NEW":
            keyword.block.lose("what earlier steps hold and OP=NEW frees", "OP")
        for line, words in keyword.data:
            with mesh.source.gathered():
                _support(mesh, bodies, keyword, (line, words), end)


def _support(
    mesh: Mesh,
    bodies: list[RigidBody],
    keyword: Keyword,
    row: tuple[int, list[str]],
    end: float,
) -> None:
    """Add a row of supports or motions."""
    line, words = row
    ids = set(mesh.node_ids(keyword, words[0], line))
    directions, value = _directions(keyword, words, line)
    kind = keyword.kind("TYPE", "DISPLACEMENT", *_QUANTITIES)
    rigid = [body for body in bodies if body.reference & ids]
    others = ids - {n for body in rigid for n in body.reference}
    if value == 0.0:
        for body in rigid:
            body.held.update(directions)
        if others:
            mesh.source.put_support(keyword.block, others, directions, line, _NAMES)
        return
    lcid = _curve(mesh, keyword, kind, line, end)
    for direction in directions:
        motion = {"DOF": direction, "VAD": _QUANTITIES[kind], "LCID": lcid, "SF": value}
        for body in rigid:
            body.moved.add(direction)
            name = "BOUNDARY_PRESCRIBED_MOTION_RIGID"
            own = motion | {"PID": body.pid}
            mesh.source.put(name, keyword.block, own, line=line, names=_NAMES)
        if others:
            sid = mesh.source.put_set("SET_NODE_LIST", keyword.block, others, line)
            name = "BOUNDARY_PRESCRIBED_MOTION_SET"
            own = motion | {"NSID": sid}
            mesh.source.put(name, keyword.block, own, line=line, names=_NAMES)


def _directions(keyword: Keyword, words: list[str], line: int) -> tuple[tuple[int, ...], float]:
    """The directions of a row and what is prescribed."""
    word = words[1].upper() if len(words) > 1 else ""
    if word in _NAMED:
        return _NAMED[word], 0.0
    first, last, value = (*keyword.numbers("", words[1:4], line), 0.0, 0.0, 0.0)[:3]
    last = last or first
    if not 1.0 <= first <= last <= 6.0:
        raise keyword.fail("", f"{word or 'nothing'} is no direction from 1 to 6", line)
    return tuple(range(int(first), int(last) + 1)), value


def _curve(mesh: Mesh, keyword: Keyword, kind: str, line: int, end: float) -> int:
    """The curve of a motion or a load."""
    name = keyword.options.get("AMPLITUDE", "").upper()
    if not name and kind == "DISPLACEMENT":
        words = "a displacement needs an AMPLITUDE: it cannot jump"
        raise keyword.fail("AMPLITUDE", words, line)
    if not name:
        return mesh.source.put_curve("", keyword.block, [(0.0, 1.0), (end or 1.0, 1.0)])
    for each in mesh.each("AMPLITUDE"):
        if each.option("NAME").upper() == name:
            return mesh.source.put_curve(name, each.block, _points(each))
    raise keyword.fail("AMPLITUDE", f"there is no amplitude {name}", line)


def _points(keyword: Keyword) -> Points:
    """The points of an amplitude."""
    kind = keyword.kind("DEFINITION", "TABULAR", "TABULAR", "SMOOTH STEP")
    keyword.kind("VALUE", "RELATIVE", "RELATIVE")
    numbers = keyword.all_numbers("", 4)
    points = list(zip(numbers[::2], numbers[1::2], strict=False))
    if any(a[0] >= b[0] for a, b in pairwise(points)):
        raise keyword.fail("", "times must rise")
    if kind == "TABULAR":
        return points
    found = points[:1]
    for (t0, a0), (t1, a1) in pairwise(points):
        for n in range(1, _SMOOTH + 1):
            s = n / _SMOOTH
            rise = s**3 * (10.0 - 15.0 * s + 6.0 * s * s)
            found.append((t0 + s * (t1 - t0), a0 + rise * (a1 - a0)))
    return found


def put_velocities(mesh: Mesh, bodies: list[RigidBody]) -> None:
    """Add velocities at time zero, which are given direction by direction."""
    found: dict[int, list[float]] = {}
    by: dict[int, tuple[Keyword, int]] = {}
    for keyword in mesh.each("INITIAL CONDITIONS"):
        with mesh.source.gathered():
            if keyword.option("TYPE").upper() != "VELOCITY":
                keyword.block.lose("only VELOCITY is translated", "TYPE")
                continue
            for line, words in keyword.data:
                _, direction, value = (*words, "", "", "")[:3]
                axis, size = keyword.numbers("", [direction, value], line)
                if axis not in (1.0, 2.0, 3.0):
                    keyword.block.lose("a rotation at time zero is not translated", line=line)
                    continue
                for nid in mesh.node_ids(keyword, words[0], line):
                    found.setdefault(nid, [0.0, 0.0, 0.0])[int(axis) - 1] = size
                    by[nid] = (keyword, line)
    for body in bodies:
        for nid in body.reference & found.keys():
            keyword, line = by.pop(nid)
            own = {"PID": body.pid}
            mesh.source.put_velocity(keyword.block, own, found.pop(nid), line, _NAMES)
    for nid, velocity in found.items():
        keyword, line = by[nid]
        mesh.source.put_velocity(keyword.block, {"NID": nid}, velocity, line, _NAMES)


def put_loads(mesh: Mesh, end: float) -> None:
    """Add forces, pressures and gravity."""
    for keyword in mesh.each("CLOAD", "DLOAD", "DSLOAD"):
        for line, words in keyword.data:
            with mesh.source.gathered():
                lcid = _curve(mesh, keyword, "", line, end)
                if keyword.name == "CLOAD":
                    _force(mesh, keyword, words, line, lcid)
                else:
                    _distributed(mesh, keyword, words, line, lcid)


def _force(mesh: Mesh, keyword: Keyword, words: list[str], line: int, lcid: int) -> None:
    """Add forces at nodes."""
    direction, value = (*keyword.numbers("", words[1:3], line), 0.0, 0.0)[:2]
    rows = [
        {"NID": nid, "DOF": int(direction), "LCID": lcid, "SF": value}
        for nid in mesh.node_ids(keyword, words[0], line)
    ]
    mesh.source.put("LOAD_NODE_POINT", keyword.block, *rows, line=line, names=_NAMES)


def _distributed(mesh: Mesh, keyword: Keyword, words: list[str], line: int, lcid: int) -> None:
    """Add gravity or a pressure."""
    kind = words[1].upper() if len(words) > 1 else ""
    if kind == "GRAV" and keyword.name == "DLOAD":
        size, *along = (*keyword.numbers("", words[2:6], line), 0.0, 0.0, 0.0, 0.0)[:4]
        length = sum(a * a for a in along) ** 0.5
        if not length:
            raise keyword.fail("GRAV", "its direction is missing", line)
        if words[0]:
            keyword.block.remarks.append(f"gravity acts on all, not on {words[0]} alone")
        for axis, a in zip("XYZ", along, strict=True):
            if a:
                card = {"LCID": lcid, "SF": -size * a / length}
                mesh.source.put(f"LOAD_BODY_{axis}", keyword.block, card, line=line)
        return
    if kind != "P":
        keyword.block.lose(f"{kind or 'nothing'} is not translated; P and GRAV are", line=line)
        return
    value = (*keyword.numbers("", words[2:3], line), 0.0)[0]
    if keyword.name == "DSLOAD":
        faces: Iterable[tuple[int, ...]] = mesh.surface(keyword, words[0], line).faces
    else:
        ids = mesh.element_ids(keyword, words[0], line)
        # along the normal of a shell: onto its other face
        faces = [mesh.elements[eid].faces()[0][::-1] for eid in ids]
    rows = [{"LCID": lcid, "SF": value} | corner_fields(face) for face in faces]
    mesh.source.put("LOAD_SEGMENT", keyword.block, *rows, line=line, names=_NAMES)
