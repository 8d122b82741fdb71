"""Keys that earlier recipes had are refused by their names; manual/removed.md lists them all."""

from __future__ import annotations

from pathlib import Path

import pytest

import plydyn_pre as pre
from plydyn_pre.typed import REMOVED, build

PAGE = Path(__file__).parents[2] / "manual" / "removed.md"


def listed() -> set[tuple[str, str]]:
    """Tables and keys of the page."""
    lines = [line for line in PAGE.read_text().splitlines() if line.startswith("| recipe")]
    options = [line.split("|")[2].replace("`", "").split() for line in lines]
    return {(kind, key) for kind, key in options}


def test_the_page_lists_every_removed_key() -> None:
    assert listed() == {(kind, key) for kind, keys in REMOVED.items() for key in keys}


@pytest.mark.parametrize(("kind", "key"), sorted(listed()))
def test_a_removed_key_is_refused_with_advice(kind: str, key: str) -> None:
    tables = {each.kind: each for each in (pre.PlyCodam2, pre.Cohesive)}
    with pytest.raises(pre.RecipeError) as caught:
        build(tables[kind], {key: 1.0}, "materials.ply")
    assert str(caught.value) == f"materials.ply.{key}: the key was removed: {REMOVED[kind][key]}"
