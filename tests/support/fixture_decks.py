"""Decks of plates that lie on fixtures."""

from __future__ import annotations

import numpy as np

from broken import ANGLES, END, PLY, RADIUS, SIDE, outputs
from decks import BOTTOM, TOP, Deck, Ply, Sphere
from elasticity import CARBON
from meshes import regular

SLIP, FALL = 300.0, -1000.0


def all_fixtures(implicit: int = 0, *, linear: bool = False, method: int = 1) -> Deck:
    """A rough ball on a plate that drifts onto a window, a moving ring, a punch, a bar, a clamp."""
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
    velocity = (1.0e2, 0.0, -8.0e3)
    deck.sphere(Sphere(RADIUS, 5.0e-6, centre, velocity, method=method, friction=rough))
    outputs(deck, [mesh.at(middle, middle)])
    return deck


def all_bodies(
    implicit: int = 0, *, linear: bool = False, apart: bool = False, end: float = END
) -> Deck:
    """A tup, two cylinders, and a cone from below, on a plate of two parts in a window.

    The cylinder that lies comes down last, in twice the time.
    """
    mesh = regular(SIDE, SIDE, 8, 8, 9)
    deck = Deck("bodies of every shape", end)
    deck.control(linear=linear, scheme=implicit)
    left = mesh.points[mesh.quads].mean(axis=1)[:, 0] < 0.5 * SIDE
    deck.mesh(mesh, [1 if is_left or not apart else 2 for is_left in left])
    for part in (1, 2) if apart else (1,):
        deck.laminate([Ply(CARBON, PLY, angle) for angle in ANGLES], 1, part=part)
        deck.add("INTERFACE_COHESIVE", (part, 0, 0, 100))
    deck.add("MAT_COHESIVE_ELASTIC", (100, 0.0, 0, 0, 5.0e4, 1.0e5))
    window = (1, 0.5 * SIDE, 0.5 * SIDE, 0.8 * SIDE, 0.8 * SIDE, 2.0)
    deck.add("FIXTURE_PLANE", (1, BOTTOM, 0.0, 0.5, 0.2), window)
    top, bottom, fall = 1.5 * PLY, -1.5 * PLY, (0.0, 0.0, -8.0e3)
    middle = 0.5 * SIDE
    tup = (5.0, middle, top + 2.01)
    deck.sphere(Sphere(2.0, 2.0e-6, tup, fall, shape="TUP", form=(0.0,), method=1, part=0))
    flat = (14.5, 5.0, top + 2.01)
    form = (4.0, 0.5)
    body = Sphere(2.0, 2.0e-6, flat, fall, shape="CYLINDER", form=form, method=2, part=0)
    deck.sphere(body, 2)
    # over the line between the parts
    lying = (middle, 14.0, top + 1.01)
    form = (6.0, 0.25, 1.0, 0.2, 0.1)
    raised = (lying[0], lying[1], lying[2] + 0.35)
    body = Sphere(1.0, 1.0e-6, raised, fall, shape="CYLINDER", form=form, method=1, part=0)
    deck.sphere(body, 3)
    form = (60.0, 1.0)
    deep = 1.0 + 2.0 / float(np.tan(np.radians(60.0)))
    cone, rise = (15.0, 12.0, bottom - 0.01 - deep), (0.0, 0.0, 8.0e3)
    body = Sphere(3.0, 2.0e-6, cone, rise, shape="CONE", form=form, face=BOTTOM, part=0)
    deck.sphere(body, 4)
    outputs(deck, [mesh.at(middle, middle)])
    return deck
