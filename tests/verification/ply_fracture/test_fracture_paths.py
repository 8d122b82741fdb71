"""A quad led along random paths of strain, there and back and across: the law written twice."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck
from elasticity import Array
from fracture_reference import (
    ELASTIC,
    IM7,
    POINTS,
    POWER,
    SHEAR_CURVE,
    FracturePly,
    FracturePoint,
)
from runs import run
from strained import COMPONENTS, cube

# A heavy ply takes long steps: some two hundred in a path, all of which are compared
END, DENSITY = 6.0e-3, 1.6e-4
PLY = replace(IM7, density=DENSITY, band=0.1)
# Strains of onset in uniaxial stress
SIZES = np.array([0.014, 0.01, 0.01, 0.02, 0.02, 0.025])
VARIANTS = {
    "linear hardening": PLY,
    "elastic shear": replace(PLY, shear_curve=(ELASTIC,)),
    "power curve": replace(PLY, shear_curve=(POWER, 4.06e-9 / 5290.0, 5.4)),
    "curve by points": replace(PLY, shear_curve=(POINTS,), points=SHEAR_CURVE),
    "curve with an elastic part": replace(
        PLY, shear_curve=(POINTS,), points=((0.0, 0.0), (0.01, 52.9), (0.02, 80.0), (0.05, 90.0))
    ),
    "fibres on two lines": replace(PLY, lines=(0.75, 0.375, 0.614, 0.432)),
    "no friction": replace(PLY, friction=0.0),
    "too wide": replace(PLY, band=2.0),
    "debris": replace(PLY, debris=(0.01, 0.3)),
    "crushing": replace(PLY, crush=150.0, plateau=0.2),
    "unlike through the thickness": replace(
        PLY,
        young=(130.0e3, 7.7e3, 7.0e3),
        poisson=(0.3, 0.28, 0.35),
        shear=(4.8e3, 4.5e3, 3.8e3),
    ),
}


def path(seed: int) -> Array:
    """Knots of a random path of strain, some of them back or through zero, (knots, 6)."""
    random = np.random.default_rng(seed)
    knots = [np.zeros(6)]
    for _ in range(6):
        size = np.exp(random.uniform(-0.7, 1.2))
        knot = size * SIZES * random.normal(size=6) * (random.random(6) < 0.6)
        knots.append(-0.8 * knots[-1] if random.random() < 0.25 else knot)
    return np.array(knots)


def add_ply(deck: Deck, ply: FracturePly) -> None:
    """The ply as material 1, with its curve of shear."""
    curve = deck.curve(list(ply.points)) if ply.points else 0
    deck.add("MAT_PLY_FRACTURE_3D", *ply.cards(1, curve))


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("variant", list(VARIANTS))
def test_path(variant: str, seed: int, compare: Comparison, tmp_path: Path) -> None:
    """Stress of every step, and energies that never fall."""
    ply: FracturePly = VARIANTS[variant]
    knots = path(seed)
    times = np.linspace(0.0, 1.001 * END, len(knots))
    deck = cube(lambda deck: add_ply(deck, ply), times, knots)
    deck.profile(1, 0.5, 0.5, 1.0e-9 * END, points=2)
    deck.intervals(glstat=1.0e-9 * END, binary_d3plot=2.0 * END)
    results = run(deck, tmp_path)
    profile = results.table("profile_1")
    below = profile["z"] < 0.0
    names = [f"{kind}{two}" for kind, two in zip("eeeggg", COMPONENTS, strict=True)]
    strain = np.stack([profile[name][below] for name in names], axis=1)
    stress = np.stack([profile[f"s{two}"][below] for two in COMPONENTS], axis=1)
    assert len(strain) > 100
    point, expected = FracturePoint(ply), []
    for now in strain:
        point.step(now)
        expected.append(deepcopy(point).step(now))
    # the angle of the plane is known to a millionth of a turn, and turns some 2000 MPa with it
    compare.values("stress of random paths", stress, np.array(expected), unit="MPa", abs=2.0e-2)
    energy = results.table("energy")
    assert np.abs(energy["error"]).max() < 1.0e-9
    # a step that takes the stress of broken fibres through zero counts half the product of the
    # stresses before and after, over the modulus that it gains or loses, and so does a crack there
    shares = {"fibre damage": 1.0e-6, "matrix damage": 1.0e-6, "ply plasticity": 1.0e-12}
    for mechanism, share in shares.items():
        assert np.diff(energy[mechanism]).min() > -share * energy["internal"].max()
