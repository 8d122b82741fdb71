"""A quarter of the plate cut away, so that the plies are seen through the thickness."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pyvista as pv

from plydyn_post.hexahedra import refine_cells, same
from plydyn_post.surface import Block, Surface, extent, joined, surface_of

# Finer cells along each edge of one that a cut goes through
PARTS = 4


def cut_surface(blocks: list[Block], points: np.ndarray, corner: tuple[float, float]) -> Surface:
    """The surface of what is left without the quarter x > corner x, y < corner y."""
    step = 1e-6 * extent(points)
    rest, through = [], []
    for block in blocks:
        x, y = (points[block.nodes, axis].reshape(len(block.nodes), -1) for axis in (0, 1))
        left = (x.max(axis=1) <= corner[0] + step) | (y.min(axis=1) >= corner[1] - step)
        gone = (x.min(axis=1) >= corner[0] - step) & (y.max(axis=1) <= corner[1] + step)
        rest.append(_chosen(block, ~gone))
        through.append(_chosen(block, ~left & ~gone))
    outside = surface_of(rest, points)
    if not any(len(block.nodes) for block in through):
        return outside
    faces = [_cut_faces(block, points, corner, step) for block in through]
    return joined([_outside_quarter(outside, corner, step), *faces])


def _chosen(block: Block, chosen: np.ndarray) -> Block:
    return replace(block, nodes=block.nodes[chosen], ply=block.ply[chosen])


def _outside_quarter(surface: Surface, corner: tuple[float, float], step: float) -> Surface:
    """What of a surface lies outside the quarter; faces in the cut itself stay."""
    x, y = corner[0] + step, corner[1] - step
    behind = _beyond(surface, 0, -1.0, x)
    beside = _beyond(_beyond(surface, 0, 1.0, x), 1, 1.0, y)
    return joined([behind, beside])


def _beyond(surface: Surface, axis: int, sign: float, limit: float) -> Surface:
    """What of a surface lies beyond a plane across an axis."""
    height = sign * (surface.points[:, axis] - limit)
    points, triangles = triangles_beyond(surface.points, surface.triangles, height)
    ply_lines, mesh_lines = (
        lines_beyond(lines, sign * (lines[..., axis] - limit))
        for lines in (surface.ply_lines, surface.mesh_lines)
    )
    return Surface(points, triangles, ply_lines, mesh_lines)


def triangles_beyond(
    points: np.ndarray, triangles: np.ndarray, height: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles of the part where a height given at the points is positive."""
    above = height > 0.0
    count = above[triangles].sum(axis=1)
    # turned so that the point alone on its side comes first: the edges from it are cut
    alone = np.where(count[:, None] == 1, above[triangles], ~above[triangles]).argmax(axis=1)
    a, b, c = (
        np.take_along_axis(triangles, (alone[:, None] + turn) % 3, 1)[:, 0] for turn in range(3)
    )
    one, two = count == 1, count == 2
    cut = one | two
    edges = np.concatenate([np.column_stack([a[cut], b[cut]]), np.column_stack([a[cut], c[cut]])])
    first, kind, _ = same(np.sort(edges, axis=1))
    start, end = edges[first].T
    share = height[start] / (height[start] - height[end])
    new = points[start] + share[:, None] * (points[end] - points[start])
    on_b, on_c = np.zeros((2, len(triangles)), dtype=int)
    on_b[cut], on_c[cut] = len(points) + kind.reshape(2, -1)
    pieces = [
        triangles[count == 3],
        np.column_stack([a, on_b, on_c])[one],
        np.column_stack([b, c, on_c])[two],
        np.column_stack([b, on_c, on_b])[two],
    ]
    return np.concatenate([points, new]), np.concatenate(pieces)


def lines_beyond(lines: np.ndarray, height: np.ndarray) -> np.ndarray:
    """Parts of segments where a height given at their ends is positive."""
    kept = height.max(axis=1) > 0.0
    lines, height = lines[kept], height[kept]
    rise = height[:, 1] - height[:, 0]
    zero = np.clip(-height[:, 0] / np.where(rise == 0.0, 1.0, rise), 0.0, 1.0)
    start = np.where(height[:, 0] < 0.0, zero, 0.0)[:, None]
    end = np.where(height[:, 1] < 0.0, zero, 1.0)[:, None]
    way = lines[:, 1] - lines[:, 0]
    return np.stack([lines[:, 0] + start * way, lines[:, 0] + end * way], axis=1)


def _cut_faces(
    block: Block, points: np.ndarray, corner: tuple[float, float], step: float
) -> Surface:
    """Where the cuts go through cells: a face for every ply, with its edges."""
    pieces = []
    for ply in np.unique(block.ply):
        grid = _fine_grid(_chosen(block, block.ply == ply), points)
        across_x = grid.slice("x", origin=(*corner, 0)).clip("y", origin=(*corner, 0))
        across_y = grid.slice("y", origin=(*corner, 0)).clip("-x", origin=(*corner, 0))
        for face, look in ((across_x, (1.0, 0.0, 0.0)), (across_y, (0.0, -1.0, 0.0))):
            if face.n_cells:
                flat = face.triangulate()
                seven, triangles = np.asarray(flat.point_data["seven"]), flat.regular_faces
                edges = _level_edges(face, step, look)
                pieces.append(Surface(seven, triangles.astype(int), ply_lines=edges))
    return joined(pieces)


def _fine_grid(block: Block, points: np.ndarray) -> pv.UnstructuredGrid:
    """Linear hexahedra at time zero that carry the seven numbers."""
    fine = refine_cells(points[block.nodes], PARTS)
    number = np.arange(fine[..., 0].size).reshape(fine.shape[:4])
    low, high = slice(None, -1), slice(1, None)
    around = [(low, low), (high, low), (high, high), (low, high)]
    corners = [number[:, i, j, k].ravel() for k in (low, high) for i, j in around]
    grid = pv.UnstructuredGrid(
        {pv.CellType.HEXAHEDRON: np.column_stack(corners)}, fine[..., :3].reshape(-1, 3)
    )
    grid.point_data["seven"] = fine.reshape(-1, 7)
    return grid.clean(tolerance=1e-6 * extent(points))


def _level_edges(face: pv.PolyData, step: float, look: tuple[float, float, float]) -> np.ndarray:
    """Edges of a face of a cut that run along the ply, (segments, 2, 10)."""
    edges = face.clean(tolerance=step, absolute=True).extract_feature_edges(
        feature_edges=False, non_manifold_edges=False, manifold_edges=False
    )
    lines = np.asarray(edges.lines).reshape(-1, 3)[:, 1:]
    if len(lines) == 0:
        return np.empty((0, 2, 10))
    ends = np.asarray(edges.point_data["seven"])[lines]
    rise = np.abs(ends[:, 0, 2] - ends[:, 1, 2])
    length = np.linalg.norm(ends[:, 0, :3] - ends[:, 1, :3], axis=1)
    level = ends[rise <= 0.5 * length]
    return np.concatenate([level, np.broadcast_to(look, (*level.shape[:2], 3))], axis=2)
