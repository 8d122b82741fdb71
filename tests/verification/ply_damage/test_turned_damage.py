"""Damage knows of no x: a patch of plies that is torn, turned in its plane with all its plies."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from damage import HTS40
from decks import Deck, Ply
from meshes import Mesh, distorted, regular
from runs import Table, run

END = 4.0e-5
# Every switch that may ask for a direction. The matrix is ten times tougher: where it breaks
# at once, round-off decides where, and a step smaller by 1e-4 changes energies by a hundredth
PLY = replace(
    HTS40,
    matrix_toughness=(2.2, 11.0),
    curve=(1, 0, 0.05),
    switches=(0, 0, 1.05, 1, 0, 1, 0.1, 0),
)
PLIES = [(0.125, 10.0), (0.125, 55.0), (0.125, -80.0)]
PULL = (0.10, 0.03, -0.05)


def torn(nodes: int, angle: float, linear: bool, folder: Path) -> Table:
    """Hold one edge and move the other one away along all three axes."""
    mesh = distorted(regular(3.0, 2.0, 3, 2, nodes), 0.06 if nodes == 9 else 0.15)
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    turn = np.array([[c, -s], [s, c]])
    deck = Deck("a patch that is torn", END)
    deck.control(linear=linear, damping=1.0e5)
    deck.mesh(Mesh(mesh.points @ turn.T, mesh.quads))
    deck.laminate([Ply(PLY, thickness, own + angle) for thickness, own in PLIES])
    deck.hold(mesh.where(x=0.0), "xyz")
    curve = deck.curve([(0.0, 0.0), (END, 1.0)])
    moved = (*(turn @ PULL[:2]), PULL[2])
    for direction in (1, 2, 3):
        deck.move(mesh.where(x=3.0), direction, curve, float(moved[direction - 1]))
    deck.intervals(glstat=END / 50.0, binary_d3plot=END)
    return run(deck, folder).table("energy")


@pytest.mark.parametrize(("nodes", "linear"), [(4, False), (9, False), (9, True)])
def test_turned(nodes: int, linear: bool, compare: Comparison, tmp_path: Path) -> None:
    """Every mechanism spends the same.

    Cracks begin a step earlier or later by round-off: a step smaller by 1e-4 makes 2.5e-4.
    """
    straight = torn(nodes, 0.0, linear, tmp_path / "straight")
    for name in ("fibre damage", "matrix damage", "ply plasticity"):
        assert straight[name][-1] > 0.004 * straight["dissipated"][-1], name
    assert np.abs(straight["error"]).max() < 1.0e-6
    for angle in (30.0, 90.0, -117.0):
        turned = torn(nodes, angle, linear, tmp_path / f"{angle}")
        for name in ("internal", "fibre damage", "matrix damage", "ply plasticity"):
            close = 1.0e-3 * straight["internal"].max()
            what = f"{name} of a torn patch that is turned"
            compare.values(what, turned[name], straight[name], unit="mJ", abs=close)
