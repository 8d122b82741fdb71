"""Rigid bodies of revolution: the impactors of pictures and dents."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

# Points along an outline, and around the axis
_AROUND, _FINE = 96, 24


@dataclass(frozen=True)
class Body:
    """A convex core that turns about an axis, widened by a radius, at time zero."""

    radius: float
    centre: tuple[float, float, float]
    axis: tuple[float, float, float] = (0.0, 0.0, 1.0)  # unit vector from the tip to the back
    rounding: float | None = None  # by which the core is widened; the radius for a sphere
    core: tuple[tuple[float, float], ...] = ((0.0, 0.0),)  # along the axis and across it
    back: float = np.inf  # where along the axis it is cut

    def outline(self) -> np.ndarray:
        """The widened core on one side of the axis, from tip to back, (n, 2) along and across."""
        wide = self.radius if self.rounding is None else self.rounding
        angles = np.linspace(0.0, np.pi, 2 * _FINE + 1)
        arc = wide * np.column_stack([-np.cos(angles), np.sin(angles)])
        points = (np.array(self.core)[:, None, :] + arc[None, :, :]).reshape(-1, 2)
        upper = _chain(points)
        end = min(self.back, upper[-1, 0])
        last = [end, np.interp(end, *upper.T)]
        return np.vstack([[upper[0, 0], 0.0], upper[upper[:, 0] < end], last, [end, 0.0]])

    def surface(self) -> tuple[np.ndarray, np.ndarray]:
        """Points (n, 3) and triangles (m, 3) of its surface."""
        outline = self.outline()
        turns = np.linspace(0.0, 2.0 * np.pi, _AROUND, endpoint=False)
        axis = np.array(self.axis)
        first = np.eye(3)[np.argmin(np.abs(axis))]
        first -= axis * (axis @ first)
        first /= np.linalg.norm(first)
        across = np.outer(np.cos(turns), first) + np.outer(np.sin(turns), np.cross(axis, first))
        along = outline[:, 0, None, None] * axis
        points = np.array(self.centre) + along + outline[:, 1, None, None] * across[None, :, :]
        place = np.arange(points.shape[0] * _AROUND).reshape(-1, _AROUND)
        one, other = place, np.roll(place, -1, axis=1)
        lower = np.stack([one[:-1], other[:-1], one[1:]], axis=-1).reshape(-1, 3)
        upper = np.stack([other[:-1], other[1:], one[1:]], axis=-1).reshape(-1, 3)
        return points.reshape(-1, 3), np.vstack([lower, upper])

    def reach(self, direction: float) -> float:
        """Distance from its centre to its farthest point along z, upwards (1) or downwards (-1)."""
        wide = self.radius if self.rounding is None else self.rounding
        along, across = np.array(self.core).T
        upright = self.axis[2]
        level = np.sqrt(max(0.0, 1.0 - upright**2))
        return float(np.max(direction * upright * along + level * across)) + wide


def hull(points: np.ndarray) -> np.ndarray:
    """Corners of the convex hull of points in the plane, in order, (n, 2)."""
    return np.vstack([_chain(points), -_chain(-points)])


def _chain(points: np.ndarray) -> np.ndarray:
    """Corners of the hull from the point farthest left over the upper ones to the right, (n, 2)."""
    order = points[np.lexsort((-points[:, 1], points[:, 0]))]
    corners: list[np.ndarray] = []
    for point in order:
        while len(corners) > 1 and _lies_below(corners[-1], corners[-2], point):
            corners.pop()
        corners.append(point)
    return np.array(corners)


def _lies_below(point: np.ndarray, left: np.ndarray, right: np.ndarray) -> bool:
    """Whether a point lies below the line between two others, or on it."""
    along, to_point = right - left, point - left
    return bool(along[0] * to_point[1] - along[1] * to_point[0] <= 0.0)
