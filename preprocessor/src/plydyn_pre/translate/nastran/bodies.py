"""Rigid bodies of a file of bulk data: RBE2 over a whole body, or a property of MATRIG."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from plydyn_pre.translate.block import Value
from plydyn_pre.translate.masses import area, volume
from plydyn_pre.translate.model import CODES
from plydyn_pre.translate.nastran.lines import Card
from plydyn_pre.translate.nastran.mesh import Element, Mesh
from plydyn_pre.translate.nastran.parts import law_of, mass_factor, put_elements

_NAMES = {"PID": "GN", "RO": "mass", "TM": "mass", "CON1": "SPC"}


@dataclass
class RigidBody:
    """A rigid body."""

    card: Card  # RBE2 or MATRIG
    pid: int
    elements: list[Element]
    reference: set[int]  # nodes by which it is held and moved
    held: set[int] = field(default_factory=set)  # directions 1 to 6

    @property
    def nodes(self) -> set[int]:
        """Nodes of all elements."""
        return {nid for element in self.elements for nid in element.nodes}


def read_rigid_bodies(mesh: Mesh) -> list[RigidBody]:
    """The rigid bodies of a file."""
    found = []
    for card in mesh.deck.each("RBE2"):
        with mesh.source.gathered():
            found.append(_tied(mesh, card))
    rigid = {element.number for body in found for element in body.elements}
    for card in mesh.deck.each("PSHELL", "PSOLID"):
        name = "MID1" if card.name == "PSHELL" else "MID"
        with mesh.source.gathered():
            law = law_of(mesh, card, name, card.whole(name, None))
            members = mesh.of_part(card.whole("PID"))
            if law.name == "MATRIG" and members and members[0].number not in rigid:
                nodes = {nid for element in members for nid in element.nodes}
                found.append(RigidBody(law, card.whole("PID"), members, nodes))
    return found


def _tied(mesh: Mesh, card: Card) -> RigidBody:
    """The body of an RBE2, whose dependent nodes are those of whole elements."""
    if set(card.word("CM")) != set("123456"):
        raise card.fail("CM", f"{card.word('CM')} is not translated: 123456 is")
    nodes = {mesh.check(card, "GM", nid) for nid in card.ids(3)}
    chosen = nodes | {mesh.check(card, "GN", card.whole("GN", None))}
    members = [each for each in mesh.elements.values() if set(each.nodes) <= chosen]
    if not members or nodes - {nid for each in members for nid in each.nodes}:
        words = "its nodes are not those of whole elements: RBE2 over a rigid body is translated"
        raise card.fail("GM", words)
    if any(each.pid == members[0].pid and each not in members for each in mesh.elements.values()):
        raise card.fail("GM", f"it holds a part of the elements of property {members[0].pid} only")
    return RigidBody(card, members[0].pid, members, {card.whole("GN")})


def put_rigid_bodies(mesh: Mesh, bodies: list[RigidBody]) -> None:
    """Add the rigid bodies; what holds them is known by now. Refuse masses of others."""
    rigid = {nid for body in bodies for nid in body.reference | body.nodes}
    for card in mesh.deck.each("CONM2"):
        if card.whole("G") not in rigid:
            card.lose("a mass that is added to no rigid body is not translated", "G")
    for body in bodies:
        with mesh.source.gathered():
            _put(mesh, body)


def _put(mesh: Mesh, body: RigidBody) -> None:
    """Add a rigid body."""
    mid = mesh.source.number("MAT", ("rigid", body.pid))
    held = ("".join(a for n, a in enumerate("xyz", start=s) if n in body.held) for s in (1, 4))
    codes = [CODES[word] for word in held]
    card: dict[str, Value] = {"CMO": 1.0, "CON1": float(codes[0]), "CON2": float(codes[1])}
    by: dict[str, Any] = {"line": body.card.line, "names": _NAMES}
    mesh.source.put("MAT_RIGID", body.card.block, {"MID": mid} | card, **by)
    mass, inertia = _mass(mesh, body)
    weight: dict[str, Value] = {"TM": mass, "IXX": inertia} if mass > 0.0 or codes != [7, 7] else {}
    mesh.source.put("PART_INERTIA", body.card.block, {"PID": body.pid, "MID": mid, **weight}, **by)
    put_elements(mesh, body.elements, body.pid)


def _mass(mesh: Mesh, body: RigidBody) -> tuple[float, float]:
    """Mass and moment of inertia: those of CONM2, of MATRIG, and of densities."""
    mass = inertia = 0.0
    for card in mesh.deck.each("CONM2"):
        if card.whole("G") in body.reference | body.nodes:
            mass += card.number("M")
            inertia += card.number("I11")
    if body.card.name == "MATRIG" and body.card.number("MASS"):
        mass += body.card.number("MASS")
    else:
        mass += sum(_own_mass(mesh, element) for element in body.elements)
    factor = mass_factor(mesh)
    return float(f"{mass * factor:.6g}"), inertia * factor


def _own_mass(mesh: Mesh, element: Element) -> float:
    """The mass of an element by its density."""
    places = [mesh.nodes[n] for n in element.corners()]
    for card in mesh.deck.each("PSHELL", "PSOLID"):
        if card.whole("PID") == element.pid:
            shell = card.name == "PSHELL"
            law = law_of(mesh, card, "MID1", card.whole("MID1" if shell else "MID", None))
            size = area(places) * card.number("T") if shell else volume(places)
            return law.number("RHO") * size
    return 0.0
