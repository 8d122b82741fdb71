"""A bar whose fibres kink: the work does not depend on the mesh, with and without a plateau.

Stress over strain of the band rises to X, and falls along a line to the plateau p X; the area above
the plateau is G/l, l the width of the band. A bar of length L, area A and modulus E, shortened by d
until the stress is that of the plateau, has then taken, whatever l is,

    W/A = G + p X d - (p X)^2 L / 2E,

and stores p X d / 2 of it, since damage unloads to the origin; the rest is spent on the fibres.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from damage import BAND, HTS40
from decks import BOTTOM, Deck, Ply
from elasticity import Array
from meshes import regular
from runs import run

LENGTH, WIDTH, THICKNESS = 6.0, 1.0, 0.25
#: The quad in the middle is weaker by a tenth
STRENGTH, TOUGHNESS = 0.9 * HTS40.fibre_strength[1], HTS40.fibre_toughness[1]
AREA, MODULUS = WIDTH * THICKNESS, HTS40.young[0]
SHORTENING, END, DAMPING = 0.3, 1.0e-3, 5.0e5


def bar(nodes: int, quads: int, plateau: float, folder: Path) -> tuple[Array, Array, Array]:
    """Shortening, work of the end over the area, and energy spent on fibres over it."""
    mesh = regular(LENGTH, WIDTH, quads, 1, nodes)
    strong = replace(HTS40, switches=(BAND, 0, 1.05, 0, 0, 0, plateau))
    weak = replace(strong, fibre_strength=(HTS40.fibre_strength[0], STRENGTH))
    deck = Deck("a bar whose fibres kink", END)
    deck.control(linear=True, damping=DAMPING)
    deck.mesh(mesh, [2 if 2 * quad + 1 == quads else 1 for quad in range(quads)])
    deck.laminate([Ply(strong, THICKNESS)], order=1)
    deck.laminate([Ply(weak, THICKNESS)], order=1, part=2)
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(mesh.where(y=0.0), "y")
    deck.hold_face(range(len(mesh.points)), BOTTOM, "z")
    deck.move(mesh.where(x=LENGTH), 1, deck.curve([(0.0, 0.0), (END, 1.0)]), -SHORTENING)
    deck.intervals(glstat=END / 400.0)
    energy = run(deck, folder).table("energy")
    assert np.abs(energy["error"]).max() < 1.0e-9
    work = energy["external"] - energy["damping"]
    return SHORTENING * energy["time"] / END, work / AREA, energy["fibre damage"] / AREA


@pytest.mark.parametrize("plateau", [0.0, 0.3])
@pytest.mark.parametrize(("nodes", "close"), [(4, 1.0e-3), (9, 5.0e-3)])
def test_work(
    nodes: int, close: float, plateau: float, compare: Comparison, tmp_path: Path
) -> None:
    """Three meshes; quads of nine nodes open 13/18 of their length, which the band counts.

    What is left for quads of four nodes is the motion of the bar, at 300 mm/s.
    """
    stress = plateau * STRENGTH
    stored = stress**2 * LENGTH / (2.0 * MODULUS)
    work = TOUGHNESS + stress * SHORTENING - stored
    spent = TOUGHNESS + 0.5 * stress * SHORTENING - stored
    drawn = {}
    for quads in (3, 5, 9):
        way, found, fibres = bar(nodes, quads, plateau, tmp_path / f"{quads}")
        compare.number(f"work, {quads} quads", found[-1], work, unit="mJ/mm2", rel=close)
        compare.number(
            f"spent on fibres, {quads} quads", fibres[-1], spent, unit="mJ/mm2", rel=close
        )
        drawn[f"{quads} quads"] = (way, found)
    after = np.linspace(0.6, 1.0, 3) * SHORTENING
    compare.curves(
        f"a bar whose fibres kink, plateau {plateau:g}, {nodes} nodes",
        ("shortening [mm]", "work over area [mJ/mm$^2$]"),
        drawn,
        {"closed form": (after, TOUGHNESS + stress * after - stored)},
    )
