"""Mass of rigid parts: of their elements, and added to their nodes or to them as a whole."""

from __future__ import annotations

import numpy as np

from plydyn_pre.translate.block import IDLE, REPLACED, TAKEN, Block, Row
from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.elements import Body
from plydyn_pre.translate.model import Model, Place

#: The five tetrahedra of a brick
_TETS = ((0, 1, 3, 4), (1, 2, 3, 6), (1, 3, 4, 6), (3, 4, 6, 7), (1, 4, 5, 6))
#: Parts of the names of contacts that begin at the faces of shells
_OUTSIDE = ("AUTOMATIC", "SINGLE_SURFACE", "GENERAL")
_ADDED = ("ELEMENT_MASS", "ELEMENT_MASS_PART")


def mass_of(model: Model, bodies: Bodies, body: Body, material: Block) -> float:
    """Mass of a rigid part."""
    inertia = body.block.name.startswith("PART_INERTIA")
    if body.shares and not inertia:
        return sum(mass_of(model, bodies, each, bodies.laws[each.material]) for each in body.shares)
    material.mark(TAKEN, "density of the impactor", "RO")
    if inertia and body.block.has("TM"):
        mass = body.block.positive("TM")
    else:
        mass = float(f"{material.positive('RO') * _volume(model, bodies, body):.6g}")
    for block in model.find(*_ADDED):
        for row in block.rows:
            if not _is_on(block, row, body):
                continue
            if inertia:
                block.lose("the mass of *PART_INERTIA is TM alone", "PID", line=row.line)
            elif row.whole("LCID"):
                block.lose("a mass that varies over time is not translated", "LCID", line=row.line)
            block.mark(REPLACED, "mass of the impactor", *(n for n in row.values))
            mass = row.number("FINMASS") or mass + row.number("ADDMASS") + row.number("MASS")
    return float(f"{mass:.12g}")


def _is_on(block: Block, row: Row, body: Body) -> bool:
    """Whether a mass is added to a part or to a node of it."""
    if block.name == "ELEMENT_MASS_PART":
        return row.whole("PID") in body.pids
    return row.whole("NID") in body.nodes


def check_masses(model: Model, bodies: Bodies) -> None:
    """Refuse masses that are added to the plate."""
    for block in model.find(*_ADDED):
        names = sorted({name for row in block.rows for name in row.values} - block.fates.keys())
        block.mark(IDLE, "of a rigid body that touches nothing", *names)
        for row in block.rows:
            if not any(_is_on(block, row, body) for body in bodies.rigid):
                words = "a mass that is added to no rigid body is not translated"
                block.lose(words, "PID" if "PART" in block.name else "NID", line=row.line)


def _volume(model: Model, bodies: Bodies, body: Body) -> float:
    """Volume of the elements of a part."""
    elements = [[bodies.nodes[n] for n in element.nodes] for element in body.elements]
    if body.kind != "shell":
        return sum(map(volume, elements))
    secid = body.block.whole("SECID")
    for section in model.find("SECTION_SHELL"):
        if section.raw("SECID", 0) == secid:
            section.mark(REPLACED, "only for the mass of the rigid body", "SECID")
            return sum(map(area, elements)) * section.positive("T1")
    raise body.block.fail("SECID", f"there is no *SECTION_SHELL {secid}")


def note_thickness(model: Model, body: Body, contacts: list[str]) -> None:
    """Tell of the thickness of rigid shells, at half of which a contact of LS-DYNA begins."""
    secid = int(body.block.raw("SECID", 0))
    section = next((b for b in model.find("SECTION_SHELL") if b.raw("SECID", 0) == secid), None)
    thickness = float(section.raw("T1", 0.0)) if section else 0.0
    if thickness > 0.0 and any(word in name for name in contacts for word in _OUTSIDE):
        words = f"contact is at its shells, in LS-DYNA {thickness / 2.0:g} outside of them (T1)"
        model.notes.append(f"part {body.pid}: {words}; SST, MST or OPTT is taken where it is given")


def volume(corners: list[Place]) -> float:
    """Volume of a brick."""
    p = np.array(corners)
    return float(sum(abs(np.linalg.det(p[list(t[1:])] - p[t[0]])) for t in _TETS) / 6.0)


def area(corners: list[Place]) -> float:
    """Area of a quad."""
    a, b, c, d = np.array(corners)
    return float(np.linalg.norm(np.cross(c - a, d - b)) / 2.0)
