"""How large a study is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plydyn_pre.extrude import extrude
from plydyn_pre.mesh import Mesh
from plydyn_pre.study import Study


@dataclass(frozen=True)
class Counts:
    """Sizes of the model that a deck describes."""

    quads: int  # bricks of all layers where the plate is of bricks
    nodes: int  # of the plane
    levels: int  # thickness points above a node; of the part that has most
    freedoms: int  # three to every point


def count(study: Study, mesh: Mesh) -> Counts:
    """Count quads, nodes, thickness levels and degrees of freedom.

    Bricks count by their nodes. Tied plies share the points of their faces, plies apart or on
    springs do not. A node between two parts counts with the levels of the one that has more.
    """
    if study.bricks is not None:
        plate = extrude(study, mesh)
        levels_of_bricks = len(plate.heights)
        return Counts(plate.bricks, len(plate.plane.nodes), levels_of_bricks, 3 * plate.nodes)
    levels = np.zeros(len(mesh.nodes), np.int64)
    for part, quads in mesh.parts.items():
        nodes = np.unique(mesh.quads[quads])
        levels[nodes] = np.maximum(levels[nodes], study.laminate_of(part).levels)
    return Counts(
        quads=len(mesh.quads),
        nodes=len(mesh.nodes),
        levels=int(levels.max()),
        freedoms=3 * int(levels.sum()),
    )
