"""Forces, pressures and gravity."""

from __future__ import annotations

from dataclasses import dataclass

from plydyn_pre.translate.block import REPLACED, TAKEN, Block, Row
from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.model import Model
from plydyn_pre.translate.stack import Stack, twice_area


@dataclass(frozen=True)
class Force:
    """A force at nodes."""

    ids: tuple[int, ...]
    dof: int
    lcid: int
    factor: float


@dataclass(frozen=True)
class Pressure:
    """A pressure onto a face of some quads."""

    quads: tuple[int, ...]
    face: int
    lcid: int
    factor: float


@dataclass(frozen=True)
class Gravity:
    """An acceleration of the frame."""

    axis: str
    lcid: int
    factor: float
    points: tuple[tuple[float, float], ...]

    def steady(self) -> bool:
        """Whether it is the same at all times."""
        return len({value for _, value in self.points}) == 1


def read_forces(model: Model, bodies: Bodies, stack: Stack) -> list[Force]:
    """Forces at nodes of the plate."""
    found = []
    for block in model.find("LOAD_NODE_POINT", "LOAD_NODE_SET"):
        for row in block.rows:
            with model.gathered():
                name = "NID" if block.name == "LOAD_NODE_POINT" else "NSID"
                block.mark(TAKEN, "over the whole thickness", name, "DOF", "LCID", "SF")
                number = row.whole(name)
                ids = {number} if name == "NID" else bodies.sets.node_set(number, block, row.line)
                outside = ids - stack.column_of.keys()
                if outside:
                    words = f"node {min(outside)} is not of the plate: its force is not translated"
                    block.lose(words, name, line=row.line)
                if row.whole("DOF") not in (1, 2, 3):
                    words = f"{row.whole('DOF')}: points have no moments; 1, 2 and 3 are translated"
                    block.lose(words, "DOF", line=row.line)
                    continue
                for own in ("CID", "M1", "M2", "M3"):
                    if row.number(own):
                        words = "a direction of its own is not translated"
                        block.lose(words, own, line=row.line)
                factor, lcid = _curve(model, block, row)
                nodes = tuple(sorted(stack.column_of[n] for n in ids - outside))
                found.append(Force(nodes, row.whole("DOF"), lcid, factor))
    return found


def _curve(model: Model, block: Block, row: Row) -> tuple[float, int]:
    """Factor and curve of a row."""
    lcid = row.whole("LCID")
    model.history(block, lcid, row.line)
    if row.number("AT"):
        block.lose("a load that arrives later is not translated", "AT", line=row.line)
    block.mark(TAKEN, "", "LCID", "SF", "AT")
    return row.number("SF", 1.0) or 1.0, lcid


def read_pressures(model: Model, bodies: Bodies, stack: Stack) -> list[Pressure]:
    """Pressures on shells and segments of the plate."""
    found: list[Pressure] = []
    names = ("LOAD_SHELL_SET", "LOAD_SHELL_ELEMENT", "LOAD_SEGMENT", "LOAD_SEGMENT_SET")
    for block in model.find(*names):
        for row in block.rows:
            with model.gathered():
                faces = _faces(bodies, block, row)
                factor, lcid = _curve(model, block, row)
                found += _pressures(bodies, stack, (block, row), faces, (lcid, factor))
    return found


def _faces(bodies: Bodies, block: Block, row: Row) -> list[tuple[int, ...]]:
    """Nodes of the faces that a row loads."""
    sets = bodies.sets
    if block.name == "LOAD_SEGMENT":
        block.mark(REPLACED, "by the number of its quad", "N1", "N2", "N3", "N4")
        return [tuple(row.whole(f"N{n}") for n in range(1, 5))]
    name = {"LOAD_SHELL_SET": "ESID", "LOAD_SHELL_ELEMENT": "EID", "LOAD_SEGMENT_SET": "SSID"}
    key = name[block.name]
    block.mark(REPLACED, "by the numbers of its quads", key)
    number = row.whole(key)
    if key == "SSID":
        return sets.segments(number, block, row.line)
    chosen = {number} if key == "EID" else sets.shell_set(number, block, row.line)
    if missing := chosen - sets.elements.keys():
        raise block.fail(key, f"there is no shell {min(missing)}", row.line)
    return [sets.elements[e][1] for e in sorted(chosen)]


def _pressures(
    bodies: Bodies,
    stack: Stack,
    where: tuple[Block, Row],
    faces: list[tuple[int, ...]],
    load: tuple[int, float],
) -> list[Pressure]:
    """Pressures by the face that they press on, against the normal of each face."""
    block, row = where
    pressed: dict[tuple[int, float], list[int]] = {}
    for face in faces:
        quad = stack.quad_of(face)
        layers = [each for each in stack.layers if set(face) <= each.nodes]
        if not quad or not layers:
            words = f"the face of nodes {face} is no face of the plate"
            block.lose(words, line=row.line)
            continue
        outer = 1 if layers[0] is stack.layers[-1] else -1 if layers[0] is stack.layers[0] else 0
        if layers[0].body.kind != "shell":
            heights = [bodies.nodes[n][2] for n in face]
            outer = 1 if max(heights) >= stack.top - 1e-6 * stack.thickness else -1
        if not outer:
            block.lose(f"the face of nodes {face} lies inside the stack", line=row.line)
            continue
        left = twice_area(face, bodies.nodes) > 0.0  # counter-clockwise from above
        sign = 1.0 if left == (outer == 1) else -1.0
        pressed.setdefault((outer, sign * load[1]), []).append(quad)
    return [Pressure(tuple(sorted(q)), f, load[0], value) for (f, value), q in pressed.items()]


def read_gravity(model: Model) -> list[Gravity]:
    """Accelerations of the frame."""
    found = []
    for axis in "XYZ":
        blocks = list(model.find(f"LOAD_BODY_{axis}"))
        for block in blocks[1:]:
            block.lose("a second one along an axis is not translated", "LCID")
        for block in blocks[:1]:
            with model.gathered():
                lcid = block.whole("LCID", 0)
                points = model.history(block, lcid, block.line_of("LCID"))
                factor = block.number("SF", 0.0) or 1.0
                block.lose_filled("a rotation or a direction of its own is not translated", "CID")
                block.mark(TAKEN, "of no use without a rotation", "XC", "YC", "ZC")
                found.append(Gravity(axis.lower(), lcid, factor, tuple(points)))
    return found
