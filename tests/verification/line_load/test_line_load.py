"""A cantilever under a force along its end: P L^3 / (3 E I) + P L / (k G A) of beam theory."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, TOP, Deck, Ply, ramp
from elasticity import isotropic
from meshes import regular
from runs import run

LENGTH, WIDTH, HEIGHT = 40.0, 4.0, 4.0
YOUNG, DENSITY, FORCE = 210.0e3, 7.85e-9, 10.0
INERTIA = WIDTH * HEIGHT**3 / 12.0
# no Poisson's ratio: the end that is held is that of beam theory
MATERIAL = isotropic(DENSITY, YOUNG, 0.0)


@pytest.mark.parametrize(
    ("face", "direction", "order", "nodes", "quads", "tolerance"),
    [
        (TOP, 3, 3, 9, 10, 1.0e-3),
        (BOTTOM, 3, 2, 9, 10, 1.0e-3),
        (TOP, 2, 2, 9, 10, 2.0e-3),
        (TOP, 3, 2, 4, 60, 2.0e-2),
    ],
    ids=["top", "bottom", "across", "four nodes"],
)
def test_end_load(
    face: int,
    direction: int,
    order: int,
    nodes: int,
    quads: int,
    tolerance: float,
    compare: Comparison,
    tmp_path: Path,
) -> None:
    """Deflection at rest, and force of the support; quads of four nodes are stiff in bending."""
    omega = 1.8751**2 * np.sqrt(YOUNG * INERTIA / (DENSITY * WIDTH * HEIGHT)) / LENGTH**2
    period = 2.0 * np.pi / omega
    mesh = regular(LENGTH, WIDTH, quads, 1, nodes)
    deck = Deck("cantilever", 5.0 * period)
    deck.control(linear=True, damping=1.8 * omega)
    deck.mesh(mesh)
    deck.laminate([Ply(MATERIAL, 0.5 * HEIGHT)] * 2, order)
    deck.hold(mesh.where(x=0.0), "xyz")
    end = deck.node_set(mesh.where(x=LENGTH))
    load = (end, face, direction, deck.curve(ramp(period)), FORCE / WIDTH)
    deck.add("LOAD_FACE_LINE", load)
    node = mesh.at(LENGTH, 0.5 * WIDTH)
    deck.histories([node], 0.1 * period)
    deck.intervals(glstat=0.1 * period, spcforc=0.1 * period, binary_d3plot=5.0 * period)
    results = run(deck, tmp_path)
    table, axis = results.table("nodes"), "xyz"[direction - 1]
    found = 0.5 * (table[f"n{node + 1} bottom u{axis}"] + table[f"n{node + 1} top u{axis}"])[-1]
    shear = 5.0 / 6.0 * 0.5 * YOUNG * WIDTH * HEIGHT
    exact = FORCE * LENGTH**3 / (3.0 * YOUNG * INERTIA) + FORCE * LENGTH / shear
    compare.number("deflection of the end", found, exact, unit="mm", rel=tolerance)
    assert results.table("supports")[f"f{axis}"][-1] == pytest.approx(-FORCE, rel=1e-6)
