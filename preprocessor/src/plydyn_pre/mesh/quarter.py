"""The quarter of a mesh that two planes of symmetry leave."""

from __future__ import annotations

import numpy as np

from plydyn_pre.mesh.grid import Integers, Mesh

#: Node sets on the planes of symmetry, across x and across y
PLANES = ("symmetry_x", "symmetry_y")


def quarter_of(mesh: Mesh) -> Mesh:
    """The quads at larger x and y than the middle, with nodes and quads numbered from 1.

    Sets keep what is left of them; the planes of symmetry become node sets, and the middle stays
    that of the whole. No quad may lie across a plane.
    """
    middle = np.array(mesh.middle)
    off = mesh.nodes - middle
    off[np.abs(off) <= 1e-9 * mesh.size] = 0.0
    kept = np.flatnonzero(np.all(off[mesh.quads] >= 0.0, axis=(1, 2)))
    nodes, quads = np.unique(mesh.quads[kept], return_inverse=True)
    planes = {name: np.flatnonzero(off[nodes, i] == 0.0) for i, name in enumerate(PLANES)}
    return Mesh(
        nodes=middle + off[nodes],
        quads=quads.reshape(-1, mesh.quads.shape[1]),
        parts=_left(mesh.parts, kept),
        node_sets=_left(mesh.node_sets, nodes) | planes,
        quad_sets=_left(mesh.quad_sets, kept),
        height=mesh.height,
        whole_middle=mesh.middle,
    )


def _left(sets: dict[str, Integers], kept: Integers) -> dict[str, Integers]:
    """What is left of sets, as indices into those that are kept."""
    return {
        name: np.searchsorted(kept, members[np.isin(members, kept)])
        for name, members in sets.items()
    }
