"""A ply with a flaw, torn across its fibres on a mesh whose lines run along x and y."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from damage import HTS40
from decks import BOTTOM, Deck, Ply, ramp
from elasticity import Array
from meshes import Mesh, regular, without
from runs import Results, run

# Half of the flaw along the fibres. Strain across them, far below that of the strength: only the
# ends of the flaw crack. It rises slowly, for what is stored beyond need cracks more. Damping
SIDE, FLAW, THICKNESS = 24.0, 4.0, 0.25
STRAIN, RISE, END, DAMPING = 2.6e-3, 1.6e-4, 1.9e-4, 5.0e4
# A point counts as cracked from here on
CRACKED = 0.9


@dataclass(frozen=True)
class Tear:
    """How a ply is torn: angle of its fibres, side of the quads, rules of the card, radii."""

    angle: float
    quad: float
    rule: int = 0
    snap: int = 0
    radii: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True)
class Crack:
    """What came out."""

    angle: float  # of the cracked points, degrees
    length: float  # without the flaw, along the fibres, mm
    width: float  # across, from the area that is cracked, mm
    energy: float  # of matrix damage over toughness times thickness times length


def axes(tear: Tear) -> tuple[Array, Array]:
    """Directions along the fibres and across them."""
    turn = np.radians(tear.angle)
    return np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])


def flawed(tear: Tear) -> Mesh:
    """The square without the quads of its flaw, a row along the fibres through the middle."""
    count = round(SIDE / tear.quad)
    mesh = regular(SIDE, SIDE, count, count, 9)
    along, across = axes(tear)
    centres = mesh.points[mesh.quads].mean(axis=1) - 0.5 * SIDE
    cut = (np.abs(centres @ along) < FLAW) & (np.abs(centres @ across) <= 0.5 * tear.quad + 1e-9)
    return without(mesh, cut)


def torn(tear: Tear, folder: Path) -> Crack:
    """Tear a ply: its edges move as those of a ply that is stretched across its fibres."""
    mesh, (_, across) = flawed(tear), axes(tear)
    deck = Deck("torn across the fibres", END)
    deck.control(linear=True, damping=DAMPING)
    deck.mesh(mesh)
    ply = replace(HTS40, switches=(tear.rule, tear.snap), radii=tear.radii)
    deck.laminate([Ply(ply, THICKNESS, tear.angle)], order=1)
    deck.hold_face(range(len(mesh.points)), BOTTOM, "z")
    curve = deck.curve(ramp(RISE))
    places = mesh.points - 0.5 * SIDE
    for node in np.flatnonzero(np.abs(places).max(axis=1) > 0.5 * SIDE - 1e-9):
        for k in (0, 1):
            deck.move([int(node)], k + 1, curve, STRAIN * float(places[node] @ across) * across[k])
    deck.add("DATABASE_FIELD", "displacement damage_matrix")
    deck.intervals(glstat=END / 100.0, binary_d3plot=END)
    return measured(tear, mesh, run(deck, folder))


def measured(tear: Tear, mesh: Mesh, results: Results) -> Crack:
    """Direction of the points that are cracked outside of the flaw, and what they took."""
    places, damage = results.points()[:, :2] - 0.5 * SIDE, results.field("damage_matrix").ravel()
    along, _ = axes(tear)
    cracked = places[damage > CRACKED]
    energy = results.table("energy")
    spent = float(energy["matrix damage"][-1])
    length = float(np.ptp(cracked @ along)) - 2.0 * FLAW if len(cracked) else 0.0
    if length < tear.quad:
        return Crack(np.nan, 0.0, 0.0, np.nan)
    main = np.linalg.eigh(np.cov(cracked.T))[1][:, 1]
    angle = float(np.degrees(np.arctan2(main[1], main[0])))
    angle = (angle - tear.angle + 90.0) % 180.0 - 90.0 + tear.angle
    area = len(cracked) / len(damage) * SIDE**2
    took = spent / (HTS40.matrix_toughness[0] * THICKNESS * length)
    return Crack(angle, length, area / length, took)
