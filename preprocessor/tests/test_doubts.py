"""Numbers that look like those of another unit are noted, with what they mean as they stand."""

from __future__ import annotations

from pathlib import Path

import pytest
from programs import plydyn_pre

import plydyn_pre as pre

MINE = """
base = "coupon.toml"
cracks = false
[materials.mine]
like = "IM7/8552"
YT = 60.0
[laminate]
layup = "[45/-45/0/90]2s"
material = "mine"
thickness = 0.14
join_alike = false
[mesh]
quad = 5.0
[impactor]
mass = 2.0e-3
energy = 12.0e3
"""


def notes(folder: Path, *overrides: str, recipe: str = MINE) -> list[str]:
    """What is noted of a coupon on top of a template."""
    (folder / "coupon.toml").write_text(pre.example_recipe("astm-d7136"))
    (folder / "mine.toml").write_text(recipe)
    words = [word for override in overrides for word in ("--set", override)]
    done = plydyn_pre(folder, "deck", "mine.toml", *words)
    assert done.returncode == 0, done.stderr
    told = [line.removeprefix("note: mine.toml: ") for line in done.stderr.splitlines()]
    # with a mass or a thickness of another unit the contact lasts longer than the run, too
    return [line for line in told if "the impactor will touch the plate" not in line]


@pytest.mark.parametrize(
    ("override", "told"),
    [
        # 12 mJ of 2 kg fall from 12e-3/(2 x 9.80665) m
        ("impactor.energy=12", "impactor.energy: a fall from a height of 0.6118 mm"),
        # 12 J of 2 t
        ("impactor.mass=2.0", "impactor.energy: a fall from a height of 0.6118 mm"),
        # 3.4641 m/s for 3.5 s
        ("control.end_time=3.5", "control.end_time: the impactor could travel 1.212e+04 mm"),
        ("laminate.thickness=2.24", "laminate.thickness: 16 plies are 35.84 mm thick on a plate"),
        ("laminate.thickness=0.14e-3", "laminate.thickness: a ply is 0.00014 mm thick; is it"),
        # 3.4641 m/s for 10 ms
        ("impactor.gap=50.0", "control.end_time: the impactor travels 34.64 mm until then, less"),
    ],
)
def test_other_units_are_noted(override: str, told: str, tmp_path: Path) -> None:
    found = notes(tmp_path, override)
    assert len(found) == 1
    assert found[0].startswith(told)


@pytest.mark.parametrize(
    ("override", "told"),
    [
        ("stages[1].impactor.energy=20", "stages[1].impactor.energy: a fall from a height of"),
        ("stages[1].impactor.position=[125.0, 0.0]", "stages[1].impactor.position: 50 mm beside"),
        # 2.697 m/s for 5 s
        ("stages[1].end_time=5.0", "stages[1].end_time: the impactor could travel 1.348e+04 mm"),
    ],
)
def test_impactors_of_stages_are_looked_at(override: str, told: str, tmp_path: Path) -> None:
    (tmp_path / "preload.toml").write_text(pre.example_recipe("preload-impact"))
    recipe = 'base = "preload.toml"\n[mesh]\nquad = 5.0\n'
    assert notes(tmp_path, recipe=recipe) == []
    (found,) = notes(tmp_path, override, recipe=recipe)
    assert found.startswith(told)


def test_metres_per_second_are_noted(tmp_path: Path) -> None:
    slow = MINE.replace("energy = 12.0e3", "velocity = [0.0, 0.0, -3.0]")
    slow = slow.replace("[impactor]", '[impactor]\nkind = "sphere"\nradius = 8.0')
    (found,) = notes(tmp_path, recipe=slow)
    assert found.startswith("impactor.velocity: 3; is it in mm/s?")


def test_si_units_are_their_own_measure(tmp_path: Path) -> None:
    """The same fall in m, s and kg: 2 kg and 12 J."""
    text = MINE.replace('base = "coupon.toml"', 'title = "mine"').replace("quad = 5.0", "")
    text = text.replace("0.14", "0.14e-3").replace("2.0e-3", "2.0").replace("12.0e3", "12.0")
    text = text.replace("YT = 60.0", "YT = 60.0e6")
    text += "radius = 8.0e-3\n[units]\nlength = 'm'\nmass = 'kg'\n[control]\nend_time = 3.5e-3\n"
    shape = "[mesh]\nkind = 'rectangle'\nsides = [0.15, 0.1]\nquads = [6, 4]\n"
    text = text.replace("[mesh]\n", shape)
    assert notes(tmp_path, recipe=text) == []
    assert len(notes(tmp_path, "impactor.energy=12.0e-3", recipe=text)) == 1


