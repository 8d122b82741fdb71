"""What joins the parts of a stack."""

from __future__ import annotations

from dataclasses import dataclass

from plydyn_pre.translate.block import IDLE, REPLACED, Block
from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.bonds import Bond, cohesive_material, tiebreak_material
from plydyn_pre.translate.contacts import BONDS, Contact
from plydyn_pre.translate.laws import modulus_across
from plydyn_pre.translate.model import Model
from plydyn_pre.translate.stack import Layer, Stack


@dataclass(frozen=True)
class Joint:
    """An interface of the laminate; a law of None leaves the faces apart."""

    interface: int  # counted from the bottom, from 1
    law: Bond | None
    friction: float = 0.0  # of failed faces


def read_joints(model: Model, bodies: Bodies, stack: Stack, contacts: list[Contact]) -> list[Joint]:
    """The interfaces between the parts of a stack that are not tied."""
    joints: list[Joint] = []
    below, joined = 0, set()
    for number, layer in enumerate(stack.layers[:-1]):
        above = stack.layers[number + 1]
        below += len(layer.plies)
        with model.gathered():
            if layer.nodes & above.nodes:
                _check_gap(layer, above)
                continue
            joint, block = _joint(model, bodies, contacts, (layer, above), below)
            joined.add(block)
            if joint and joint.law is None:
                model.notes.append(f"nothing joins plies {below} and {below + 1}: they are apart")
            joints += [joint] if joint else []
    for block in [each.block for each in contacts if each.block.name in BONDS]:
        if block not in joined and not block.failed:
            block.lose("joins no two neighbours of the stack of plies", "SSID", "MSID")
    for body in bodies.cohesive:
        if body.block in joined:
            words = (
                f"{len(body.elements)} elements: *INTERFACE_COHESIVE between the plies they join"
            )
            body.block.mark(REPLACED, words, "PID", "SECID", "MID", "TITLE")
        else:
            body.block.lose(f"the cohesive part {body.pid} lies between no two plies", "PID")
    return joints


def _check_gap(below: Layer, above: Layer) -> None:
    """Refuse two layers that share nodes and do not touch."""
    gap = above.bottom - below.top
    if abs(gap) > 0.05 * min(below.top - below.bottom, above.top - above.bottom):
        words = f"part {above.body.pid} shares nodes with part {below.body.pid}, {gap:.3g} from it"
        raise above.body.block.fail("PID", words)


def _joint(
    model: Model,
    bodies: Bodies,
    contacts: list[Contact],
    pair: tuple[Layer, Layer],
    number: int,
) -> tuple[Joint | None, Block | None]:
    """The interface of two layers, none for tied ones, and the keyword that joins them."""
    below, above = pair
    low, high = 0.5 * (below.bottom + below.top), 0.5 * (above.bottom + above.top)
    for body in bodies.cohesive:
        heights = [bodies.nodes[n][2] for n in body.nodes]
        if low <= 0.5 * (min(heights) + max(heights)) <= high:
            _check_cover(body.block, "PID", len(body.elements), below)
            law = cohesive_material(model, bodies.laws[body.material])
            return Joint(number, law), body.block
    for contact in contacts:
        block = contact.block
        if block.name not in BONDS or not contact.joins(below.pids, above.pids):
            continue
        _check_sides(contact, below, above)
        if block.name == "CONTACT_TIED" or _sticks(block):
            model.notes.append(f"plies {number} and {number + 1} are tied, as the contact says")
            return None, block
        law = _bond(model, bodies, block, below, above)
        return Joint(number, law, _friction(block)), block
    return Joint(number, None), None


def _sticks(block: Block) -> bool:
    """Whether a tiebreak contact never breaks."""
    if block.name != "CONTACT_TIEBREAK" or abs(int(block.raw("OPTION", 0))) != 1:
        return False
    block.mark(REPLACED, "1: what touches sticks for ever", "OPTION")
    rest = ("NFLS", "SFLS", "PARAM", "ERATEN", "ERATES", "CT2CN", "CN", "FS", "FD")
    block.mark(IDLE, "of a bond that breaks", *rest)
    return True


def _check_sides(contact: Contact, below: Layer, above: Layer) -> None:
    """Refuse a contact that joins a part of the faces only."""
    for side in contact.sides:
        if side.faces:
            _check_cover(contact.block, "SSID", side.faces, below)
            continue
        nodes = below.nodes if side.nodes is None else side.nodes
        if not (below.nodes <= nodes or above.nodes <= nodes):
            missing = len((below.nodes | above.nodes) - nodes)
            words = f"{missing} nodes of the faces are not in its set: a bond of a part"
            contact.block.lose(f"{words} of a face is not translated", "SSID")


def _check_cover(block: Block, name: str, count: int, layer: Layer) -> None:
    """Refuse a bond over a part of the faces of a layer."""
    if count < len(layer.quads):
        words = f"it joins {count} of {len(layer.quads)} faces: a bond of a part of a face is not"
        block.lose(f"{words} translated; *INITIAL_DELAMINATION of plydyn opens the rest", name)


def _bond(model: Model, bodies: Bodies, block: Block, below: Layer, above: Layer) -> Bond:
    """The law of a tiebreak contact."""
    words = "*INTERFACE_COHESIVE between the plies of the two parts"
    block.mark(REPLACED, words, "SSID", "MSID", "SSTYP", "MSTYP")
    modulus = min(_modulus(bodies, layer) for layer in (below, above))
    thin = min(layer.top - layer.bottom for layer in (below, above))
    return tiebreak_material(model, block, modulus, thin)


def _friction(block: Block) -> float:
    """Friction of the failed faces."""
    block.mark(REPLACED, "FRIC of *INTERFACE_COHESIVE, for failed faces", "FS")
    block.mark(IDLE, "the friction of failed faces is FS at any speed", "FD", "DC")
    return max(0.0, float(block.raw("FS", 0.0)))


def _modulus(bodies: Bodies, layer: Layer) -> float:
    """The modulus through the thickness of a part."""
    mid = layer.plies[0].material
    if mid not in bodies.laws:
        raise layer.body.block.fail("MID1", f"there is no material {mid}")
    if modulus := modulus_across(bodies.laws[mid]):
        return modulus
    raise bodies.laws[mid].fail("EC", "missing; the stiffness of a tiebreak needs it")
