"""Laws of metals at a point: closed forms, and rate equations integrated in fine steps.

Uniaxial strain of a perfectly plastic metal: beyond the limit the stress rises with the bulk
modulus, and the plastic strain is 2/3 (strain - limit) 2 G / 2 G. In shear the yield stress is
sqrt(3) times the shear stress and the plastic strain (gamma - tau / G) / sqrt(3), whatever the
hardening and the rate.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck
from elasticity import Array
from strained import Answer, strain_cube

YOUNG, POISSON, DENSITY = 210.0e3, 0.3, 7.8e-9
SHEAR = YOUNG / (2.0 * (1.0 + POISSON))
BULK = YOUNG / (3.0 * (1.0 - 2.0 * POISSON))
# Profiles have ten significant digits at least; the solution of the law is good to 1e-12
DIGITS = 1.0e-7

STRAINS = np.array([0.0, 0.002, 0.01, 0.03])
STRESSES = np.array([210.0, 260.0, 300.0, 310.0])
FASTER = STRESSES + np.array([120.0, 100.0, 90.0, 80.0])
SLOW_RATE, FAST_RATE = 10.0, 4.0e4


def perfect(deck: Deck) -> None:
    """*MAT_024 with nothing but SIGY."""
    deck.add("MAT_PIECEWISE_LINEAR_PLASTICITY", (1, DENSITY, YOUNG, POISSON, 210.0))


def by_points(deck: Deck) -> None:
    """*MAT_024 with EPS and ES; with zeros behind the last point, as LS-DYNA writes them."""
    deck.add(
        "MAT_PIECEWISE_LINEAR_PLASTICITY",
        (1, DENSITY, YOUNG, POISSON, 0.0, 0.0, 1.0e21),
        (0.0, 0.0, 0, 0, 0.0),
        (*STRAINS, 0.0, 0.0, 0.0, 0.0),
        (*STRESSES, 0.0, 0.0, 0.0, 0.0),
    )


def by_curve(deck: Deck) -> None:
    """*MAT_024 with a curve whose ordinates are scaled."""
    deck.add("DEFINE_CURVE", (900, 0, 1.0, 10.0), *zip(STRAINS, STRESSES / 10.0, strict=True))
    first = (1, DENSITY, YOUNG, POISSON)
    deck.add("MAT_PIECEWISE_LINEAR_PLASTICITY", first, (0.0, 0.0, 900, 0, 0.0))


def by_table(deck: Deck) -> None:
    """*MAT_024 with a table of two rates whose curves follow."""
    deck.add("DEFINE_TABLE", (900,), (SLOW_RATE,), (FAST_RATE,))
    for number, stresses in ((901, STRESSES), (902, FASTER)):
        deck.add("DEFINE_CURVE", (number,), *zip(STRAINS, stresses, strict=True))
    first = (1, DENSITY, YOUNG, POISSON)
    deck.add("MAT_PIECEWISE_LINEAR_PLASTICITY", first, (0.0, 0.0, 900, 0, 1.0))


def by_logarithmic_table(deck: Deck) -> None:
    """*MAT_024 with a table of logarithms of rates, the first below 0."""
    deck.add("DEFINE_TABLE_2D", (900,), (np.log(1.0e-3), 901), (np.log(FAST_RATE), 902))
    for number, stresses in ((902, FASTER), (901, STRESSES)):
        deck.add("DEFINE_CURVE", (number,), *zip(STRAINS, stresses, strict=True))
    first = (1, DENSITY, YOUNG, POISSON)
    deck.add("MAT_PIECEWISE_LINEAR_PLASTICITY", first, (0.0, 0.0, 900, 0, 1.0))


def raised(deck: Deck) -> None:
    """*MAT_024 with a curve, and a rise after Cowper and Symonds."""
    deck.add("DEFINE_CURVE", (900,), *zip(STRAINS, STRESSES, strict=True))
    first = (1, DENSITY, YOUNG, POISSON, 150.0)
    deck.add("MAT_PIECEWISE_LINEAR_PLASTICITY", first, (40.0, 5.0, 900, 0, 1.0))


def johnson_cook(deck: Deck) -> None:
    """*MAT_SIMPLIFIED_JOHNSON_COOK."""
    card = (210.0, 300.0, 0.4, 0.03, 1.0e17, 0.0, 0.0, 0.5)
    deck.add("MAT_SIMPLIFIED_JOHNSON_COOK", (1, DENSITY, YOUNG, POISSON, 1.0), card)


def static(strain: Array) -> Array:
    """Yield stress of the points; past the last it goes on as it ended."""
    slope = (STRESSES[-1] - STRESSES[-2]) / (STRAINS[-1] - STRAINS[-2])
    beyond = np.maximum(strain - STRAINS[-1], 0.0)
    return np.interp(strain, STRAINS, STRESSES) + slope * beyond


def sheared(material: Callable[[Deck], None], times: Array, shears: Array, folder: Path) -> Answer:
    """The cube in shear along x in planes of z."""
    strains = np.zeros((len(times), 6))
    strains[:, 4] = shears
    return strain_cube(material, times, strains, 200, folder)


def plastic_path(answer: Answer) -> Array:
    """Plastic shear strain over time, as effective strain with a sign."""
    return (answer.strain[:, 4] - answer.stress[:, 4] / SHEAR) / np.sqrt(3.0)


def test_uniaxial_strain(compare: Comparison, tmp_path: Path) -> None:
    """1890.000 and 1680.000 MPa at a strain of 0.01, plastic strain 5.8e-3."""
    strains = np.zeros((2, 6))
    strains[1, 0] = 0.01
    answer = strain_cube(perfect, np.array([0.0, 2.0e-5]), strains, 20, tmp_path)
    axial = BULK * 0.01 + 2.0 / 3.0 * 210.0
    found = answer.stress[-1, 0]
    compare.number("axial stress of uniaxial strain", found, axial, unit="MPa", rel=DIGITS)
    assert axial == pytest.approx(1890.0)
    assert answer.stress[-1, 1:3] == pytest.approx(axial - 210.0, rel=DIGITS)
    assert answer.plastic_strain == pytest.approx(5.8e-3, rel=1e-6)
    assert answer.energy["dissipated"][-1] == pytest.approx(210.0 * 5.8e-3, rel=1e-6)


@pytest.mark.parametrize("material", [by_points, by_curve])
def test_shear_there_and_back(
    material: Callable[[Deck], None], compare: Comparison, tmp_path: Path
) -> None:
    """Loaded, unloaded and loaded the other way, the stress is that of all plastic strain."""
    times = np.array([0.0, 1.0e-5, 3.0e-5])
    answer = sheared(material, times, np.array([0.0, 0.04, -0.05]), tmp_path)
    flow = plastic_path(answer)
    path = np.cumsum(np.abs(np.diff(flow, prepend=0.0)))
    yields = np.abs(np.diff(flow, prepend=0.0)) > 1.0e-6
    assert yields.sum() > 150
    stress = np.sqrt(3.0) * np.abs(answer.stress[yields, 4])
    # the turn lies between two outputs, where the path is not the sum of both ends
    compare.values("shear there and back", stress, static(path[yields]), unit="MPa", rel=1.0e-3)
    order = np.argsort(path)
    compare.curves(
        f"yield stress, {material.__name__.replace('_', ' ')}",
        ("plastic strain [-]", "effective stress [MPa]"),
        {"run, there and back": (path[yields], stress)},
        {"curve of the card": (path[order], static(path[order]))},
    )
    there = answer.time[yields] < times[1]
    assert stress[there] == pytest.approx(static(path[yields][there]), rel=DIGITS)
    assert answer.plastic_strain == pytest.approx(path[-1], rel=2.0e-3)
    assert np.ptp(answer.stress[:, [0, 1, 2, 3, 5]]) < 1.0e-6


def rates(answer: Answer) -> tuple[Array, Array, Array]:
    """Plastic strain, its rate and the yield stress where both rates of shear are steady."""
    flow = plastic_path(answer)
    rate = np.gradient(flow, answer.time)
    turn = answer.time[-1] / 2.0
    step = answer.time[1] - answer.time[0]
    steady = (flow > 0.001) & (np.abs(answer.time - turn) > 4.0 * step)
    steady[[0, -1]] = False
    return flow[steady], rate[steady], np.sqrt(3.0) * answer.stress[steady, 4]


def table_yield(strain: Array, rate: Array) -> Array:
    """Straight between the curves of both rates."""
    share = np.clip((rate - SLOW_RATE) / (FAST_RATE - SLOW_RATE), 0.0, 1.0)
    return (1.0 - share) * static(strain) + share * np.interp(strain, STRAINS, FASTER)


def logarithmic_yield(strain: Array, rate: Array) -> Array:
    """Straight between the curves over the logarithm of the rate."""
    share = np.clip(np.log(rate / 1.0e-3) / np.log(FAST_RATE / 1.0e-3), 0.0, 1.0)
    return (1.0 - share) * static(strain) + share * np.interp(strain, STRAINS, FASTER)


def raised_yield(strain: Array, rate: Array) -> Array:
    """The curve and the rise of SIGY."""
    return static(strain) + 150.0 * (rate / 40.0) ** 0.2


def johnson_cook_yield(strain: Array, rate: Array) -> Array:
    """As printed."""
    return (210.0 + 300.0 * strain**0.4) * (1.0 + 0.03 * np.log(rate / 0.5))


@pytest.mark.parametrize(
    ("material", "expected"),
    [
        (by_table, table_yield),
        (by_logarithmic_table, logarithmic_yield),
        (raised, raised_yield),
        (johnson_cook, johnson_cook_yield),
    ],
)
def test_rates(
    material: Callable[[Deck], None],
    expected: Callable[[Array, Array], Array],
    compare: Comparison,
    tmp_path: Path,
) -> None:
    """Shear at one rate and then at four times this rate."""
    times = np.array([0.0, 1.0e-5, 2.0e-5])
    answer = sheared(material, times, np.array([0.0, 0.01, 0.05]), tmp_path)
    strain, rate, stress = rates(answer)
    assert rate.min() < 1.1e3 / np.sqrt(3.0) < 3.9e3 / np.sqrt(3.0) < rate.max()
    # differences over an output blur the rate behind the turn and where the curves bend
    name = f"yield stress with rate, {material.__name__.replace('_', ' ')}"
    compare.values(name, stress, expected(strain, rate), unit="MPa", rel=3.0e-3)
    assert np.median(np.abs(stress / expected(strain, rate) - 1.0)) < 1.0e-5


def follow(times: Array, strains: Array, substeps: int) -> tuple[Array, float]:
    """Stress at the end of a path and plastic strain: forward steps of the rate equations."""
    weights = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])
    stress, flow = np.zeros(6), 0.0
    for before, after in pairwise(strains):
        step = (after - before) / substeps
        step = np.concatenate([step[:3], 0.5 * step[3:]])
        volume = step[:3].sum()
        mean = np.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]) / 3.0
        for _ in range(substeps):
            deviator = stress - mean * stress[:3].sum()
            effective = np.sqrt(1.5 * (weights * deviator**2).sum())
            grown = 0.0
            if effective >= static(flow) * (1.0 - 1.0e-9):
                normal = 1.5 * deviator / effective
                slope = (static(flow + 1.0e-7) - static(flow)) / 1.0e-7
                ahead = 2.0 * SHEAR * (weights * normal * step).sum() + effective - static(flow)
                grown = max(ahead, 0.0) / (3.0 * SHEAR + slope)
            stress = stress + 2.0 * SHEAR * (step - mean * volume) + 3.0 * BULK * mean * volume
            if grown > 0.0:
                stress = stress - 2.0 * SHEAR * grown * normal
            flow += grown
    return stress, flow


def test_turning_strain(compare: Comparison, tmp_path: Path) -> None:
    """Tension, then a circle of tension and two shears: the normal of the surface turns."""
    turns = np.linspace(0.0, 1.5 * np.pi, 61)
    strains = np.zeros((len(turns) + 1, 6))
    strains[1:, 0] = 0.004 * np.cos(turns)
    strains[1:, 1] = -0.002 * np.cos(turns)
    strains[1:, 3] = 0.006 * np.sin(turns)
    strains[1:, 5] = 0.004 * np.sin(turns) * (turns / turns[-1])
    times = np.linspace(0.0, 2.0e-4, len(strains))
    answer = strain_cube(by_curve, times, strains, 10, tmp_path)
    stress, flow = follow(times, strains, 400)
    # backward steps, 30 between two points of the path: an error of first order in the turn
    close = 2.0e-3 * np.abs(stress).max()
    compare.values("stress of a turning strain", answer.stress[-1], stress, unit="MPa", abs=close)
    assert answer.plastic_strain == pytest.approx(flow, rel=2.0e-3)
