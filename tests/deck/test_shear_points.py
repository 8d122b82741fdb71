"""Cyclic shear 12, 13 and 23 of a ply with planes of fracture, along a measured curve by points."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from decks import Deck
from elasticity import Array
from fracture_reference import IM7, NEGLECTED, POINTS, SHEAR_CURVE, FracturePly
from strained import strain_cube

END = 4.0e-3
#: Moduli and shear strengths of T700/M21; shear 23 is tension on a plane, and must not open it. A
#: heavy ply takes long steps
PLY = replace(
    IM7,
    density=1.6e-4,
    shear=(4800.0, 4500.0, 3800.0),
    matrix_strength=(200.0, 290.0),
    shear_strength=110.0,
    band=0.05,
    shear_curve=(POINTS,),
    points=SHEAR_CURVE,
)


def curve_of(ply: FracturePly, component: int) -> tuple[Array, Array]:
    """Total strain and stress of monotone loading: the permanent strain is that of 12."""
    strain, stress = np.array(ply.points).T
    permanent = strain - stress / ply.shear[0]
    if component == 2:
        stress = stress * ply.across / ply.shear_strength
    return permanent + stress / ply.shear[component], stress


def expected(path: Array, curve: tuple[Array, Array], modulus: float) -> Array:
    """Stress: elastic after a turn, and then along the curve from where it was left."""
    # yield begins where the strain that is neglected has been left
    reached = NEGLECTED / (1.0 - curve[1][1] / curve[0][1] / modulus)
    stress = [0.0]
    for before, now in pairwise(path):
        elastic = stress[-1] + modulus * (now - before)
        beyond = abs(elastic) - np.interp(reached, *curve)
        if beyond > 0.0:
            reached += beyond / modulus
            elastic = np.sign(elastic) * np.interp(reached, *curve)
        stress.append(float(elastic))
    return np.array(stress)


@pytest.mark.parametrize("component", range(3), ids=("12", "13", "23"))
def test_cyclic_shear(component: int, tmp_path: Path) -> None:
    """There, back beyond zero and there again: below the strength, so that nothing cracks."""
    curve, modulus = curve_of(PLY, component), PLY.shear[component]
    (third, fifth, sixth), (at_third, at_fifth, at_sixth) = (each[[3, 5, 6]] for each in curve)
    # to a point of the curve each time, through the elastic range of both yield stresses
    first = third
    second = first - 2.0 * at_third / modulus - (fifth - third)
    last = second + 2.0 * at_fifth / modulus + (sixth - fifth)
    rest = last - at_sixth / modulus
    knots = np.zeros((5, 6))
    knots[1:, 3 + component] = first, second, last, rest

    def material(deck: Deck) -> None:
        deck.add("MAT_PLY_FRACTURE_3D", *PLY.cards(1, deck.curve(list(PLY.points))))

    answer = strain_cube(material, np.linspace(0.0, END, 5), knots, 10**9, tmp_path)
    strain, stress = (each[:, 3 + component] for each in (answer.strain, answer.stress))
    assert len(strain) > 100
    # strains are written with ten digits, stress is up to 5000 times as large
    assert stress == pytest.approx(expected(strain, curve, modulus), abs=1.0e-6)
    # within the strain of a step of the points of the curve
    step = np.abs(np.diff(strain)).max()
    assert stress.max() == pytest.approx(at_sixth, abs=modulus * step)
    assert stress.min() == pytest.approx(-at_fifth, abs=modulus * step)
    assert answer.plastic_strain == pytest.approx(abs(rest), abs=step)
    assert abs(stress[-1]) < modulus * step
    assert np.abs(answer.energy["error"]).max() < 1.0e-9
    for mechanism in ("fibre damage", "matrix damage", "friction"):
        assert answer.energy[mechanism].max() == 0.0
