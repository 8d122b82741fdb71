"""Fixtures: rigid bodies that the plate lies on or is held by, and the tips of clamps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from plydyn_pre.errors import require, require_not_negative, require_positive
from plydyn_pre.study.conditions import Face

#: A place in the plane; the middle of the mesh if absent
Place = tuple[float, float] | None


@dataclass(frozen=True, kw_only=True)
class _Surface:
    """What all fixtures have: a face that they meet, and friction."""

    face: Face  # of all parts: the bottom one from below, the top one from above
    friction: float = 0.0  # static coefficient, of any speed where there is no decay
    dynamic_friction: float = 0.0  # coefficient at high speed
    decay: float = 0.0  # time per length
    title: str = ""

    def __post_init__(self) -> None:
        """Refuse negative coefficients."""
        require_not_negative(self, "friction", "dynamic_friction", "decay")


@dataclass(frozen=True, kw_only=True)
class _Body(_Surface):
    """What rigid fixtures have: a distance at time zero and curves of their displacement."""

    gap: float = 0.0  # to the face at time zero
    move_x: str = ""  # name of a curve of displacement; stands still without one
    move_y: str = ""
    move_z: str = ""

    def __post_init__(self) -> None:
        """Refuse what begins inside the plate."""
        super().__post_init__()
        require_not_negative(self, "gap")


@dataclass(frozen=True, kw_only=True)
class Plane(_Body):
    """A plane along the plate, with a window: the base of a test frame."""

    kind: ClassVar[str] = "plane"

    # diameter, or lengths; absent for the opening whose flat face begins at the window of a coupon
    window: float | tuple[float, float] | None = None  # 0 for none
    corner: float = 0.0  # radius of the corners of a rectangular window
    centre: Place = None
    edge: float = 0.0  # radius of the edge of the window

    def __post_init__(self) -> None:
        """Refuse negative radii, and rectangles without an area."""
        super().__post_init__()
        require_not_negative(self, "corner", "edge")
        sides = self.window if isinstance(self.window, tuple) else (self.window or 0.0,)
        least = min(sides)
        whole = least > 0.0 or (least == 0.0 and len(sides) == 1)
        require(whole, "window", f"{least:g} must be above zero; 0.0 alone is none")


@dataclass(frozen=True, kw_only=True)
class Ring(_Body):
    """A flat ring."""

    kind: ClassVar[str] = "ring"

    inner: float  # radius
    outer: float  # radius
    centre: Place = None
    edge: float = 0.0  # radius of its edges

    def __post_init__(self) -> None:
        """Refuse what is no ring."""
        super().__post_init__()
        require_positive(self, "inner")
        require_not_negative(self, "edge")
        rule = f"{self.outer:g} must be above the inner radius, {self.inner:g}"
        require(self.outer > self.inner, "outer", rule)


@dataclass(frozen=True, kw_only=True)
class Punch(_Body):
    """A flat punch, round or rectangular."""

    kind: ClassVar[str] = "punch"

    size: float | tuple[float, float]  # diameter, or lengths along x and y
    corner: float = 0.0  # radius of the corners of a rectangle
    centre: Place = None
    edge: float = 0.0  # radius of its edge

    def __post_init__(self) -> None:
        """Refuse negative radii."""
        super().__post_init__()
        require_not_negative(self, "corner", "edge")


@dataclass(frozen=True, kw_only=True)
class Bar(_Body):
    """A round bar along the plate."""

    kind: ClassVar[str] = "bar"

    radius: float  # of its section
    start: tuple[float, float]  # ends of its axis
    end: tuple[float, float]  # x, y of its other end

    def __post_init__(self) -> None:
        """Refuse what is no bar."""
        super().__post_init__()
        require_positive(self, "radius")
        require(self.start != self.end, "end", "the bar has no length")


@dataclass(frozen=True, kw_only=True)
class Clamp(_Surface):
    """The soft tip of a clamp, round or a ring, that presses a face."""

    kind: ClassVar[str] = "clamp"

    force: float  # that the tip presses with, times the curve
    outer: float  # radius of the tip
    inner: float = 0.0  # radius of its hole
    centre: Place = None
    stiffness: float = 0.0  # of the tip, force per length
    curve: str = ""  # name of a curve of its factor over time; constant without one

    def __post_init__(self) -> None:
        """Refuse what is no clamp."""
        super().__post_init__()
        require_positive(self, "outer")
        require_not_negative(self, "force", "inner", "stiffness")
        rule = f"{self.outer:g} must be above the inner radius, {self.inner:g}"
        require(self.outer > self.inner, "outer", rule)


Fixture = Plane | Ring | Punch | Bar | Clamp
