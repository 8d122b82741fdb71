"""Supports, loads, the contact of the impactor, and the curves they use."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar, Literal

from plydyn_pre.errors import require, require_not_negative, require_positive

Direction = Literal["x", "y", "z"]
Face = Literal["bottom", "top"]
FaceOrAll = Literal["bottom", "top", "all"]


@dataclass(frozen=True)
class Curve:
    """Values over time, linear in between, constant before and after."""

    time: tuple[float, ...]  # or another abscissa, rising
    value: tuple[float, ...]  # at each of them

    def __post_init__(self) -> None:
        """Refuse what is not a curve over time."""
        require(len(self.time) >= 2, "time", "two points or more are needed")
        same = len(self.time) == len(self.value)
        rule = f"{len(self.value)} values for {len(self.time)} times; one each is needed"
        require(same, "value", rule)
        rising = all(a < b for a, b in pairwise(self.time))
        require(rising, "time", "each time must be later than the one before")


@dataclass(frozen=True)
class Support:
    """Nodes that do not move in some directions."""

    set: str  # name of a node set
    hold: str = "xyz"  # any of x, y, z
    face: Literal["all", "bottom", "top", "plane"] = "all"
    height: float = 0.0  # of the plane above the nodes, for face = "plane"

    def __post_init__(self) -> None:
        """Refuse directions that there are not."""
        known = bool(self.hold) and len(set(self.hold)) == len(self.hold) <= len("xyz")
        rule = f"{self.hold!r} must be one, two or three of the letters x, y, z"
        require(known and set(self.hold) <= set("xyz"), "hold", rule)
        require(self.height == 0.0 or self.face == "plane", "height", 'only for face = "plane"')


@dataclass(frozen=True)
class Contact:
    """How the impactor touches the plate."""

    part: str = ""  # name of the part that is hit; needed where the mesh has several
    face: Face = "top"
    # nodes of the mesh on the sphere, or points of the plate against the exact sphere
    method: Literal["nodes_on_impactor", "points_on_plate"] = "nodes_on_impactor"
    spacing: float = 0.0  # between nodes on the impactor; 0 for one made from the mesh
    friction: float = 0.0  # static coefficient, of any speed where there is no decay
    dynamic_friction: float = 0.0  # coefficient at high speed
    decay: float = 0.0  # time per length

    def __post_init__(self) -> None:
        """Refuse negative numbers."""
        require_not_negative(self, "spacing", "friction", "dynamic_friction", "decay")


@dataclass(frozen=True)
class Pressure:
    """A pressure onto a face: down onto the top one, up onto the bottom one."""

    kind: ClassVar[str] = "pressure"

    value: float  # force per area, times the curve
    set: str = "all"  # name of a part or of a set of quads
    face: Face = "top"
    curve: str = ""  # name of a curve; constant without one


@dataclass(frozen=True)
class Force:
    """A force at each node of a set."""

    kind: ClassVar[str] = "force"

    set: str  # name of a node set
    direction: Direction
    value: float  # force per node, times the curve
    face: FaceOrAll = "top"
    curve: str = ""  # name of a curve; constant without one


@dataclass(frozen=True)
class LineForce:
    """A force along the quad sides that lie between the nodes of a set."""

    kind: ClassVar[str] = "line_force"

    set: str  # name of a node set
    direction: Direction
    value: float  # force per length, times the curve
    face: Face = "top"
    curve: str = ""  # name of a curve; constant without one


@dataclass(frozen=True)
class FrameAcceleration:
    """An acceleration of the frame; the body force is against it."""

    kind: ClassVar[str] = "frame_acceleration"

    direction: Direction
    value: float  # length per time squared, times the curve
    curve: str = ""  # name of a curve; constant without one


@dataclass(frozen=True)
class Motion:
    """Nodes whose motion is prescribed."""

    kind: ClassVar[str] = "motion"

    set: str  # name of a node set
    direction: Direction
    quantity: Literal["velocity", "acceleration", "displacement"]
    value: float  # times the curve
    face: FaceOrAll = "all"
    curve: str = ""  # name of a curve; constant without one


@dataclass(frozen=True)
class Lever:
    """A lever without mass on two lines of nodes, whose end is moved: force and way are written."""

    kind: ClassVar[str] = "lever"

    hinge: str  # name of a node set
    fulcrum: str  # name of another one, that lies like it
    arm: float  # from the fulcrum on to the end
    value: float  # of the end, times the curve
    quantity: Literal["velocity", "displacement"] = "displacement"
    direction: Direction = "z"
    face: FaceOrAll = "top"
    curve: str = ""  # name of a curve; constant without one

    def __post_init__(self) -> None:
        """Refuse an end that is no end."""
        require_positive(self, "arm")
        require(self.hinge != self.fulcrum, "fulcrum", "the same set as the hinge")


@dataclass(frozen=True)
class InitialVelocity:
    """The velocity of nodes at time zero."""

    kind: ClassVar[str] = "initial_velocity"

    velocity: tuple[float, float, float]  # along x, y, z
    set: str = "all"  # name of a node set


Load = Pressure | Force | LineForce | FrameAcceleration | Motion | Lever | InitialVelocity
