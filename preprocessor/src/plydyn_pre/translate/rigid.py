"""Rigid parts and rigid walls as impactors and fixtures."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from plydyn_pre.translate.block import IDLE, REPLACED, TAKEN, Block
from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.contacts import BONDS, Contact
from plydyn_pre.translate.elements import Body
from plydyn_pre.translate.frames import axes_of, held_along, motion_along
from plydyn_pre.translate.masses import check_masses, mass_of, note_thickness
from plydyn_pre.translate.model import CODES, Model, Place, triple
from plydyn_pre.translate.shapes import Shape, shape_of
from plydyn_pre.translate.stack import Stack
from plydyn_pre.translate.velocities import Velocities

#: CON1 that leaves motion along z, that holds all; CON2 that leaves no rotation
_ALONG_Z, _HELD = 4, 7
_NO_MASS = "a body that is held or follows a curve needs no mass"
_WEIGHTS = ("LOAD_BODY_X", "LOAD_BODY_Y", "LOAD_BODY_Z")

Points = list[tuple[float, float]]


@dataclass
class Rigid:
    """A rigid body of the new deck."""

    shape: Shape
    above: bool
    friction: tuple[float, float, float]
    mass: float = 0.0
    inertia: float = 0.0
    velocity: Place = (0.0, 0.0, 0.0)
    freedom: int = 0  # 0 free, 1 guided along z, 2 free to move but not to rotate
    moves: bool = True  # an impactor; else a fixture
    gap: float = 0.0  # of a fixture
    curves: dict[str, Points] = field(default_factory=dict)  # motion by axis
    quantity: int = 0  # what they give: 0 velocity, 1 acceleration, 2 displacement


def read_rigid(
    model: Model, bodies: Bodies, stack: Stack, contacts: list[Contact], velocities: Velocities
) -> list[Rigid]:
    """The rigid parts that touch the plate."""
    found = []
    for body in bodies.rigid:
        before = len(model.problems)
        with model.gathered():
            rigid = _rigid(model, bodies, body, stack, contacts, velocities)
            if rigid:
                found.append(rigid)
        if len(model.problems) > before:
            body.block.failed = True  # so that nothing is said of its other fields
    _check_idle(bodies, stack, contacts)
    check_masses(model, bodies)
    return found


def _check_idle(bodies: Bodies, stack: Stack, contacts: list[Contact]) -> None:
    """Tell of contacts that touch no rigid body: of plies, which their interfaces keep apart."""
    plates = {pid for layer in stack.layers for pid in layer.pids}
    rigid = {pid for body in bodies.rigid for pid in body.pids}
    for contact in contacts:
        block = contact.block
        if block.name in BONDS or contact.joins(rigid, plates):
            continue
        filled = {name for row in block.rows for name in row.values}
        if any(side.pids & rigid for side in contact.sides):
            block.lose("it joins no rigid body with the plate", "SSID", "MSID")
        words = "plies touch each other at their interfaces, and rigid bodies only the plate"
        block.mark(IDLE, words, *(filled - {"SSID", "MSID"}))


def _rigid(
    model: Model,
    bodies: Bodies,
    body: Body,
    stack: Stack,
    contacts: list[Contact],
    velocities: Velocities,
) -> Rigid | None:
    """A rigid part as a body of plydyn; None for one that touches nothing."""
    touching = _touching(model, body, stack, contacts)
    if not touching:
        return None
    friction = max(contact.friction() for contact in touching)
    material = bodies.laws[body.material]
    heights = [bodies.nodes[n][2] for n in body.nodes]
    above = 0.5 * (min(heights) + max(heights)) > stack.middle
    shape = _grown(model, body, shape_of(body, bodies.nodes, above), above, touching)
    curves, quantity = _motion(model, body)
    velocity = velocities.of_body(body)
    held = _held(model, material)
    rigid = Rigid(shape, above, friction)
    rigid.curves, rigid.quantity = curves, quantity
    if body.block.name.startswith("PART_INERTIA"):
        words = "a rotation at time zero is not translated"
        body.block.lose_filled(words, "VRX", "VRY", "VRZ")
    if held == (_HELD, _HELD) and not curves:
        _fixed(body, rigid, velocity)
    else:
        _moving(model, bodies, body, rigid, velocity)
    rigid.gap = gap_of(shape, above, stack)
    words = f"{len(body.elements)} elements as a {shape.words()}"
    kind = "an impactor" if rigid.moves else "a fixture"
    model.notes.append(
        f"part {body.pid}: {words}, {kind}; its nodes lie within {shape.off:.2g} of it"
    )
    if shape.wider:
        model.notes.append(f"part {body.pid} is wider above its face: its edges are taken as sharp")
    body.block.mark(REPLACED, words, "PID", "SECID", "MID", "TITLE")
    material.mark(REPLACED, words, "MID")
    if "RO" not in material.fates:  # no mass was asked for
        material.mark(IDLE, _NO_MASS, "RO")
        body.block.mark(IDLE, _NO_MASS, "TM")
    if rigid.moves:
        rigid.shape = _lifted(rigid, stack, model.notes)
    return rigid


def _touching(model: Model, body: Body, stack: Stack, contacts: list[Contact]) -> list[Contact]:
    """The contacts of a body with the plate; one that has none is left out."""
    plates = {pid for layer in stack.layers for pid in layer.pids}
    found = [
        contact
        for contact in contacts
        if contact.block.name not in BONDS and contact.joins(body.pids, plates)
    ]
    if not found:
        words = f"rigid part {body.pid} is in no contact with the plate: it is left out"
        model.notes.append(f"{words} (line {body.block.line})")
        body.block.mark(IDLE, words, *(n for row in body.block.rows for n in row.values))
    return found


def _grown(model: Model, body: Body, shape: Shape, above: bool, touching: list[Contact]) -> Shape:
    """The shape grown by half the contact thickness of its shells."""
    if body.kind != "shell" or shape.kind not in ("sphere", "tup", "bar"):
        return shape
    thickness = 0.0
    if body.block.name.endswith("_CONTACT"):
        thickness = body.block.number("OPTT", 0.0)
    for contact in touching:
        sides = zip(("SST", "MST"), contact.sides, strict=True)
        for name, side in sides:
            if body.pids & side.pids:
                thickness = max(thickness, abs(contact.block.number(name, 0.0)))
    if thickness <= 0.0:
        note_thickness(model, body, [contact.block.written for contact in touching])
        return shape
    words = f"part {body.pid}: its radius is grown by {thickness / 2:g}, half its contact thickness"
    model.notes.append(words)
    return replace(shape, radius=shape.radius + thickness / 2.0)


def _held(model: Model, material: Block) -> tuple[int, int]:
    """What CON1 and CON2 hold."""
    material.mark(TAKEN, "", "CMO", "CON1", "CON2")
    bound = float(material.raw("CMO", 0.0))
    if bound == -1.0:
        return _held_in_system(model, material)
    if bound not in (0.0, 1.0):
        raise material.fail("CMO", f"{bound:g} is none of -1, 0 and 1", material.line_of("CMO"))
    if bound == 0.0:
        return 0, 0
    return int(float(material.raw("CON1", 0.0))), int(float(material.raw("CON2", 0.0)))


def _held_in_system(model: Model, material: Block) -> tuple[int, int]:
    """What the six digits of CON2 hold along and about the axes of the system CON1."""
    line = material.line_of("CON1")
    axes = axes_of(model, material, "CON1", int(float(material.raw("CON1", 0.0))), line)
    digits = f"{int(float(material.raw('CON2', 0.0))):06d}"
    found = []
    for own in (digits[:3], digits[3:]):
        held = held_along(axes, "".join(n for n, d in zip("xyz", own, strict=True) if d == "1"))
        if held is None or len(digits) != 6 or set(digits) - {"0", "1"}:
            words = f"{digits} in this system: such axes or digits are not translated"
            raise material.fail("CON2", words, line)
        found.append(CODES[held])
    return found[0], found[1]


def _motion(model: Model, body: Body) -> tuple[dict[str, Points], int]:
    """The curves that a part follows along x, y and z, and what they give."""
    curves: dict[str, Points] = {}
    quantities: set[int] = set()
    for block in model.find("BOUNDARY_PRESCRIBED_MOTION_RIGID"):
        for row in block.rows:
            if row.whole("PID") != body.pid:
                continue
            names = ("PID", "DOF", "VAD", "LCID", "SF", "DEATH", "BIRTH")
            block.mark(TAKEN, "the curves of motion of the body", *names)
            if (motion := motion_along(model, block, row)) is None:
                continue
            if row.number("BIRTH") > 0.0 or 0.0 < row.number("DEATH") < model.end:
                words = "a motion of a rigid body that begins late or ends early is not translated"
                block.lose(words, "BIRTH", "DEATH", line=row.line)
            points = model.history(block, row.whole("LCID"), row.line)
            axis, scale = motion
            if axis in curves:
                block.lose(f"a second motion along {axis} is not translated", "DOF", line=row.line)
            curves[axis] = [(t, scale * value) for t, value in points]
            quantities.add(row.whole("VAD"))
            if len(quantities) > 1:
                block.lose(
                    "one VAD for all directions of a body is translated", "VAD", line=row.line
                )
    return curves, min(quantities, default=0)


def _moving(model: Model, bodies: Bodies, body: Body, rigid: Rigid, velocity: Place | None) -> None:
    """An impactor."""
    material, shape = bodies.laws[body.material], rigid.shape
    held, turned = _held(model, material)
    if shape.kind not in ("sphere", "tup", "cylinder", "cone", "bar"):
        if not rigid.curves or rigid.quantity != 2:
            words = f"a {shape.kind} of rigid part {body.pid} is no impactor"
            more = "spheres, tups, cones and cylinders are; CON1 7 and CON2 7 make a fixture"
            raise body.block.fail("PID", f"{words}; {more}")
        rigid.moves = False
        return
    rigid.mass = mass_of(model, bodies, body, material)
    if not any(velocity or ()) and not rigid.curves and model.first(*_WEIGHTS) is None:
        model.notes.append(f"part {body.pid} does not move at time zero, and nothing moves it")
    given = velocity or (0.0, 0.0, 0.0)
    rigid.velocity = triple(
        0.0 if axis in rigid.curves else v for axis, v in zip("xyz", given, strict=True)
    )
    if not rigid.curves and rigid.velocity[2] * (1.0 if rigid.above else -1.0) > 0.0:
        model.notes.append(f"part {body.pid} moves away from the plate at time zero")
    _check_held(material, held, rigid)
    guided = held in (_ALONG_Z, _HELD)
    straight = rigid.velocity[:2] == (0.0, 0.0) and not {"x", "y"} & set(rigid.curves)
    if guided and straight:
        rigid.freedom = 1
    elif turned == _HELD or shape.kind != "sphere":
        rigid.freedom = 2
    if rigid.freedom == 0 and body.block.name.startswith("PART_INERTIA"):
        rigid.inertia = body.block.number("IXX", 0.0)
    if turned != _HELD and (shape.kind != "sphere" or rigid.freedom == 1):
        words = "guided ones do not" if rigid.freedom == 1 else "spheres do"
        model.notes.append(f"part {body.pid} does not rotate: of plydyn's impactors {words}")


def _check_held(material: Block, held: int, rigid: Rigid) -> None:
    """Refuse directions that plydyn cannot hold alone, where the body moves along others."""
    if held == _ALONG_Z and any(rigid.velocity[:2]):
        words = "it holds x and y, along which the body has a velocity at time zero"
        material.lose(words, "CON1", line=material.line_of("CON1"))
    if held in (0, _ALONG_Z):
        return
    if held == _HELD and set(rigid.curves) == {"z"}:
        return
    words = f"{held} is not translated; 0 and 4 are, and 7 for a fixture"
    material.lose(words, "CON1", line=material.line_of("CON1"))


def _fixed(body: Body, rigid: Rigid, velocity: Place | None) -> None:
    """A fixture; a body that plydyn has as impactor only stands still on a curve."""
    rigid.moves = False
    if velocity and any(velocity):
        body.block.remarks.append("held in all directions, so that its velocity has no effect")
    if rigid.shape.kind in ("sphere", "tup", "cone"):
        rigid.moves, rigid.freedom, rigid.mass = True, 1, 1.0
        rigid.curves, rigid.quantity = {"z": [(0.0, 0.0), (1.0, 0.0)]}, 2


def gap_of(shape: Shape, above: bool, stack: Stack) -> float:
    """Distance of a fixture from the face that it meets."""
    level = shape.centre[2]
    if shape.kind == "bar":
        level += -shape.radius if above else shape.radius
    return max(0.0, level - stack.top if above else stack.bottom - level)


def _lifted(rigid: Rigid, stack: Stack, notes: list[str]) -> Shape:
    """The shape, moved out of the plate where it begins inside."""
    shape = rigid.shape
    x, y, z = shape.centre
    reach = reach_of(shape)
    least = stack.top + reach if rigid.above else stack.bottom - reach
    inside = least - z if rigid.above else z - least
    if inside <= 0.0:
        return shape
    if inside > 1e-6 * max(shape.radius, stack.thickness):
        notes.append(f"the impactor began {inside:.3g} inside the plate; it begins at its face")
    return replace(shape, centre=(x, y, least))


def reach_of(shape: Shape) -> float:
    """Distance from its place to the point of a shape that is nearest to the plate."""
    if shape.kind == "cone":
        slant = np.radians(shape.angle)
        whole = shape.radius / np.tan(slant)
        return float(whole - shape.tip * (1.0 / np.sin(slant) - 1.0))
    return shape.radius if shape.kind in ("sphere", "tup", "bar") else 0.0
