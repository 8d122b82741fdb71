"""The round or flat shape that the outer nodes of a rigid body have."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from math import atan, degrees
from typing import Any

import numpy as np

from plydyn_pre.translate.elements import Body
from plydyn_pre.translate.model import Place
from plydyn_pre.translate.sets import faces_of
from plydyn_pre.translate.windows import window_of

_ROUND = 0.02  # of the radius by which nodes may lie off the shape
_WRITTEN = 1e-5  # of the radius by which nodes with rounded coordinates may lie off it
#: Sine of the angle by which a face may look away from the plate, and of one that looks at it
_SIDEWAYS, _DOWN = 1e-3, 0.5
_WIDER = 1e-3  # of the size of a flat face by which its body is wider above it
_TIP = 0.8  # of the radius by which the lowest node is below the centre of a sphere at least
_LEAST_ANGLE, _MOST_ANGLE = 1.0, 89.0  # of the side of a cone, from its axis


@dataclass(frozen=True)
class Shape:
    """A shape of plydyn's rigid bodies with its sizes."""

    kind: str  # sphere, tup, cylinder, cone, ring, punch, plane or bar
    centre: Place
    radius: float
    length: float = 0.0
    angle: float = 0.0  # of a cone
    tip: float = 0.0  # of a cone
    edge: float = 0.0  # radius of the edge of a cylinder
    inner: float = 0.0  # of a ring
    sides: tuple[float, float] = (0.0, 0.0)  # of a rectangle
    axis: Place = (0.0, 0.0, 0.0)  # of a lying cylinder
    off: float = 0.0  # largest distance of a node from it
    wider: bool = False  # whether the body of a flat face is wider above it, as at a round edge

    def words(self) -> str:
        """The shape in words."""
        place = ", ".join(f"{x:g}" for x in self.centre)
        size = f" of radius {self.radius:g}" if self.radius else ""
        return f"{self.kind}{size} at {place}"


def shape_of(body: Body, nodes: dict[int, Place], above: bool) -> Shape:
    """The shape of the nodes that face the plate; an error if they have none that plydyn has."""
    points = np.array([nodes[n] for n in sorted(_outer(body, nodes, 1.0 if above else -1.0))])
    if not above:
        points = points * np.array([1.0, 1.0, -1.0])
    flat = partial(_flat_faces, body, nodes, 1.0 if above else -1.0)
    found = _sphere(points) or _cone(points) or _upright(points, flat) or _lying(points)
    if found is None:
        words = f"the nodes of rigid part {body.pid} lie on no sphere, tup, cone, cylinder or bar"
        raise body.block.fail("PID", f"{words}; these are the rigid bodies of plydyn")
    centre = (*found.centre[:2], found.centre[2] if above else -found.centre[2])
    return replace(found, centre=centre)


def _outer(body: Body, nodes: dict[int, Place], up: float) -> set[int]:
    """Nodes of the outer faces that look towards the plate or sideways; all of shells."""
    if body.kind == "shell":
        return body.nodes
    faces = [(face, element) for element in body.elements for face in faces_of(element.nodes)]
    times = Counter(frozenset(face) for face, _ in faces if len(set(face)) > 2)
    middle = np.mean([nodes[n] for n in body.nodes], axis=0)
    found: set[int] = set()
    for face, element in faces:
        if times[frozenset(face)] == 1:
            corners = np.array([nodes[n] for n in face])
            normal = np.cross(corners[2] - corners[0], corners[3] - corners[1])
            inside = np.mean([nodes[n] for n in element.nodes], axis=0)
            centre = corners.mean(axis=0)
            normal *= np.sign(normal @ (centre - inside)) / (np.linalg.norm(normal) or 1.0)
            outward = normal[:2] @ (centre - middle)[:2] >= 0.0 and up * normal[2] <= _SIDEWAYS
            if outward or up * normal[2] < -_DOWN:
                found |= set(face)
    return found


def _rounded(value: float, size: float) -> float:
    """A size or place with six digits."""
    return float(f"{value:.6g}") if abs(value) > 1e-9 * size else 0.0


def _made(kind: str, centre: np.ndarray, radius: float, off: float, **sizes: float) -> Shape:
    """A shape with rounded numbers."""
    x, y, z = (_rounded(float(c), radius) for c in centre)
    kept: dict[str, Any] = {key: _rounded(float(value), radius) for key, value in sizes.items()}
    return Shape(kind, (x, y, z), _rounded(radius, radius), off=off, **kept)


