"""A steel disc that rests on a ring, under a pressure, brought to rest by dynamic relaxation."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, TOP, Deck, Ply, ramp
from elasticity import isotropic
from meshes import disc
from runs import run

DENSITY, YOUNG, POISSON = 7.85e-9, 210.0e3, 0.3
RADIUS, THICKNESS, PRESSURE = 40.0, 3.0, 0.05
BENDING = YOUNG * THICKNESS**3 / (12.0 * (1.0 - POISSON**2))
# The first frequency of a simply supported thin disc (Leissa, 1969)
OMEGA = 4.935 / RADIUS**2 * np.sqrt(BENDING / (DENSITY * THICKNESS))
PERIOD = 2.0 * np.pi / OMEGA
SHARE = 1.0e-6


def test_disc_on_a_ring_comes_to_rest(compare: Comparison, tmp_path: Path) -> None:
    """Points on the ring keep the accelerations of the internal forces, and do not move.

    The deflection is (5 + nu) / (1 + nu) q R^4 / 64 D with the shear of thick plates, within 2 %
    for the mesh; the motion that is left is off by the root of its share. A quotient within a
    factor of two of the first frequency gives a damping that brings it to rest in a few periods.
    """
    mesh = disc(4, 3, RADIUS, 0.5 * RADIUS)
    deck = Deck("disc settles on a ring", 40.0 * PERIOD)
    deck.control(linear=False)
    deck.add("DAMPING_RELAXATION", (SHARE,))
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(DENSITY, YOUNG, POISSON), THICKNESS)], 2)
    deck.intervals(glstat=0.005 * PERIOD, fixture=0.005 * PERIOD)
    deck.add("LOAD_FACE_PRESSURE", (0, TOP, deck.curve(ramp(PERIOD)), PRESSURE))
    deck.add("FIXTURE_RING", (1, BOTTOM), (0.0, 0.0, 0.999 * RADIUS, RADIUS + 5.0))
    middle = mesh.at(0.0, 0.0)
    deck.histories([middle], 0.005 * PERIOD)
    results = run(deck, tmp_path)
    shear = YOUNG / (2.0 * (1.0 + POISSON)) * THICKNESS * 5.0 / 6.0
    expected = PRESSURE * RADIUS**2 / 4.0 / shear
    expected += (5.0 + POISSON) / (1.0 + POISSON) * PRESSURE * RADIUS**4 / (64.0 * BENDING)
    found = -float(results.table("nodes")[f"n{middle + 1} bottom uz"][-1])
    bound = 0.02 + np.sqrt(SHARE)
    compare.number("deflection on a ring at rest", found, expected, unit="mm", rel=bound)
    force = -float(results.table("fixture_1")["force z"][-1])
    assert force == pytest.approx(np.pi * RADIUS**2 * PRESSURE, rel=0.02)
    energy = results.table("energy")
    assert energy["time"][-1] < 10.0 * PERIOD
    assert np.abs(energy["error"]).max() < 1e-9
    assert np.all(np.diff(energy["contact"]) >= -1e-12 * energy["external"].max())
    line = re.search(r"frequency of ([\d.Ee+-]+) per s", results.listing())
    assert line
    assert 0.5 / PERIOD < float(line[1]) < 2.0 / PERIOD
