"""Areas, Jacobians and sizes of a mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plydyn_pre.mesh.grid import SIDES, Integers, Mesh, Reals

#: Places of the nodes of a quad in its own coordinates
_NODES = np.array(
    [[-1, -1], [1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [0, 1], [-1, 0], [0, 0]], dtype=float
)


@dataclass(frozen=True)
class Quality:
    """How good the quads of a mesh are."""

    area: float  # of all quads
    smallest_jacobian: float  # at a node, over the mean of its quad; 1 for a parallelogram
    worst_quad: int  # number of the quad with that Jacobian
    shortest_side: float
    longest_side: float


def quality(mesh: Mesh) -> Quality:
    """Measure a mesh."""
    areas = quad_areas(mesh)
    at_nodes = jacobians(mesh, _NODES[: mesh.quads.shape[1]])
    relative = at_nodes.min(axis=1) / (areas / 4)
    worst = int(np.argmin(relative))
    corners = mesh.nodes[mesh.quads[:, :4]]
    sides = np.stack([corners[:, j] - corners[:, i] for i, j in SIDES], axis=1)
    lengths = np.hypot(sides[..., 0], sides[..., 1])
    return Quality(
        area=float(areas.sum()),
        smallest_jacobian=float(relative[worst]),
        worst_quad=int(mesh.quad_ids[worst]),
        shortest_side=float(lengths.min()),
        longest_side=float(lengths.max()),
    )


def quad_areas(mesh: Mesh) -> Reals:
    """Area of each quad, exact for its curved sides, (quads,)."""
    places, weights = np.polynomial.legendre.leggauss(3)
    grid = np.stack(np.meshgrid(places, places), axis=-1).reshape(-1, 2)
    return jacobians(mesh, grid) @ np.outer(weights, weights).ravel()


def places_in_quads(mesh: Mesh, quads: Integers, places: Reals) -> Reals:
    """Positions of some places in the own coordinates of some quads, (quads, places, 2)."""
    own = _NODES[: 4 if mesh.order == 1 else 9]
    along, across = (_lagrange(places[:, axis], own[:, axis], mesh.order) for axis in (0, 1))
    return np.einsum("qnx,pn->qpx", mesh.nodes[mesh.quads[quads]], along * across)


def jacobians(mesh: Mesh, places: Reals) -> Reals:
    """Jacobians of all quads at some places in their own coordinates, (quads, places)."""
    slopes = _slopes(places, mesh.order)
    columns = np.einsum("qnx,dpn->dpqx", mesh.nodes[mesh.quads], slopes)
    return (columns[0, ..., 0] * columns[1, ..., 1] - columns[0, ..., 1] * columns[1, ..., 0]).T


def _slopes(places: Reals, order: int) -> Reals:
    """Derivatives of the shape functions along both coordinates, (2, places, nodes)."""
    own = _NODES[: 4 if order == 1 else 9]
    values, slopes = (
        np.stack([function(places[:, axis], own[:, axis], order) for axis in (0, 1)])
        for function in (_lagrange, _lagrange_slope)
    )
    return np.stack([slopes[0] * values[1], values[0] * slopes[1]])


def _lagrange(x: Reals, node: Reals, order: int) -> Reals:
    """Lagrange polynomials of some nodes at -1, 0 and 1, at some places, (places, nodes)."""
    x, node = x[:, None], node[None, :]
    if order == 1:
        return (1.0 + node * x) / 2
    return np.where(node == 0.0, 1.0 - x**2, x * (x + node) / 2)


def _lagrange_slope(x: Reals, node: Reals, order: int) -> Reals:
    """Derivatives of the same."""
    x, node = x[:, None], node[None, :]
    if order == 1:
        return np.broadcast_to(node / 2, np.broadcast_shapes(x.shape, node.shape))
    return np.where(node == 0.0, -2.0 * x, x + node / 2)
