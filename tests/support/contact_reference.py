"""Impact of rigid spheres on a plate, dense and slow, as section 11 of `manual/theory.md` has it.

Closest points by trying everything; the multipliers from the shortest motion, measured by mass,
that opens all gaps.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.optimize import nnls

from decks import Sphere
from elasticity import Array
from facets import (
    SIDES,
    Face,
    Foot,
    closest,
    closest_on_side,
    face_of,
    normal_at_fold,
    shape,
    tangents,
)
from layered_plate import LayeredPlate
from meshes import Integers

#: This close to a side, in local coordinates, the surface folds
FOLD = 1.0e-4
#: Beyond a side by this much of the facet is beyond
BESIDE = 1.0e-10
#: Facets turned from the sphere by more than 60 degrees have folded
FACED = 0.5
#: A centre beside a side of the border by this much of the radius is not in the plane above it
OFFSET = 1.0e-6
#: Plate points against the exact sphere
POINTS = 2


@dataclass(frozen=True)
class Row:
    """A gap that must not be negative: normal . (impactor - sum of weights times points)."""

    points: Integers
    weights: Array
    normal: Array
    gap: float
    node: int = -1  # on the sphere; -1 for others


@dataclass
class Impactor:
    """A sphere that moves, and the force of the last step on it."""

    sphere: Sphere
    centre: Array
    velocity: Array
    inverse: Array
    nodes: Array
    force: Array = field(default_factory=lambda: np.zeros(3))
    displacement: Array = field(default_factory=lambda: np.zeros(3))


class Impact:
    """A plate at rest and its impactors, step by step."""

    def __init__(self, plate: LayeredPlate, spheres: Sequence[Sphere], step: float) -> None:
        """Start at time zero."""
        self.plate, self.step, self.cycle = plate, step, 0
        self.displacement, self.velocity, self.acceleration = np.zeros((3, plate.size))
        self.face = face_of(plate.mesh.quads)
        self.impactors = [_impactor(plate, sphere) for sphere in spheres]

    def advance(self) -> None:
        """One step of central differences, with contact."""
        dt = self.step
        span = dt if self.cycle > 0 else 0.5 * dt
        self.velocity += span * self.acceleration
        self.displacement += dt * self.velocity
        for own in self.impactors:
            own.velocity[2] += span * own.sphere.gravity
            own.displacement += dt * own.velocity
            own.centre += dt * own.velocity
        for own in self.impactors:
            self._press(own)
        forces = -self.plate.stiffness @ self.displacement
        self.acceleration = np.where(self.plate.free, forces / self.plate.mass, 0.0)
        self.cycle += 1

    def full_velocity(self) -> Array:
        """Velocity of the plate at the time of the step, (unknowns,)."""
        return self.velocity + 0.5 * self.step * self.acceleration

    def energies(self) -> dict[str, float]:
        """Columns of the file of energies that are sums over the state."""
        plate = self.plate
        balls = [
            0.5 * own.sphere.mass * float(own.velocity @ own.velocity) for own in self.impactors
        ]
        return {
            "kinetic": 0.5 * float(plate.mass @ self.full_velocity() ** 2),
            "internal": 0.5 * float(self.displacement @ plate.stiffness @ self.displacement),
            "impactor": sum(balls),
        }

    def momentum(self) -> Array:
        """Momentum of plate and impactors."""
        plate = (self.plate.mass * self.full_velocity()).reshape(-1, 3).sum(axis=0)
        return plate + sum(own.sphere.mass * own.velocity for own in self.impactors)

    def _press(self, own: Impactor) -> None:
        """Push an impactor and the plate apart."""
        start, unknowns = self.plate.face(own.sphere.face)
        points = start + self.displacement[unknowns]
        inverse = np.where(self.plate.free, 1.0 / self.plate.mass, 0.0)[unknowns]
        rows = _rows(points, self.face, own)
        motion, shift, own.force = _corrections(rows, inverse, own, self.step)
        if any(row.node >= 0 for row in rows):
            rows = [_follow(row, points, self.face, own, motion, shift) for row in rows]
            motion, shift, own.force = _corrections(rows, inverse, own, self.step)
        own.centre += shift
        own.displacement += shift
        own.velocity += shift / self.step
        self.displacement[unknowns] += motion
        self.velocity[unknowns] += motion / self.step


def _impactor(plate: LayeredPlate, sphere: Sphere) -> Impactor:
    """An impactor as it starts, with its contact nodes."""
    inverse = np.array([0.0, 0.0, 1.0] if sphere.guided else [1.0] * 3) / sphere.mass
    velocity = np.where(inverse > 0.0, sphere.velocity, 0.0)
    spacing = sphere.spacing or 0.5 * _point_distance(plate, sphere)
    nodes = sphere_nodes(sphere.radius, spacing, sphere.face)
    return Impactor(sphere, np.array(sphere.centre), velocity, inverse, nodes)


def _point_distance(plate: LayeredPlate, sphere: Sphere) -> float:
    """Least distance of points along the sides of quads within half a radius."""
    points, quads = plate.mesh.points, plate.mesh.quads
    away = np.hypot(*(points[quads[:, -1]] - sphere.centre[:2]).T)
    corners = quads[away <= max(0.5 * sphere.radius, away.min()), :4]
    sides = np.hypot(*(points[corners] - points[np.roll(corners, -1, axis=1)]).transpose(2, 0, 1))
    return float(sides.min()) / (2.0 if quads.shape[1] == 9 else 1.0)


def sphere_nodes(radius: float, spacing: float, side: int) -> Array:
    """Contact nodes on rings around the pole, half a spacing from the x axis, (nodes, 3)."""
    rings = max(1, int(np.ceil(0.5 * np.pi * radius / spacing)))
    nodes = [(0.0, 0.0, -side * radius)]
    for tilt in 0.5 * np.pi * np.arange(1, rings + 1) / rings:
        across, height = radius * np.sin(tilt), -side * radius * np.cos(tilt)
        quarter = max(1, int(np.floor(0.5 * np.pi * across / spacing + 0.5)))
        for angle in 0.5 * np.pi * (np.arange(4 * quarter) + 0.5) / quarter:
            nodes.append((across * np.cos(angle), across * np.sin(angle), height))
    return np.array(nodes)


def _corrections(
    rows: list[Row], inverse: Array, own: Impactor, step: float
) -> tuple[Array, Array, Array]:
    """Motion of points and centre that opens all gaps, and the force on the impactor."""
    shift, motion, force = np.zeros(3), np.zeros_like(inverse), np.zeros(3)
    for row, push in zip(rows, multipliers(rows, inverse, own.inverse), strict=True):
        shift += push * own.inverse * row.normal
        motion[row.points] -= push * np.outer(row.weights, row.normal) * inverse[row.points]
        force += push / step**2 * row.normal
    return motion, shift, force


def _follow(row: Row, points: Array, face: Face, own: Impactor, motion: Array, shift: Array) -> Row:
    """Row of a contact node as the corrected facets have it, with the gap before corrections."""
    if row.node < 0:
        return row
    corrected, arm, side = points + motion, own.nodes[row.node], own.sphere.face
    foot = closest(corrected, face.quads, own.centre + shift + arm)
    new = _row_at(corrected, face, foot, side, row.node)
    opened = new.normal @ (shift - new.weights @ motion[new.points])
    return replace(new, gap=new.gap - float(opened))


def _rows(points: Array, face: Face, own: Impactor) -> list[Row]:
    """Gaps of the trial positions."""
    if own.sphere.method == POINTS:
        return _point_rows(points, own)
    return _node_rows(points, face, own) + _border_rows(points, face, own)


def _point_rows(points: Array, own: Impactor) -> list[Row]:
    """Points of the face inside the exact sphere."""
    arms = own.centre - points
    distance = np.linalg.norm(arms, axis=1)
    return [
        Row(np.array([k]), np.ones(1), arms[k] / distance[k], distance[k] - own.sphere.radius)
        for k in np.flatnonzero(distance < own.sphere.radius)
    ]


def _node_rows(points: Array, face: Face, own: Impactor) -> list[Row]:
    """Contact nodes below the facets; those far above all of them need no closest point."""
    side, quads = own.sphere.face, face.quads
    places = (own.centre + own.nodes)[:, None]
    low, high = points[quads].min(axis=1), points[quads].max(axis=1)
    room = 0.3 * (high - low) + 0.3 * np.ptp(points[:, 2])
    over = ((low - room <= places) & (places <= high + room))[:, :, :2].all(axis=2)
    below = (side * places <= np.maximum(side * low, side * high) + room)[:, :, 2]
    rows = [
        _node_row(points, face, own, int(k), side)
        for k in np.flatnonzero((over & below).any(axis=1))
    ]
    return [row for row in rows if row is not None]


def _node_row(points: Array, face: Face, own: Impactor, node: int, side: int) -> Row | None:
    """Row of one contact node, if it is below the face and not beside it."""
    arm = own.nodes[node]
    foot = closest(points, face.quads, own.centre + arm)
    quad = face.quads[foot.facet]
    along = tangents(points[quad], foot.local)
    normal = side * np.cross(*along)
    normal /= np.linalg.norm(normal)
    gap = float(normal @ foot.arm)
    height = -float(normal @ arm)
    if gap >= 0.0 or height < FACED * np.linalg.norm(arm) or height + gap <= 0.0:
        return None
    radial = foot.arm - gap / (arm @ normal) * arm
    on = {s for s, (axis, end) in enumerate(SIDES) if end * foot.local[axis] >= 1.0 - 1.0e-12}
    border = [SIDES[s] for s in on if (foot.facet, s) in face.border]
    over = along @ foot.arm / (along**2).sum(axis=1)
    if _leaves(border, over) and _leaves(border, np.linalg.lstsq(along.T, radial)[0]):
        return None
    return _row_at(points, face, foot, side, node)


def _row_at(points: Array, face: Face, foot: Foot, side: int, node: int) -> Row:
    """Row of a node at its closest point."""
    quad = face.quads[foot.facet]
    folded = np.abs(foot.local) > 1.0 - FOLD
    local = np.where(folded, np.sign(foot.local), foot.local)
    normal = side * np.cross(*tangents(points[quad], foot.local))
    normal /= np.linalg.norm(normal)
    if folded.any():
        normal = normal_at_fold(points, face, foot.facet, local, side)
    return Row(quad, shape(len(quad), local), normal, float(normal @ foot.arm), node)


def _leaves(sides: list[tuple[int, float]], over: Array) -> bool:
    """Whether a way from a foot on some sides of a facet, along xi and eta, leads out over one."""
    return any(end * over[axis] > BESIDE for axis, end in sides)


def _border_rows(points: Array, face: Face, own: Impactor) -> list[Row]:
    """Sides of the border inside the exact sphere, but those that its centre is right over."""
    rows, radius = [], own.sphere.radius
    for facet, s in sorted(face.border):
        quad = face.quads[facet]
        corners = points[quad] - own.centre
        if np.linalg.norm(corners, axis=1).min() > radius + np.ptp(corners, axis=0).max():
            continue
        local, arm = closest_on_side(corners, s)
        along = tangents(corners, local)[1 - SIDES[s][0]]
        beside = abs(arm[0] * along[1] - arm[1] * along[0]) / np.hypot(*along[:2])
        distance = float(np.linalg.norm(arm))
        if distance < radius and beside > OFFSET * radius:
            rows.append(Row(quad, shape(len(quad), local), arm / distance, distance - radius))
    return rows


def multipliers(rows: list[Row], inverse: Array, of_impactor: Array) -> Array:
    """Multipliers times the step squared, (rows,), from least-distance programming.

    The shortest x = M^(1/2) u with B' x >= -g, which Lawson and Hanson (1974, chapter 23) turn
    into non-negative least squares.
    """
    pushes = np.zeros(len(rows))
    if all(row.gap >= 0.0 for row in rows):
        return pushes
    used = np.unique(np.concatenate([row.points for row in rows]))
    matrix = np.zeros((3 * len(used) + 3, len(rows)))
    for r, row in enumerate(rows):
        for point, weight in zip(row.points, row.weights, strict=True):
            k = 3 * int(np.searchsorted(used, point))
            matrix[k : k + 3, r] = -weight * row.normal * np.sqrt(inverse[point])
        matrix[-3:, r] = row.normal * np.sqrt(of_impactor)
    size = np.linalg.norm(matrix, axis=0)
    can = size > 0.0
    depth = np.array([-row.gap for row in rows])[can] / size[can]
    unit = np.abs(depth).max()
    system = np.vstack([matrix[:, can] / size[can], depth / unit])
    right = np.append(np.zeros(len(system) - 1), 1.0)
    solution = nnls(system, right)[0]
    pushes[can] = solution / (1.0 - system[-1] @ solution) * unit / size[can]
    return pushes
