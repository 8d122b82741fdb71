"""A quad led along random paths of strain, there and back and across: each law written twice."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck
from elasticity import Array
from metal_reference import MetalPoint, Yield
from runs import run
from strained import COMPONENTS, cube

# A heavy metal takes long steps: some hundred in a path, all of which are compared
END, DENSITY, YOUNG, POISSON = 2.0e-2, 4.0e-3, 210.0e3, 0.3
STRAINS = np.array([0.0, 0.002, 0.01, 0.03])
# The second one falls between two points
STRESSES = np.array([210.0, 260.0, 300.0, 310.0])
FALLING = np.array([210.0, 300.0, 260.0, 310.0])
FASTER = STRESSES + np.array([120.0, 100.0, 90.0, 80.0])
SLOW, FAST = 0.1, 40.0
FIRST = (1, DENSITY, YOUNG, POISSON)


@dataclass(frozen=True)
class Metal:
    """How a deck says it, the yield stress over plastic strain and rate, and Prager's modulus."""

    cards: Callable[[Deck], None]
    yields: Yield
    kinematic: float = 0.0


def kinematic(beta: float, reference: float = 0.0, power: float = 5.0) -> Metal:
    """*MAT_PLASTIC_KINEMATIC."""
    modulus = YOUNG * 8.0e3 / (YOUNG - 8.0e3)

    def yields(strain: float, rate: float) -> float:
        rise = (rate / reference) ** (1.0 / power) if reference > 0.0 else 0.0
        return (210.0 + beta * modulus * strain) * (1.0 + rise)

    card = (*FIRST, 210.0, 8.0e3, beta)
    rates = [(reference, power)] if reference > 0.0 else []
    cards = [card, *rates]
    return Metal(
        lambda deck: deck.add("MAT_PLASTIC_KINEMATIC", *cards), yields, (1.0 - beta) * modulus
    )


def static(stresses: Array, strain: float) -> float:
    """A curve that goes on past its last point as it ended."""
    slope = (stresses[-1] - stresses[-2]) / (STRAINS[-1] - STRAINS[-2])
    return float(np.interp(strain, STRAINS, stresses) + slope * max(strain - STRAINS[-1], 0.0))


def curve(stresses: Array, raised: float = 0.0) -> Metal:
    """*MAT_PIECEWISE_LINEAR_PLASTICITY with a curve, and a stress that rises with the rate."""

    def cards(deck: Deck) -> None:
        deck.add("DEFINE_CURVE", (900,), *zip(STRAINS, stresses, strict=True))
        rates = (2.0, 4.0) if raised > 0.0 else (0.0, 0.0)
        second = (*rates, 900, 0, 1.0)
        deck.add("MAT_PIECEWISE_LINEAR_PLASTICITY", (*FIRST, raised), second)

    return Metal(cards, lambda p, rate: static(stresses, p) + raised * (rate / 2.0) ** 0.25)


def table(logarithmic: bool) -> Metal:
    """*MAT_PIECEWISE_LINEAR_PLASTICITY with curves at two rates, or at their logarithms."""
    ends = np.log([SLOW, FAST]) if logarithmic else np.array([SLOW, FAST])

    def cards(deck: Deck) -> None:
        deck.add("DEFINE_TABLE", (900,), *[(end,) for end in ends])
        for number, stresses in ((901, STRESSES), (902, FASTER)):
            deck.add("DEFINE_CURVE", (number,), *zip(STRAINS, stresses, strict=True))
        deck.add("MAT_PIECEWISE_LINEAR_PLASTICITY", FIRST, (0.0, 0.0, 900, 0, 1.0))

    def yields(strain: float, rate: float) -> float:
        place = np.log(max(rate, 1.0e-200)) if logarithmic else rate
        share = float(np.clip((place - ends[0]) / (ends[1] - ends[0]), 0.0, 1.0))
        return (1.0 - share) * static(STRESSES, strain) + share * static(FASTER, strain)

    return Metal(cards, yields)


def johnson_cook() -> Metal:
    """*MAT_SIMPLIFIED_JOHNSON_COOK."""
    card = (210.0, 300.0, 0.4, 0.03, 1.0e17, 0.0, 0.0, 0.5)
    return Metal(
        lambda deck: deck.add("MAT_SIMPLIFIED_JOHNSON_COOK", (*FIRST, 1.0), card),
        lambda p, rate: (210.0 + 300.0 * p**0.4) * (1.0 + 0.03 * np.log(max(rate / 0.5, 1.0))),
    )


METALS = {
    "moves": kinematic(0.0),
    "grows and moves": kinematic(0.4),
    "grows and moves with the rate": kinematic(0.4, 2.0, 3.0),
    "curve": curve(STRESSES),
    "curve that falls": curve(FALLING),
    "curve with the rate": curve(STRESSES, 150.0),
    "table": table(logarithmic=False),
    "table of logarithms": table(logarithmic=True),
    "Johnson and Cook": johnson_cook(),
}


def path(seed: int) -> Array:
    """Knots of a random path of strain, some of them back or through zero, (knots, 6)."""
    random = np.random.default_rng(seed)
    knots = [np.zeros(6)]
    for _ in range(6):
        knot = 0.006 * np.exp(random.uniform(-2.0, 1.0)) * random.normal(size=6)
        knot *= random.random(6) < 0.7
        knots.append(-0.8 * knots[-1] if random.random() < 0.25 else knot)
    return np.array(knots)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("metal", list(METALS))
def test_path(metal: str, seed: int, compare: Comparison, tmp_path: Path) -> None:
    """Stress of every step to the digits of the files; at the end what has been dissipated.

    The solver takes the mean yield stress of a step, which errs where a curve bends within it.
    """
    law = METALS[metal]
    times = np.linspace(0.0, 1.001 * END, 7)
    deck = cube(law.cards, times, path(seed))
    deck.profile(1, 0.5, 0.5, 1.0e-9 * END, points=2)
    deck.intervals(glstat=1.0e-9 * END, binary_d3plot=2.0 * END)
    results = run(deck, tmp_path)
    profile, energy = results.table("profile_1"), results.table("energy")
    below = profile["z"] < 0.0
    names = [f"{kind}{two}" for kind, two in zip("eeeggg", COMPONENTS, strict=True)]
    strain = np.stack([profile[name][below] for name in names], axis=1)
    stress = np.stack([profile[f"s{two}"][below] for two in COMPONENTS], axis=1)
    point = MetalPoint(YOUNG, POISSON, law.yields, law.kinematic)
    assert len(strain) == len(energy["step"]) > 60
    expected = [np.zeros(6)]
    for now, step in zip(strain[1:], energy["step"][1:], strict=True):
        expected.append(point.step(now, step))
    assert point.path > 0.005
    compare.values("stress of random paths", stress, np.array(expected), abs=1.0e-7 * 210.0)
    spent = energy["dissipated"][-1]
    compare.number("energy of random paths", spent, point.dissipated, unit="mJ", rel=1.0e-4)
