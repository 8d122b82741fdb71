"""One distorted quad that is thrown apart: large strains, the same equations solved densely."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck, Ply
from elasticity import Array, Material, stiffness
from meshes import GRID, Mesh, regular, shapes
from runs import run

PLY = Material(1.0e-6, (20.0e3, 5.0e3, 4.0e3), (0.3, 0.25, 0.35), (2.0e3, 1.8e3, 1.5e3))
HEIGHT, END = 0.8, 2.0e-4
LEAST = 0.8  # ratio of volumes below which the barrier acts
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def polynomials(order: int, places: Array) -> tuple[Array, Array]:
    """Lagrange polynomials of equally spaced points, and their slopes: (places, points)."""
    powers = np.arange(order + 1)
    inverse = np.linalg.inv(np.linspace(-1.0, 1.0, order + 1)[:, None] ** powers)
    slopes = powers * places[:, None] ** np.maximum(powers - 1, 0)
    return places[:, None] ** powers @ inverse, slopes @ inverse


@dataclass(frozen=True)
class Body:
    """A quad of one ply: gradients and volumes at its Gauss points, masses, stiffness."""

    gradient: Array  # (points, nodes, planes, 3)
    volume: Array  # (points,)
    mass: Array  # (nodes, planes, 1)
    law: Array  # (6, 6)

    def force(self, displacement: Array) -> tuple[Array, float]:
        """Internal forces, (nodes, planes, 3), and the least ratio of volumes."""
        slopes = np.einsum("gntj,nti->gij", self.gradient, displacement)
        turn = np.eye(3) + slopes
        strain = 0.5 * (np.einsum("gki,gkj->gij", turn, turn) - np.eye(3))
        double = [1.0, 1.0, 1.0, 2.0, 2.0, 2.0]
        stress = np.array([f * strain[:, i, j] for f, (i, j) in zip(double, PAIRS, strict=True)])
        stress = self.law @ stress
        second = np.zeros_like(strain)
        for own, (i, j) in zip(stress, PAIRS, strict=True):
            second[:, i, j] = second[:, j, i] = own
        ratio = np.linalg.det(turn)
        push = -self.law[2, 2] * np.maximum(LEAST - ratio, 0.0) ** 2
        # the cofactors are those of the ratio times the inverse, transposed
        barrier = push[:, None, None] * np.linalg.inv(turn).transpose(0, 2, 1)
        first = turn @ second + barrier
        forces = np.einsum("g,gij,gntj->nti", self.volume, first, self.gradient)
        return forces, float(ratio.min())


def body(corners: Array, order: int, angle: float) -> Body:
    """The body of a quad whose nodes are in the order of the deck."""
    nodes = len(corners)
    along, weights = np.polynomial.legendre.leggauss(2 if nodes == 4 else 3)
    heights, parts = np.polynomial.legendre.leggauss(order + 1)
    through, rise = polynomials(order, heights)
    gradient, volume = [], []
    for xi, u in zip(along, weights, strict=True):
        for eta, v in zip(along, weights, strict=True):
            values, slopes = shapes(nodes, xi, eta)
            jacobian = slopes.T @ corners
            plane = slopes @ np.linalg.inv(jacobian).T
            for k, part in enumerate(parts):
                flat = [np.outer(plane[:, d], through[k]) for d in range(2)]
                gradient.append(np.stack([*flat, np.outer(values, rise[k] * 2 / HEIGHT)], axis=2))
                volume.append(u * v * np.linalg.det(jacobian) * part * HEIGHT / 2)
    line = np.array({4: [1.0, 1.0], 9: [1 / 3, 4 / 3, 1 / 3]}[nodes])
    places, grid = np.linspace(-1.0, 1.0, len(line)), GRID if nodes == 9 else GRID[:4] // 2
    areas = [
        line[a] * line[b] * np.linalg.det(shapes(nodes, places[a], places[b])[1].T @ corners)
        for a, b in grid
    ]
    # rows of the consistent mass: integrals of the polynomials
    share = 0.5 * parts @ through
    mass = PLY.density * HEIGHT * np.outer(areas, share)[:, :, None]
    return Body(np.array(gradient), np.array(volume), mass, stiffness(PLY, angle))


@pytest.mark.parametrize(
    ("nodes", "order", "angle", "speed"),
    [
        (4, 1, 30.0, 5.0e3),
        (9, 1, 30.0, 5.0e3),
        (9, 2, -50.0, 5.0e3),
        (4, 3, 70.0, 5.0e3),
        (9, 4, 15.0, 5.0e3),
        (9, 2, 20.0, 12.0e3),
    ],
)
def test_quad_is_thrown_apart(
    nodes: int, order: int, angle: float, speed: float, compare: Comparison, tmp_path: Path
) -> None:
    """Both faces in every step, at strains of a tenth and more: the ten digits of the files.

    At the highest speed the barrier against compression acts.
    """
    random = np.random.default_rng(nodes + order)
    plain = regular(2.0, 1.5, 1, 1, nodes)
    mesh = Mesh(plain.points + random.uniform(-0.12, 0.12, plain.points.shape), plain.quads)
    start = speed * random.normal(size=(nodes, 3))
    deck = Deck("thrown apart", END)
    # the work of such large steps is not that of the strain
    deck.add("CONTROL_LAYERWISE", (1, 1.0e9))
    deck.add("CONTROL_TIMESTEP", (0.0, 0.6))
    deck.mesh(mesh)
    deck.laminate([Ply(PLY, HEIGHT, angle)], order)
    deck.velocities(start)
    deck.histories(range(nodes), 0.0)
    deck.intervals(glstat=0.0)
    results = run(deck, tmp_path)
    table, quad = results.table("nodes"), mesh.quads[0]
    found = np.array(
        [
            [[table[f"n{node + 1} {face} u{c}"] for c in "xyz"] for face in ("bottom", "top")]
            for node in quad
        ]
    )
    own, place = body(mesh.points[quad], order, angle), np.zeros((nodes, order + 1, 3))
    velocity = np.repeat(start[quad][:, None], order + 1, axis=1)
    before, least, exact = 0.0, 1.0, [place[:, [0, -1]]]
    for step in results.table("energy")["step"][1:]:
        force, ratio = own.force(place)
        least = min(least, ratio)
        velocity = velocity - 0.5 * (before + step) * force / own.mass
        place = place + step * velocity
        before = step
        exact.append(place[:, [0, -1]])
    assert (least < LEAST) == (speed > 1.0e4)
    wanted = np.moveaxis(np.array(exact), 0, -1)
    close = 1.0e-8 * np.abs(wanted).max()
    compare.values("faces of a quad at large strain", found, wanted, unit="mm", abs=close)
