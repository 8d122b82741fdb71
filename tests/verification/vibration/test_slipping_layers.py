"""Two layers on springs swing in cylindrical bending: from two beams that slip to a single one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh

from comparison import Comparison
from decks import Deck, Ply
from elasticity import isotropic
from meshes import regular
from runs import run
from swings import deflection, fitted

YOUNG, POISSON, DENSITY, HEIGHT, LENGTH = 70.0e3, 0.3, 2.7e-9, 1.0, 40.0
OPENING = 1.0e4  # stiffness across, MPa/mm
WAVE = np.pi / LENGTH


def strip(sliding: float, parts: int) -> float:
    """Angular frequency of u = U(z) cos, w = W(z) sin, linear in equal parts of both layers."""
    lame, shear = YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON), YOUNG / (2 * (1 + POISSON))
    law = np.diag([lame + 2 * shear, lame + 2 * shear, shear])
    law[0, 1] = law[1, 0] = lame
    size, high = 4 * (parts + 1), HEIGHT / parts
    stiffness, mass = np.zeros((size, size)), np.zeros((size, size))
    for part in range(2 * parts + 1):
        own = slice(2 * part, 2 * part + 4)
        if part == parts:  # the springs between the layers
            spring = np.array([[1.0, -1.0], [-1.0, 1.0]])
            stiffness[own, own] += np.kron(spring, np.diag([sliding, OPENING]))
            continue
        for place in np.array([-1.0, 1.0]) / np.sqrt(3.0):
            value = np.array([1.0 - place, 1.0 + place]) / 2.0
            strain, motion = np.zeros((3, 4)), np.kron(value, np.eye(2))
            strain[0, ::2], strain[1, 1::2] = -WAVE * value, [-1.0 / high, 1.0 / high]
            strain[2, ::2], strain[2, 1::2] = [-1.0 / high, 1.0 / high], WAVE * value
            stiffness[own, own] += 0.5 * high * strain.T @ law @ strain
            mass[own, own] += 0.5 * high * DENSITY * motion.T @ motion
    return float(np.sqrt(eigh(stiffness, mass, eigvals_only=True, subset_by_index=[0, 0])[0]))


@pytest.mark.parametrize("sliding", [20.0, 200.0, 2000.0])
def test_layers_slip(sliding: float, compare: Comparison, tmp_path: Path) -> None:
    """The exact strip, whose parts are refined to the limit.

    Two layers that slip freely would swing at half the frequency of a single one. Eight quads are
    0.04 % too stiff where the layers slip most, twice as many a tenth of that.
    """
    coarse, fine = strip(sliding, 30), strip(sliding, 60)
    exact = (4.0 * fine - coarse) / 3.0
    time = 4.0 * 2.0 * np.pi / exact
    mesh = regular(LENGTH / 2.0, 1.0, 8, 1, 9)
    deck = Deck("layers that slip", time)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(DENSITY, YOUNG, POISSON), HEIGHT)] * 2, 3)
    deck.interfaces(OPENING, sliding)
    deck.hold(range(len(mesh.points)), "y")
    deck.hold(mesh.where(x=0.0), "z")
    deck.hold(mesh.where(x=LENGTH / 2.0), "x")
    speeds = np.zeros((len(mesh.points), 3))
    speeds[:, 2] = np.sin(WAVE * mesh.points[:, 0])
    deck.velocities(speeds)
    deck.histories([mesh.at(LENGTH / 2.0, 0.0)], time / 500.0)
    deck.intervals(glstat=time)
    found = fitted(*deflection(run(deck, tmp_path)), exact, within=0.1)
    hertz = 2.0 * np.pi
    compare.number("two layers on springs", found / hertz, exact / hertz, unit="Hz", rel=5e-4)
