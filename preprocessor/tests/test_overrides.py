"""Values that replace those of a recipe."""

from __future__ import annotations

import pytest

import plydyn_pre as pre
from plydyn_pre.overrides import parse_override, title_with, with_overrides


@pytest.mark.parametrize(
    ("text", "steps", "value"),
    [
        ("mesh.n=6", ["mesh", "n"], 6),
        ("supports[1].set=left", ["supports", 1, "set"], "left"),
        ("outputs.profiles[2].at[1]=0.5", ["outputs", "profiles", 2, "at", 1], 0.5),
        ('laminates."left side".order=3', ["laminates", "left side", "order"], 3),
        ("title=a=b", ["title"], "a=b"),
        ("mesh.sides=[1, 2]", ["mesh", "sides"], [1, 2]),
    ],
)
def test_overrides_are_keys_and_a_value(text: str, steps: list, value: object) -> None:
    assert parse_override(text) == (steps, value)


def test_a_value_brings_no_other_keys() -> None:
    assert with_overrides({}, ["a=1"]) == {"a": 1}
    with pytest.raises(pre.RecipeError, match="is no override"):
        parse_override("a=1\nb=2")


def test_entries_of_lists_can_be_reached() -> None:
    table = {"supports": [{"set": "a", "hold": "x"}, {"set": "b"}], "n": [1, 2]}
    changed = with_overrides(table, ["supports[2].set=c", "supports[1].hold=z", "n[2]=5"])
    assert changed == {"supports": [{"set": "a", "hold": "z"}, {"set": "c"}], "n": [1, 5]}
    assert table["n"] == [1, 2]


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("supports[3].set=c", r"supports\[3\]: there is no entry 3; the recipe has 1"),
        ("supports[0].set=c", r"supports\[0\]: there is no entry 0"),
        ("mesh[1]=c", r"mesh\[1\]: there is no entry 1; the recipe has 0"),
        (
            "supports.set=c",
            r"a list of 1 was given; name an entry, as supports\[1\]\.set",
        ),
    ],
)
def test_entries_that_there_are_not_are_told(override: str, words: str) -> None:
    with pytest.raises(pre.RecipeError, match=words):
        with_overrides({"supports": [{"set": "a"}]}, [override])


def test_the_title_tells_what_was_replaced() -> None:
    assert title_with("Drop", []) == "Drop"
    assert title_with("Drop", ["mesh.n=6", "mesh.order=1"]) == "Drop; mesh.n=6 mesh.order=1"
    assert title_with("Mine", ["mesh.n=6", "title=Mine"]) == "Mine"
    long = title_with("Drop", ["mesh.corner=[0.0, 0.125]"] * 4)
    assert long.endswith("...") and len(long) == 80
