"""Plates that are pressed along fibres which crush early, since quads are too wide for them."""

from __future__ import annotations

from collections.abc import Iterator
from math import sqrt

import numpy as np

from plydyn_pre.deck.names import Names
from plydyn_pre.mesh import Mesh
from plydyn_pre.mesh.grid import Integers
from plydyn_pre.study.bodies import runs
from plydyn_pre.study.conditions import Motion
from plydyn_pre.study.laminate import Laminate
from plydyn_pre.study.materials import PlyCodam2
from plydyn_pre.study.study import Study

#: Share of a quad's length that its crack band is wide, with four and with nine nodes
_BAND = {1: 1.0, 2: 13.0 / 18.0}
#: Share of the strength that a coarse mesh may cost without a word
LOST = 0.05
#: Degrees between fibres and load up to which the fibres are along it
_ALONG = 22.5


def early_crushing(study: Study, mesh: Mesh) -> Iterator[str]:
    """Materials whose fibres start to crush below their strength in a part that is pressed."""
    names = Names(study, mesh)
    pressed = {
        load.direction: None
        for run in runs(study)
        for number, load in enumerate(run.own.loads, start=1)
        if isinstance(load, Motion) and _presses(names, load, f"{run.path}loads[{number}].set")
    }
    for direction in pressed:
        for part, quads in mesh.parts.items():
            laminate = study.laminates.get(part, study.laminate)
            if laminate is not None:
                yield from _early(study, mesh, quads, laminate, "xy".index(direction))


def _presses(names: Names, load: Motion, path: str) -> bool:
    """Whether nodes beside the middle are moved towards it, along x or y."""
    if load.direction == "z":
        return False
    axis, mesh = "xy".index(load.direction), names.mesh
    curve = names.study.curves[load.curve].value if load.curve else (1.0,)
    way = load.value * max(curve, key=abs)
    beside = mesh.nodes[names.nodes_of(load.set, path), axis].mean() - mesh.middle[axis]
    return bool(way * beside < 0.0)


def _early(
    study: Study, mesh: Mesh, quads: Integers, laminate: Laminate, axis: int
) -> Iterator[str]:
    """What the fibres along an axis of a part bear, where that is less than their strength."""
    long = float(np.ptp(mesh.nodes[mesh.quads[quads], axis], axis=1).max())
    names = {ply.material: None for ply in laminate.stack if _is_along(ply.angle, axis)}
    for name in names:
        ply = study.materials[name]
        if not isinstance(ply, PlyCodam2):
            continue
        share = early_share(ply, mesh, long, stable_band(ply))
        if share < 1.0 - LOST:
            yield (
                f"materials.{name}.XC: in quads {long:.3g} {study.units.length} long along"
                f" {'xy'[axis]} fibres start to crush at {share * ply.XC:.4g} of {ply.XC:g}, at a"
                f" strain of {100.0 * share * ply.XC / ply.E1:.2g} %; the plate may fail there,"
                ' clear of the damage. Smaller quads help, or snap_back = "drop"'
            )


def _is_along(angle: float, axis: int) -> bool:
    """Whether fibres run along x or y."""
    return abs((angle - 90.0 * axis + 90.0) % 180.0 - 90.0) <= _ALONG


def early_share(ply: PlyCodam2, mesh: Mesh, long: float, stable: float) -> float:
    """Share of a strength at which damage starts in quads of some length.

    By the widest stable band; 1 where the strength is kept, or where quads do not give the width.
    """
    by_quads = bool(ply.width) or ply.width_rule == "band"
    if ply.snap_back != "reduce" or ply.average_along or not by_quads:
        return 1.0
    band = ply.width or _BAND[mesh.order] * long
    return min(1.0, sqrt(stable / (ply.snap_ratio * band)))


def stable_band(ply: PlyCodam2) -> float:
    """The widest band over which crushed fibres soften without snapping back.

    On one line it is 2 E1 G1C / XC**2 (Bazant and Oh, 1983); on two lines the one that ends first
    counts, and a plateau leaves the stress above it to fall.
    """
    first = 1.0
    if ply.FXC < 1.0:
        first = min(ply.FGXC / ply.FXC, (1.0 - ply.FGXC) / (1.0 - ply.FXC))
    return 2.0 * ply.E1 * ply.G1C / ply.XC**2 * first / (1.0 - ply.plateau) ** 2
