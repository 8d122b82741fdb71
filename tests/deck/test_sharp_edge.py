"""Contact that gives energy stops the run: a plate that slides over a sharp edge and back."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from broken import said
from decks import BOTTOM, TOP, Deck, Ply
from elasticity import Material
from meshes import regular

METAL = Material(2.7e-9, (70.0e3,) * 3, (0.3,) * 3, (26923.0,) * 3)
LONG, WIDE, SWING, PERIOD = 20.0, 10.0, 0.5, 4.0e-4


def sliding(edge: float) -> Deck:
    """A strip pressed down, half of it on a punch; it slides along x by half a millimetre."""
    mesh = regular(LONG, WIDE, 8, 4, 9)
    deck = Deck("a strip that slides over an edge", 2.0 * PERIOD)
    deck.control()
    deck.mesh(mesh)
    deck.laminate([Ply(METAL, 1.0, 0.0)], 1)
    times = np.linspace(0.0, 2.0 * PERIOD, 161)
    swing = 0.5 * SWING * (1.0 - np.cos(2.0 * np.pi * times / PERIOD))
    motion = deck.curve(zip(map(float, times), map(float, swing), strict=True))
    deck.move(range(len(mesh.points)), 1, motion, 1.0)
    deck.add("LOAD_FACE_PRESSURE", (0, TOP, 0, 2.0))
    # the edge lies just beyond a line of nodes, which slides off it
    size = (LONG / 2.0 + 0.3, 3.0 * WIDE)
    deck.add("FIXTURE_PUNCH", (1, BOTTOM, 0.0, edge), (1, LONG / 4.0, WIDE / 2.0, *size, 0.0))
    return deck


@pytest.mark.parametrize(("edge", "ends"), [(0.0, 3), (0.5, 0)])
def test_contact_that_gives_energy_stops_the_run(edge: float, ends: int, tmp_path: Path) -> None:
    """A point that was off a sharp edge is lifted in one step; a round edge lets it climb."""
    code, text = said("run", sliding(edge).write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == ends, text
    assert ("contact has given" in text) == (ends == 3)
