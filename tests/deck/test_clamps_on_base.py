"""A plate that clamps press onto a base: contact takes energy, the thickness implicit or not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from decks import BOTTOM, TOP, Deck, Ply
from elasticity import Material
from meshes import regular
from runs import run

CARBON = Material(1.58e-9, (171420.0, 9080.0, 9080.0), (0.32, 0.32, 0.45), (5290.0, 5290.0, 3131.0))
LONG, WIDE, FORCE = 40.0, 30.0, 1000.0


def clamped(scheme: int) -> Deck:
    """Four clamps near the corners of a plate in a window; damping brings it to rest."""
    deck = Deck("clamps over a base", 3.0e-4)
    deck.control(share=0.8, scheme=scheme)
    mesh = regular(LONG, WIDE, 8, 6, 9)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.6, angle) for angle in (0.0, 90.0, 90.0, 0.0)], 1)
    window = (1, 0.5 * LONG, 0.5 * WIDE, 30.0, 20.0, 1.0)
    deck.add("FIXTURE_PLANE", (1, BOTTOM, 0.0, 0.5), window)
    rise = deck.curve([(0.0, 0.0), (5.0e-5, 1.0)])
    places = [(x, y) for x in (2.5, LONG - 2.5) for y in (2.5, WIDE - 2.5)]
    for number, place in enumerate(places, start=2):
        deck.add("FIXTURE_CLAMP", (number, TOP, FORCE, rise), (*place, 0.0, 2.6))
    deck.add("DAMPING_GLOBAL", (0, 2.0e4))
    deck.intervals(glstat=1.0e-6)
    return deck


def test_energies_are_those_of_explicit_time_integration(tmp_path: Path) -> None:
    """Contact loses as much, and the clamps do the same work; contact never gives any back."""
    explicit, implicit = (run(clamped(n), tmp_path / str(n)).table("energy") for n in (0, 2))
    put_in = explicit["external"][-1]
    assert put_in > 1.0
    assert implicit["external"][-1] == pytest.approx(put_in, rel=0.05)
    for energy in (explicit, implicit):
        contact = energy["contact"]
        assert np.max(np.maximum.accumulate(contact) - contact) <= 1.0e-4 * put_in
    lost = [energy["contact"][-1] for energy in (explicit, implicit)]
    assert lost[1] == pytest.approx(lost[0], abs=0.03 * put_in)
