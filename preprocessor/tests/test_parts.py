"""Parts of a recipe: quads around the impact with a laminate of their own."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from deck_cards import cards_of

import plydyn_pre as pre
from plydyn_pre.deck.names import Names

RECIPE = """
title = "Zone"
materials.ply = {like = "IM7/8552"}
materials.planes = {like = "IM7/8552 3D"}
materials.bond = {like = "IM7/8552 interface"}
laminate = {layup = "[0/90]", thickness = 0.2, material = "ply", interfaces = "bond"}
mesh = {kind = "rectangle", sides = [8.0, 8.0], quads = [8, 8]}
impactor = {radius = 5.0, mass = 1.0e-3, velocity = [0.0, 0.0, -1000.0]}
control.end_time = 1e-6
[parts.impact]
circle = [4.0, 4.0, 2.1]
[laminates.impact]
layup = "[0/90]"
thickness = 0.2
material = "planes"
interfaces = "bond"
"""


def loaded(folder: Path, text: str = RECIPE) -> pre.Study:
    """The study of a recipe."""
    path = folder / "zone.toml"
    path.write_text(text, encoding="utf-8")
    return pre.load_recipe(path)


def test_quads_in_the_circle_are_a_part_with_a_laminate_of_its_own(tmp_path: Path) -> None:
    study = loaded(tmp_path)
    mesh = pre.make_mesh(study.mesh)
    text = "\n".join(pre.deck_text(study, mesh))
    middles = mesh.nodes[mesh.quads[:, :4]].mean(axis=1)
    inside = np.hypot(*(middles - 4.0).T) <= 2.1
    assert 0 < inside.sum() < len(inside)
    parts = Names(study, mesh).mesh.parts
    assert parts["impact"].tolist() == np.flatnonzero(inside).tolist()
    assert sorted(np.concatenate(list(parts.values()))) == list(range(len(mesh.quads)))
    cards = cards_of(text)
    assert cards["MAT_PLY_FRACTURE_3D_TITLE"]
    assert cards["MAT_PLY_CODAM2_TITLE"]
    assert cards["CONTACT_IMPACTOR"][0].split()[2] == "0"  # any part is met
    assert text.count("\n*NODE\n") == 1  # nodes are shared


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("2.1]", "90.0]", "parts.impact: leaves no quad to the part"),
        ("2.1]", "0.1]", "parts.impact.circle: no quad has its middle in it"),
        ("circle = [4.0, 4.0, 2.1]", "at = [4.0, 4.0]", "quads need box, circle or ring"),
        ("laminates.impact", "laminates.other", "laminates.impact: missing; parts.impact needs it"),
        ('"[0/90]"\nthickness = 0.2', '"[0/90]"\nthickness = 0.3', "the same bottom and top faces"),
    ],
)
def test_a_part_that_cannot_be_is_refused(old: str, new: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(pre.RecipeError, match=words.replace("[", r"\[")):
        study = loaded(tmp_path, RECIPE.replace(old, new))
        list(pre.deck_text(study, pre.make_mesh(study.mesh)))
