"""A parallel view of a scene, the same for both ways of drawing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plydyn_post.scene import Scene

# From where the plate is seen, degrees: the cut quarter, x > and y <, lies in front
AZIMUTH, ELEVATION = -52.0, 24.0
# Free share around what is drawn
MARGIN = 0.03
# Height over width of a zoomed view
ZOOMED_ASPECT = 0.55


@dataclass(frozen=True)
class Camera:
    """Directions and window of a parallel view."""

    right: np.ndarray  # (3,)
    up: np.ndarray  # (3,)
    towards: np.ndarray  # (3,) to the eye
    window: tuple[float, float, float, float]  # left, right, low, high in right and up

    @property
    def middle(self) -> np.ndarray:
        """A point seen in the middle of the window, (3,)."""
        left, right, low, high = self.window
        return (left + right) / 2 * self.right + (low + high) / 2 * self.up

    @property
    def aspect(self) -> float:
        """Height over width of the window."""
        left, right, low, high = self.window
        return (high - low) / (right - left)

    def pixels(self, height: float, width: int) -> float:
        """What a height along z takes in a picture of some width."""
        left, right, _, _ = self.window
        return height * float(self.up[2]) * width / (right - left)

    def seen(self, points: np.ndarray) -> np.ndarray:
        """Place in the window and nearness to the eye, (..., 3) to (..., 3)."""
        return points @ np.column_stack([self.right, self.up, self.towards])


def camera_for(scene: Scene, azimuth: float = AZIMUTH, elevation: float = ELEVATION) -> Camera:
    """A view that holds all of a scene, or the zoomed part of it."""
    turn, rise = np.radians([azimuth, elevation])
    towards = np.array([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)])
    right = np.array([-np.sin(turn), np.cos(turn), 0.0])
    up = np.cross(towards, right)
    plane = np.column_stack([right, up])
    low, high = (scene.points @ plane).min(axis=0), (scene.points @ plane).max(axis=0)
    for body in scene.bodies:
        seen = body.surface()[0] @ plane
        low, high = np.minimum(low, seen.min(axis=0)), np.maximum(high, seen.max(axis=0))
    free = MARGIN * float(np.max(high - low))
    low, high = low - free, high + free
    if scene.zoom > 1.0:
        wide = float(high[0] - low[0]) / scene.zoom
        half = 0.5 * wide * np.array([1.0, ZOOMED_ASPECT])
        low, high = scene.middle @ plane - half, scene.middle @ plane + half
    return Camera(right, up, towards, (low[0], high[0], low[1], high[1]))
