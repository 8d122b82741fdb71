"""Levers between two lines of nodes, as linear constraints."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from plydyn_pre.deck.cards import keyword
from plydyn_pre.deck.names import Names
from plydyn_pre.errors import RecipeError
from plydyn_pre.mesh.grid import Integers
from plydyn_pre.study import Lever

_FACES = {"bottom": -1, "top": 1, "all": 2}
_DIRECTIONS = {"x": 1, "y": 2, "z": 3}
_QUANTITIES = {"velocity": 0, "displacement": 2}
# share of the size of the mesh by which two lines may be no copies of each other
_APART = 1.0e-6
#: Constraints of the lever that is load n have numbers above n times this
_NUMBERS = 100_000


def lever_keywords(names: Names, lever: Lever, number: int) -> Iterator[str]:
    """One constraint for each pair of nodes, of the lever that is the so-manieth load."""
    hinges, fulcra, length = _pairs(names, lever, f"loads[{number}]")
    turn = lever.arm / length
    right = {"vad": _QUANTITIES[lever.quantity], "lcid": names.written_curve(lever.curve)}
    place = {"face": _FACES[lever.face], "dof": _DIRECTIONS[lever.direction]}
    for k, pair in enumerate(zip(hinges, fulcra, strict=True), start=1):
        ids = names.mesh.node_ids[list(pair)]
        rows = [
            {"nid": int(nid), **place, "coef": coefficient}
            for nid, coefficient in zip(ids, (-turn, 1.0 + turn), strict=True)
        ]
        head = {"id": _NUMBERS * number + k, **right, "sf": lever.value}
        yield keyword("CONSTRAINED_FACE_LINEAR", head, *rows)


def _pairs(names: Names, lever: Lever, path: str) -> tuple[Integers, Integers, float]:
    """Nodes at hinge and fulcrum in the same order, and how far these are apart."""
    ends = []
    for key in ("hinge", "fulcrum"):
        nodes = names.nodes_of(getattr(lever, key), f"{path}.{key}")
        x, y = names.mesh.nodes[nodes].T
        ends.append(nodes[np.lexsort((x, y))])
    hinges, fulcra = ends
    if len(hinges) != len(fulcra):
        rule = f"{len(fulcra)} nodes for {len(hinges)} at the hinge; a lever needs as many"
        raise RecipeError(f"{path}.fulcrum", rule)
    between = names.mesh.nodes[fulcra] - names.mesh.nodes[hinges]
    length = float(np.hypot(*between.mean(axis=0)))
    if length <= _APART * names.mesh.size or np.ptp(between, axis=0).max() > _APART * length:
        rule = "its nodes must lie like those of the hinge, some way off"
        raise RecipeError(f"{path}.fulcrum", rule)
    return hinges, fulcra, length
