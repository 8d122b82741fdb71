"""A ply with a flaw that is opened along its fibres, on a mesh whose lines run along x and y."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from damage import HTS40
from decks import BOTTOM, Deck, Ply, ramp
from elasticity import Array, Material
from meshes import Mesh, regular, without
from runs import Results, run

# Half of the flaw along the fibres. Its faces are moved apart, slowly, so that the crack grows with
# the opening: under a load from afar it would jump and branch. Damping
SIDE, FLAW, THICKNESS = 24.0, 5.0, 0.25
OPENING, RISE, DAMPING = 0.1, 2.4e-4, 1.0e5
# Along the fibres the moved faces, and along and across the quads around them whose matrix does not
# crack
MOVED, WHOLE, ACROSS = 2.0, 4.0, 3.072
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
    band: float = 0.0  # width of the crack band; 0 by the rule
    line: bool = False  # only the quads on the line of the flaw may crack
    opening: float = OPENING  # of the flaw at the end


@dataclass(frozen=True)
class Crack:
    """What came out; nothing if the ply is not torn in two."""

    angle: float  # of the cracked points, degrees
    width: float  # across, from the area that is cracked, mm
    energy: float  # of matrix damage over toughness times thickness times length


def axes(tear: Tear) -> tuple[Array, Array]:
    """Directions along the fibres and across them."""
    turn = np.radians(tear.angle)
    return np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])


def plate(tear: Tear) -> Mesh:
    """The square with the quads of the flaw."""
    count = round(SIDE / tear.quad)
    return regular(SIDE, SIDE, count, count, 9)


def middles(mesh: Mesh, tear: Tear) -> tuple[Array, Array]:
    """Middles of the quads from that of the square, along the fibres and across."""
    places = mesh.points[mesh.quads].mean(axis=1) - 0.5 * SIDE
    along, across = axes(tear)
    return places @ along, places @ across


def flaw(tear: Tear) -> Array:
    """Which quads are left out: a row along the fibres through the middle."""
    along, across = middles(plate(tear), tear)
    return (np.abs(along) < FLAW) & (np.abs(across) <= 0.5 * tear.quad + 1e-9)


def parts(mesh: Mesh, tear: Tear) -> list[int]:
    """Parts of the quads: 2 where the matrix cannot crack, around the moved faces."""
    along, across = middles(mesh, tear)
    whole = (np.abs(along) < WHOLE) & (np.abs(across) < ACROSS)
    if tear.line:
        reach = 0.5 * tear.quad * np.abs(axes(tear)[0]).sum()
        whole |= np.abs(across - 0.1 * tear.quad) > reach
    return [2 if one else 1 for one in whole]


def length(tear: Tear) -> float:
    """Length of the crack: from one side of the square to the other, without the flaw."""
    direction, _ = axes(tear)
    along = middles(plate(tear), tear)[0][flaw(tear)]
    whole = SIDE / np.abs(direction).max()
    return float(whole - np.ptp(along) - tear.quad * np.abs(direction).sum())


def torn(tear: Tear, folder: Path) -> Crack:
    """Tear a ply in two by its flaw."""
    mesh = without(plate(tear), flaw(tear))
    deck = Deck("a flaw that is opened", RISE)
    deck.control(linear=True, damping=DAMPING)
    deck.mesh(mesh, parts(mesh, tear))
    switches, radii = (tear.rule, tear.snap), tear.radii
    ply = replace(HTS40, cross_strength=0.0, switches=switches, radii=radii, band=tear.band)
    elastic = Material(HTS40.density, HTS40.young, HTS40.poisson, HTS40.shear)
    for part, material in ((1, ply), (2, elastic)):
        deck.laminate([Ply(material, THICKNESS, tear.angle)], order=1, part=part)
    deck.hold_face(range(len(mesh.points)), BOTTOM, "z")
    curve, (along, across) = deck.curve(ramp(RISE)), axes(tear)
    places = mesh.points - 0.5 * SIDE
    near = (np.abs(places @ along) < MOVED) & (np.abs(places @ across) < 1.2 * tear.quad)
    for node in np.intersect1d(np.flatnonzero(near), mesh.quads):
        way = 0.5 * tear.opening * np.sign(places[node] @ across) * across
        for k in (0, 1):
            deck.move([int(node)], k + 1, curve, float(way[k]))
    deck.add("DATABASE_FIELD", "displacement damage_matrix")
    deck.intervals(glstat=RISE / 100.0, binary_d3plot=RISE)
    return measured(tear, run(deck, folder))


def measured(tear: Tear, results: Results) -> Crack:
    """Direction of the points that are cracked, and what they took."""
    places, damage = results.points()[:, :2] - 0.5 * SIDE, results.field("damage_matrix").ravel()
    along, _ = axes(tear)
    cracked = places[damage > CRACKED]
    at_rim = np.sign((cracked @ along)[np.abs(cracked).max(axis=1) > 0.5 * SIDE - tear.quad])
    if len(np.unique(at_rim)) < 2:
        return Crack(np.nan, 0.0, np.nan)
    spent = float(results.table("energy")["matrix damage"][-1])
    main = np.linalg.eigh(np.cov(cracked.T))[1][:, 1]
    angle = float(np.degrees(np.arctan2(main[1], main[0])))
    angle = (angle - tear.angle + 90.0) % 180.0 - 90.0 + tear.angle
    area = len(cracked) / len(damage) * SIDE**2
    took = spent / (HTS40.matrix_toughness[0] * THICKNESS * length(tear))
    return Crack(angle, area / length(tear), took)
