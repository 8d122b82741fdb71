"""Bricks in place of layers: how a plate is extruded."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from plydyn_pre.errors import require, require_between

_MOST_PER_PLY = 100


@dataclass(frozen=True)
class Bricks:
    """A plate of bricks: its quads, drawn through the plies; quads of nine nodes give four."""

    per_ply: int = 1  # bricks through a ply
    points: Literal["one", "eight"] = "one"  # of integration
    hourglass: Literal["stiffness", "viscous"] = "stiffness"  # for one point
    coefficient: float = 0.1  # of hourglass control

    def __post_init__(self) -> None:
        """Refuse what cannot be extruded."""
        require_between(self, 1, _MOST_PER_PLY, "per_ply")
        share = 0.0 < self.coefficient <= 1.0
        require(share, "coefficient", f"{self.coefficient!r} must be above 0 and not above 1")
