"""Cattaneo (1938) and Mindlin (1949): a sphere that is pressed on a block and then pushed along it.

Under P, and Q < mu P along the face, a ring slips and a disc sticks: the sphere moves by

    3 mu P (2 - nu) / (16 a G) (1 - (1 - Q / mu P)^(2/3)),   a = (3 P R (1 - nu^2) / 4 E)^(1/3).

The closed form leaves out what friction does to the pressure, which vanishes for nu = 1/2.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, Deck, Ply, Sphere, ramp
from elasticity import Array, isotropic
from meshes import rectangle
from runs import Table, run

YOUNG, POISSON, RADIUS, FRICTION = 10.0e3, 0.45, 8.0, 0.3
SHEAR = YOUNG / (2.0 * (1.0 + POISSON))
CONTACT = 0.8  # about; the mesh is made for it
DEPTH = 20.0 * CONTACT
DOWN = CONTACT**2 / RADIUS
ALONG = 0.035  # some tenths more than it takes to slip throughout
PRESSED, PUSHED = 4.0e-5, 2.4e-4  # times at which the sphere is down, and has been pushed


def lines() -> Array:
    """From the contact outwards: four quads, five nodes to its radius, then ever larger ones."""
    widths = CONTACT * np.append(np.full(4, 0.4), 0.4 * 2.5 ** np.arange(1, 5))
    widths[4:] *= (DEPTH - widths[:4].sum()) / widths[4:].sum()
    return np.append(0.0, np.cumsum(widths))


def test_sphere_is_pushed_along_a_block(compare: Comparison, tmp_path: Path) -> None:
    """Half of a block, y > 0; the far bottom is held.

    It stops what a half-space would move there by the solution of Cerruti (1882),
    2 (3/2 - nu) / (pi (2 - nu)) a / H of the motion with all points sticking, 2.2 %: the sphere
    moves less than in the closed form, by at most that. Some fifty points are in contact: its area
    is known to one of them, and its radius, on which the motion depends inversely, to 1 %.
    """
    mesh = rectangle(np.concatenate([-lines()[:0:-1], lines()]), lines(), 9)
    deck = Deck("Mindlin", PUSHED)
    deck.control(linear=True, damping=2.0e5)
    deck.mesh(mesh)
    block = isotropic(2.0e-9, YOUNG, POISSON)
    deck.laminate([Ply(block, float(height)) for height in np.diff(lines())[::-1]], 1)
    deck.hold(mesh.where(y=0.0), "y")
    deck.hold_face(range(len(mesh.points)), BOTTOM, "xyz")
    deck.intervals(impactor=0.0, glstat=0.002 * PUSHED)
    still = deck.curve([(0.0, 0.0), (PUSHED, 0.0)])
    press = deck.curve([(t, -DOWN * s) for t, s in ramp(PRESSED)])
    push = deck.curve([(0.0, 0.0), *((PRESSED + t, ALONG * s) for t, s in ramp(PUSHED - PRESSED))])
    ball = Sphere(RADIUS, 1.0e-3, (0.0, 0.0, 0.5 * DEPTH + RADIUS), rotates=False)
    curves, friction = (push, still, press), (FRICTION,)
    deck.sphere(replace(ball, curves=curves, quantity=2, friction=friction))
    results = run(deck, tmp_path)
    history, energy = results.table("impactor_1"), results.table("energy")
    smooth = np.ones(151) / 151.0
    normal, pull = (
        2.0 * np.abs(np.convolve(history[name], smooth, "same")) for name in ("force", "force x")
    )
    pushed = (history["time"] > PRESSED) & (history["time"] < 0.95 * PUSHED)
    pressure = float(normal[pushed].mean())
    most = FRICTION * pressure
    contact = (0.75 * pressure * RADIUS * (1.0 - POISSON**2) / YOUNG) ** (1.0 / 3.0)
    slipping = 3.0 * most * (2.0 - POISSON) / (16.0 * contact * SHEAR)
    held = 2.0 * (1.5 - POISSON) / (np.pi * (2.0 - POISSON)) * contact / DEPTH
    bounds = (-held - 0.01, 0.01)
    for share in (0.5, 0.75, 0.9):
        at = int(np.argmax(pushed & (pull > share * most)))
        moved = slipping * (1.0 - (1.0 - share) ** (2.0 / 3.0))
        name = f"sphere pushed along by {share:g} of the friction limit"
        compare.number(name, history["displacement x"][at], moved, unit="mm", bounds=bounds)
    assert pull[pushed].max() == pytest.approx(most, rel=0.01)
    _check_energy(energy)


def _check_energy(energy: Table) -> None:
    """Contact that lasts with its gap closed does no work, though damping acts on its points.

    What it takes is lost by points that meet the sphere: it never gives, and it is far less than
    friction and damping take.
    """
    assert np.diff(energy["contact"]).min() > -1.0e-6 * energy["external"][-1]
    assert energy["contact"][-1] < 0.05 * energy["contact friction"][-1]
    assert np.abs(energy["error"][:-2]).max() < 1.0e-12
