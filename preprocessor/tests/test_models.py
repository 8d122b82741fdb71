"""Named sets of choices of damaged plies: what a recipe, the library and a set have to say."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

import plydyn_pre as pre
from plydyn_pre.models import MODELS, model_lines

RECIPE = """
title = "Model"
[materials.ply]
like = "{like}"
{more}
[laminate]
layup = "[0/90]s"
thickness = 0.25
material = "ply"
[mesh]
kind = "rectangle"
sides = [10.0, 10.0]
quads = [2, 2]
[control]
end_time = 1e-6
"""
#: What the comment of decks/damage_impact/q192_le2.toml says that it chooses
CHOSEN = {
    "shear": "exponential",
    "shear_strain": 0.05,
    "width_rule": "gauss_point",
    "snap_back": "drop",
    "weakens_across": False,
    "largest_damage": 0.99,
    "closure": False,
}
COUPONS = (
    "astm-d7136",
    "astm-d7137",
    "aitm-1-0010",
    "aitm-1-0010-compression",
    "ring",
    "indentation",
)


def ply_of(folder: Path, more: str = "", like: str = "HTS40/977-2", *sets: str) -> pre.PlyCodam2:
    """The ply of a small recipe."""
    path = folder / "job.toml"
    path.write_text(RECIPE.format(like=like, more=more), encoding="utf-8")
    return pre.load_recipe(path, sets).materials["ply"]


def values(ply: pre.PlyCodam2) -> dict[str, object]:
    """What a ply has of the choices."""
    return {key: getattr(ply, key) for key in CHOSEN}


def test_a_ply_has_the_values_of_the_set_that_it_names(tmp_path: Path) -> None:
    assert values(ply_of(tmp_path, 'model = "nagaraj2020"')) == CHOSEN
    assert values(ply_of(tmp_path, "", "HTS40/977-2", "materials.ply.model=nagaraj2020")) == CHOSEN


def test_a_ply_without_a_set_has_the_default_one(tmp_path: Path) -> None:
    plain = ply_of(tmp_path)
    assert plain == ply_of(tmp_path, 'model = "default"')
    kept = {"width_rule": "band", "snap_back": "reduce", "largest_damage": 0.999, "closure": True}
    assert values(plain) == CHOSEN | kept  # and the curve of the library


def test_a_key_of_the_recipe_wins_over_the_set(tmp_path: Path) -> None:
    ply = ply_of(tmp_path, 'model = "nagaraj2020"\nsnap_back = "refuse"\nweakens_across = true')
    assert values(ply) == CHOSEN | {"snap_back": "refuse", "weakens_across": True}


def test_a_curve_of_the_library_wins_over_the_set(tmp_path: Path) -> None:
    ply = ply_of(tmp_path, 'model = "nagaraj2020"', "T700GC/M21")
    assert values(ply) == CHOSEN | {"shear": "curve"}


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ('model = "nagaraj"', "materials.ply.model: 'nagaraj' is not a model; did you mean"),
        ('model = "x"', "materials.ply.model: 'x' is not a model; known: default, nagaraj2020"),
        ("model = 3", "materials.ply.model: 3 is not a model; known: default, nagaraj2020"),
        ('kind = "ply_elastic"\nmodel = "default"', "only plies of kind ply_codam2 have one"),
    ],
)
def test_a_set_that_is_not_known_is_refused(tmp_path: Path, more: str, words: str) -> None:
    with pytest.raises(pre.RecipeError) as error:
        ply_of(tmp_path, more)
    assert words in str(error.value)


@pytest.mark.parametrize("template", COUPONS)
def test_templates_of_tests_repeat_no_default(template: str) -> None:
    ply = tomllib.loads(pre.example_recipe(template))["materials"]["ply"]
    assert "model" not in ply
    assert not [key for key, value in ply.items() if MODELS["default"].get(key) == value]


def test_words_about_broken_points_are_those_of_the_default(decks: Path) -> None:
    kept = f"{100.0 * (1.0 - MODELS['default']['largest_damage']):.3g} %"
    manual = (decks.parent / "manual" / "materials.md").read_text(encoding="utf-8")
    texts = {template: pre.example_recipe(template) for template in COUPONS} | {"manual": manual}
    for name, text in texts.items():
        flat = " ".join(text.replace("\n#", "\n").split())
        said = re.findall(r"(?:Broken points keep|residual stiffness of) ([\d.]+ %)", flat)
        assert said == [kept], name


def test_the_decks_of_the_paper_name_its_set(decks: Path) -> None:
    ply = tomllib.loads((decks / "damage_impact" / "q192_le2.toml").read_text(encoding="utf-8"))
    assert ply["materials"]["hts40_9772"]["model"] == "nagaraj2020"
    assert MODELS["nagaraj2020"] == CHOSEN


def test_manual_and_example_show_the_sets_as_they_are(decks: Path) -> None:
    manual = (decks.parent / "manual" / "materials.md").read_text(encoding="utf-8")
    assert "\n".join(model_lines()) in manual
    assert "\n".join(f"#   {line}" for line in model_lines()) in pre.example_recipe("impact-all")
