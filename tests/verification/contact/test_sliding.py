"""A ball that slides over a plate which gives way: contact takes energy, and never gives any."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck, Ply, Sphere
from elasticity import Material
from meshes import Mesh, distorted, regular
from runs import Table, run

LENGTH, WIDTH, PLY, RADIUS, MASS, END = 40.0, 30.0, 0.25, 4.0, 5.0e-5, 2.0e-3
CARBON = Material(1.58e-9, (171420.0, 9080.0, 9080.0), (0.32, 0.32, 0.45), (5290.0, 5290.0, 3131.0))
#: Fall of the column over the largest energy: what is to be seen is 1 % and more
SHARE = 1.0e-3
BALL = Sphere(
    RADIUS,
    MASS,
    (10.0, 15.0, RADIUS + 2.0 * PLY + 0.02),
    velocity=(2000.0, 0.0, -100.0),
    gravity=-1.0e7,
    method=1,
)
MESHES = {
    "quads of 5 mm": regular(LENGTH, WIDTH, 8, 6, 9),
    "four nodes": regular(LENGTH, WIDTH, 16, 12, 4),
    "distorted": distorted(regular(LENGTH, WIDTH, 8, 6, 9), 0.2, 3),
}
FINER = {"quads of 2.5 mm": regular(LENGTH, WIDTH, 16, 12, 9)}


def slide(mesh: Mesh, ball: Sphere, folder: Path, end: float = END, plane: bool = False) -> Table:
    """Energies of a cross-ply plate that is held at its edges, or at all but one of them."""
    deck = Deck("a ball slides", end)
    deck.control(share=0.8)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, PLY, angle) for angle in (0.0, 90.0, 90.0, 0.0)], 1)
    x, y = mesh.points.T
    is_edge = (x < 1e-9) | (x > LENGTH - 1e-9) | (y < 1e-9) | (y > WIDTH - 1e-9)
    if plane:
        middle = y > 0.5 * WIDTH - 1e-9
        is_edge &= ~(middle & (x > 1e-9) & (x < LENGTH - 1e-9))
        deck.hold(np.flatnonzero(middle & ~is_edge), "y")
        ball = replace(ball, curves=(0, deck.curve([(0.0, 0.0), (end, 0.0)]), 0))
    deck.hold(np.flatnonzero(is_edge), "xyz")
    deck.sphere(ball)
    deck.intervals(glstat=2.0e-6)
    return run(deck, folder).table("energy")


def largest_fall(energy: Table) -> float:
    """Of the energy lost in contact, over the largest energy in the run."""
    lost = energy["contact"]
    stored = energy["kinetic"] + energy["internal"] + energy["impactor"]
    return float((np.maximum.accumulate(lost) - lost).max() / stored.max())


@pytest.mark.parametrize("name", MESHES)
def test_contact_without_friction_gives_nothing(
    name: str, compare: Comparison, tmp_path: Path
) -> None:
    """A force along the normal does no work on the way along the surface."""
    fall = largest_fall(slide(MESHES[name], BALL, tmp_path))
    label = f"energy that contact gave, {name}"
    compare.number(label, 100.0 * fall, 0.0, unit="%", abs=100.0 * SHARE)


def test_plane_of_symmetry_gives_nothing(compare: Comparison, tmp_path: Path) -> None:
    """The ball slides along the free edge of half a plate, which is a plane of symmetry."""
    half = regular(LENGTH, 0.5 * WIDTH, 8, 3, 9)
    ball = replace(BALL, mass=0.5 * MASS)
    fall = largest_fall(slide(half, ball, tmp_path, plane=True))
    compare.number("energy that contact gave, half", 100.0 * fall, 0.0, unit="%", abs=100.0 * SHARE)


@pytest.mark.parametrize(("friction", "name"), [(0.0, "quads of 5 mm"), (0.3, "quads of 2.5 mm")])
def test_oblique_hit(name: str, friction: float, compare: Comparison, tmp_path: Path) -> None:
    """At 45 degrees; the ball turns where it rubs, and only friction takes from the motion."""
    ball = replace(
        BALL,
        centre=(12.0, *BALL.centre[1:]),
        velocity=(3000.0, 0.0, -3000.0),
        gravity=0.0,
        friction=(friction,) if friction else (),
    )
    energy = slide((MESHES | FINER)[name], ball, tmp_path, end=1.0e-3)
    fall = largest_fall(energy)
    label = f"energy that an oblique hit gave, {name}, friction {friction:g}"
    compare.number(label, 100.0 * fall, 0.0, unit="%", abs=100.0 * SHARE)
    rubbed = energy["contact friction"]
    assert np.all(np.diff(rubbed) >= -1.0e-9 * rubbed.max())
    assert (rubbed[-1] > 0.0) == (friction > 0.0)
    left = energy["kinetic"] + energy["internal"] + energy["impactor"]
    assert np.all(left - left[0] + energy["contact"] + rubbed < 1.0e-2 * left[0])
