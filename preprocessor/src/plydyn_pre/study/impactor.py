"""A rigid impactor: a body of revolution, its motion at time zero and along curves."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, radians, sqrt, tan
from typing import Literal

from plydyn_pre.errors import require, require_not_negative, require_positive

Kind = Literal["sphere", "tup", "cylinder", "cone"]
_STEEPEST = 89.0  # degrees from the axis to the side of a cone
#: Keys of the shape that a kind has
_OWN = {
    "sphere": ("hemisphere",),
    "tup": ("length", "axis"),
    "cylinder": ("length", "edge", "axis"),
    "cone": ("angle", "tip", "length", "axis"),
}


@dataclass(frozen=True)
class Impactor:
    """A rigid body above the top face, or below the bottom one if the contact says so."""

    radius: float  # length
    mass: float  # of the whole impactor
    velocity: tuple[float, float, float] | None = None  # at time zero; absent if energy is given
    position: tuple[float, float] | None = None  # x, y; the middle of the mesh if absent
    gap: float = 0.0  # between its lowest point and the face at time zero
    guided: bool = False  # moves along z only
    kind: Kind = "sphere"  # tup: a hemisphere on a rod
    length: float = 0.0  # of a cylinder, or of the rod of a tup or cone
    edge: float = 0.0  # radius of the edges of a cylinder
    angle: float = 0.0  # between axis and side of a cone, degrees
    tip: float = 0.0  # radius of the tip of a cone
    axis: tuple[float, float, float] | None = None  # upright if absent
    hemisphere: bool = False  # only the half of the sphere that faces the plate
    gravity: float = 0.0  # acceleration along z at all times, negative downwards
    energy: float | None = None  # of a fall, from which the velocity downwards follows
    motion_z: str = ""  # name of a curve that the body follows along z
    motion: Literal["velocity", "acceleration", "displacement"] = "velocity"  # what it gives
    title: str = ""

    def __post_init__(self) -> None:
        """Refuse what is no impactor."""
        require_positive(self, "radius", "mass")
        require_not_negative(self, "gap", "length", "edge", "tip")
        self._check_shape()
        if self.energy is not None:
            require(self.velocity is None, "velocity", "follows from the energy; leave one out")
            require_positive(self, "energy")
            speed = sqrt(2.0 * self.energy / self.mass)
            object.__setattr__(self, "velocity", (0.0, 0.0, -speed))
        if self.motion_z and self.velocity is None:
            object.__setattr__(self, "velocity", (0.0, 0.0, 0.0))
        require(self.velocity is not None, "velocity", "missing; or give the energy of a fall")
        straight = not self.guided or self.start[:2] == (0.0, 0.0)
        require(straight, "velocity", "a guided impactor moves along z: [0.0, 0.0, ...]")

    def _check_shape(self) -> None:
        """Refuse sizes of other kinds, and those that make no body."""
        for key in ("length", "edge", "angle", "tip", "axis", "hemisphere"):
            unused = key in _OWN[self.kind] or not getattr(self, key)
            require(unused, key, f"a {self.kind} has none")
        require(self.axis is None or hypot(*self.axis) > 0.0, "axis", "has no direction")
        if self.kind == "cylinder":
            require_positive(self, "length")
            narrow = self.edge < min(self.radius, 0.5 * self.length)
            require(narrow, "edge", "must be less than the radius and half of the length")
        if self.kind == "cone":
            some = 0.0 < self.angle <= _STEEPEST
            require(some, "angle", f"must be above 0 and at most {_STEEPEST:g} degrees")
            require(self.tip < self.radius, "tip", "must be less than the radius")

    @property
    def start(self) -> tuple[float, float, float]:
        """Its velocity at time zero."""
        return self.velocity or (0.0, 0.0, 0.0)

    @property
    def reach(self) -> float:
        """Distance along z from its centre to its point nearest to the plate."""
        if self.kind == "cylinder":
            upright = abs(self.axis[2]) / hypot(*self.axis) if self.axis else 1.0
            core = upright * (0.5 * self.length - self.edge)
            return core + sqrt(1.0 - upright**2) * (self.radius - self.edge) + self.edge
        if self.kind == "cone":
            return self._reach_of_cone()
        return self.radius

    def _reach_of_cone(self) -> float:
        """The lower of its tip and of the edge where it is widest."""
        across = self.radius - self.tip
        upright = abs(self.axis[2]) / hypot(*self.axis) if self.axis else 1.0
        apex = upright * across / tan(radians(self.angle))
        return max(apex, sqrt(1.0 - upright**2) * across) + self.tip
