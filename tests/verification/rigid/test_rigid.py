"""Rigid motion: the right mass and inertia, no strain, nothing lost."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck, Ply
from elasticity import CARBON, GLASS, Array
from meshes import Mesh, distorted, plane_weights, regular
from runs import DIGITS, Results, Table, run

LENGTH, WIDTH = 12.0, 8.0
RATE = 1500.0  # of the quarter turn, rad/s
PLIES = [Ply(CARBON, 0.4, 0.0), Ply(GLASS, 0.6, 40.0), Ply(CARBON, 0.5, 90.0)]
DENSITY_PER_AREA = sum(ply.material.density * ply.thickness for ply in PLIES)


def free_plate(mesh: Mesh, order: int, time: float, linear: bool) -> Deck:
    """A plate without supports or loads."""
    deck = Deck("rigid motion", time)
    deck.control(linear=linear)
    deck.mesh(mesh)
    deck.laminate(PLIES, order)
    deck.intervals(glstat=time / 20.0)
    return deck


@pytest.mark.parametrize("linear", [True, False], ids=["linear", "total lagrangian"])
@pytest.mark.parametrize("order", [1, 2, 3, 4])
@pytest.mark.parametrize("nodes", [4, 9])
def test_translation_keeps_momentum_and_strains_nothing(
    nodes: int, order: int, linear: bool, compare: Comparison, tmp_path: Path
) -> None:
    """The mass is exact on distorted quads too: nodal quadrature integrates their area."""
    mesh = distorted(regular(LENGTH, WIDTH, 3, 2, nodes), 0.3 if nodes == 9 else 0.8)
    velocity, time = np.array([3.0e3, -2.0e3, 1.0e3]), 2.0e-5
    deck = free_plate(mesh, order, time, linear)
    deck.velocity(range(len(mesh.points)), velocity)
    deck.profile(1, 5.0, 3.0, time)
    results = run(deck, tmp_path)
    energy, mass = results.table("energy"), DENSITY_PER_AREA * LENGTH * WIDTH
    kinetic = 0.5 * mass * velocity @ velocity
    compare.values("kinetic energy", energy["kinetic"], kinetic, unit="mJ", rel=DIGITS)
    assert np.abs(energy["internal"]).max() < 1e-12 * kinetic
    for k, axis in enumerate("xyz"):
        momentum = energy[f"momentum {axis}"]
        compare.values(f"momentum along {axis}", momentum, mass * velocity[k], rel=DIGITS)
    profile = results.profile(1)
    travelled = velocity * profile["time"][0]
    for k, name in enumerate(("ux", "uy", "uz")):
        assert profile[name] == pytest.approx(
            np.full(len(profile[name]), travelled[k]), rel=3.0 * DIGITS
        )
    # round-off of a displacement of 0.06 mm over 1 mm times a modulus of 1e5 MPa
    assert max(np.abs(profile[name]).max() for name in ("sxx", "syy", "szz", "sxz")) < 1e-6


def spin(mesh: Mesh, rate: float) -> Array:
    """Velocities of a rotation about the z axis through the centre of the plate."""
    x, y = (mesh.points - [LENGTH / 2.0, WIDTH / 2.0]).T
    return np.stack([-rate * y, rate * x, np.zeros(len(x))], axis=1)


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_inertia_about_z_is_exact(order: int, compare: Comparison, tmp_path: Path) -> None:
    """Simpson's rule integrates r squared on Q9 rectangles: kinetic energy is I omega^2 / 2."""
    mesh, rate = regular(LENGTH, WIDTH, 3, 2, 9), 500.0
    deck = free_plate(mesh, order, 1.0e-7, linear=False)
    deck.velocities(spin(mesh, rate))
    energy = run(deck, tmp_path).table("energy")
    inertia = DENSITY_PER_AREA * LENGTH * WIDTH * (LENGTH**2 + WIDTH**2) / 12.0
    found, expected = energy["kinetic"][0], 0.5 * inertia * rate**2
    compare.number("energy of a spin", found, expected, unit="mJ", rel=DIGITS)


def histories(table: Table, count: int, names: tuple[str, ...]) -> Array:
    """Histories of all nodes on both faces, (nodes, 2, names, times)."""
    return np.array(
        [
            [[table[f"n{i + 1} {face} {name}"] for name in names] for face in ("bottom", "top")]
            for i in range(count)
        ]
    )


def turned_by_a_quarter(mesh: Mesh, ply: Ply, folder: Path) -> Results:
    """A plate that spins freely until it has made a quarter turn."""
    time = 0.5 * np.pi / RATE
    deck = Deck("quarter turn", time)
    deck.control()
    deck.mesh(mesh)
    deck.laminate([ply], 1)
    deck.intervals(glstat=time / 100.0)
    deck.velocities(spin(mesh, RATE))
    deck.histories(range(len(mesh.points)), time / 50.0)
    deck.profile(1, 5.0, 3.0, time)
    return run(deck, folder)


@pytest.mark.parametrize("nodes", [4, 9])
def test_quarter_turn(nodes: int, compare: Comparison, tmp_path: Path) -> None:
    """A quarter turn in the plane strains no more than the centrifugal forces do.

    Those stretch by at most rho omega^2 R^2 / E, twice that when they set in suddenly; this is
    1e-6 here, while strains linear in the displacements would reach 1.
    """
    mesh, ply = regular(LENGTH, WIDTH, 3, 2, nodes), Ply(CARBON, 2.0)
    results = turned_by_a_quarter(mesh, ply, tmp_path)

    centre = np.array([LENGTH / 2.0, WIDTH / 2.0])
    arm = mesh.points - centre
    radius = np.hypot(*arm.T).max()
    stretch = 2.0 * CARBON.density * RATE**2 * radius**2 / CARBON.young[1]
    table = results.table("nodes")
    place = arm[:, None, :, None] + histories(table, len(arm), ("ux", "uy"))
    angle = RATE * table["time"]
    turned = np.array(
        [
            arm[:, :1] * np.cos(angle) - arm[:, 1:] * np.sin(angle),
            arm[:, :1] * np.sin(angle) + arm[:, 1:] * np.cos(angle),
        ]
    )
    # radial stretch, and the lag of a body whose inertia has grown by as much
    assert np.abs(place - turned.transpose(1, 0, 2)[:, None]).max() < 4.0 * stretch * radius
    profile = results.profile(1)
    for name in ("exx", "eyy", "ezz", "gxy", "gxz", "gyz"):
        strain = np.abs(profile[name]).max()
        compare.number("strain of a quarter turn", strain, 0.0, abs=2.0 * stretch)
    energy = results.table("energy")
    assert np.ptp(energy["total"]) < 1e-6 * energy["total"][0]

    point_mass = 0.5 * CARBON.density * ply.thickness * plane_weights(mesh)
    velocity = histories(table, len(arm), ("vx", "vy"))
    spin_of = place[:, :, 0] * velocity[:, :, 1] - place[:, :, 1] * velocity[:, :, 0]
    momentum = np.einsum("i,ijt->t", point_mass, spin_of)
    # the forces of an element have no moment: the digits of the file are left
    assert np.ptp(momentum[1:]) < 10.0 * DIGITS * abs(momentum[1])
