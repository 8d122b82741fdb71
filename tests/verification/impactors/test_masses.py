"""Masses of impactors that a deck gives a density."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck, Ply
from elasticity import STEEL
from meshes import regular
from runs import run

RADIUS, ROD, DENSITY, SPEED, ANGLE = 3.0, 7.0, 7.8e-9, 100.0, np.radians(30.0)
FLIGHT = (0.0, 0.0, -SPEED)
BALL = 4.0 / 3.0 * np.pi * RADIUS**3
SHAFT = np.pi * RADIUS**2 * ROD
# Keyword, height of the centre, cards behind the first, and the volume
BODIES = {
    "ball": ("SPHERE", 4.0, [FLIGHT], BALL),
    "half of a ball": ("SPHERE", 4.0, [(*FLIGHT, 0, 0.0, 1)], 0.5 * BALL),
    "tup": ("TUP", 4.0, [(ROD,), FLIGHT], 0.5 * BALL + SHAFT),
    "cylinder": ("CYLINDER", 5.0, [(ROD, 0.0), FLIGHT], SHAFT),
    "lying cylinder": ("CYLINDER", 4.0, [(ROD, 0.0, 1.0, 0.0, 0.0), FLIGHT], SHAFT),
    "cone": (
        "CONE",
        6.5,
        [(30.0, 0.0, ROD), FLIGHT],
        SHAFT + np.pi * RADIUS**3 / np.tan(ANGLE) / 3,
    ),
}


@pytest.mark.parametrize("body", list(BODIES))
def test_mass_by_density(body: str, compare: Comparison, tmp_path: Path) -> None:
    """Density times volume, of half a ball for a hemisphere: the digits of the kinetic energy."""
    shape, height, cards, volume = BODIES[body]
    mesh = regular(40.0, 40.0, 4, 4, 4)
    deck = Deck("a body with a density", 1.0e-3, 1)
    deck.mesh(mesh)
    deck.laminate([Ply(STEEL, 1.0)], 1)
    deck.hold(mesh.boundary(), "xyz")
    deck.add(f"IMPACTOR_{shape}", (1, RADIUS, 0.0, 20.0, 20.0, height, DENSITY), *cards)
    deck.add("CONTACT_IMPACTOR", (1, 1, 1, 1, 1))
    deck.intervals(impactor=0.0)
    energy = run(deck, tmp_path).table("impactor_1")["kinetic"][0]
    mass = 2.0 * energy / SPEED**2
    compare.number("mass by its density", mass, DENSITY * volume, unit="t", rel=1e-9)