def _sphere(points: np.ndarray) -> Shape | None:
    """A sphere, or a hemisphere on a rod, whose lowest point is down."""
    height = np.ptp(points[:, 2])
    for share in (0.3, 0.1, 0.05):
        near = points[points[:, 2] <= points[:, 2].min() + share * height + 1e-12]
        found = _fitted(near)
        if found is None:
            continue
        centre, radius = found
        low = points[points[:, 2] < centre[2] - 1e-3 * radius]
        off = _off(low, centre, radius)
        if len(low) < 4 or off > _ROUND * radius:
            continue
        # all its nodes hold the centre better than those of the tip, some of which may be of a rod
        again = _fitted(low)
        if again and (better := _off(low, *again)) <= max(off, _WRITTEN * radius):
            (centre, radius), off = _plain(low, *again, better), better
        if centre[2] - low[:, 2].min() < _TIP * radius:  # two rings, as the ends of a bar
            continue
        rest = points[points[:, 2] > centre[2] + _ROUND * radius]
        beyond = np.abs(np.linalg.norm(rest - centre, axis=1) - radius).max(initial=0.0)
        if beyond <= _ROUND * radius:
            return _made("sphere", centre, radius, off)
        wide = np.hypot(*(rest[:, :2] - centre[:2]).T)
        if wide.max() > radius * (1.0 + _ROUND):
            return None
        return _made("tup", centre, radius, off, length=points[:, 2].max() - centre[2])
    return None


def _fitted(points: np.ndarray) -> tuple[np.ndarray, float] | None:
    """Centre and radius of the sphere through points, by least squares; None without one."""
    matrix = np.column_stack([2.0 * points, np.ones(len(points))])
    found, _, rank, _ = np.linalg.lstsq(matrix, (points**2).sum(axis=1), rcond=None)
    square = found[3] + found[:3] @ found[:3]
    return (found[:3], float(np.sqrt(square))) if rank == 4 and square > 0.0 else None


def _off(points: np.ndarray, centre: np.ndarray, radius: float) -> float:
    """Largest distance of points from a sphere."""
    return float(np.abs(np.linalg.norm(points - centre, axis=1) - radius).max(initial=0.0))


def _plain(
    points: np.ndarray, centre: np.ndarray, radius: float, off: float
) -> tuple[np.ndarray, float]:
    """The sphere of the fewest digits of which its nodes, written with some, lie no farther off."""
    for digits in range(3, 7):
        *place, size = (float(f"{value:.{digits}g}") for value in (*centre, radius))
        if _off(points, np.array(place), size) <= off:
            return np.array(place), size
    return centre, radius


