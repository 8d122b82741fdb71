"""Coupons: a plate on the window of a frame or in a ring, with a core of equal quads.

The quads of the core lie along x and y, the 0 and 90 of the plies; outside of it they grow. Mesh
lines follow the edge of the window. A rectangular window has straight lines through the whole
plate, a round one has an O-grid around it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil, floor, sqrt
from typing import ClassVar, Literal

import numpy as np

from plydyn_pre.errors import require, require_between, require_not_negative, require_positive
from plydyn_pre.mesh.boards import RingBoard, board_of_lines
from plydyn_pre.mesh.grid import Mesh, Reals, with_centre
from plydyn_pre.mesh.limits import LARGEST_GROWTH, require_few
from plydyn_pre.mesh.lines import Span, place_on, zoned_line
from plydyn_pre.mesh.ogrid import to_circle
from plydyn_pre.mesh.quarter import quarter_of
from plydyn_pre.mesh.zones import Zone, check_zones, spans_of

#: How fine a mesh is by the process zone of its interfaces
Level = Literal["look", "standard", "fine"]
# share of a size by which a node may lie off a line
_NEAR = 1e-6


@dataclass(frozen=True)
class Coupon:
    """A plate with a window below it. Node sets: boundary, centre, core, window.

    Of a rectangle left, right, bottom and top, too; of a quarter symmetry_x and symmetry_y.
    """

    kind: ClassVar[str] = "coupon"

    plate: float | tuple[float, float]  # diameter, or lengths along x and y
    window: float | tuple[float, float]  # diameter, or lengths along x and y
    core: float  # side of the square that holds the damage
    level: Level = "standard"  # of resolution of the process zone of the interfaces
    quad: float = 0.0  # side of the quads of the core; 0: by the level
    growth: float = 1.3  # size of a quad outside of the core over that of the one before
    largest: float = 6.0  # size of the quads outside of the core at most
    order: Literal[1, 2] = 2  # quads of four or of nine nodes
    centre: tuple[float, float] = (0.0, 0.0)  # place of the middle
    quarter: bool = False  # only what lies at larger x and y than the middle
    zones: tuple[Zone, ...] = ()  # other places of finer quads than the core
    core_at: tuple[float, float] | None = None  # place that the core is to hold; the impactor's

    def __post_init__(self) -> None:
        """Refuse what cannot be meshed."""
        plate, window = sides_of(self.plate), sides_of(self.window)
        for name, sides in (("plate", plate), ("window", window)):
            require(min(sides) > 0.0, name, f"{getattr(self, name)} must be above zero")
        require_positive(self, "core", "largest")
        require_not_negative(self, "quad")
        require_between(self, 1.0, LARGEST_GROWTH, "growth")
        round_plate, round_window = is_round(self.plate), is_round(self.window)
        rule = "a round plate needs a round window: a diameter"
        require(round_window or not round_plate, "window", rule)
        rule = f"{self.window} must be less than the plate, {self.plate}"
        require(all(a < b for a, b in zip(window, plate, strict=True)), "window", rule)
        limit = min(window) / (sqrt(2.0) if round_window else 1.0)
        rule = f"{self.core:g} must be less than {limit:g} to lie in the window"
        require(self.core < limit, "core", rule)
        self._check_zones(plate)
        rule = "the core lies in the middle of a round window and of a quarter; leave it out"
        require(self.core_at is None or self.core_moves, "core_at", rule)
        if self.quad > 0.0:
            require_few(core_quads(self.core, self.quad), "quad")
            require_few(_quads(self), "quad")

    @property
    def core_moves(self) -> bool:
        """Whether the core may lie beside the middle of the plate."""
        return not (is_round(self.window) or self.quarter)

    @property
    def core_middle(self) -> tuple[float, float]:
        """The middle of the core: near the place that it is to hold, a quad or more in the window.

        It lies whole quads beside that of the plate, through which mesh lines run.
        """
        x, y = (self._core_place(axis) for axis in (0, 1))
        return x, y

    def _core_place(self, axis: int) -> float:
        """The middle of the core along an axis."""
        if self.core_at is None or self.quad == 0.0:
            return self.centre[axis]
        size = self.core / core_quads(self.core, self.quad)
        room = (sides_of(self.window)[axis] - self.core) / 2.0
        most = max(0, floor(room / size) - 1)
        wanted = round((self.core_at[axis] - self.centre[axis]) / size)
        return self.centre[axis] + size * max(-most, min(most, wanted))

    def _check_zones(self, plate: tuple[float, float]) -> None:
        """Refuse zones where mesh lines do not run along x and y, and beyond the plate."""
        rule = "a round window takes none beside the core; give a window of two lengths"
        require(not self.zones or not is_round(self.window), "zones", rule)
        low, high = zip(
            *((c - s / 2, c + s / 2) for c, s in zip(self.centre, plate, strict=True)), strict=True
        )
        check_zones(self.zones, self.centre if self.quarter else low, high, (self.largest,) * 2)


def is_round(size: float | tuple[float, float]) -> bool:
    """Whether a size is a diameter."""
    return not isinstance(size, tuple)


def sides_of(size: float | tuple[float, float]) -> tuple[float, float]:
    """Lengths along x and y of a rectangle, or of the square around a circle."""
    return size if isinstance(size, tuple) else (size, size)


def mesh_coupon(shape: Coupon) -> Mesh:
    """Mesh a coupon whose quads have a size."""
    mesh = _mesh_round(shape) if is_round(shape.window) else _mesh_rectangle(shape)
    whole = with_centre(mesh)
    return quarter_of(whole) if shape.quarter else whole


def core_quads(core: float, quad: float) -> int:
    """Quads along a side of the core; even, so that a node lies in the middle."""
    return 2 * max(1, ceil(core / (2.0 * quad) - 1e-9))


def _quads(shape: Coupon) -> int:
    """How many quads a coupon has, of the whole plate."""
    n = core_quads(shape.core, shape.quad)
    if is_round(shape.window):
        return n**2 + 4 * n * (len(_rings(shape)) - 1)
    return int(np.prod([len(_line(shape, axis)) - 1 for axis in (0, 1)]))


def _line(shape: Coupon, axis: int) -> Reals:
    """Ends of the quads along an axis, around the middle.

    The core is a zone whose ends are mesh lines, as is the middle where there are other zones, or
    where the core lies beside it.
    """
    half, off = shape.core / 2, shape.core_middle[axis] - shape.centre[axis]
    window, plate = sides_of(shape.window)[axis] / 2, sides_of(shape.plate)[axis] / 2
    core = Span(off - half, off + half, shape.core / core_quads(shape.core, shape.quad))
    middle = (0.0,) if shape.zones or off != 0.0 else ()
    ends = [end for end in (core.low, core.high) if not middle or abs(end) > _NEAR * shape.core]
    marks = sorted((-plate, -window, *ends, *middle, window, plate))
    spans = [core, *spans_of(shape.zones, axis, shape.largest, shape.centre[axis])]
    return zoned_line(marks, spans, shape.growth, shape.largest)


def _mesh_rectangle(shape: Coupon) -> Mesh:
    """A rectangular plate on a rectangular window."""
    mesh = board_of_lines(_line(shape, 0), _line(shape, 1), shape.order)
    half = np.array(sides_of(shape.window)) / 2
    return _with_sets(mesh, shape, (np.abs(mesh.nodes) / half).max(axis=1))


def _rings(shape: Coupon) -> Reals:
    """Radii of the rings of quads, halfway along the sides of the core: (rings + 1,)."""
    half, n = shape.core / 2, core_quads(shape.core, shape.quad)
    window, plate = sides_of(shape.window)[0] / 2, min(sides_of(shape.plate)) / 2
    core = Span(0.0, half, shape.core / n)
    return zoned_line((0.0, half, window, plate), [core], shape.growth, shape.largest)[n // 2 :]


def _mesh_round(shape: Coupon) -> Mesh:
    """A plate on a round window: from the core to a circle, and on to the edge of the plate."""
    n, radii = core_quads(shape.core, shape.quad), _rings(shape)
    board = RingBoard(n, len(radii) - 1, shape.order)
    unit, radius = board.unit, place_on(radii, board.ring)
    half, window = shape.core / 2, sides_of(shape.window)[0] / 2
    edge = np.array(sides_of(shape.plate)) / 2
    square, circle = half * unit, window * to_circle(unit)
    outline = edge[0] * to_circle(unit) if is_round(shape.plate) else edge * unit
    places = np.where(
        (radius <= window)[:, None],
        _between(square, circle, (radius - half) / (window - half)),
        _between(circle, outline, (radius - window) / (radii[-1] - window)),
    )
    return _with_sets(board.mesh(places), shape, np.hypot(*places.T) / window)


def _with_sets(mesh: Mesh, shape: Coupon, reach: Reals) -> Mesh:
    """A mesh around the origin at its place, with its sets; `reach` is 1 at the window's edge."""
    off = np.array(shape.core_middle) - shape.centre
    inside = np.abs(mesh.nodes - off).max(axis=1) <= (0.5 + _NEAR) * shape.core
    kept = {"boundary"} if is_round(shape.plate) else mesh.node_sets.keys() - {"core"}
    sets = {name: nodes for name, nodes in mesh.node_sets.items() if name in kept}
    sets["window"] = np.flatnonzero(np.abs(reach - 1.0) <= _NEAR)
    return replace(
        mesh,
        nodes=np.array(shape.centre) + mesh.nodes,
        node_sets=sets | {"core": np.flatnonzero(inside)},
        quad_sets={"core": np.flatnonzero(np.all(inside[mesh.quads], axis=1))},
    )


def _between(start: Reals, end: Reals, share: Reals) -> Reals:
    """Places at a share of the way."""
    return (1.0 - share)[:, None] * start + share[:, None] * end
