"""O-grids: a square core of n x n quads with rings of 4 n quads around it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Literal

import numpy as np

from plydyn_pre.errors import require, require_positive
from plydyn_pre.mesh.boards import RingBoard
from plydyn_pre.mesh.grid import Mesh, Reals, with_centre
from plydyn_pre.mesh.limits import require_few, require_grading
from plydyn_pre.mesh.lines import graded_line, place_on
from plydyn_pre.mesh.quarter import quarter_of

_EDGES = ("bottom", "right", "top", "left")
# share of its shortest side by which the middle of a quad may lie off: with more the solver takes
# its nodes to be in another order
_MOST_OFF = 0.25


@dataclass(frozen=True)
class OgridSquare:
    """A square with a square core. Node sets: left, right, bottom, top, boundary, centre, core."""

    kind: ClassVar[str] = "ogrid_square"

    side: float  # length
    core: float  # side of the core, length
    n: int  # quads along a side of the core
    rings: int  # rings of quads around the core
    grading: float = 1.0  # width of the outermost ring over that of the innermost
    order: Literal[1, 2] = 2  # quads of four or of nine nodes
    corner: tuple[float, float] = (0.0, 0.0)  # place of the corner with the smallest x and y

    def __post_init__(self) -> None:
        """Refuse what cannot be meshed."""
        require_positive(self, "side", "core", "n", "rings")
        require_grading(self.grading)
        require_few(self.n**2 + 4 * self.n * self.rings, "n")
        rule = f"{self.core:g} must be less than the side, {self.side:g}"
        require(self.core < self.side, "core", rule)


@dataclass(frozen=True)
class OgridDisc:
    """A disc with a square core, or a quarter of it.

    Node sets: boundary, centre, core; of a quarter symmetry_x and symmetry_y, too.
    """

    kind: ClassVar[str] = "ogrid_disc"

    diameter: float  # length
    core: float  # side of the core, length
    n: int  # quads along a side of the core
    rings: int  # rings of quads around the core
    grading: float = 1.0  # width of the outermost ring over that of the innermost
    order: Literal[1, 2] = 2  # quads of four or of nine nodes
    centre: tuple[float, float] = (0.0, 0.0)  # place of the middle
    quarter: bool = False  # only what lies at larger x and y than the middle

    def __post_init__(self) -> None:
        """Refuse what cannot be meshed."""
        require_positive(self, "diameter", "core", "n", "rings")
        require_grading(self.grading)
        require_few(self.n**2 + 4 * self.n * self.rings, "n")
        limit = self.diameter / np.sqrt(2.0)
        rule = f"{self.core:g} must be less than diameter / sqrt(2) = {limit:g}"
        require(self.core < limit, "core", rule)
        rule = f"{self.n} must be even: a quarter is cut between quads"
        require(not self.quarter or self.n % 2 == 0, "n", rule)
        rule = f"{self.n} quads along the core bend too much around it: more, or a smaller core"
        require(self.order == 1 or _bend(self) <= _MOST_OFF, "n", rule)


def mesh_ogrid_square(shape: OgridSquare) -> Mesh:
    """Mesh a square; the nodes of the rings lie on straight lines from the core to the edges."""
    board = RingBoard(shape.n, shape.rings, shape.order)
    places = _places(shape, board.unit, board.ring, shape.side / 2 * board.unit)
    return with_centre(board.mesh(np.array(shape.corner) + shape.side / 2 + places))


def mesh_ogrid_disc(shape: OgridDisc) -> Mesh:
    """Mesh a disc; the nodes of the rings lie on straight lines from the core to the circle.

    On the circle all nodes, mid-sides too, have the same distance from each other.
    """
    board = RingBoard(shape.n, shape.rings, shape.order)
    mesh = board.mesh(np.array(shape.centre) + _places_of_disc(shape, board.unit, board.ring))
    sets = {name: nodes for name, nodes in mesh.node_sets.items() if name not in _EDGES}
    whole = replace(mesh, node_sets=sets)
    return with_centre(quarter_of(whole) if shape.quarter else whole)


def _bend(shape: OgridDisc) -> float:
    """How far the middles of the quads in the rings lie off, in shortest sides; the worst."""
    along, rings = np.meshgrid(
        np.linspace(-1.0, 1.0, 2 * shape.n + 1),
        np.linspace(0.0, shape.rings, 2 * shape.rings + 1),
    )
    unit = np.stack([along, np.ones_like(along)], axis=-1).reshape(-1, 2)
    places = _places_of_disc(shape, unit, rings.ravel()).reshape(*along.shape, 2)
    left, right = places[:, :-1:2], places[:, 2::2]
    corners = np.stack([left[:-1:2], right[:-1:2], right[2::2], left[2::2]])
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=-1)
    off = np.linalg.norm(places[1::2, 1::2] - corners.mean(axis=0), axis=-1)
    return float((off / sides.min(axis=0)).max())


def _places_of_disc(shape: OgridDisc, unit: Reals, ring: Reals) -> Reals:
    """Places around the origin of nodes of a disc, (nodes, 2)."""
    return _places(shape, unit, ring, shape.diameter / 2 * to_circle(unit))


def _places(shape: OgridSquare | OgridDisc, unit: Reals, ring: Reals, outer: Reals) -> Reals:
    """Places around the origin of nodes of a board, (nodes, 2); `outer` are those on the edge."""
    share = place_on(graded_line(1.0, shape.rings, shape.grading), ring)[:, None]
    return (1.0 - share) * shape.core / 2 * unit + share * outer


def to_circle(unit: Reals) -> Reals:
    """Places on the unit circle for those on the edge of a square: equal steps, equal angles."""
    x, y = unit.T
    flat = np.abs(y) >= np.abs(x)
    angle = np.pi / 4 * np.where(flat, x * y, y * x)
    along, across = np.cos(angle), np.sin(angle)
    return np.where(
        flat[:, None],
        np.stack([y * across, y * along], axis=1),
        np.stack([x * along, x * across], axis=1),
    )
