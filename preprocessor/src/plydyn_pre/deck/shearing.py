"""Cross-ply plates that shear through below their strength, since quads are too wide for it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from plydyn_pre.deck.crushing import LOST, early_share
from plydyn_pre.mesh import Mesh, Rectangle
from plydyn_pre.mesh.grid import Integers
from plydyn_pre.study.laminate import Laminate
from plydyn_pre.study.materials import PlyCodam2
from plydyn_pre.study.study import Study

#: Degrees by which plies may lie off two directions at a right angle that bear no shear
_OFF = 10.0


def early_shear(study: Study, mesh: Mesh) -> Iterator[str]:
    """Plies of laminates without any at another angle whose matrix cracks early in shear.

    Of plates that are struck. All of their plies have the same shear in the plane: once it cracks
    them they give way together, in bands up to the edges of the plate.
    """
    if all(run.impactor is None for run in study.parts_of_chain) or _cracks_everywhere(study):
        return
    for part, quads in mesh.parts.items():
        laminate = study.laminates.get(part, study.laminate)
        if laminate is not None and _is_cross_ply(laminate):
            yield from _early(study, mesh, quads, laminate)


def _cracks_everywhere(study: Study) -> bool:
    """Whether all cracks of the matrix are lines, so that none is smeared over quads."""
    return study.cracks is not None and isinstance(study.mesh, Rectangle)


def _is_cross_ply(laminate: Laminate) -> bool:
    """Whether plies lie in two directions at a right angle, or in one."""
    first = laminate.stack[0].angle
    return all(abs((ply.angle - first + 45.0) % 90.0 - 45.0) <= _OFF for ply in laminate.stack)


def _early(study: Study, mesh: Mesh, quads: Integers, laminate: Laminate) -> Iterator[str]:
    """Shear at which plies of a part crack, where that is less than their strength."""
    corners = mesh.nodes[mesh.quads[quads]]
    long = float(np.ptp(corners, axis=1).max())
    for name in {ply.material: None for ply in laminate.stack}:
        ply = study.materials[name]
        if not isinstance(ply, PlyCodam2):
            continue
        share = early_share(ply, mesh, long, 2.0 * ply.G12 * (ply.G2S or ply.G2T) / ply.SL**2)
        if share < 1.0 - LOST:
            yield (
                f"materials.{name}.SL: in quads {long:.3g} {study.units.length} long the matrix"
                f" cracks in shear at {share * ply.SL:.4g} of {ply.SL:g}, and no ply at another"
                " angle bears the shear of this laminate: plies may break in bands up to the"
                ' edges of the plate. snap_back = "drop" keeps the strength'
            )
