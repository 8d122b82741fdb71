"""A quad led along random paths of strain, there and back and across: the law written twice."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from damage import HTS40, DamagedPly
from elasticity import Array
from ply_reference import EXPONENTIAL, PlyPoint
from runs import Results, run
from strained import COMPONENTS, cube

# A heavy ply takes long steps: some two hundred in a path, all of which are compared
END, DENSITY = 6.0e-3, 1.6e-4
# So narrow that no mode snaps back, and so wide that all do but fibres
NARROW, WIDE = 0.25, 1.0
PLY = replace(HTS40, density=DENSITY, band=NARROW, curve=(EXPONENTIAL, 0, 0.05))
# Strains of onset in uniaxial stress, and of little stress where nothing breaks
SIZES = np.array([0.016, 0.012, 0.004, 0.02, 0.01, 0.01])
VARIANTS = {
    "as by default": PLY,
    "a line of shear": replace(PLY, curve=(0,), shear_toughness=0.5),
    "too wide": replace(PLY, band=WIDE),
    "drops": replace(PLY, band=WIDE, switches=(0, 2)),
    "Hashin": replace(PLY, cross_strength=90.0, switches=(0, 0, 1.05, 1)),
    "closes": replace(PLY, switches=(0, 0, 1.05, 0, 0, 1)),
    "fibres on two lines": replace(PLY, lines=(0.75, 0.375, 0.2, 0.5)),
    "closes, two lines": replace(
        PLY, lines=(0.63, 0.469, 0.614, 0.432), switches=(0, 0, 1.05, 0, 0, 1)
    ),
    "plateau": replace(PLY, largest=0.99, switches=(0, 0, 1.05, 0, 0, 0, 0.3)),
}


def path(seed: int) -> Array:
    """Knots of a random path of strain, some of them back or through zero, (knots, 6)."""
    random = np.random.default_rng(seed)
    knots = [np.zeros(6)]
    for _ in range(6):
        size = np.exp(random.uniform(-0.7, 1.5))
        knot = size * SIZES * random.normal(size=6) * (random.random(6) < 0.6)
        knots.append(-0.8 * knots[-1] if random.random() < 0.25 else knot)
    return np.array(knots)


def led(ply: DamagedPly, knots: Array, folder: Path) -> Results:
    """Lead a quad of this ply along a path, every step written."""
    times = np.linspace(0.0, 1.001 * END, len(knots))
    deck = cube(lambda deck: deck.add("MAT_PLY_CODAM2", *ply.cards(1)), times, knots)
    deck.profile(1, 0.5, 0.5, 1.0e-9 * END, points=2)
    deck.intervals(glstat=1.0e-9 * END, binary_d3plot=2.0 * END)
    return run(deck, folder)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("variant", list(VARIANTS))
def test_path(variant: str, seed: int, compare: Comparison, tmp_path: Path) -> None:
    """Stress of every step, but for steps in which a second mode begins because a first one did.

    What is written then has been asked once more at the strain of the step.
    """
    ply = VARIANTS[variant]
    results = led(ply, path(seed), tmp_path)
    profile = results.table("profile_1")
    below = profile["z"] < 0.0
    names = [f"{kind}{two}" for kind, two in zip("eeeggg", COMPONENTS, strict=True)]
    strain = np.stack([profile[name][below] for name in names], axis=1)
    stress = np.stack([profile[f"s{two}"][below] for two in COMPONENTS], axis=1)
    assert len(strain) > 100
    point, expected = PlyPoint(ply), []
    for now in strain:
        point.step(now)
        expected.append(deepcopy(point).step(now))
    close = 1.0e-5 * ply.matrix_strength[0]
    compare.values("stress of random paths", stress, np.array(expected), unit="MPa", abs=close)
    energy = results.table("energy")
    assert np.all(np.diff(energy["dissipated"]) >= 0.0)
