"""Rigid walls as impactors and fixtures."""

from __future__ import annotations

from math import hypot, sqrt

from plydyn_pre.translate.block import REPLACED, TAKEN, Block
from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.model import Model, Place, triple
from plydyn_pre.translate.rigid import Points, Rigid, gap_of
from plydyn_pre.translate.shapes import Shape
from plydyn_pre.translate.stack import Stack

_WALLS = ("RIGIDWALL_PLANAR", "RIGIDWALL_FLAT", "RIGIDWALL_SPHERE", "RIGIDWALL_CYLINDER")
_STRAIGHT = 1e-3  # of the length of a normal by which it may lean


def read_walls(model: Model, bodies: Bodies, stack: Stack) -> list[Rigid]:
    """The walls that the plate can meet."""
    found = []
    for block in model.find(*_WALLS):
        with model.gathered():
            wall = _wall(model, bodies, stack, block)
            if wall is not None:
                found.append(wall)
    return found


def _wall(model: Model, bodies: Bodies, stack: Stack, block: Block) -> Rigid | None:
    """A wall."""
    if not _meets_plate(bodies, stack, block):
        return None
    place = triple(block.number(name, 0.0) for name in ("XT", "YT", "ZT"))
    head = tuple(block.number(name, 0.0) for name in ("XH", "YH", "ZH"))
    axis = triple(b - a for a, b in zip(place, head, strict=True))
    shape = _shape(block, place, axis)
    friction = block.number("FRIC", 0.0)
    if not 0.0 <= friction < 1.0:
        words = f"{friction:g} is not translated: coefficients of friction below 1 are"
        block.lose(words, "FRIC", line=block.line_of("FRIC"))
    above = place[2] > stack.middle
    if shape.kind in ("plane", "punch") and above == (axis[2] > 0.0):
        block.lose("the normal looks away from the plate", "ZH", line=block.line_of("ZH"))
    wall = Rigid(shape, above, (friction, friction, 0.0), mass=1.0, freedom=1)
    wall.curves, wall.quantity = _motion(model, block)
    still = not wall.curves
    if still:
        wall.curves, wall.quantity = {"z": [(0.0, 0.0), (1.0, 0.0)]}, 2
    wall.freedom = 1 if set(wall.curves) <= {"z"} else 2
    wall.moves = shape.kind == "sphere" or (shape.kind in ("bar", "cylinder") and not still)
    wall.gap = gap_of(shape, above, stack)
    if not wall.moves and not still and wall.quantity != 2:
        block.lose(
            "a flat wall of given velocity is not translated; of given displacement it is", "OPT"
        )
    wall.curves = {} if still and not wall.moves else wall.curves
    model.notes.append(
        f"{block.title}, line {block.line}: a {shape.words()}. LS-DYNA's wall stops nodes,"
        f" in the middle of shells; here it stops the face, {stack.thickness / 2:g} sooner"
    )
    block.mark(REPLACED, f"a {shape.words()}", "XT", "YT", "ZT", "XH", "YH", "ZH")
    return wall


def _meets_plate(bodies: Bodies, stack: Stack, block: Block) -> bool:
    """Whether the nodes of the plate are those of the wall."""
    block.mark(TAKEN, "", "NSID", "NSIDEX", "BIRTH", "DEATH")
    block.lose_filled("a wall of nodes in a box is not translated", "BOXID")
    block.lose_filled("a wall with nodes at a distance is not translated", "OFFSET")
    sid, without = int(block.raw("NSID", 0)), int(block.raw("NSIDEX", 0))
    plate = set(stack.column_of)
    held = bodies.sets.node_set(sid, block) & plate if sid else set(plate)
    held -= bodies.sets.node_set(without, block) if without else set()
    if not held:
        block.remarks.append("it holds no node of the plate: it is left out")
        return False
    if held != plate:
        block.lose(f"it stops {len(held)} of {len(plate)} nodes of the plate: all or none", "NSID")
    birth, death = float(block.raw("BIRTH", 0.0)), float(block.raw("DEATH", 0.0))
    if birth > 0.0 or 0.0 < death < 1.0e19:
        block.lose("a wall that begins late or ends early is not translated", "BIRTH", "DEATH")
    return True


def _shape(block: Block, place: Place, axis: Place) -> Shape:
    """The shape of a wall."""
    size = sqrt(sum(x * x for x in axis))
    upright = hypot(*axis[:2]) <= _STRAIGHT * size
    if block.name == "RIGIDWALL_SPHERE":
        return Shape("sphere", place, block.positive("RADSPH"))
    if size == 0.0:
        raise block.fail("XH", "head and tail of the normal are one point")
    if block.name == "RIGIDWALL_CYLINDER":
        radius, length = block.positive("RADCYL"), block.number("LENCYL", 0.0)
        if upright:
            return Shape("cylinder", place, radius, length or size)
        if abs(axis[2]) > _STRAIGHT * size or length <= 0.0:
            raise block.fail(
                "ZH", "a cylinder must stand upright or lie along the plate, with a length"
            )
        unit = tuple(x / size for x in axis)
        middle = triple(a + 0.5 * length * u for a, u in zip(place, unit, strict=True))
        return Shape("bar", middle, radius, length, axis=(unit[0], unit[1], 0.0))
    if not upright:
        raise block.fail("ZH", "the normal of a flat wall must be along z")
    block.mark(TAKEN, "the wall is along the plate", "ZHEV")
    sides = (block.number("LENL", 0.0), block.number("LENM", 0.0))
    if 0.0 in sides:
        return Shape("plane", place, 0.0)
    edge = tuple(block.number(n, 0.0) - p for n, p in zip(("XHEV", "YHEV"), place, strict=False))
    length = hypot(*edge)
    if length == 0.0 or min(abs(edge[0]), abs(edge[1])) > _STRAIGHT * length:
        raise block.fail("XHEV", "the edge of a flat wall must be along x or y")
    along, across = (x / length for x in edge), sides
    u = tuple(along)
    corner = (u[0] * across[0] - u[1] * across[1], u[1] * across[0] + u[0] * across[1])
    if axis[2] < 0.0:
        corner = (u[0] * across[0] + u[1] * across[1], u[1] * across[0] - u[0] * across[1])
    middle = (place[0] + 0.5 * corner[0], place[1] + 0.5 * corner[1], place[2])
    return Shape("punch", middle, 0.0, sides=(abs(corner[0]), abs(corner[1])))


def _motion(model: Model, block: Block) -> tuple[dict[str, Points], int]:
    """The curves of a wall that moves, and what they give."""
    if not block.has("LCID"):
        return {}, 0
    block.mark(TAKEN, "the curves of motion of the body", "LCID", "OPT", "VX", "VY", "VZ")
    points = model.history(block, block.whole("LCID"), block.line_of("LCID"))
    option = block.whole("OPT", 0)
    if option not in (0, 1):
        raise block.fail("OPT", f"{option} is not translated; 0 and 1 are", block.line_of("OPT"))
    along = [block.number(name, 0.0) for name in ("VX", "VY", "VZ")]
    size = sqrt(sum(x * x for x in along))
    if size == 0.0:
        raise block.fail("VX", "the wall has no direction of motion", block.line_of("LCID"))
    curves = {
        axis: [(t, value * x / size) for t, value in points]
        for axis, x in zip("xyz", along, strict=True)
        if x
    }
    return curves, 2 if option == 1 else 0
