"""A meshed rigid body as a rigid sphere."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from plydyn_pre.translate.bodies import Bodies, Body, find
from plydyn_pre.translate.reader import LOST, REPLACED, TAKEN, Block
from plydyn_pre.translate.stack import Stack

_ROUND = 0.02  # of the radius by which nodes may lie off the sphere
_FACES = ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
#: CON1 that leaves motion along z, CON2 that leaves no rotation
_ALONG_Z, _NO_ROTATION = 4.0, 7.0
#: The five tetrahedra of a brick
_TETS = ((0, 1, 3, 4), (1, 2, 3, 6), (1, 3, 4, 6), (3, 4, 6, 7), (1, 4, 5, 6))


@dataclass(frozen=True)
class Sphere:
    """A rigid sphere above or below a plate."""

    radius: float
    mass: float
    centre: tuple[float, float, float]
    velocity: tuple[float, float, float]
    freedom: int  # 0 free, 1 guided along z, 2 free to move but not to rotate
    above: bool


def read_impactor(
    bodies: Bodies, blocks: list[Block], known: dict[int, Block], stack: Stack, notes: list[str]
) -> Sphere | None:
    """The rigid part that moves; others are lost."""
    moving = [(body, velocity) for body in bodies.rigid if (velocity := _velocity(body, blocks))]
    for body in bodies.rigid:
        if all(body is not each for each, _ in moving):
            words = f"the rigid part {body.pid} does not move and is lost: hold its nodes instead"
            body.block.mark(LOST, words, "PID", "SECID", "MID", "HEADING")
            notes.append(words)
    if not moving:
        return None
    if len(moving) > 1:
        raise moving[1][0].block.fail("PID", "a second rigid part that moves; one is translated")
    body, velocity = moving[0]
    material = known[body.material]
    radius, centre, off, above = _fit(body, bodies, stack)
    mass = _mass(body, bodies, material, blocks)
    freedom = _freedom(material, velocity)
    words = f"{len(body.elements)} elements as a sphere of radius {radius:g} at {_words(centre)}"
    notes.append(f"part {body.pid}: {words}; its nodes lie within {off:.2g} of it")
    body.block.mark(REPLACED, f"*IMPACTOR_SPHERE: {words}", "PID", "SECID", "MID", "HEADING")
    return Sphere(
        radius, mass, _lifted(centre, radius, above, stack, notes), velocity, freedom, above
    )


def _words(place: tuple[float, ...]) -> str:
    """A place in words."""
    return ", ".join(f"{x:g}" for x in place)


def _velocity(body: Body, blocks: list[Block]) -> tuple[float, float, float] | None:
    """The velocity of a rigid part at time zero; None for one that rests."""
    for block in find(blocks, "INITIAL_VELOCITY_RIGID_BODY"):
        for row in block.rows:
            if row.values.get("PID") == body.pid:
                block.mark(TAKEN, "velocity of the impactor", "PID", "VX", "VY", "VZ")
                return tuple(float(row.values.get(n, 0.0)) for n in ("VX", "VY", "VZ"))
    for block in find(blocks, "INITIAL_VELOCITY_GENERATION"):
        if block.raw("STYP", 0) == 2 and block.raw("ID", 0) == body.pid:
            block.mark(TAKEN, "velocity of the impactor", "ID", "STYP")
            return tuple(block.number(n, 0.0) for n in ("VX", "VY", "VZ"))
    if body.block.name == "PART_INERTIA" and body.block.number("VTZ", 0.0):
        return tuple(body.block.number(n, 0.0) for n in ("VTX", "VTY", "VTZ"))
    return None


def _fit(
    body: Body, bodies: Bodies, stack: Stack
) -> tuple[float, tuple[float, float, float], float, bool]:
    """Radius and centre of the sphere through the outer nodes that face the plate."""
    points = np.array([bodies.nodes[n] for n in sorted(_outer(body))])
    above = bool(points[:, 2].mean() > stack.middle)
    depth = points[:, 2] if above else -points[:, 2]
    height = float(np.ptp(depth))
    near = points[depth <= depth.min() + 0.3 * height + 1e-12]
    matrix = np.column_stack([2.0 * near, np.ones(len(near))])
    found, _, rank, _ = np.linalg.lstsq(matrix, (near**2).sum(axis=1), rcond=None)
    if rank < 4:
        raise body.block.fail("PID", f"rigid part {body.pid} has no round face; a sphere is needed")
    centre = found[:3]
    radius = float(np.sqrt(found[3] + centre @ centre))
    off = float(np.abs(np.linalg.norm(near - centre, axis=1) - radius).max())
    if not off <= _ROUND * radius:
        words = f"nodes of rigid part {body.pid} lie up to {off:.3g} off a sphere of {radius:.4g}"
        raise body.block.fail("PID", f"{words}; plydyn's impactor is a sphere")
    x, y, z = (float(f"{c:.6g}") if abs(c) > 1e-9 * radius else 0.0 for c in centre)
    return float(f"{radius:.6g}"), (x, y, z), off, above


def _outer(body: Body) -> set[int]:
    """Nodes of the outer faces."""
    if body.kind != "solid":
        return body.nodes
    faces = [[element[i] for i in face] for element in body.elements for face in _FACES]
    times = Counter(frozenset(face) for face in faces if len(set(face)) > 2)
    return {node for face, count in times.items() if count == 1 for node in face}


def _mass(body: Body, bodies: Bodies, material: Block, blocks: list[Block]) -> float:
    """Mass of a rigid part."""
    if body.block.name == "PART_INERTIA" and body.block.has("TM"):
        return body.block.positive("TM")
    density = material.positive("RO")
    if body.kind == "solid":
        volume = sum(_volume([bodies.nodes[n] for n in element]) for element in body.elements)
        return float(f"{density * volume:.6g}")
    secid = body.block.whole("SECID")
    for section in find(blocks, "SECTION_SHELL"):
        if section.raw("SECID") == secid:
            section.mark(REPLACED, "only for the mass of the rigid body", "SECID")
            area = sum(_area([bodies.nodes[n] for n in element]) for element in body.elements)
            return float(f"{density * area * section.positive('T1'):.6g}")
    raise body.block.fail("SECID", f"there is no *SECTION_SHELL {secid}")


def _volume(corners: list[tuple[float, float, float]]) -> float:
    """Volume of a brick."""
    p = np.array(corners)
    return float(sum(abs(np.linalg.det(p[list(t[1:])] - p[t[0]])) for t in _TETS) / 6.0)


def _area(corners: list[tuple[float, float, float]]) -> float:
    """Area of a quad."""
    a, b, c, d = np.array(corners)
    return float(np.linalg.norm(np.cross(c - a, d - b)) / 2.0)


def _freedom(material: Block, velocity: tuple[float, float, float]) -> int:
    """How the impactor may move: DOF of *IMPACTOR_SPHERE."""
    bound = material.number("CMO", 0.0) != 0.0
    held = material.number("CON1", 0.0)
    if bound and held not in (0.0, _ALONG_Z):
        raise material.fail("CON1", f"{held:g} is not translated; 0 and 4 are")
    turned = material.raw("CON2", 0.0)
    words = "DOF of *IMPACTOR_SPHERE; one that rotates has the inertia of a solid ball"
    material.mark(REPLACED, words, "CON2")
    material.mark(TAKEN, "density of the impactor", "RO")
    material.mark(LOST, "a rigid body has no stiffness; contact has no penalty", "E", "PR")
    material.mark(REPLACED, "*IMPACTOR_SPHERE", "MID")
    if bound and held == _ALONG_Z and velocity[:2] == (0.0, 0.0):
        return 1
    return 2 if bound and turned == _NO_ROTATION else 0


def _lifted(
    centre: tuple[float, float, float],
    radius: float,
    above: bool,
    stack: Stack,
    notes: list[str],
) -> tuple[float, float, float]:
    """The centre, moved out of the plate where it begins inside."""
    x, y, z = centre
    least = stack.top + radius if above else stack.layers[0].bottom - radius
    inside = least - z if above else z - least
    if inside <= 0.0:
        return centre
    notes.append(f"the impactor began {inside:.3g} inside the plate; it begins at its face")
    return x, y, least
