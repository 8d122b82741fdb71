"""Cracks across a mesh: the energy is that of one crack, however fine the quads are."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from damage import BAND, HTS40, POINT
from decks import BOTTOM, Deck, Ply
from meshes import Mesh, regular, without
from runs import Table, run

THICKNESS = 0.125
TOUGHNESS, STRENGTH = HTS40.matrix_toughness[0], HTS40.matrix_strength[0]
END, DAMPING = 5.0e-4, 5.0e5


def pulled(deck: Deck, mesh: Mesh, elongation: float, folder: Path, end: float = END) -> Table:
    """Pull a rectangle along x, free to become narrower, and give its energies."""
    length = mesh.points[:, 0].max()
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(mesh.where(y=0.0), "y")
    deck.hold_face(range(len(mesh.points)), BOTTOM, "z")
    deck.move(mesh.where(x=length), 1, deck.curve([(0.0, 0.0), (end, 1.0)]), elongation)
    deck.intervals(glstat=end / 400.0, binary_d3plot=end)
    energy = run(deck, folder).table("energy")
    assert np.abs(energy["error"]).max() < 1.0e-9
    assert np.all(np.diff(energy["dissipated"]) >= 0.0)
    assert energy["dissipated"] == pytest.approx(energy["matrix damage"], abs=1.0e-12)
    return energy


def bar(nodes: int, quads: int, rule: int, folder: Path) -> Table:
    """A ply across the bar, its quad in the middle weaker by a tenth."""
    length, width = 0.6, 0.6
    mesh = regular(length, width, quads, 1, nodes)
    weak = replace(HTS40, matrix_strength=(0.9 * STRENGTH, 236.0), switches=(rule,))
    deck = Deck("a bar with a weak quad", END)
    deck.control(linear=True, damping=DAMPING)
    deck.mesh(mesh, [2 if 2 * i + 1 == quads else 1 for i in range(quads)])
    deck.laminate([Ply(replace(HTS40, switches=(rule,)), THICKNESS, 90.0)], order=1)
    deck.laminate([Ply(weak, THICKNESS, 90.0)], order=1, part=2)
    return pulled(
        deck, mesh, (5.0 if rule == POINT else 2.5) * 2.0 * TOUGHNESS / (0.9 * STRENGTH), folder
    )


@pytest.mark.parametrize(
    ("nodes", "rule", "share"),
    [(4, BAND, 1.0), (9, BAND, 1.0), (4, POINT, 2.0), (9, POINT, 2.0)],
)
def test_bar(nodes: int, rule: int, share: float, compare: Comparison, tmp_path: Path) -> None:
    """Energy per area over the toughness, the same for three meshes.

    In a quad of nine nodes two of the three rows of Gauss points open, 13/18 of its length; the
    length of the Gauss point itself would count the crack twice.
    """
    area = 0.6 * THICKNESS
    spent = [bar(nodes, quads, rule, tmp_path / f"{quads}") for quads in (3, 5, 7)]
    found = [each["matrix damage"][-1] / (TOUGHNESS * area) for each in spent]
    for quads, own in zip((3, 5, 7), found, strict=True):
        name = f"energy of a crack over its toughness, {quads} quads"
        compare.number(name, own, share, rel=1.0e-4 if nodes == 4 else 5.0e-3)


def notched(columns: int, folder: Path) -> Table:
    """A ply across a plate; of its column in the middle only the middle half is there."""
    length, height, rows = 0.6, 0.8, columns - 1
    whole = regular(length, height, columns, 2 * rows, 9)
    middle = whole.points[whole.quads].mean(axis=1)
    cut = np.abs(middle[:, 0] - 0.5 * length) < 0.4 * length / columns
    cut &= np.abs(middle[:, 1] - 0.5 * height) > 0.25 * height
    mesh = without(whole, cut)
    deck = Deck("a plate with two notches", 0.5 * END)
    deck.control(linear=True, damping=DAMPING)
    deck.mesh(mesh)
    deck.laminate([Ply(HTS40, THICKNESS, 90.0)], order=1)
    return pulled(deck, mesh, 6.0 * TOUGHNESS / STRENGTH, folder, 0.5 * END)


def test_notched(compare: Comparison, tmp_path: Path) -> None:
    """The toughness times what the notches leave, with both meshes.

    A few hundredths more are spent beside the corners of the notches, more where quads are finer.
    """
    spent = [notched(columns, tmp_path / f"{columns}") for columns in (3, 5)]
    area = 0.4 * THICKNESS
    coarse, fine = (each["matrix damage"][-1] / (TOUGHNESS * area) for each in spent)
    assert coarse <= fine
    for name, own in (("coarse", coarse), ("fine", fine)):
        compare.number(f"energy of a notched plate, {name}", own, 1.0, bounds=(0.0, 0.06))
