"""Zones of finer quads in meshes of rows and columns."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from plydyn_pre.errors import require
from plydyn_pre.mesh.limits import require_few
from plydyn_pre.mesh.lines import Span
from plydyn_pre.mesh.region import Box, Circle, check_box, check_circle

_AXES = "xy"
# share of the plate by which a zone may reach beyond its edge
_NOISE = 1e-9


@dataclass(frozen=True)
class Zone:
    """A box, or the square around a circle, in which quads have a size.

    Rows and columns of quads run through the whole plate, so that those through a zone are as
    narrow beside it.
    """

    size: float | tuple[float, float]  # of its quads at most, along both axes or along x and y
    box: Box | None = None  # smallest x, largest x, the same of y
    circle: Circle | None = None  # x and y of the middle, radius

    def __post_init__(self) -> None:
        """Refuse two shapes and none, and sizes that no quad has."""
        one = (self.box is None) != (self.circle is None)
        rule = "a zone needs one of box = [x1, x2, y1, y2], circle = [x, y, radius]"
        require(one, "", rule)
        check_box(self.box)
        check_circle(self.circle)
        require(min(self.sizes) > 0.0, "size", f"{self.size} must be above zero")
        for axis, size in enumerate(self.sizes):
            low, high = self.reach(axis)
            rule = f"{high - low:g} wide along {_AXES[axis]}, less than a quad of {size:g}"
            require(high - low >= size, "box" if self.box else "circle", rule)

    @property
    def sizes(self) -> tuple[float, float]:
        """Largest sides of its quads along x and y."""
        return self.size if isinstance(self.size, tuple) else (self.size, self.size)

    def reach(self, axis: int) -> tuple[float, float]:
        """Its ends along an axis."""
        if self.box is not None:
            return self.box[2 * axis], self.box[2 * axis + 1]
        middle, radius = (self.circle or (0.0, 0.0, 0.0))[axis], (self.circle or (0.0,) * 3)[2]
        return middle - radius, middle + radius


def check_zones(
    zones: Iterable[Zone],
    low: Sequence[float],
    high: Sequence[float],
    sizes: Sequence[float],
) -> None:
    """Refuse zones beyond the plate and zones with quads as large as those of the plate.

    The plate lies between two corners; its quads have some sizes along x and y.
    """
    for number, zone in enumerate(zones, start=1):
        for axis in (0, 1):
            start, end = zone.reach(axis)
            slack = _NOISE * (high[axis] - low[axis])
            name = _AXES[axis]
            rule = (
                f"from {name} = {start:g} to {end:g}, the mesh is from {low[axis]:g} to"
                f" {high[axis]:g}"
            )
            inside = start >= low[axis] - slack and end <= high[axis] + slack
            require(inside, f"zones[{number}].{'box' if zone.box else 'circle'}", rule)
        finer = any(own < other for own, other in zip(zone.sizes, sizes, strict=True))
        counts = [(high[axis] - low[axis]) / zone.sizes[axis] for axis in (0, 1)]
        require_few(int(max(counts)), f"zones[{number}].size")
        rule = f"{zone.size} must be less than the quads elsewhere, {sizes[0]:g} x {sizes[1]:g}"
        require(finer, f"zones[{number}].size", rule)


def spans_of(zones: Iterable[Zone], axis: int, largest: float, origin: float) -> list[Span]:
    """The zones along an axis, from an origin; a size that is not finer than elsewhere is left."""
    spans = []
    for zone in zones:
        low, high = zone.reach(axis)
        if zone.sizes[axis] < largest:
            spans.append(Span(low - origin, high - origin, zone.sizes[axis]))
    return spans
