"""The outer surface of the plate as fine triangles, with the lines between plies.

Points carry seven numbers: their place at time zero, their displacement, and the value shown.
Ends of lines carry three more: the direction in which the face looks that they are on.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial

import numpy as np
import pyvista as pv

from plydyn_post.errors import ResultsError
from plydyn_post.hexahedra import (
    LINEAR,
    QUADRATIC,
    SIDES,
    faces,
    lattice,
    refine_edges,
    refine_faces,
    rounded,
    same,
)
from plydyn_post.vtkhdf import nodes_of

# Finer points of a figure, about: more would not be seen
MANY = 400_000


@dataclass(frozen=True)
class Block:
    """Cells of one kind."""

    kind: int  # type of VTK
    nodes: np.ndarray  # (cells, n, n, n) points of the grid
    ply: np.ndarray  # (cells,)


@dataclass(frozen=True)
class Surface:
    """Triangles and lines; every part may be missing."""

    points: np.ndarray = field(default_factory=partial(np.empty, (0, 7)))
    triangles: np.ndarray = field(default_factory=partial(np.empty, (0, 3), dtype=int))
    ply_lines: np.ndarray = field(default_factory=partial(np.empty, (0, 2, 10)))  # segments
    mesh_lines: np.ndarray = field(default_factory=partial(np.empty, (0, 2, 10)))


def blocks_of(grid: pv.UnstructuredGrid) -> list[Block]:
    """The hexahedra of a grid, by kind."""
    ply = np.asarray(grid.cell_data["ply"]) if "ply" in grid.cell_data else np.ones(grid.n_cells)
    blocks = []
    for kind in map(int, grid.cells_dict):
        if kind in (LINEAR, QUADRATIC):
            of_kind = ply[grid.celltypes == kind].astype(int)
            blocks.append(Block(kind, nodes_of(grid, kind)[:, lattice(kind)], of_kind))
    if not blocks:
        raise ResultsError("the fields hold no hexahedra of 8 or 27 nodes to draw")
    return blocks


def extent(points: np.ndarray) -> float:
    """The larger side of the plate in its plane."""
    return float(np.max(np.ptp(points[:, :2], axis=0)))


def surface_of(blocks: list[Block], points: np.ndarray) -> Surface:
    """The outer surface of some cells; points (points, 7)."""
    found = [_outer_faces(block, points) for block in blocks]
    count = sum(len(block_faces) for block_faces, _, _ in found)
    parts = int(np.clip(np.sqrt(MANY / max(count, 1)), 2, 8))
    pieces = []
    for block_faces, local, ply in found:
        if len(block_faces):
            pieces.append(_refined(points[block_faces], local, ply, parts))
    return joined(pieces)


def joined(pieces: list[Surface]) -> Surface:
    """Several surfaces as one."""
    if not pieces:
        return Surface()
    starts = np.cumsum([0] + [len(piece.points) for piece in pieces[:-1]])
    return Surface(
        np.concatenate([piece.points for piece in pieces]),
        np.concatenate(
            [piece.triangles + start for piece, start in zip(pieces, starts, strict=True)]
        ),
        np.concatenate([piece.ply_lines for piece in pieces]),
        np.concatenate([piece.mesh_lines for piece in pieces]),
    )


def _outer_faces(block: Block, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Faces that no other face covers: nodes (faces, n, n), place in the cell, ply.

    Layers have points of their own, so faces are told apart by where they are and how they moved:
    the two sides of a face that opens are both outer ones.
    """
    shape = faces(block.kind)
    nodes = block.nodes.reshape(len(block.nodes), -1)
    order = np.argsort(lattice(block.kind).ravel())
    all_faces = nodes[:, order][:, shape].reshape(-1, *shape.shape[1:])
    middle = points[all_faces, :6].mean(axis=(1, 2))
    step = 1e-6 * extent(points)
    first, _, count = same(rounded(middle, step))
    outer = np.sort(first[count == 1])
    return all_faces[outer], outer % 6, block.ply[outer // 6]


def _refined(nodes: np.ndarray, local: np.ndarray, ply: np.ndarray, parts: int) -> Surface:
    """Triangles and lines of faces whose nodes are (faces, n, n, 7)."""
    fine = refine_faces(nodes, parts)
    flat = fine.reshape(-1, 7)
    step = 1e-6 * extent(flat)
    # points of neighbours become one, so that light is smooth; not across plies or around edges
    group = np.repeat(ply * 6 + local, (parts + 1) ** 2)
    first, kind, _ = same(np.column_stack([rounded(flat[:, :3], step), group]))
    corner = kind.reshape(fine.shape[:3])
    quads = [corner[:, :-1, :-1], corner[:, 1:, :-1], corner[:, 1:, 1:], corner[:, :-1, 1:]]
    a, b, c, d = (quad.ravel() for quad in quads)
    triangles = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    on_side = np.isin(local, SIDES)
    looking = np.concatenate([nodes, _looks(nodes)], axis=3)
    return Surface(
        flat[first],
        triangles,
        _ply_lines(looking[on_side], ply[on_side], parts),
        _mesh_lines(looking[~on_side], parts),
    )


def _looks(nodes: np.ndarray) -> np.ndarray:
    """The direction in which faces look, the same at all their nodes, (faces, n, n, 3)."""
    place = nodes[..., :3]
    look = np.cross(place[:, -1, 0] - place[:, 0, 0], place[:, 0, -1] - place[:, 0, 0])
    look /= np.linalg.norm(look, axis=1, keepdims=True)
    return np.broadcast_to(look[:, None, None], place.shape)


def _ply_lines(nodes: np.ndarray, ply: np.ndarray, parts: int) -> np.ndarray:
    """Lower and upper edges of side faces, without those between layers of one ply."""
    edges = np.concatenate([nodes[:, :, 0], nodes[:, :, -1]])
    if len(edges) == 0:
        return np.empty((0, 2, 10))
    middle = rounded(edges[:, :, :3].mean(axis=1), 1e-6 * extent(edges.reshape(-1, 10)))
    first, _, count = same(np.column_stack([middle, np.tile(ply, 2)]))
    return _segments(refine_edges(edges[first[count == 1]], parts))


def _mesh_lines(nodes: np.ndarray, parts: int) -> np.ndarray:
    """Edges of the elements on the top and the bottom."""
    edges = np.concatenate([nodes[:, :, 0], nodes[:, :, -1], nodes[:, 0, :], nodes[:, -1, :]])
    if len(edges) == 0:
        return np.empty((0, 2, 10))
    middle = rounded(edges[:, :, :3].mean(axis=1), 1e-6 * extent(edges.reshape(-1, 10)))
    return _segments(refine_edges(edges[same(middle)[0]], parts))


def _segments(lines: np.ndarray) -> np.ndarray:
    """Straight pieces of lines, (lines, n, k) to (pieces, 2, k)."""
    return np.stack([lines[:, :-1], lines[:, 1:]], axis=2).reshape(-1, 2, lines.shape[2])
