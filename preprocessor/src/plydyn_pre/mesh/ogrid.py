"""O-grids: a square core of n x n quads with rings of 4 n quads around it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar, Literal

import numpy as np

from plydyn_pre.errors import require, require_positive
from plydyn_pre.mesh.blocks import Blocks, graded_line, place_on, to_halves
from plydyn_pre.mesh.grid import Mesh, Reals, renumbered, with_centre, with_set
from plydyn_pre.mesh.limits import require_few, require_grading
from plydyn_pre.mesh.quarter import quarter_of
from plydyn_pre.mesh.session import collect, generate, session

_CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))
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
    mesh = mesh_board(shape.n, shape.rings, shape.order)
    places = _places(mesh.nodes, shape, lambda unit: shape.side / 2 * unit)
    middle = np.array(shape.corner) + shape.side / 2
    return with_centre(renumbered(mesh, middle + places))


def mesh_ogrid_disc(shape: OgridDisc) -> Mesh:
    """Mesh a disc; the nodes of the rings lie on straight lines from the core to the circle.

    On the circle all nodes, mid-sides too, have the same distance from each other.
    """
    mesh = mesh_board(shape.n, shape.rings, shape.order)
    sets = {name: nodes for name, nodes in mesh.node_sets.items() if name not in _EDGES}
    places = _places_of_disc(mesh.nodes, shape)
    whole = renumbered(replace(mesh, node_sets=sets), np.array(shape.centre) + places)
    return with_centre(quarter_of(whole) if shape.quarter else whole)


def _bend(shape: OgridDisc) -> float:
    """How far the middles of the quads in the rings lie off, in shortest sides; the worst."""
    along, reach = np.meshgrid(
        np.linspace(-1.0, 1.0, 2 * shape.n + 1),
        np.linspace(shape.n / 2, shape.n / 2 + shape.rings, 2 * shape.rings + 1),
    )
    board = np.stack([along * reach, reach], axis=-1)
    places = _places_of_disc(board.reshape(-1, 2), shape).reshape(board.shape)
    left, right = places[:, :-1:2], places[:, 2::2]
    corners = np.stack([left[:-1:2], right[:-1:2], right[2::2], left[2::2]])
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=-1)
    off = np.linalg.norm(places[1::2, 1::2] - corners.mean(axis=0), axis=-1)
    return float((off / sides.min(axis=0)).max())


def _places_of_disc(board: Reals, shape: OgridDisc) -> Reals:
    """Places around the origin of nodes on the board of a disc, (nodes, 2)."""
    return _places(board, shape, lambda unit: shape.diameter / 2 * to_circle(unit))


def mesh_board(n: int, rings: int, order: int) -> Mesh:
    """The O-grid around the origin of a core of n x n quads and rings, all one wide."""
    core, edge = n / 2, n / 2 + rings
    with session() as gmsh:
        blocks = Blocks(gmsh)
        inner = [blocks.add_point(x * core, y * core) for x, y in _CORNERS]
        outer = [blocks.add_point(x * edge, y * edge) for x, y in _CORNERS]
        edges: dict[str, list[int]] = {}
        for i, name in enumerate(_EDGES):
            j = (i + 1) % 4
            blocks.add_line(inner[i], inner[j], n)
            blocks.add_line(inner[i], outer[i], rings)
            edges[name] = [blocks.add_line(outer[i], outer[j], n)]
        middle = blocks.add_block(inner)
        around = [
            blocks.add_block((outer[i], outer[j], inner[j], inner[i]))
            for i, j in ((0, 1), (1, 2), (2, 3), (3, 0))
        ]
        blocks.finish()
        generate(gmsh, order)
        edges["boundary"] = [line for edge in tuple(edges.values()) for line in edge]
        mesh = collect(gmsh, {"plate": [middle, *around]}, {"core": [middle]}, edges, {})
    return with_set(mesh, "core", np.unique(mesh.quads[mesh.quad_sets["core"]]))


def _places(board: Reals, shape: OgridSquare | OgridDisc, outer: Callable[[Reals], Reals]) -> Reals:
    """Places around the origin of nodes on the board, (nodes, 2).

    `outer` gives the place on the outer edge that belongs to one on the edge of the square
    between -1 and 1.
    """
    half = shape.n / 2
    reach = np.abs(board).max(axis=1)
    inside = reach < half + 0.25
    rings = graded_line(1.0, shape.rings, shape.grading)
    share = place_on(rings, to_halves(np.where(inside, 0.0, reach - half)))[:, None]
    # place on the edge of the square, from -1 to 1
    unit = to_steps(board / np.where(inside, half, reach)[:, None], shape.n)
    return (1.0 - share) * shape.core / 2 * unit + share * outer(unit)


def to_steps(unit: Reals, n: int) -> Reals:
    """Places between -1 and 1 at the nodes of n quads, without noise."""
    return (np.round((unit + 1.0) * n) - n) / n


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
