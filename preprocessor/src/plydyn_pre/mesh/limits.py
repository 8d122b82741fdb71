"""How large and how fine a mesh may be."""

from __future__ import annotations

import numpy as np

from plydyn_pre.errors import MeshError, require
from plydyn_pre.mesh.grid import SIDES, Mesh

#: Quads of a mesh; of nine nodes they have two million nodes
MOST_QUADS = 500_000
#: Ratio of the lengths of two neighbouring sizes beyond which quads are slivers
MOST_GRADING = 1000.0
#: Largest size of a quad over that of the one before on a line of growing quads
LARGEST_GROWTH = 2.0
# shortest side of a quad over the largest coordinate: a deck has ten digits of a coordinate
_FINEST = 1e-6


def require_few(count: int, path: str) -> None:
    """Refuse a mesh that would take the machine's memory, before it is made."""
    rule = f"{count:,} quads would be made, at most {MOST_QUADS:,} can be; take fewer"
    require(count <= MOST_QUADS, path, rule)


def require_grading(grading: float) -> None:
    """Refuse a grading that leaves slivers."""
    most = f"{grading:g} must be from {1 / MOST_GRADING:g} to {MOST_GRADING:g}"
    require(1 / MOST_GRADING <= grading <= MOST_GRADING, "grading", most)


def refuse_slivers(mesh: Mesh) -> Mesh:
    """A mesh whose quads keep their shape with the digits of a deck, or an error."""
    corners = mesh.nodes[mesh.quads[:, :4]]
    sides = np.stack([corners[:, j] - corners[:, i] for i, j in SIDES], axis=1)
    lengths = np.hypot(sides[..., 0], sides[..., 1]).min(axis=1)
    worst = int(np.argmin(lengths))
    reach = float(np.abs(mesh.nodes).max())
    if not lengths[worst] >= _FINEST * reach:
        size, least = float(lengths[worst]), _FINEST * reach
        raise MeshError(
            f"quad {mesh.quad_ids[worst]} has a side of {size:.3g}, too short beside coordinates of"
            f" up to {reach:.3g}: {least:.3g} or more is needed"
        )
    return mesh
