"""What may not act on nodes that crack lines double, where a whole rectangle cracks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from plydyn_pre.deck.names import Names
from plydyn_pre.errors import RecipeError, require
from plydyn_pre.mesh import Rectangle
from plydyn_pre.study.conditions import Force, Lever, LineForce, Motion, Pressure
from plydyn_pre.study.fixtures import Clamp
from plydyn_pre.study.laminate import Laminate
from plydyn_pre.study.stages import Stage
from plydyn_pre.study.study import Study

#: Share of the plate by which a node may lie off an edge of it
_NEAR = 1.0e-9


def check_cracked(names: Names) -> None:
    """Refuse supports, loads and clamps on nodes where plies may crack, before anything has run.

    Zones of coupons lie in the core, clear of what holds a plate.
    """
    study = names.study
    if study.cracks is None or study.laminate is None or not isinstance(study.mesh, Rectangle):
        return
    cracked = _cracked_nodes(study.laminate, names.mesh.nodes)
    for path, run in study.named_runs:
        for number, fixture in enumerate(run.fixtures, start=1):
            rule = "a rectangle with cracks has crack lines under it; a coupon has none there"
            require(not isinstance(fixture, Clamp), f"{path}fixtures[{number}]", rule)
        for key, sets in _held(run):
            if any(cracked[names.nodes_of(each, f"{path}{key}")].any() for each in sets):
                rule = "a rectangle with cracks has crack lines there, whose nodes nothing may hold"
                raise RecipeError(f"{path}{key}", f"{rule} or load: fixtures, or a coupon")


def _cracked_nodes(laminate: Laminate, nodes: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Nodes with quads on both sides of the fibres of some ply, each of which may be doubled."""
    low, high = nodes.min(axis=0), nodes.max(axis=0)
    near = _NEAR * (high - low)
    inner = (nodes > low + near) & (nodes < high - near)
    cracked = np.zeros(len(nodes), dtype=bool)
    for ply in laminate.stack:
        straight = ply.angle % 90.0 == 0.0
        cracked |= inner[:, int(ply.angle % 180.0 == 0.0)] if straight else inner.any(axis=1)
    return cracked


def _held(run: Study | Stage) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Keys of supports and loads that act on nodes, with the names of their sets."""
    for number, support in enumerate(run.supports, start=1):
        yield f"supports[{number}].set", (support.set,)
    for number, load in enumerate(run.loads, start=1):
        if isinstance(load, Force | LineForce | Motion):
            yield f"loads[{number}].set", (load.set,)
        elif isinstance(load, Lever):
            yield f"loads[{number}]", (load.hinge, load.fulcrum)
        elif isinstance(load, Pressure):
            yield f"loads[{number}]", ("all",)
