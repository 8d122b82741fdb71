"""Every law in plates and in bricks: work is what is stored and what is dissipated."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from damage import HTS40
from decks import Deck
from elasticity import Array
from runs import Results
from strained import BODIES, strain_body

YOUNG, POISSON, DENSITY, YIELD, TANGENT = 210.0e3, 0.3, 7.8e-9, 210.0, 20.0e3
#: Modulus of hardening over plastic strain
HARDENING = YOUNG * TANGENT / (YOUNG - TANGENT)
METAL = (1, DENSITY, YOUNG, POISSON)
#: What the issue asks for; the trapezia of the work against the backward steps of the laws
CLOSE = 0.01


def kinematic(beta: float, tangent: float = TANGENT, rate: float = 0.0) -> Callable[[Deck], None]:
    """*MAT_PLASTIC_KINEMATIC with a share of isotropic hardening."""

    def add(deck: Deck) -> None:
        deck.add("MAT_PLASTIC_KINEMATIC", (*METAL, YIELD, tangent, beta), (rate, 5.0))

    return add


def by_points(deck: Deck) -> None:
    """*MAT_PIECEWISE_LINEAR_PLASTICITY by points."""
    deck.add(
        "MAT_PIECEWISE_LINEAR_PLASTICITY",
        (*METAL, 0.0, 0.0, 1.0e21),
        (0.0, 0.0, 0, 0, 0.0),
        (0.0, 0.002, 0.01, 0.03),
        (210.0, 260.0, 300.0, 310.0),
    )


def by_table(deck: Deck) -> None:
    """*MAT_PIECEWISE_LINEAR_PLASTICITY by curves of two rates."""
    deck.add("DEFINE_TABLE", (900,), (10.0,), (4.0e4,))
    for number, rise in ((901, 0.0), (902, 120.0)):
        deck.add("DEFINE_CURVE", (number,), (0.0, 210.0 + rise), (0.03, 310.0 + rise))
    deck.add("MAT_PIECEWISE_LINEAR_PLASTICITY", METAL, (0.0, 0.0, 900, 0, 1.0))


def johnson_cook(deck: Deck) -> None:
    """*MAT_SIMPLIFIED_JOHNSON_COOK."""
    card = (210.0, 300.0, 0.4, 0.03, 1.0e17, 0.0, 0.0, 0.5)
    deck.add("MAT_SIMPLIFIED_JOHNSON_COOK", (*METAL, 1.0), card)


#: Law, and its modulus of kinematic hardening
METALS = {
    "perfect": (kinematic(1.0, 0.0), 0.0),
    "isotropic": (kinematic(1.0), 0.0),
    "kinematic": (kinematic(0.0), HARDENING),
    "mixed": (kinematic(0.4), 0.6 * HARDENING),
    "Cowper and Symonds": (kinematic(0.4, rate=40.0), 0.6 * HARDENING),
    "points": (by_points, 0.0),
    "table": (by_table, 0.0),
    "Johnson and Cook": (johnson_cook, 0.0),
}


def path(last: Array) -> tuple[Array, Array]:
    """Tension, then a circle of tension and two shears, then some last strain."""
    turns = np.linspace(0.0, 1.5 * np.pi, 31)
    strains = np.zeros((len(turns) + 2, 6))
    strains[1:-1, 0] = 0.012 * np.cos(turns)
    strains[1:-1, 1] = -0.004 * np.cos(turns)
    strains[1:-1, 3] = 0.018 * np.sin(turns)
    strains[1:-1, 5] = 0.012 * np.sin(turns) * turns / turns[-1]
    strains[-1] = last
    return np.linspace(0.0, 1.0e-4, len(strains)), strains


def stress_of(results: Results) -> Array:
    """The stress at the end, xx yy zz xy xz yz, the same everywhere."""
    field = results.field("stress")[:, [0, 1, 2, 3, 5, 4]]
    assert np.ptp(field, axis=0).max() < 1.0e-6 * np.abs(field).max()
    return field[0]


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("law", list(METALS))
def test_metals(law: str, body: str, compare: Comparison, tmp_path: Path) -> None:
    """Stored is what the stress does elastically, and what back stress stores (Prager).

    The back stress is 2/3 of the modulus times the plastic strain.
    """
    material, modulus = METALS[law]
    last = np.array([0.006, -0.002, 0.001, 0.004, 0.0, -0.003])
    results = strain_body(body, material, *path(last), tmp_path)
    stress, energy = stress_of(results), results.table("energy")
    shear = YOUNG / (2.0 * (1.0 + POISSON))
    elastic = np.concatenate(
        [((1.0 + POISSON) * stress[:3] - POISSON * stress[:3].sum()) / YOUNG, stress[3:] / shear]
    )
    plastic = last - elastic
    back = modulus / 3.0 * (np.sum(plastic[:3] ** 2) + 0.5 * np.sum(plastic[3:] ** 2))
    stored = 0.5 * stress @ elastic + back
    dissipated = energy["metal plasticity"][-1]
    assert dissipated > 5.0 * YIELD * 0.01
    assert energy["dissipated"] == pytest.approx(energy["metal plasticity"])
    work = energy["internal"][-1]
    compare.number("work of a metal", work, dissipated + stored, unit="mJ", rel=CLOSE)


def by_stress(deck: Deck) -> None:
    """*MAT_PLY_CODAM2."""
    deck.add("MAT_PLY_CODAM2", *HTS40.cards(1))


def by_strain(deck: Deck) -> None:
    """*MAT_CODAM2, fibres along x."""
    deck.add(
        "MAT_CODAM2",
        (1, 1.6e-9, 130.0e3, 9.0e3, 0, 0.02, 0, 0.4),
        (5.0e3, 0, 0, 1, 0, 0, 0),
        (0, 0, 0, 1.0, 0.0, 0.0, 2.0),
        (0, 0, 0, 0.0, 1.0, 0.0, 0, 1),
        (0.0,) * 8,
        (0.008, 0.009, 0.06, 0.0, 0.032, 0.06, 0.08, 0.0),
        (0.020, 0.011, 0.09, 0.0, 0.07, 0.09, 0.11, 0.0),
        (0, 1.2, 0.4, 0.0),
    )


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("ply", [by_stress, by_strain])
def test_damaged_ply(
    ply: Callable[[Deck], None], body: str, compare: Comparison, tmp_path: Path
) -> None:
    """Cracks unload to the origin: back at no strain, all work has been dissipated."""
    results = strain_body(body, ply, *path(np.zeros(6)), tmp_path)
    energy = results.table("energy")
    spent = energy["fibre damage"][-1] + energy["matrix damage"][-1]
    assert spent > 0.0
    assert energy["dissipated"][-1] == pytest.approx(spent)
    compare.number("work of a ply", energy["internal"][-1], spent, unit="mJ", rel=CLOSE)
