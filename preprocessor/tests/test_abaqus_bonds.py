"""Bonds between plies of an input file of Abaqus."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import pytest
from abaqus_decks import BY_SEPARATION, COHESIVE, stacked
from models_of_others import numbers, refused_model, translated_model

NAME = "user.inp"
translated, refused = partial(translated_model, NAME), partial(refused_model, NAME)


@pytest.mark.parametrize("joint", ["elements", "contact", "general"])
def test_bonds_in_every_form(joint: str, tmp_path: Path) -> None:
    cards, _ = translated(tmp_path, stacked(joint))
    assert numbers(cards["INTERFACE_COHESIVE"])[0][:4] == [1.0, 1.0, 1.0, 2.0]
    first, second = numbers(cards["MAT_COHESIVE_MIXED_MODE_TITLE"])[:2]
    assert first[4:] == [1e5, 4e4, 0.3, 0.8]
    assert second[:3] == [-1.5, 60.0, 90.0]


@pytest.mark.parametrize("joint", ["elements", "contact"])
def test_a_separation_at_failure_counts_from_that_at_onset(joint: str, tmp_path: Path) -> None:
    """The energy is that of a triangle: half of the strength times onset and separation."""
    text = stacked(joint).replace("\n".join(COHESIVE[4:]), BY_SEPARATION)
    first, _ = numbers(translated(tmp_path, text)[0]["MAT_COHESIVE_MIXED_MODE_TITLE"])[:2]
    onset = 60.0 / 1e5, 90.0 / 4e4
    energy = 0.5 * 60.0 * (onset[0] + 0.01), 0.5 * 90.0 * (onset[1] + 0.01)
    assert first[4:] == pytest.approx([1e5, 4e4, *energy])


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("DISPLACEMENT", "DISPLACEMENT, softening=EXPONENTIAL", "SOFTENING: EXPONENTIAL is not"),
        ("DISPLACEMENT", "DISPLACEMENT, mixed mode behavior=TABULAR", "BEHAVIOR: TABULAR is not"),
        ("Behavior\n1e5, 4e4, 4e4", "Behavior", "a separation that counts from the onset needs"),
        ("1e5, 4e4, 4e4", "1e5, 4e4, 4e4, 1e3", "couples opening and sliding"),
        ("1e5, 4e4, 4e4", "1e5, 4e4, 5e4", "Ktt that differs from Kss"),
    ],
)
def test_other_forms_of_a_separation_at_failure_are_refused(
    old: str, new: str, words: str, tmp_path: Path
) -> None:
    text = stacked("contact").replace("\n".join(COHESIVE[4:]), BY_SEPARATION)
    assert old in text
    refused(tmp_path, text.replace(old, new), words)


def test_a_bond_of_elements_that_are_stacked_aside_is_refused(tmp_path: Path) -> None:
    text = stacked("elements").replace("elset=Bond, material", "elset=Bond, {}material")
    words = "*COHESIVE SECTION STACK DIRECTION: 1 is not translated"
    refused(tmp_path, text.format("stack direction=1, "), words)
    translated(tmp_path, text.format("stack direction=3, "))


def test_a_tie_joins_without_an_interface(tmp_path: Path) -> None:
    cards, _ = translated(tmp_path, stacked("tie"))
    assert "INTERFACE_COHESIVE" not in cards
    assert [row[2] for row in numbers(cards["PART_COMPOSITE_LONG"])[1:]] == [0.0, 90.0]
