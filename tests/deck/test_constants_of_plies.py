"""Constants that can be, but that no ply has, are told with the line of the card."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from broken import said
from damage import HTS40, DamagedPly
from decks import Deck, Ply
from elasticity import CARBON, Material
from meshes import regular
from plydyn_pre.study import plausible
from runs import ROOT

#: G12 of the ply
SHEAR = HTS40.shear[0]


def told(material: Material, folder: Path, curve: list[tuple[float, float]] | None = None) -> str:
    """Warnings of `plydyn check` on a ply, each on its own line, and its exit code in front."""
    deck = Deck("one ply", 1.0e-6)
    deck.mesh(regular(1.0, 1.0, 1, 1, 9))
    if curve:
        number = deck.curve(curve)
        material = replace(material, curve=(2, number))
    deck.laminate([Ply(material, 0.2)], 1)
    code, text = said("check", deck.write(folder / "job.k"))
    lines = text.splitlines()
    keyword = next(
        number
        for number, line in enumerate((folder / "job.k").read_text().splitlines(), start=1)
        if line.startswith("*MAT_PLY")
    )
    place = f"job.k:{keyword + 1}: "
    found = [line.split(place)[1] for line in lines if place in line]
    return "; ".join([str(code), *found])


def strong(**constants: object) -> DamagedPly:
    """The ply with some other constants."""
    return replace(HTS40, **constants)


@pytest.mark.parametrize("material", [HTS40, CARBON], ids=["damaged", "elastic"])
def test_a_usual_ply_is_not_blamed(material: Material, tmp_path: Path) -> None:
    assert told(material, tmp_path) == "0"


@pytest.mark.parametrize(
    ("material", "words"),
    [
        (strong(poisson=(0.51, 0.3, 0.4)), "nu12 = 0.51, the strain across from stress along"),
        (strong(poisson=(0.3, 0.51, 0.4)), "nu13 = 0.51, the strain across from stress along"),
        # the minor ratio, 0.02, in the place of the major one: 0.02 10.3/153
        (strong(poisson=(0.02, 0.3, 0.4)), "nu12 = 0.02 gives nu21 = 0.00135"),
        # 153000/76 = 2013.2 and 153000/7700 = 19.87
        (strong(fibre_strength=(76.0, 1580.0)), "XT = 76 is E1/2013"),
        (strong(fibre_strength=(7700.0, 1580.0)), "XT = 7700 is E1/19.9"),
        (strong(fibre_strength=(2537.0, 76.0)), "XC = 76 is E1/2013"),
        (strong(matrix_strength=(5.1, 236.0)), "YT = 5.1 is E2/2020"),
        (strong(matrix_strength=(82.0, 520.0)), "YC = 520 is E2/19.8"),
        (strong(shear_strength=2.9), "S = 2.9 is G12/2069"),
    ],
)
def test_other_constants_are_told(material: DamagedPly, words: str, tmp_path: Path) -> None:
    found = told(material, tmp_path)
    assert found.startswith(f"0; {words}"), found
    assert found.count(";") == 1


@pytest.mark.parametrize(
    ("share", "expected"),
    [
        (0.71, "0"),
        (0.69, f"0; the curve of shear begins with 0.69 of G12 = {SHEAR:g}"),
        # strain in %
        (0.01, f"2; the curve of shear begins with 0.01 of G12 = {SHEAR:g}"),
    ],
)
def test_a_curve_of_another_modulus_is_told(share: float, expected: str, tmp_path: Path) -> None:
    """Below 0.05 strain and stress are in other units, which is an error."""
    slope = share * SHEAR
    points = [(0.0, 0.0), (30.0 / slope, 30.0), (120.0 / slope, 90.0)]
    assert told(HTS40, tmp_path, points) == expected


def numbers(name: str) -> list[float]:
    """A parameter of the solver's check."""
    text = (ROOT / "src" / "input" / "check_plies.f90").read_text()
    found = re.search(rf"\b{name}(?:\(2\))? = (\[[^]]*\]|[\d.]+_wp)", text)
    assert found is not None
    return [float(number) for number in re.findall(r"[\d.]+(?=_wp)", found[1])]


def test_recipes_have_the_same_bounds() -> None:
    """Those of `plydyn-pre`, whose rules are in terms of strength over modulus."""
    assert numbers("largest_major") == [plausible.LARGEST_MAJOR]
    assert tuple(numbers("minor_range")) == plausible._MINOR
    ratios = 1.0 / plausible._STRONGEST, 1.0 / plausible._WEAKEST
    assert tuple(numbers("strength_range")) == pytest.approx(ratios)
    assert tuple(numbers("usual_slope")) == plausible._USUAL_SLOPE
    assert tuple(numbers("wrong_slope")) == plausible._WRONG_SLOPE
