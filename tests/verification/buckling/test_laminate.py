"""Buckling load of the coupon of compression after impact, found as that of cross-plies.

T700/M21 [0_2/45_2/90_2/-45_2]s, 4.16 mm, between clamped ends and on simply supported sides, free
90 x 130 mm: it bends and twists at once. The reference is Ritz's method with transverse shear
(`ritz_plate.py`); without shear it gives the 493 MPa of a thin plate that another program of
Kirchhoff's plate had found (`THIN`). The shear of the solid beside 5/6 of that of the plies is in
the tolerance.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck, Ply, ramp
from elasticity import Material
from meshes import Mesh, regular
from ritz_plate import buckling_stress, compressed, plane_stress
from runs import run
from swings import fitted, zero_of_line

# Tan, Falzon, Chiu and Price (2015)
T700 = Material(1.58e-9, (130.0e3, 7.7e3, 7.7e3), (0.3, 0.3, 0.35), (4.8e3, 4.8e3, 3.8e3))
HALF = ((0.52, 0.0), (0.52, 45.0), (0.52, 90.0), (0.52, -45.0))
STACK = tuple(Ply(T700, *one) for one in (*HALF, *HALF[::-1]))
THICKNESS = sum(ply.thickness for ply in STACK)
SIZE = (130.0, 90.0)
THIN = 493.0
#: Shares of the buckling stress at which the plate swings
SHARES = (0.8, 0.9)
#: Amplitude over the thickness: stiffening by stretch is of the square of it; time of the rise, s
AMPLITUDE, RISE = 2.0e-3, 2.0e-4


def modulus() -> float:
    """Stress along x for a unit of strain of the balanced laminate, free to become wider."""
    mean = sum(ply.thickness * plane_stress(ply) for ply in STACK) / THICKNESS
    return float(1.0 / np.linalg.inv(mean)[0, 0])


def swinging_deck(mesh: Mesh, stress: float) -> tuple[Deck, float]:
    """The plate that is compressed to a stress while it swings, and the frequency to expect."""
    square, shape = compressed(STACK, SIZE, stress)
    omega = float(np.sqrt(square))
    deck = Deck("coupon that swings under load", RISE + 2.5 * np.pi / omega)
    deck.intervals(glstat=RISE)
    deck.mesh(mesh)
    deck.laminate(STACK, order=1)
    curve = deck.curve(ramp(RISE, 200))
    # strain of Green
    shortening = 1.0 - np.sqrt(1.0 - 2.0 * stress / modulus())
    sides = [node for y in (0.0, SIZE[1]) for node in mesh.where(y=y)]
    ends = [node for x in (0.0, SIZE[0]) for node in mesh.where(x=x)]
    edges = sorted({*sides, *ends})
    deck.hold(edges, "z")
    deck.hold(mesh.where(y=0.5 * SIZE[1], x=0.5 * SIZE[0]), "y")
    for along in sorted({*mesh.points[edges, 0]}):
        chosen = [node for node in edges if mesh.points[node, 0] == along]
        deck.move(chosen, 1, curve, -shortening * along)
    places = mesh.points[:, :2] - 0.5 * np.array(SIZE)
    speed = AMPLITUDE * THICKNESS * omega * shape(places)
    deck.velocities(np.stack([0.0 * speed, 0.0 * speed, speed], axis=1))
    deck.histories([int(np.argmax(np.abs(speed)))], RISE / 200)
    return deck, omega


def swinging(stress: float, folder: Path) -> float:
    """Angular frequency of the plate at a stress."""
    deck, omega = swinging_deck(regular(*SIZE, 12, 8, 9), stress)
    table = run(deck, folder).table("nodes")
    bottom, top = (
        next(table[name] for name in table.names if name.endswith(f"{face} uz"))
        for face in ("bottom", "top")
    )
    after = table["time"] > RISE
    return fitted(table["time"][after], 0.5 * (bottom + top)[after], omega)


def test_thin_plate(compare: Comparison) -> None:
    """Without transverse shear, that of Kirchhoff's plate."""
    share = 1.0e-2
    thin = [Ply(T700, share * ply.thickness, ply.angle) for ply in STACK]
    stress = buckling_stress(thin, SIZE) / share**2
    compare.number("buckling stress of the thin plate", stress, THIN, unit="MPa", rel=2e-3)


def test_coupon(compare: Comparison, tmp_path: Path) -> None:
    """The stress at which two frequencies under load point, within 2 %."""
    exact = buckling_stress(STACK, SIZE)
    stresses = exact * np.array(SHARES)
    line = np.array([compressed(STACK, SIZE, stress)[0] for stress in stresses])
    # beyond the crossing of two modes the square falls along a line
    assert zero_of_line(stresses, line) == pytest.approx(exact, rel=5e-3)
    squares = [swinging(stress, tmp_path / f"{stress:.0f}") ** 2 for stress in stresses]
    found = zero_of_line(stresses, np.array(squares))
    compare.number("buckling stress of the coupon", found, exact, unit="MPa", rel=0.02)
