"""Velocities at time zero in every form that LS-DYNA has for them."""

from __future__ import annotations

from dataclasses import dataclass, field

from plydyn_pre.translate.block import TAKEN, Block, Row
from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.elements import Body
from plydyn_pre.translate.frames import along, axes_of
from plydyn_pre.translate.model import Model, Place, triple

_AXES = ("VX", "VY", "VZ")
_TURNS = ("VXR", "VYR", "VZR")


@dataclass
class Velocities:
    """Velocities of nodes and of rigid parts."""

    nodes: dict[int, Place] = field(default_factory=dict)
    parts: dict[int, Place] = field(default_factory=dict)
    where: dict[int, tuple[Block, int]] = field(default_factory=dict)  # keyword of a node's, line
    over: set[int] = field(default_factory=set)  # parts whose *PART_INERTIA it overwrites

    def of_body(self, body: Body) -> Place | None:
        """The velocity of a rigid part; its own keyword wins over that of its nodes."""
        own: Place = (0.0, 0.0, 0.0)
        if body.block.name.startswith("PART_INERTIA"):
            own = triple(body.block.number(n, 0.0) for n in ("VTX", "VTY", "VTZ"))
        if body.pid in self.parts:
            return self.parts[body.pid]
        if any(own) and body.pid not in self.over:
            return own
        found = {self.nodes[n] for n in body.nodes if n in self.nodes}
        if len(found) > 1 or (found and not body.nodes <= self.nodes.keys()):
            node = next(n for n in body.nodes if n in self.where)
            block, line = self.where[node]
            words = f"the nodes of rigid part {body.pid} have not one velocity"
            block.lose(f"{words}: rotations are not translated", line=line)
        return next(iter(found), None)


def read_velocities(model: Model, bodies: Bodies) -> Velocities:
    """All velocities at time zero; later keywords win."""
    found = Velocities()
    for block in model.find("INITIAL_VELOCITY", "INITIAL_VELOCITY_NODE"):
        with model.gathered():
            if block.name == "INITIAL_VELOCITY":
                _of_set(bodies, block, found)
            else:
                _of_nodes(model, block, found)
    for block in model.find("INITIAL_VELOCITY_GENERATION"):
        with model.gathered():
            _generated(bodies, block, found)
    rigid = {body.pid for body in bodies.rigid}
    for block in model.find("INITIAL_VELOCITY_RIGID_BODY"):
        for row in block.rows:
            velocity = _taken(model, block, row, "velocity of the impactor", "PID")
            if row.whole("PID") not in rigid:
                block.lose(f"there is no rigid part {row.whole('PID')}", "PID", line=row.line)
            found.parts[row.whole("PID")] = velocity
    return found


def _taken(model: Model, block: Block, row: Row, words: str, *names: str) -> Place:
    """The velocity of a row."""
    block.mark(TAKEN, words, *names, *_AXES)
    for name in (*_TURNS, "OMEGA"):
        if row.number(name):
            block.lose("a rotation at time zero is not translated", name, line=row.line)
    return _in_axes(model, block, row, triple(row.number(name) for name in _AXES))


def _in_axes(model: Model, block: Block, row: Row, velocity: Place) -> Place:
    """A velocity along x, y and z that is given in the system of its row."""
    block.mark(TAKEN, "the axes of the velocity", "ICID")
    cid = row.whole("ICID")
    return along(axes_of(model, block, "ICID", cid, row.line), velocity) if cid else velocity


def _put(found: Velocities, block: Block, line: int, nodes: set[int], velocity: Place) -> None:
    """Give nodes a velocity."""
    for node in nodes:
        found.nodes[node] = velocity
        found.where[node] = (block, line)


def _of_set(bodies: Bodies, block: Block, found: Velocities) -> None:
    """The velocity of a set of nodes."""
    block.mark(TAKEN, "", "NSID", "NSIDEX", "BOXID", "IRIGID")
    sid = int(block.raw("NSID", 0))
    nodes = bodies.sets.node_set(sid, block) if sid else set(bodies.nodes)
    if box := int(block.raw("BOXID", 0)):
        nodes &= bodies.sets.box(box, block)
    if without := int(block.raw("NSIDEX", 0)):
        nodes -= bodies.sets.node_set(without, block)
    blank = Row(block.line, {})
    first, row, other = (*block.rows, blank, blank, blank)[:3]
    model, row = bodies.sets.model, Row(row.line, first.values | row.values)
    velocity = _taken(model, block, row, "velocity of the impactor or of the plate")
    _put(found, block, row.line, nodes, velocity)
    block.mark(TAKEN, "velocity of the nodes of NSIDEX", "VXE", "VYE", "VZE")
    block.lose_filled("a rotation at time zero is not translated", "VXRE", "VYRE", "VZRE")
    if without:
        other = Row(other.line, first.values | other.values)
        exempted = triple(other.number(f"{name}E") for name in _AXES)
        exempted = _in_axes(model, block, other, exempted)
        _put(found, block, other.line, bodies.sets.node_set(without, block), exempted)
    if (over := int(block.raw("IRIGID", 0))) > 0:
        found.over |= bodies.sets.part_set(over, block)
    elif over < 0:
        found.over |= {body.pid for body in bodies.rigid}


def _of_nodes(model: Model, block: Block, found: Velocities) -> None:
    """Velocities of single nodes."""
    for row in block.rows:
        velocity = _taken(model, block, row, "velocity of the impactor or of the plate", "NID")
        _put(found, block, row.line, {row.whole("NID")}, velocity)


def _generated(bodies: Bodies, block: Block, found: Velocities) -> None:
    """The velocity of a set of parts, a part or a set of nodes."""
    kind, number = int(block.raw("STYP", 0)), int(block.raw("ID", 0))
    block.mark(TAKEN, "velocity of the impactor or of the plate", "ID", "STYP", "IVATN", "IRIGID")
    row = next((each for each in block.rows if "ID" in each.values or "VZ" in each.values), None)
    row = row or Row(block.line, {})
    words = "velocity of the impactor or of the plate"
    velocity = _taken(bodies.sets.model, block, row, words)
    block.lose_filled("a velocity after a dynamic relaxation is not translated", "PHASE")
    block.mark(TAKEN, "an axis without a rotation", *("XC", "YC", "ZC", "NX", "NY", "NZ"))
    sets = bodies.sets
    if kind == 3:
        _put(found, block, row.line, sets.node_set(number, block), velocity)
        return
    every = {pid for pid, _ in sets.elements.values()}
    if kind not in (0, 1, 2) or (kind == 0 and number):
        raise block.fail("STYP", f"{kind} is not translated; 1, 2 and 3 are", row.line)
    pids = {number} if kind == 2 else sets.part_set(number, block) if kind == 1 else every
    if number == 0:
        pids = every
    if missing := pids - every:
        block.lose(f"part {min(missing)} has no elements", "ID", line=row.line)
    _put(found, block, row.line, sets.nodes_of_parts(pids), velocity)
    found.over |= pids if block.raw("IRIGID", 0) else set()
