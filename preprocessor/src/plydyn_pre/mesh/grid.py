"""A plane mesh of quads, with its named sets."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from plydyn_pre.errors import MeshError

Reals = NDArray[np.float64]
Integers = NDArray[np.int64]

#: Corners at the two ends of each side of a quad
SIDES = ((0, 1), (1, 2), (2, 3), (3, 0))
#: The same quad walked the other way round, by its number of nodes
_FLIPPED = {4: [0, 3, 2, 1], 9: [0, 3, 2, 1, 7, 6, 5, 4, 8]}


@dataclass(frozen=True)
class Mesh:
    """Nodes of the reference plane and the quads between them, counter-clockwise from above.

    A quad of nine nodes: corners, mid-sides from the one between the first two corners on, centre.
    """

    nodes: Reals  # (nodes, 2)
    quads: Integers  # (quads, 4 or 9), indices into nodes
    parts: dict[str, Integers]  # quads of each part; every quad is in one
    node_sets: dict[str, Integers] = field(default_factory=dict)
    quad_sets: dict[str, Integers] = field(default_factory=dict)
    node_ids: Integers = field(default_factory=lambda: np.empty(0, np.int64))  # (nodes,)
    quad_ids: Integers = field(default_factory=lambda: np.empty(0, np.int64))  # (quads,)
    height: float = 0.0  # z of the plane
    whole_middle: tuple[float, float] | None = None  # of what this is a quarter of

    def __post_init__(self) -> None:
        """Number nodes and quads from 1 where they have no numbers."""
        if not len(self.node_ids):
            object.__setattr__(self, "node_ids", np.arange(1, len(self.nodes) + 1))
        if not len(self.quad_ids):
            object.__setattr__(self, "quad_ids", np.arange(1, len(self.quads) + 1))

    @property
    def order(self) -> int:
        """1 for quads of four nodes, 2 for quads of nine."""
        return 1 if self.quads.shape[1] == 4 else 2

    @property
    def middle(self) -> tuple[float, float]:
        """The middle of the smallest box around the mesh, or around what it is a quarter of."""
        if self.whole_middle is not None:
            return self.whole_middle
        x, y = (self.nodes.min(axis=0) + self.nodes.max(axis=0)) / 2
        return float(x), float(y)

    @property
    def size(self) -> float:
        """The longer side of that box."""
        return float(np.ptp(self.nodes, axis=0).max())


def node_near(mesh: Mesh, place: tuple[float, float]) -> tuple[int, float]:
    """The node nearest to a place, as an index, and how far it is."""
    distance = np.hypot(*(mesh.nodes - place).T)
    nearest = int(np.argmin(distance))
    return nearest, float(distance[nearest])


def with_centre(mesh: Mesh) -> Mesh:
    """The mesh with the set ``centre``, where a node lies in the middle."""
    nearest, distance = node_near(mesh, mesh.middle)
    if distance > 1e-9 * mesh.size:
        return mesh
    return replace(mesh, node_sets={**mesh.node_sets, "centre": np.array([nearest])})


def counter_clockwise(nodes: Reals, quads: Integers) -> Integers:
    """Quads with those turned over that run clockwise."""
    x, y = np.moveaxis(nodes[quads[:, :4]], 2, 0)
    twice_area = (x[:, 2] - x[:, 0]) * (y[:, 3] - y[:, 1])
    twice_area -= (x[:, 3] - x[:, 1]) * (y[:, 2] - y[:, 0])
    if np.any(twice_area == 0.0):
        raise MeshError(f"quad {int(np.argmin(np.abs(twice_area))) + 1} of the mesh has no area")
    flipped = quads[:, _FLIPPED[quads.shape[1]]]
    return np.where((twice_area < 0.0)[:, None], flipped, quads)
