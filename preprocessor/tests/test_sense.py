"""Recipes in which bodies are in each other's place, or hold, load or move nothing."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from programs import plydyn_pre

import plydyn_pre as pre
from plydyn_pre.library import library
from plydyn_pre.mesh import make_mesh
from plydyn_pre.recipe import templates
from plydyn_pre.study import doubts

#: The middle of the window of the coupon is (0, 0); the shortest quads 3.7 wide, the plate 150
BASE = 'base = "coupon.toml"\ncracks = false\n[mesh]\ncore = 45.0\nquad = 5.0\norder = 2\n'
CURVES = """
[curves.up]
time = [0.0, 1.0]
value = [0.0, 1.0]
[curves.down]
time = [0.0, 1.0]
value = [0.0, -1.0]
[curves.still]
time = [0.0, 1.0]
value = [0.0, 0.0]
"""
PUNCH = '[[fixtures]]\nkind = "punch"\nface = "{face}"\nsize = 6.0\ncentre = {at}\n{more}\n'
STAGE = '[[stages]]\nname = "next"\nend_time = 1.0e-3\n'
HELD = 'supports = [{ set = "ends", hold = "xyz" }]\n'
SETS = "[sets]\nends.box = [-75.0, -75.0, -50.0, 50.0]\nother.box = [75.0, 75.0, -50.0, 50.0]\n"


def looked_at(folder: Path, recipe: str, template: str = "astm-d7136") -> list[str]:
    """What is noted of a recipe on top of a template."""
    (folder / "coupon.toml").write_text(pre.example_recipe(template))
    (folder / "mine.toml").write_text(recipe)
    study = pre.load_recipe(folder / "mine.toml")
    return doubts(study, make_mesh(study.mesh))


def punch(at: list[float], face: str = "top", more: str = "") -> str:
    """A fixture; it replaces the base and the clamps of the template."""
    return PUNCH.format(at=at, face=face, more=more)


def clamp(at: list[float]) -> str:
    """A tip on the top face."""
    tip = 'kind = "clamp"\nface = "top"\nforce = 100.0\nouter = 6.0'
    return f"[[fixtures]]\n{tip}\ncentre = {at}\n"


def base(size: float, at: list[float]) -> str:
    """A base with a round window."""
    return f'[[fixtures]]\nkind = "plane"\nface = "bottom"\nwindow = {size}\ncentre = {at}\n'


def pull(value: float) -> str:
    """A stage that moves one end of a coupon without bodies."""
    motion = 'kind = "motion", set = "other", direction = "x", quantity = "velocity"'
    load = f"loads = [{{ {motion}, value = {value} }}]"
    return SETS + STAGE + 'remove = ["impactor", "fixtures"]\n' + HELD + load


#: Speed of a wave along the fibres of IM7/8552 190 gsm of the template, the fastest there can be
PLY = library()["IM7/8552 190 gsm"].values
WAVE = (float(PLY["E1"].value) / float(PLY["density"].value)) ** 0.5

REFUSED = [
    (punch([0.0, 0.0]), "impactor.position: the centre is over fixtures[1], which is on the same"),
    (punch([20.0, 0.0]) * 2, "fixtures[2]: is in the place of fixtures[1]; leave one out"),
    (base(90.0, [0.0, 0.0]) * 2, "fixtures[2]: is in the place of fixtures[1]; leave one out"),
    (STAGE + "at_rest = 1.0", "stages[1].at_rest: every motion has this share of the largest"),
    # the clamps of the template press on the face that the impactor should meet
    (
        '[impactor]\nmotion_z = "up"\n' + CURVES,
        "impactor.motion_z: 'up' leads away from the plate; n",
    ),
    (
        '[impactor]\nmotion_z = "still"\n' + CURVES,
        "impactor: it is at rest; nothing moves the plate",
    ),
    # the coupon ends at x = 75 and y = 50; the rod stands, and the hemisphere ends 7 mm beside it
    ("[impactor]\nposition = [90.0, 0.0]", "impactor.position: 15 mm beside the plate, which the"),
    ("[impactor]\nposition = [105.0, 90.0]", "impactor.position: 50 mm beside the plate, which"),
]
NOTED = [
    (clamp([50.0, 44.0]) * 2, "fixtures[2]: is in the place of fixtures[1], and adds its force"),
    (clamp([50.0, 44.0]), "fixtures[1]: the clamp presses the plate and nothing on the other"),
    (
        base(90.0, [0.0, 0.0]) + clamp([30.0, 20.0]),
        "fixtures[2]: the clamp presses the plate where no fixture of the other face",
    ),
    (base(15.0, [0.0, 0.0]), "fixtures[1]: its window begins 7.5 mm beside the axis of impactor,"),
    (base(50.0, [120.0, 0.0]), "fixtures[1]: its window is open under no node of the plate"),
    (punch([30.0, 0.0], more='move_z = "up"') + CURVES, "fixtures[1].move_z: 'up' leads away"),
    (punch([0.0, 0.0], "bottom", 'move_z = "down"') + CURVES, "fixtures[1].move_z: 'down' leads"),
    (
        punch([9.0, 0.0]),
        "impactor.position: fixtures[1] on the same face begins 6 mm beside the axis, inside of",
    ),
    (
        "[curves.clamping]\ntime=[0.0,1.0]\nvalue=[1.0,-1.0]",
        "fixtures[2].curve: 'clamping' is below",
    ),
    ("[contact]\nfriction = 50.0", "contact.friction: 50; materials have 0.1 to 1"),
    ("[materials.bond]\nfriction = 2.5", "materials.bond.friction: 2.5; materials have 0.1 to 1"),
    (
        "[materials.bond]\nscatter = 12.0\nscatter_length = 1.0e-6",
        "materials.bond.scatter_length: 1e-06 is below the sides of all quads, 3",
    ),
    (
        "[materials.bond]\nscatter = 12.0\nscatter_length = 151.0",
        "materials.bond.scatter_length: 151 is above the sides of the plate, 150; all",
    ),
    (STAGE + "at_rest = 0.2\nremove = ['impactor']", "stages[1].at_rest: a plate with 0.2 of its"),
    (STAGE + "at_rest = 1.0e-4", "stages[1].at_rest: impactor is not damped; a plate that it"),
    (SETS + STAGE + HELD, "stages[1].remove: the plate is held anew, and none of fixtures[1], "),
    # 100 m/s
    (pull(-1.0e5), "stages[1].loads[1].value: at 1e+05 mm/s the front of the wave alone strains"),
]
SOUND = [
    clamp([50.0, 44.0]) + base(80.0, [0.0, 0.0]),
    base(16.1, [0.0, 0.0]),
    punch([0.0, 0.0], "bottom", 'move_z = "up"') + CURVES,
    '[impactor]\nmotion_z = "down"\n' + CURVES,
    "[materials.bond]\nscatter = 12.0\nscatter_length = 3.8",
    "[materials.bond]\nscatter = 12.0\nscatter_length = 150.0",
    STAGE + "at_rest = 0.1\nremove = ['impactor']",
    SETS + STAGE + HELD + "remove = ['impactor']",
    pull(-0.99e-3 * WAVE),
]


@pytest.mark.parametrize(("recipe", "told"), REFUSED)
def test_bodies_in_one_place_are_refused(recipe: str, told: str, tmp_path: Path) -> None:
    with pytest.raises(pre.RecipeError) as caught:
        looked_at(tmp_path, BASE + recipe)
    assert told in str(caught.value)


@pytest.mark.parametrize(("recipe", "told"), NOTED)
def test_what_does_nothing_is_noted(recipe: str, told: str, tmp_path: Path) -> None:
    assert [note for note in looked_at(tmp_path, BASE + recipe) if note.startswith(told)]


@pytest.mark.parametrize("recipe", SOUND)
def test_sound_recipes_are_not_blamed(recipe: str, tmp_path: Path) -> None:
    assert looked_at(tmp_path, BASE + recipe) == []


#: An impactor on a plate whose edges are held, where it may come, and what is said of it elsewhere
COMES = {
    "velocity = [0.0, 0.0, -1.0e3]": "",
    "velocity = [0.0, 0.0, 1.0e3]\ngravity = -9810.0": "",
    "velocity = [1.0e3, 0.0, -1.0e3]": "",
    "velocity = [0.0, 0.0, 0.0]\ngravity = -9810.0": "",
    "velocity = [0.0, 0.0, 0.0]": "impactor: it is at rest",
    "velocity = [0.0, 0.0, 1.0e3]": "impactor.velocity: it leads away from the plate",
    "velocity = [1.0e3, 0.0, 0.0]": "impactor.velocity: it leads along the plate alone",
    "position = [-30.0, 50.0]": "impactor.position: 30 mm beside the plate",
}
WEIGHT = '[[loads]]\nkind = "frame_acceleration"\ndirection = "z"\nvalue = {}\n'


@pytest.mark.parametrize("impactor", COMES)
def test_an_impactor_that_never_comes_is_refused(impactor: str, tmp_path: Path) -> None:
    """Unless something else moves the plate, which a load of zero does not."""
    recipe, words = f'base = "coupon.toml"\n[impactor]\n{impactor}\n', COMES[impactor]
    if not words:
        assert looked_at(tmp_path, recipe, "impact") == []
        return
    for load in ("", WEIGHT.format(0.0)):
        with pytest.raises(pre.RecipeError) as caught:
            looked_at(tmp_path, recipe + load, "impact")
        assert words in str(caught.value) and "nothing can happen" in str(caught.value)
    notes = looked_at(tmp_path, recipe + WEIGHT.format(9810.0), "impact")
    assert [note for note in notes if note.startswith(words)] or "at rest" in words


@pytest.mark.parametrize(("load", "is_noted"), [(None, True), (0.0, True), (9810.0, False)])
def test_a_plate_that_nothing_acts_on_is_noted(
    load: float | None, is_noted: bool, tmp_path: Path
) -> None:
    """A load moves it, which one of zero does not."""
    recipe = re.sub(r"\[impactor\].*?(?=\n\[)", "", pre.example_recipe("impact"), flags=re.DOTALL)
    recipe = re.sub(r"(?m)^impactor_interval.*", "", recipe)
    path = tmp_path / "plate.toml"
    path.write_text(recipe + (WEIGHT.format(load) if load is not None else ""))
    study = pre.load_recipe(path)
    words = "impactor: there is none, and no load and no fixture moves the plate"
    assert doubts(study, make_mesh(study.mesh)) == ([words] if is_noted else [])


def test_the_command_says_so_with_the_recipe(tmp_path: Path) -> None:
    (tmp_path / "coupon.toml").write_text(pre.example_recipe("astm-d7136"))
    for recipe, code, told in (
        (punch([0.0, 0.0]), 2, "error: mine.toml: impactor.position: the centre is over"),
        ("[contact]\nfriction = 50.0", 0, "note: mine.toml: contact.friction: 50; materials have"),
    ):
        (tmp_path / "mine.toml").write_text(BASE + recipe)
        done = plydyn_pre(tmp_path, "deck", "mine.toml")
        assert done.returncode == code
        assert told in done.stderr


@pytest.mark.parametrize("template", templates())
def test_templates_have_sense(template: str, tmp_path: Path) -> None:
    assert looked_at(tmp_path, pre.example_recipe(template)) == []
