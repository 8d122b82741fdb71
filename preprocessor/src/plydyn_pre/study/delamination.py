"""Interfaces that have failed, or are damaged, before the run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from plydyn_pre.errors import require
from plydyn_pre.mesh.region import Annulus, Box, Circle, check_box, check_circle, check_ring
from plydyn_pre.study.sets import ALL


@dataclass(frozen=True)
class InitialDelamination:
    """A delamination that is there at the start, such as an insert of film.

    A circle takes the points of the interfaces in it; a box, a ring and a set take whole quads.
    """

    interfaces: Literal["all"] | int | tuple[int, ...] = "all"  # from the bottom, from 1
    set: str = ALL  # name of a part or of a set of quads
    box: Box | None = None  # smallest x, largest x, the same of y
    circle: Circle | None = None  # x and y of the middle, radius
    ring: Annulus | None = None  # x and y of the middle, inner and outer radius
    part: str = ""  # name of the part; needed where the mesh has several
    damage: float = 1.0  # below 1 the interface keeps 1 - damage of its stiffness

    def __post_init__(self) -> None:
        """Refuse two places, no interface, and a damage that there is not."""
        check_box(self.box)
        check_circle(self.circle)
        check_ring(self.ring)
        places = [self.box, self.circle, self.ring, None if self.set == ALL else self.set]
        rule = "one of set, box, circle and ring tells the place; leave the others out"
        require(places.count(None) >= len(places) - 1, "", rule)
        require(self.interfaces != (), "interfaces", 'empty; name some, or leave it out for "all"')
        require(
            0.0 < self.damage <= 1.0, "damage", f"{self.damage!r} must be above 0, and 1 at most"
        )

    @property
    def numbers(self) -> tuple[int, ...]:
        """The interfaces that are named; none for all."""
        if isinstance(self.interfaces, tuple):
            return self.interfaces
        return () if isinstance(self.interfaces, str) else (self.interfaces,)
