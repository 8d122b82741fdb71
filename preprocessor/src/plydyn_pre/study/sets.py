"""Named sets: nodes and quads by their place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from plydyn_pre.errors import require
from plydyn_pre.mesh.region import Annulus, Box, Circle, check_box, check_circle, check_ring
from plydyn_pre.study.laminate import Laminate

#: The set of all nodes and quads
ALL = "all"
#: Keys of rules that have quads, too
REGIONS = ("box", "circle", "ring")
_KEYS = (*REGIONS, "at", "line")
#: Share of the thickness by which faces may differ that count as the same
_SAME = 1.0e-9


@dataclass(frozen=True)
class PlaceSet:
    """Nodes or quads by their place, whichever the user of the set takes.

    In a box, a circle or a ring are the nodes there, and the quads whose middle is there. A node at
    a place and the mesh line next to a line have nodes only.
    """

    box: Box | None = None  # smallest x, largest x, the same of y
    circle: Circle | None = None  # x and y of the middle, radius
    ring: Annulus | None = None  # x and y of the middle, inner and outer radius
    at: tuple[float, float] | None = None  # x, y of a node
    line: tuple[float, float, float, float] | None = None  # along x or y: its ends, x1, y1, x2, y2

    def __post_init__(self) -> None:
        """Refuse two rules, and none."""
        rule = (
            "a set needs one of box = [x1, x2, y1, y2], circle = [x, y, radius],"
            " ring = [x, y, inner, outer], at = [x, y], line = [x1, y1, x2, y2]"
        )
        require(sum(getattr(self, key) is not None for key in _KEYS) == 1, "", rule)
        check_box(self.box)
        check_circle(self.circle)
        check_ring(self.ring)
        if self.line is not None:
            x1, y1, x2, y2 = self.line
            require((x1 == x2) != (y1 == y2), "line", "a line must lie along x or along y")

    @property
    def key(self) -> str:
        """The key of its rule."""
        return next(key for key in _KEYS if getattr(self, key) is not None)


def check_parts(
    parts: Mapping[str, PlaceSet],
    laminates: Mapping[str, Laminate],
    every: Sequence[Laminate],
    bricks: object,
) -> None:
    """Refuse parts of quads that cannot be, or that would be nothing new."""
    for name, rule in parts.items():
        path = f"parts.{name}"
        require(bricks is None, path, "bricks have one part; leave bricks out")
        require(rule.key in REGIONS, f"{path}.{rule.key}", "quads need box, circle or ring")
        require(name in laminates, f"laminates.{name}", f"missing; parts.{name} needs it")
    if parts:
        low, high = every[0].bottom, every[0].bottom + every[0].total
        slack = _SAME * every[0].total
        rule_of_faces = "laminates of parts need the same bottom and top faces"
        for each in every:
            same = abs(each.bottom - low) <= slack and abs(each.bottom + each.total - high) <= slack
            require(same, "laminates", rule_of_faces)
