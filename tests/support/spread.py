"""Decks of more quads or bricks than fit in one chunk, with every kind of load and result."""

from __future__ import annotations

from brick_decks import add_bricks, box
from decks import BOTTOM, Deck, Ply, Sphere, ramp
from elasticity import CARBON, GLASS
from meshes import Mesh, distorted, regular

STEP = 2.0e-8
STEPS = 60
WIDTH, LENGTH = 18.0, 24.0
THICKNESS = 1.5


def start(title: str, mesh: Mesh, *, linear: bool, scaled: float = 0.0) -> Deck:
    """A plate of more quads than fit in one chunk, held on one side."""
    deck = Deck(title, STEPS * STEP)
    deck.control(linear=linear, damping=1.0e4, scaled=scaled)
    deck.mesh(mesh)
    deck.hold(mesh.where(x=0.0), "xyz")
    return deck


def load(deck: Deck, mesh: Mesh, method: int) -> None:
    """Loads, a face held beside the edge, a moved corner, an impactor in contact, all results."""
    curve = deck.curve(ramp(0.5 * STEPS * STEP))
    edge = deck.node_set(mesh.where(x=LENGTH))
    deck.add("LOAD_FACE_PRESSURE", (0, -1, curve, 0.5))
    deck.add("LOAD_FACE_LINE", (edge, 1, 3, curve, 0.1))
    deck.add("LOAD_BODY_Z", (curve, 1.0e6))
    deck.hold_face(mesh.where(y=0.0), BOTTOM, "yz")
    deck.move_face(mesh.where(x=LENGTH, y=WIDTH), 1, 1, curve, 1.0e-3)
    centre = (0.5 * LENGTH, 0.5 * WIDTH, 8.0 + 0.5 * THICKNESS)
    deck.sphere(Sphere(8.0, 1.0e-5, centre, (0.0, 0.0, -2.0e4), method=method))
    deck.histories(mesh.where(y=0.0), 0.0)
    deck.profile(1, 9.0, 9.0, 0.0)
    deck.add("DATABASE_FIELD", "displacement velocity stress strain stress_ply strain_ply")
    deck.intervals(spcforc=0.0, binary_d3plot=0.25 * STEPS * STEP)


def tied() -> Deck:
    """Tied plies in large displacement, two orders side by side."""
    mesh = distorted(regular(LENGTH, WIDTH, 8, 6, 9), 0.3)
    deck = start("tied plies", mesh, linear=False)
    plies = [Ply(CARBON, 0.5), Ply(GLASS, 0.5, 45.0), Ply(CARBON, 0.5, 90.0)]
    deck.laminate(plies, orders=(1, 3, 1))
    load(deck, mesh, 2)
    return deck


def springs(scaled: float = 0.0) -> Deck:
    """Ten plies joined by springs, linear, four nodes to a quad; with mass for a step, if given."""
    mesh = distorted(regular(LENGTH, WIDTH, 12, 9, 4), 0.3)
    deck = start("springs", mesh, linear=True, scaled=scaled)
    deck.laminate([Ply(CARBON, 0.1 * THICKNESS, 30.0 * k) for k in range(10)], order=1)
    deck.interfaces(1.0e5, 5.0e4)
    load(deck, mesh, 1)
    return deck


def metal() -> Deck:
    """Plies of a metal that yields under the impactor, a law at every point."""
    mesh = distorted(regular(LENGTH, WIDTH, 8, 6, 9), 0.3)
    deck = start("metal", mesh, linear=False)
    deck.add("MAT_PLASTIC_KINEMATIC", (1, 2.7e-9, 7.0e4, 0.3, 20.0, 700.0, 0.5), (0.0, 0.0))
    cards = [(1, 0.5, 0.0, 0, k + 1) for k in range(3)]
    deck.add("PART_COMPOSITE_LONG", "sheets", (1, 0), *cards)
    deck.add("SECTION_LAYERWISE", (1, 0, 2))
    load(deck, mesh, 2)
    return deck


def solid(scaled: float = 0.0) -> Deck:
    """Bricks of three chunks and a bit, alike but for the round-off of their nodes."""
    mesh = box((LENGTH / 0.7, WIDTH / 0.7, THICKNESS), (34, 31, 6))
    deck = Deck("solid", STEPS * STEP)
    deck.control(linear=True, damping=1.0e4, scaled=scaled)
    add_bricks(deck, mesh, _aluminium, hourglass=(6, 0.1))
    deck.hold(mesh.where(x=0.0), "xyz")
    centre = (0.5 * LENGTH, 0.5 * WIDTH, 8.0 + THICKNESS)
    deck.sphere(Sphere(8.0, 1.0e-5, centre, (0.0, 0.0, -2.0e4)))
    deck.intervals(impactor=0.0, glstat=0.0, spcforc=0.0, binary_d3plot=0.5 * STEPS * STEP)
    return deck


def _aluminium(deck: Deck) -> None:
    """Material 1."""
    deck.add("MAT_ELASTIC", (1, 2.7e-9, 7.0e4, 0.3))