def test_what_a_base_alone_has_is_not_noted(tmp_path: Path) -> None:
    """Its materials that a recipe on top replaces; those of the recipe itself are."""
    assert notes(tmp_path) == []
    assert notes(tmp_path, "sets.gauge.at=[0.0,0.0]") == ["sets.gauge is never used"]
    more = MINE + '[materials.other]\nlike = "IM7/8552"\n'
    assert notes(tmp_path, recipe=more) == ["materials.other is never used"]


def test_a_key_of_a_base_of_another_kind_is_told(tmp_path: Path) -> None:
    (tmp_path / "coupon.toml").write_text(pre.example_recipe("astm-d7136"))
    path = tmp_path / "mine.toml"
    path.write_text(MINE + 'kind = "cylinder"\n')
    with pytest.raises(pre.RecipeError) as caught:
        pre.load_recipe(path)
    assert str(caught.value).endswith(
        "impactor.radius: missing; a number is needed; that of the base is not taken, for its"
        " table is of kind 'tup'"
    )


@pytest.mark.parametrize(
    ("kind", "told"),
    [
        (
            "sphere",
            "impactor.radius, mass: missing; a number is needed for each; impactor.kind=sphere",
        ),
        ("cube", "impactor.kind: 'cube' was given, one of"),
    ],
)
def test_a_kind_on_the_command_line_is_explained(kind: str, told: str, tmp_path: Path) -> None:
    path = tmp_path / "coupon.toml"
    path.write_text(pre.example_recipe("astm-d7136"))
    with pytest.raises(pre.RecipeError) as caught:
        pre.load_recipe(path, [f"impactor.kind={kind}"])
    assert str(caught.value).removeprefix(f"{path}: ").startswith(told)


def test_a_line_that_is_not_toml_is_shown(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text("title = 'x'\n[laminate]\nthickness = 0.14mm\n")
    with pytest.raises(pre.RecipeError) as caught:
        pre.load_recipe(path)
    lines = str(caught.value).splitlines()
    assert "at line 3, column 17" in lines[0]
    assert lines[1:] == ["  thickness = 0.14mm", " " * 18 + "^"]


def test_only_interfaces_in_use_are_told_to_be_fitted(tmp_path: Path) -> None:
    """The bond of the template gives way to one of the recipe."""
    (tmp_path / "coupon.toml").write_text(pre.example_recipe("astm-d7136"))
    (tmp_path / "mine.toml").write_text(
        MINE.replace("thickness", 'interfaces = "glue"\nthickness')
        + '[materials.glue]\nlike = "IM7/8552 interface"\nfit = "core"\n'
    )
    study = pre.load_recipe(tmp_path / "mine.toml")
    assert [name for name, _ in pre.study.fitted_joints(study)] == ["glue"]


@pytest.mark.parametrize(
    ("layup", "is_noted"),
    [
        ("[45/0/-45/90]s", False),
        ("[45/0/-45/90]2s", False),
        ("[0/90/0]", False),
        ("[45/0/-45/90]", True),
        ("[0/90]2", True),
    ],
)
def test_laminate_without_symmetry_is_noted(layup: str, is_noted: bool, tmp_path: Path) -> None:
    found = [each for each in notes(tmp_path, f'laminate.layup="{layup}"') if "symmetric" in each]
    assert bool(found) == is_noted
    assert all(f"laminate.layup: '{layup}' is not symmetric" in each for each in found)


def test_half_of_a_laminate_needs_no_symmetry(tmp_path: Path) -> None:
    """Held along z all over, as the middle plane of a whole one is."""
    layup, held = "laminate.layup='[0/90]2'", 'supports=[{set="all",hold="z",face="bottom"}]'
    assert [each for each in notes(tmp_path, layup) if "symmetric" in each]
    assert not [each for each in notes(tmp_path, layup, held) if "symmetric" in each]
