"""Levers on plates."""

from __future__ import annotations

from broken import CYCLES, END, PLY, SIDE, impact, outputs
from decks import BOTTOM, TOP, Deck, Ply, ramp
from elasticity import CARBON
from meshes import Mesh, regular


def plate() -> Mesh:
    """The mesh of both."""
    return regular(SIDE, SIDE, 6, 6, 9)


def under_ball() -> Deck:
    """A ball on a plate of springs between plies; below it levers are led, and one is free."""
    deck = impact(1, "springs")
    add_levers(deck, BOTTOM)
    return deck


def levers() -> Deck:
    """Levers of both keywords on a free plate: led, and means over the thickness."""
    mesh = plate()
    deck = Deck("levers", END, 2 * CYCLES)
    deck.control(damping=100.0)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, PLY, angle) for angle in (0.0, 90.0)], 2)
    low, high, edge = (mesh.at(*place) for place in ((5.0, 5.0), (15.0, 15.0), (10.0, 0.0)))
    deck.velocity([low, high], (0.0, 0.0, -1.0e3))
    add_levers(deck, TOP)
    rows = [(low + 1, 2, 1.0), (high + 1, 2, 1.0), (edge + 1, 2, 3.0)]
    deck.add("CONSTRAINED_LINEAR_GLOBAL", (7,), *rows)
    outputs(deck, [mesh.at(10.0, 10.0)])
    return deck


def add_levers(deck: Deck, face: int) -> None:
    """A lever across the plate that moves as told, and one between its edges that shrinks it."""
    mesh = plate()
    low, middle, high = (mesh.at(x, x) + 1 for x in (5.0, 10.0, 15.0))
    left, right = mesh.at(0.0, 10.0) + 1, mesh.at(SIDE, 10.0) + 1
    way, rate = deck.curve(ramp(END)), deck.curve([(0.0, 0.0), (END, 1.0)])
    rows = [(low, face, 3, -0.7), (middle, face, 3, 2.4), (high, face, 3, -0.7)]
    deck.add("CONSTRAINED_FACE_LINEAR", (1, 2, way, -0.02), *rows)
    rows = [(left, face, 1, 1.0), (right, face, 1, -1.0)]
    deck.add("CONSTRAINED_FACE_LINEAR", (2, 0, rate, 2.0e2), *rows)
    rows = [(left, face, 2, 1.0), (right, face, 2, 1.0), (middle, face, 2, -2.0)]
    deck.add("CONSTRAINED_FACE_LINEAR", (3,), *rows)
