"""Quantities of recipes as text."""

from __future__ import annotations

import re

import pytest

from plydyn_pre import RecipeError
from plydyn_pre.quantities import with_quantities


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("171 GPa", 171000.0),
        ("30 J", 30000.0),
        ("2.5mm", 2.5),
        ("-3.2 m/s", -3200.0),
        ("1.6 g/cm3", 1.6e-9),
        ("1600 kg/m3", 1.6e-9),
        ("5.5 kg", 5.5e-3),
        ("277 J/m2", 0.277),
        ("81.5 kJ/m2", 81.5),
        ("1e6 N/mm3", 1e6),
        ("4 ms", 4e-3),
        # by definition of the inch, the pound and standard gravity
        ("1 psi", 6.894757293168361e-3),
        ("1 ft-lbf", 1355.8179483314004),
        ("1 lbf", 4.4482216152605),
    ],
)
def test_numbers_in_mm_s_and_t(text: str, number: float) -> None:
    assert with_quantities({"x": {"y": [text]}})["x"]["y"][0] == pytest.approx(number, rel=1e-12)


def test_numbers_in_the_units_of_the_recipe() -> None:
    table = {"units": {"length": "m", "time": "s", "mass": "kg"}, "E1": "171 GPa", "energy": "30 J"}
    found = with_quantities(table)
    assert found["E1"] == pytest.approx(171e9) and found["energy"] == pytest.approx(30.0)
    table["units"] = {"length": "in", "time": "s", "mass": "slinch"}
    assert with_quantities(table | {"E1": "1 psi"})["E1"] == pytest.approx(1.0, rel=1e-12)
    assert with_quantities(table | {"mass": "1 lb"})["mass"] == pytest.approx(
        1.0 / 386.0886, rel=1e-6
    )


def test_text_and_unknown_units_stay() -> None:
    table = {"title": "30 J", "layup": "0 90", "E1": "171 Gpa", "kind": "5 mm"}
    assert with_quantities(table) == table


@pytest.mark.parametrize(
    ("key", "text", "words"),
    [
        ("energy", "30 GPa", "energy: '30 GPa' is a stress, an energy is needed"),
        ("E1", "171 J", "E1: '171 J' is an energy, a stress is needed"),
        ("G1T", "81 MPa", "an energy per area is needed"),
        ("end_time", "3 mm", "end_time: '3 mm' is a length, a time is needed"),
        ("density", "1600 kg", "a density is needed"),
    ],
)
def test_a_quantity_of_another_kind_is_refused(key: str, text: str, words: str) -> None:
    with pytest.raises(RecipeError, match=re.escape(words)):
        with_quantities({key: text})
