"""Cross-ply plates that shear through below their strength, since quads are too wide for it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from plydyn_pre.deck.crushing import LOST, early_share
from plydyn_pre.deck.names import Names
from plydyn_pre.mesh import Mesh, Rectangle
from plydyn_pre.mesh.grid import Integers
from plydyn_pre.study import ZONE_OF_CRACKS, resolved
from plydyn_pre.study.laminate import Laminate
from plydyn_pre.study.materials import Material, PlyCodam2
from plydyn_pre.study.study import Study

#: Degrees by which plies may lie off two directions at a right angle that bear no shear
_OFF = 10.0


def early_shear(study: Study, mesh: Mesh) -> Iterator[str]:
    """Plies of laminates without any at another angle whose matrix cracks early in shear.

    Of plates that are struck. All of their plies have the same shear in the plane: once it cracks
    them they give way together, in bands up to the edges of the plate.
    """
    struck = any(run.impactor is not None for run in study.parts_of_chain)
    if not struck or study.bricks is not None or _cracks_everywhere(study):
        return
    names = Names(resolved(study), mesh)
    for part, quads in names.mesh.parts.items():
        laminate = names.study.laminate_of(part)
        if part != ZONE_OF_CRACKS and _is_cross_ply(laminate, names.study.materials):
            yield from _early(names.study, names.mesh, quads, laminate)


def _cracks_everywhere(study: Study) -> bool:
    """Whether all cracks of the matrix are lines, so that none is smeared over quads."""
    return study.cracks is not None and isinstance(study.mesh, Rectangle)


def _is_cross_ply(laminate: Laminate, materials: Mapping[str, Material]) -> bool:
    """Whether all plies can crack and lie in two directions at a right angle, or in one."""
    angles = [ply.angle for ply in laminate.stack]
    in_line = any(all(_between(one, each) <= _OFF for each in angles) for one in angles)
    return in_line and all(isinstance(materials[ply.material], PlyCodam2) for ply in laminate.stack)


def _between(one: float, other: float) -> float:
    """Degrees between a direction and the nearer of another one and its normal."""
    return abs((one - other + 45.0) % 90.0 - 45.0)


def _early(study: Study, mesh: Mesh, quads: Integers, laminate: Laminate) -> Iterator[str]:
    """Shear at which plies of a part crack, where that is less than their strength."""
    sides = np.ptp(mesh.nodes[mesh.quads[quads]], axis=1)
    for name in {ply.material: None for ply in laminate.stack}:
        ply = study.materials[name]
        if not isinstance(ply, PlyCodam2):
            continue
        wide = max(_widest(sides, each.angle) for each in laminate.stack if each.material == name)
        share = early_share(ply, mesh, wide, 2.0 * ply.G12 * (ply.G2S or ply.G2T) / ply.SL**2)
        if share < 1.0 - LOST:
            yield (
                f"materials.{name}.SL: in quads {wide:.3g} {study.units.length} wide across the"
                f" fibres the matrix cracks in shear at {share * ply.SL:.4g} of {ply.SL:g}, and no"
                " ply at another angle bears the shear of this laminate: plies may break in bands"
                ' up to the edges of the plate. snap_back = "drop" keeps the strength'
            )


def _widest(sides: np.ndarray, angle: float) -> float:
    """Largest chord across the fibres of quads with sides along x and y, (quads, 2)."""
    across = np.abs([np.sin(np.deg2rad(angle)), np.cos(np.deg2rad(angle))])
    return float((1.0 / (across / sides).max(axis=1)).max())
