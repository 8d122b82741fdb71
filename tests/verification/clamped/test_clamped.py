"""Clamped plates of steel: a disc under pressure, and the first frequencies of disc and square.

Plate theory gives w(0) = p R^4 / (64 D) + p R^2 / (4 k G h) and omega R^2 sqrt(rho h / D) = 10.216
for the disc, omega a^2 sqrt(rho h / D) = 35.985 for the square. Here all points of the edge are
held, which is a little stiffer than the edge of plate theory, and so are full quadrature and a
coarse mesh.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.optimize import minimize_scalar

from comparison import Comparison
from decks import Deck, Ply, ramp
from elasticity import STEEL, Array
from meshes import Mesh, disc, regular
from runs import Table, run

RADIUS, CORE = 50.0, 40.0
SIDE = 100.0
YOUNG, POISSON, DENSITY = STEEL.young[0], STEEL.poisson[0], STEEL.density
PRESSURE = 1.0


def rim(mesh: Mesh) -> Array:
    """Nodes on the circle."""
    return np.flatnonzero(np.hypot(*mesh.points.T) > RADIUS - 1e-6)


def rigidity(thickness: float) -> float:
    """D = E h^3 / 12 (1 - nu^2)."""
    return YOUNG * thickness**3 / 12.0 / (1.0 - POISSON**2)


def deflection(table: Table, node: int) -> Array:
    """Mean deflection of a node."""
    return 0.5 * (table[f"n{node + 1} bottom uz"] + table[f"n{node + 1} top uz"])


def test_disc_under_pressure(compare: Comparison, tmp_path: Path) -> None:
    """A damped disc comes to rest at the deflection of plate theory; the rim carries the load."""
    thickness = 4.0
    mesh = disc(6, 4, RADIUS, CORE)
    omega = 10.216 * np.sqrt(rigidity(thickness) / (DENSITY * thickness)) / RADIUS**2
    period = 2.0 * np.pi / omega
    deck = Deck("disc under pressure", 6.0 * period)
    deck.control(linear=True, damping=1.8 * omega)
    deck.mesh(mesh)
    deck.laminate([Ply(STEEL, thickness)], order=3)
    deck.hold(rim(mesh), "xyz")
    deck.add("LOAD_FACE_PRESSURE", (0, 1, deck.curve(ramp(period)), PRESSURE))
    deck.histories([mesh.at(0.0, 0.0)], 0.1 * period)
    deck.intervals(spcforc=0.1 * period, glstat=period, binary_d3plot=6.0 * period)
    results = run(deck, tmp_path)
    bent = PRESSURE * RADIUS**4 / (64.0 * rigidity(thickness))
    sheared = PRESSURE * RADIUS**2 / (4.0 * 5.0 / 6.0 * STEEL.shear[0] * thickness)
    found = -deflection(results.table("nodes"), mesh.at(0.0, 0.0))[-1]
    # 0.991 of it on quads of less than half the size
    compare.number("deflection of the middle", found, bent + sheared, unit="mm", rel=0.02)
    carried = results.table("supports")["fz"][-1]
    load = PRESSURE * np.pi * RADIUS**2
    compare.number("force of the support", carried, load, unit="N", rel=1e-3)


def first_frequency(mesh: Mesh, edge: Array, shape: Array, guess: float, folder: Path) -> float:
    """Angular frequency of a plate that starts with a velocity close to its first mode."""
    node = int(np.argmax(shape))
    deck = Deck("clamped plate", 6.0 * np.pi / guess)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(STEEL, 2.0)])
    deck.hold(edge, "xyz")
    deck.velocities(np.stack([0.0 * shape, 0.0 * shape, 100.0 * shape], axis=1))
    deck.histories([node], 0.01 / guess)
    deck.intervals(glstat=1.0 / guess, binary_d3plot=10.0 / guess)
    table = run(deck, folder).table("nodes")
    times, values = table["time"], deflection(table, node)

    def misfit(omega: float) -> float:
        waves = np.stack([np.cos(omega * times), np.sin(omega * times)], axis=1)
        return float(np.linalg.lstsq(waves, values, rcond=None)[1][0])

    return float(minimize_scalar(misfit, bounds=(0.9 * guess, 1.1 * guess), method="bounded").x)


def test_first_frequency_of_a_disc(compare: Comparison, tmp_path: Path) -> None:
    """10.216 of plate theory."""
    mesh = disc(6, 4, RADIUS, CORE)
    theory = 10.216 * np.sqrt(rigidity(2.0) / (DENSITY * 2.0)) / RADIUS**2
    shape = np.maximum(1.0 - (mesh.points**2).sum(axis=1) / RADIUS**2, 0.0) ** 2
    found = first_frequency(mesh, rim(mesh), shape, theory, tmp_path)
    compare.number("first angular frequency", found, theory, unit="1/s", rel=0.01)


def test_first_frequency_of_a_square(compare: Comparison, tmp_path: Path) -> None:
    """35.985 of plate theory; 1.5 % above it on 10 x 10 quads, 0.6 % on these."""
    mesh = regular(SIDE, SIDE, 14, 14, 9)
    theory = 35.985 * np.sqrt(rigidity(2.0) / (DENSITY * 2.0)) / SIDE**2
    shape = np.prod(np.sin(np.pi * mesh.points / SIDE) ** 2, axis=1)
    found = first_frequency(mesh, np.array(mesh.boundary()), shape, theory, tmp_path)
    compare.number("first angular frequency", found, theory, unit="1/s", rel=0.01)
