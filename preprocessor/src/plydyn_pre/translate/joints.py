"""What joins the parts of a stack."""

from __future__ import annotations

from dataclasses import dataclass

from plydyn_pre.study import Cohesive
from plydyn_pre.translate.bodies import Bodies, find
from plydyn_pre.translate.plies import cohesive_material, tiebreak_material
from plydyn_pre.translate.reader import LOST, REPLACED, TAKEN, Block
from plydyn_pre.translate.stack import Layer, Stack


@dataclass(frozen=True)
class Joint:
    """An interface of the laminate; a law of None leaves the faces apart."""

    interface: int  # counted from the bottom, from 1
    law: Cohesive | None


def read_joints(
    bodies: Bodies, blocks: list[Block], known: dict[int, Block], stack: Stack, notes: list[str]
) -> list[Joint]:
    """The interfaces between the parts of a stack that are not tied."""
    joints, below = [], 0
    for number, layer in enumerate(stack.layers[:-1]):
        above = stack.layers[number + 1]
        below += len(layer.body.plies)
        if layer.body.nodes & above.body.nodes:
            continue
        law, tied = _law(bodies, blocks, known, layer, above)
        if tied:
            notes.append(f"plies {below} and {below + 1} are tied, as the contact says")
            continue
        if law is None:
            notes.append(f"nothing joins plies {below} and {below + 1}: they are apart")
        joints.append(Joint(below, law))
    _mark_cohesive(bodies)
    return joints


def _law(
    bodies: Bodies, blocks: list[Block], known: dict[int, Block], below: Layer, above: Layer
) -> tuple[Cohesive | None, bool]:
    """The law of an interface, and whether it is tied."""
    for body in bodies.cohesive:
        heights = [bodies.nodes[n][2] for n in body.nodes]
        middle = 0.5 * (min(heights) + max(heights))
        low, high = 0.5 * (below.bottom + below.top), 0.5 * (above.bottom + above.top)
        if low <= middle <= high:
            return cohesive_material(known[body.material]), False
    for block in find(blocks, "CONTACT_TIEBREAK"):
        if _names(block, blocks, below.body.pid) and _names(block, blocks, above.body.pid):
            words = "*INTERFACE_COHESIVE between the plies of the two parts"
            block.mark(REPLACED, words, "SSID", "MSID", "SSTYP", "MSTYP")
            block.mark(LOST, "no friction of these faces: FRIC of *INTERFACE_COHESIVE", "FS", "FD")
            modulus = min(_modulus(known, layer) for layer in (below, above))
            thin = min(below.body.thickness, above.body.thickness)
            return tiebreak_material(block, modulus, thin), False
    for block in find(blocks, "CONTACT"):
        tied = block.written.startswith("CONTACT_TIED")
        both = _names(block, blocks, below.body.pid) and _names(block, blocks, above.body.pid)
        if tied and both:
            block.mark(REPLACED, "the plies share their points", "SSID", "MSID", "SSTYP", "MSTYP")
            return None, True
    return None, False


def _names(block: Block, blocks: list[Block], pid: int) -> bool:
    """Whether a contact names a part; 0 names all."""
    for side, kind in (("SSID", "SSTYP"), ("MSID", "MSTYP")):
        number, how = block.raw(side, 0), block.raw(kind, 0)
        if number == 0 or (how == 3 and number == pid):
            return True
        if how == 2 and pid in _parts_of(blocks, int(number)):
            return True
    return False


def _parts_of(blocks: list[Block], sid: int) -> set[int]:
    """The parts of a set."""
    for block in find(blocks, "SET_PART_LIST"):
        if block.raw("SID") == sid:
            names = [f"PID{n}" for n in range(1, 9)]
            block.mark(TAKEN, "", "SID", *names)
            return {int(row.values[n]) for row in block.rows for n in names if n in row.values}
    return set()


def _modulus(known: dict[int, Block], layer: Layer) -> float:
    """The modulus through the thickness of a part."""
    mid = layer.body.plies[0].material
    if mid not in known:
        raise layer.body.block.fail("MID1", f"there is no material {mid}")
    block = known[mid]
    for name in ("EC", "EB", "E"):
        if block.has(name) and float(block.raw(name)) > 0.0:
            return float(block.raw(name))
    raise block.fail("EC", "missing; the stiffness of a tiebreak needs it")


def _mark_cohesive(bodies: Bodies) -> None:
    """Elements of cohesive layers are interfaces now."""
    for body in bodies.cohesive:
        words = f"{len(body.elements)} elements: *INTERFACE_COHESIVE between the plies they join"
        body.block.mark(REPLACED, words, "PID", "SECID", "MID", "HEADING")
