"""Rigid bodies of an Abaqus file: their elements, mass, supports and motion."""

from __future__ import annotations

from dataclasses import dataclass, field

from plydyn_pre.translate.abaqus.lines import Keyword
from plydyn_pre.translate.abaqus.materials import Materials
from plydyn_pre.translate.abaqus.mesh import Element, Mesh
from plydyn_pre.translate.abaqus.profiles import put_surface
from plydyn_pre.translate.abaqus.sections import put_elements
from plydyn_pre.translate.masses import area, volume
from plydyn_pre.translate.model import CODES

_NAMES = {"PID": "ELSET", "RO": "mass at the reference node", "TM": "mass", "CON1": "*BOUNDARY"}


@dataclass
class RigidBody:
    """A rigid body."""

    keyword: Keyword
    pid: int
    elements: list[Element]
    reference: set[int]  # its reference node, and all that lie on it
    surfaces: set[str] = field(default_factory=set)  # analytical ones
    held: set[int] = field(default_factory=set)  # directions 1 to 6
    moved: set[int] = field(default_factory=set)

    @property
    def nodes(self) -> set[int]:
        """Nodes of all elements."""
        return {nid for element in self.elements for nid in element.nodes}


def read_rigid_bodies(mesh: Mesh) -> list[RigidBody]:
    """The rigid bodies of a file."""
    found = []
    for keyword in mesh.each("RIGID BODY"):
        with mesh.source.gathered():
            found.append(_body(mesh, keyword))
    return found


def _body(mesh: Mesh, keyword: Keyword) -> RigidBody:
    """A rigid body with its elements."""
    line = keyword.block.line
    pid = mesh.source.number("PART", ("rigid", keyword.space, keyword.block))
    body = RigidBody(
        keyword, pid, [], set(mesh.node_ids(keyword, keyword.option("REF NODE"), line))
    )
    if name := keyword.options.get("ANALYTICAL SURFACE"):
        surface = mesh.surface(keyword, name, line)
        body.surfaces.add(name.upper())
        body.elements += put_surface(mesh, surface.keyword)
    if name := keyword.options.get("ELSET"):
        chosen = mesh.element_ids(keyword, name, line)
        body.elements += [mesh.elements[n] for n in chosen if mesh.elements[n].kind != "point"]
    if not body.elements:
        raise keyword.fail("ELSET", "the body has no elements and no analytical surface")
    return body


def put_rigid_bodies(mesh: Mesh, materials: Materials, bodies: list[RigidBody]) -> None:
    """Add the rigid bodies; what holds and moves them is known by now."""
    for body in bodies:
        with mesh.source.gathered():
            _put(mesh, materials, body)


def _put(mesh: Mesh, materials: Materials, body: RigidBody) -> None:
    """Add a rigid body."""
    by, put = body.keyword.block, mesh.source.put
    mid = mesh.source.number("MAT", ("rigid", body.pid))
    held = ("".join(a for n, a in enumerate("xyz", start=s) if n in body.held) for s in (1, 4))
    codes = [CODES[word] for word in held]
    card = {"CMO": 1.0, "CON1": float(codes[0]), "CON2": float(codes[1])}
    put("MAT_RIGID", by, {"MID": mid, **card}, names=_NAMES)
    inertia = _inertia(mesh, body)
    mass = _point_mass(mesh, body) + _own_mass(mesh, materials, body)
    fixed = codes == [7, 7] and not body.moved
    weight = {"TM": mass} if mass > 0.0 or not fixed else {}
    put("PART_INERTIA", by, {"PID": body.pid, "MID": mid, "IXX": inertia} | weight, names=_NAMES)
    put_elements(mesh, body.elements, body.pid)


def _point_mass(mesh: Mesh, body: RigidBody) -> float:
    """The masses at its reference node and on its nodes."""
    total, own = 0.0, body.reference | body.nodes
    for keyword in mesh.each("MASS"):
        ids = mesh.element_ids(keyword, keyword.option("ELSET"), keyword.block.line)
        each = keyword.all_numbers("", 1)[0]
        total += each * sum(set(mesh.elements[eid].nodes) <= own for eid in ids)
    return total


def _inertia(mesh: Mesh, body: RigidBody) -> float:
    """The moment of inertia at its reference node; that of a ball is the same about all axes."""
    for keyword in mesh.each("ROTARY INERTIA"):
        ids = mesh.element_ids(keyword, keyword.option("ELSET"), keyword.block.line)
        if any(set(mesh.elements[eid].nodes) <= body.reference for eid in ids):
            return keyword.all_numbers("", 1)[0]
    return 0.0


def _own_mass(mesh: Mesh, materials: Materials, body: RigidBody) -> float:
    """The mass of its elements: density of their section, times volume or area and thickness."""
    mine = {element.number: element for element in body.elements}
    total = 0.0
    for keyword in mesh.each("SHELL SECTION", "SOLID SECTION"):
        line = keyword.block.line
        ids = mesh.element_ids(keyword, keyword.option("ELSET"), line)
        elements = [mine[eid] for eid in ids if eid in mine]
        if not elements:
            continue
        name = keyword.option("MATERIAL")
        density = materials.find(keyword, name, line).numbers("DENSITY", 1)[0]
        places = [[mesh.nodes[n] for n in element.corners()] for element in elements]
        if elements[0].kind == "shell":
            thickness = keyword.all_numbers("thickness", 1)[0]
            total += density * thickness * sum(map(area, places))
        else:
            total += density * sum(map(volume, places))
    return float(f"{total:.6g}")
