"""Decks of plates that lie on fixtures."""

from __future__ import annotations

from broken import ANGLES, END, PLY, RADIUS, SIDE, outputs
from decks import BOTTOM, TOP, Deck, Ply, Sphere
from elasticity import CARBON
from meshes import regular

SLIP, FALL = 300.0, -1000.0


def all_fixtures(implicit: int = 0, *, linear: bool = False) -> Deck:
    """A ball on a plate that drifts onto a window, a moving ring, a punch, a bar, a clamp."""
    mesh = regular(SIDE, SIDE, 6, 6, 9)
    deck = Deck("a plate on fixtures", END)
    deck.control(linear=linear, scheme=implicit)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, PLY, angle) for angle in ANGLES], 1)
    deck.interfaces(1.0e5, 5.0e4)
    deck.velocity(range(len(mesh.points)), (SLIP, -SLIP, FALL))
    middle = 0.5 * SIDE
    rough = (0.4, 0.2, 1.0e-3)
    up, force = deck.curve([(0.0, 0.0), (END, 0.01)]), deck.curve([(0.0, 0.5), (END, 1.0)])
    deck.add(
        "FIXTURE_PLANE",
        (1, BOTTOM, 0.0, 0.5, *rough),
        (1, middle, middle, 0.8 * SIDE, 0.7 * SIDE, 2.0),
    )
    deck.add("FIXTURE_RING", (2, BOTTOM, 0.0, 0.0, *rough), (middle, middle, 3.0, 6.0), (up, 0, up))
    deck.add("FIXTURE_PUNCH", (3, TOP, 0.0, 0.0, 0.1), (2, 2.0, 2.0, 0.0, 0.0, 2.0))
    deck.add("FIXTURE_BAR", (4, BOTTOM, 0.002, 1.0, 0.3), (1.0, 1.0, 1.0, 19.0))
    deck.add("FIXTURE_CLAMP", (5, TOP, 500.0, force, 50.0, *rough), (18.0, 18.0, 0.0, 4.0))
    centre = (middle, middle, RADIUS + 1.5 * PLY + 0.01)
    deck.sphere(Sphere(RADIUS, 5.0e-6, centre, (1.0e2, 0.0, -8.0e3), method=1))
    outputs(deck, [mesh.at(middle, middle)])
    return deck