def _middle(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The axis of a body of revolution, and the distances of points from it."""
    middle = 0.5 * (points[:, :2].min(axis=0) + points[:, :2].max(axis=0))
    return middle, np.hypot(*(points[:, :2] - middle).T)


def _cone(points: np.ndarray) -> Shape | None:
    """A cone with a sharp or round tip on a rod."""
    middle, wide = _middle(points)
    radius = float(wide.max())
    if radius <= 0.0:
        return None
    rim = points[wide > (1.0 - _ROUND) * radius][:, 2].min()
    on_side = (wide > 0.3 * radius) & (points[:, 2] <= rim + _ROUND * radius)
    if not (on_side & (wide < (1.0 - _ROUND) * radius)).any():
        on_side |= wide < 1e-6 * radius
    side, slant = points[on_side], wide[on_side]
    if len(side) < 4 or np.ptp(slant) < 0.1 * radius:
        return None
    slope, start = np.polyfit(slant, side[:, 2], 1)
    off = float(np.abs(slope * slant + start - side[:, 2]).max())
    if slope <= 0.0 or off > _ROUND * min(radius, float(np.ptp(side[:, 2]))):
        return None
    angle = degrees(atan(1.0 / slope))
    top = slope * radius + start
    missing = points[:, 2].min() - start
    if not _LEAST_ANGLE < angle < _MOST_ANGLE or missing < -_ROUND * radius:
        return None
    sine = float(np.sin(np.radians(angle)))
    tip = max(0.0, missing) * sine / (1.0 - sine)
    tip = tip if tip > _ROUND * radius else 0.0
    length = max(0.0, float(points[:, 2].max() - top))
    length = length if length > _ROUND * radius else 0.0
    sizes = {"angle": angle, "tip": tip, "length": length}
    return _made("cone", np.array([*middle, top]), radius, off, **sizes)


def _flat_faces(
    body: Body, nodes: dict[int, Place], up: float, level: float, slack: float
) -> np.ndarray | None:
    """The window in the faces of a body at a height; None where they are no rectangle."""
    faces = {
        frozenset(face): face
        for element in body.elements
        for face in faces_of(element.nodes)
        if all(abs(up * nodes[n][2] - level) <= slack for n in face)
    }
    return window_of([*faces.values()], {n: np.array(nodes[n][:2]) for n in body.nodes})


def _upright(
    points: np.ndarray, window_at: Callable[[float, float], np.ndarray | None]
) -> Shape | None:
    """A flat face: of a round punch, a ring, a rectangle, or a plate with a window."""
    slack = 1e-6 * float(np.ptp(points)) + 1e-12
    low = points[points[:, 2] <= points[:, 2].min() + slack]
    middle, wide = _middle(low)
    height = float(np.ptp(points[:, 2]))
    radius = float(wide.max())
    if len(low) < 4 or radius <= 0.0:
        return None
    centre = np.array([*middle, low[0, 2]])
    inner = float(wide.min())
    sides = np.ptp(low[:, :2], axis=0)
    corner = np.abs(np.abs(low[:, :2] - middle) - sides / 2.0).max(axis=1).min()
    if corner < 1e-6 * radius:
        window = window_at(float(low[0, 2]), slack)
        if window is None or sides.min() < 1e-6 * radius:  # a line is that of a lying cylinder
            return None
        kind = "plane" if window.any() else "punch"
        shape = _made(kind, centre, radius, 0.0, length=height)
        shape = replace(shape, wider=_leaves(points, middle, sides, window))
        size, place = sides, shape.centre
        if window.any():
            size, place = window[0], (*window[1], shape.centre[2])
        return replace(shape, radius=0.0, sides=(float(size[0]), float(size[1])), centre=place)
    rim = np.abs(wide - radius) < _ROUND * radius
    if rim.sum() < 6:
        return None
    hollow = inner > 0.05 * radius and (np.abs(wide - inner) < _ROUND * radius).sum() >= 6
    if hollow and inner > (1.0 - _ROUND) * radius:  # the rim of a tube has no width
        return None
    if hollow and not (wide < inner * (1.0 - _ROUND)).any():
        shape = _made("ring", centre, radius, 0.0, inner=inner, length=height)
        away = np.hypot(*(points[:, :2] - middle).T)
        wider = max(away.max() - radius, inner - away.min()) > _WIDER * radius
        return replace(shape, wider=bool(wider))
    edge = _edge(points - centre, radius)
    if edge is None:
        return None
    return _made("cylinder", centre, radius + edge, 0.0, length=height, edge=edge)


def _leaves(points: np.ndarray, middle: np.ndarray, sides: np.ndarray, window: np.ndarray) -> bool:
    """Whether points lie beside a rectangle, or in its window (sizes and middle)."""
    slack = _WIDER * float(sides.max())
    beside = np.abs(points[:, :2] - middle) > sides / 2.0 + slack
    inside = np.abs(points[:, :2] - window[1]) < window[0] / 2.0 - slack
    return bool(beside.any() or inside.all(axis=1).any())


def _edge(points: np.ndarray, radius: float) -> float | None:
    """Radius of the edge of a round face, 0 for a sharp one; None for sides of another form."""
    wide, height = np.hypot(*points[:, :2].T), points[:, 2]
    side = (wide > radius * (1.0 + _WIDER)) & (height < radius)  # not a holder further up
    if not side.any():
        return 0.0
    edge = float(wide[side].max()) - radius
    curved = side & (height < edge * (1.0 - _ROUND))
    if not curved.any():  # a side that leans a little
        return 0.0 if edge <= _ROUND * radius else None
    off = np.abs(np.hypot(wide[curved] - radius, height[curved] - edge) - edge)
    return edge if off.max() <= _ROUND * (radius + edge) else None


def _lying(points: np.ndarray) -> Shape | None:
    """A cylinder that lies along the plate."""
    _, _, turn = np.linalg.svd(points[:, :2] - points[:, :2].mean(axis=0), full_matrices=False)
    for along in (turn[0], turn[-1]):
        across = np.array([-along[1], along[0]])
        u, v, z = points[:, :2] @ across, points[:, :2] @ along, points[:, 2]
        near = z <= z.min() + 0.3 * np.ptp(z) + 1e-12
        matrix = np.column_stack([2.0 * u[near], 2.0 * z[near], np.ones(near.sum())])
        found, _, rank, _ = np.linalg.lstsq(matrix, u[near] ** 2 + z[near] ** 2, rcond=None)
        radius = float(np.sqrt(max(0.0, found[2] + found[0] ** 2 + found[1] ** 2)))
        off = float(np.abs(np.hypot(u[near] - found[0], z[near] - found[1]) - radius).max())
        if rank == 3 and off + radius > 0.0 and off <= _ROUND * radius and np.ptp(v) > radius:
            place = found[0] * across + 0.5 * (v.min() + v.max()) * along
            shape = _made("bar", np.array([*place, found[1]]), radius, off, length=np.ptp(v))
            x, y = (_rounded(float(c), 1.0) for c in along)
            return replace(shape, axis=(x, y, 0.0))
    return None
