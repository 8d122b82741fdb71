"""Free vibration of simply supported plates against exact three-dimensional elasticity.

A quarter of the plate with planes of symmetry; the deflection of the mode is its velocity at the
start. In-plane motion is not started, so that thickness modes of the same harmonic are stirred a
little; a fit over many periods does not see them.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck, Ply
from elasticity import CARBON, STEEL, Material
from exact_plate import CrossPly, frequency
from meshes import regular
from runs import run
from swings import add_first_mode, deflection, fitted

NOOR = Material(1.0e-9, (40.0e3, 1.0e3, 1.0e3), (0.25, 0.25, 0.25), (600.0, 600.0, 500.0))
CARBON_PLATE = CrossPly(
    20.0, 20.0, tuple((CARBON, 0.25, a) for a in (0.0, 90.0, 0.0, 90.0, 90.0, 0.0, 90.0, 0.0))
)
THICK_PLATE = CrossPly(5.0, 5.0, tuple((NOOR, 0.25, a) for a in (0.0, 90.0, 90.0, 0.0)))


def measured(
    plate: CrossPly, order: int, quads: int, folder: Path, nodes: int = 9, stiffer: float = 1.0
) -> tuple[float, float]:
    """Angular frequencies of the first mode: exact, and of the run over ten periods.

    Where the mesh is known to be stiffer by a factor, the frequency is looked for there.
    """
    exact = frequency(plate, 1, 1, 3.0 * np.pi / plate.length * 1.5e6)
    time = 10.0 * 2.0 * np.pi / exact
    mesh = regular(plate.length / 2.0, plate.width / 2.0, quads, quads, nodes)
    deck = Deck("free vibration", time)
    deck.intervals(glstat=time)
    deck.control(linear=True)
    add_first_mode(deck, mesh, [Ply(*ply) for ply in plate.plies], order, time / 1000.0)
    swing = deflection(run(deck, folder))
    return exact, fitted(*swing, exact * stiffer**0.5, within=0.04)


@pytest.mark.parametrize(
    ("plate", "order", "tolerance"),
    [
        (CARBON_PLATE, 1, 1.0e-2),
        (CARBON_PLATE, 2, 1.0e-3),
        (CARBON_PLATE, 3, 1.0e-3),
        (THICK_PLATE, 1, 2.0e-2),
        (THICK_PLATE, 2, 1.0e-3),
        (THICK_PLATE, 3, 1.0e-3),
    ],
    ids=["thin LE1", "thin LE2", "thin LE3", "thick LE1", "thick LE2", "thick LE3"],
)
def test_first_frequency(
    plate: CrossPly, order: int, tolerance: float, compare: Comparison, tmp_path: Path
) -> None:
    """Eight Q9 over the plate: order 1 is too stiff through the thickness, the others exact."""
    exact, found = measured(plate, order, 4, tmp_path)
    hertz = 2.0 * np.pi
    compare.number("first frequency", found / hertz, exact / hertz, unit="Hz", rel=tolerance)


@pytest.mark.parametrize("quads", [5, 10])
def test_quads_of_four_nodes_are_stiff(quads: int, compare: Comparison, tmp_path: Path) -> None:
    """By the shear that they add to a curvature.

    Of the energy of sin sin in bending and twist, 4 D k^2, curvatures along x and y add
    2 (G H L^2/12) k^2, with D = E' H^3/12. What is left is of the order of (pi L/a)^2/12.
    """
    plate = CrossPly(20.0, 20.0, ((STEEL, 1.0, 0.0),))
    length, young, nu = 10.0 / quads, STEEL.young[0], STEEL.poisson[0]
    factor = 1.0 + 0.5 * STEEL.shear[1] * length**2 * (1.0 - nu**2) / young
    exact, found = measured(plate, 2, quads, tmp_path, nodes=4, stiffer=factor)
    rest = (np.pi * length / plate.length) ** 2 / 12.0
    compare.number(
        f"stiffness, L = {length:g} H", (found / exact) ** 2, factor, rel=max(5.0e-3, 2.0 * rest)
    )
