"""Recipes: what they become, and what is said of wrong ones."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

import plydyn_pre as pre
from plydyn_pre.overrides import parse_override
from plydyn_pre.tables import merged

SMALL = """
title = "Small"
[materials.metal]
kind = "elastic"
density = 2.7e-9
E = 70000
nu = 0.33
[laminate]
layup = "[0/90]s"
material = "metal"
thickness = 1
[mesh]
kind = "rectangle"
sides = [10, 20]
quads = [2, 4]
[control]
end_time = 1e-3
"""


def recipe(folder: Path, text: str, name: str = "small.toml") -> Path:
    """A file with a recipe."""
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_tables_become_the_dataclasses_of_the_same_names(tmp_path: Path) -> None:
    study = pre.load_recipe(recipe(tmp_path, SMALL))
    assert study == pre.Study(
        title="Small",
        materials={"metal": pre.Elastic(density=2.7e-9, E=70000.0, nu=0.33)},
        laminate=pre.Laminate(layup="[0/90]s", material="metal", thickness=1.0),
        mesh=pre.Rectangle(sides=(10.0, 20.0), quads=(2, 4)),
        control=pre.Control(end_time=1e-3),
    )


METAL = """
kind = "plastic_kinematic"
density = 7.8e-9
young = 210000
poisson = 0.3
yield = 210
"""


def test_a_metal_is_perfectly_plastic_unless_it_says_more(tmp_path: Path) -> None:
    head, rest = SMALL.split('kind = "elastic"')
    text = head + METAL.strip() + rest[rest.index("\n[laminate]") :]
    study = pre.load_recipe(recipe(tmp_path, text))
    assert study.materials["metal"] == pre.PlasticKinematic(7.8e-9, 210000.0, 0.3, 210.0)
    with pytest.raises(pre.RecipeError, match=r"materials\.metal\.yield: missing; a number"):
        pre.load_recipe(recipe(tmp_path, text.replace("yield = 210\n", "")))


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("density", 0.0),
        ("poisson", 0.5),
        ("yield_stress", 0.0),
        ("tangent", 210000.0),
        ("tangent", -1.0),
        ("beta", 1.1),
        ("rate", -40.0),
    ],
)
def test_a_metal_that_cannot_be_is_refused(key: str, value: float) -> None:
    with pytest.raises(pre.RecipeError, match=key.removesuffix("_stress")):
        replace(pre.PlasticKinematic(7.8e-9, 210000.0, 0.3, 210.0), **{key: value})


def test_a_rate_of_a_metal_needs_a_power() -> None:
    with pytest.raises(pre.RecipeError, match=r"power: 0\.0 must be above zero"):
        pre.PlasticKinematic(7.8e-9, 210000.0, 0.3, 210.0, rate=40.0)


def test_the_example_is_a_study_that_can_be_written(tmp_path: Path) -> None:
    study = pre.load_recipe(recipe(tmp_path, pre.example_recipe()))
    text = "\n".join(pre.deck_text(study, pre.make_mesh(study.mesh)))
    assert text.startswith("*KEYWORD") and text.endswith("*END")


def test_the_first_recipe_is_short_and_the_same_impact_as_the_long_one(tmp_path: Path) -> None:
    """Only the histories of nodes and stresses through the thickness are in the long one alone."""
    text = pre.example_recipe()
    assert len(text.splitlines()) <= 45
    short = pre.load_recipe(recipe(tmp_path, text))
    long = pre.load_recipe(recipe(tmp_path, pre.example_recipe("impact-all")))
    more = replace(long.outputs, nodes=(), node_interval=None, profiles=())
    assert replace(short, contact=pre.Contact()) == replace(long, outputs=more)


def test_damage_without_what_it_needs_is_refused(ply: pre.PlyCodam2, bond: pre.Cohesive) -> None:
    with pytest.raises(pre.RecipeError, match="ST: needed for"):
        replace(ply, matrix_compression="hashin")
    with pytest.raises(pre.RecipeError, match="average_across: above zero"):
        replace(ply, average_along=2.0)
    assert ply.closes
    assert not replace(ply, average_along=2.0, average_across=2.0, closure=True).closes
    with pytest.raises(pre.RecipeError, match="shear_curve: the name of a curve"):
        replace(ply, shear="curve")
    with pytest.raises(pre.RecipeError, match=r"GIC: 0\.0 must be above zero"):
        replace(bond, GIC=0.0)


def switched_on(text: str, tables: bool) -> str:
    """The example with its commented keys switched on; tables that are comments too, or left."""
    lines, table_is_comment = [], False
    for line in text.splitlines():
        if line.startswith(("[", "# [")):
            table_is_comment = line.startswith("#")
        is_key = re.match(r"# (\w+ = |\[)", line) and not line.startswith("# base")
        wanted = is_key and (tables or not table_is_comment)
        lines.append(line[2:] if wanted else line)
    return "\n".join(lines)


def test_the_defaults_that_the_example_shows_are_the_defaults(tmp_path: Path) -> None:
    text = pre.example_recipe("impact-all")
    shown = pre.load_recipe(recipe(tmp_path, switched_on(text, tables=False)))
    study = pre.load_recipe(recipe(tmp_path, text))
    others = {"impactor", "outputs"}
    for name, value in vars(study).items():
        assert name in others or vars(shown)[name] == value, name
    # what depends on the mesh, and what is left to the solver, is shown with values of its own
    assert replace(shown.impactor, position=None) == study.impactor
    own = dict.fromkeys(("support_interval", "restart_steps"))
    assert replace(shown.outputs, fields=None, **own) == study.outputs


def test_all_that_the_example_shows_in_comments_can_be_switched_on(
    tmp_path: Path, ply: pre.PlyCodam2, bond: pre.Cohesive
) -> None:
    text = switched_on(pre.example_recipe("impact-all"), tables=True)
    # the example has a lever on the bottom, where it cannot have a fixture, too
    text = text.replace('kind = "plane"\nface = "bottom"', 'kind = "plane"\nface = "top"')
    study = pre.load_recipe(recipe(tmp_path, text))
    assert study.materials["weak_carbon"] == ply
    assert study.materials["bond"] == bond
    assert len(study.loads) == 3
    assert len(study.laminate.refine) == 1
    assert set(study.sets) == {"line", "gauge"}
    assert "*LOAD_FACE_PRESSURE" in "\n".join(pre.deck_text(study, pre.make_mesh(study.mesh)))


@pytest.mark.parametrize(
    ("old", "new", "path", "words"),
    [
        ("quads = [2, 4]", "quad = [2, 4]", "mesh.quad", "did you mean 'quads'?"),
        ("quads = [2, 4]", "", "mesh.quads", "missing; a list of 2 values"),
        ("quads = [2, 4]", "quads = [2]", "mesh.quads", "1 values were given, 2 are needed"),
        ("quads = [2, 4]", "quads = 2", "mesh.quads", "2 was given, a list"),
        ("quads = [2, 4]", "quads = [2, 4.5]", "mesh.quads[2]", "4.5 was given, a whole number"),
        ('kind = "rectangle"', 'kind = "square"', "mesh.kind", '"ogrid_square"'),
        ('kind = "rectangle"', "", "mesh.kind", "missing; one of"),
        ("E = 70000", "E = '70000'", "materials.metal.E", "'70000' was given, a number"),
        ("E = 70000", "E = true", "materials.metal.E", "true was given, a number"),
        ("E = 70000", "E = nan", "materials.metal.E", "finite"),
        ("E = 70000", "E = -1.0", "materials.metal.E", "above zero"),
        ("nu = 0.33", "nu = 0.5", "materials.metal.nu", "below 0.5"),
        ("E = 70000", "Young = 70000", "materials.metal.Young", "known: E, density"),
        ('"[0/90]s"', '"[0/9O]s"', "laminate.layup", "column 5"),
        ("thickness = 1", "thickness = 0", "laminate.thickness", "above zero"),
        ("thickness = 1", "thickness = { M = 1 }", "laminate.thickness.metal", "missing"),
        ("thickness = 1", "thickness = 1\norder = 5", "laminate.order", "from 1 to 4"),
        ('material = "metal"', "", "laminate.material", "missing"),
        ('material = "metal"', 'material = "metl"', "laminate.material", "did you mean 'metal'?"),
        ("thickness = 1", "thickness = 1\ninterfaces = 'tide'", "laminate.interfaces", "'tied'?"),
        ('title = "Small"', "", "title", "missing; text in quotes"),
        ('title = "Small"', "title = 3", "title", "3 was given, text"),
        ("[control]\nend_time = 1e-3", "", "control", "missing; a table"),
        ("end_time", "endtime", "control.endtime", "did you mean 'end_time'?"),
        ("[control]", "[contrl]", "contrl", "did you mean 'control'?"),
        (
            "[control]",
            "[[supports]]\nset = 'left'\nhold = 'xw'\n[control]",
            "supports[1].hold",
            "x",
        ),
        ("[control]", "[contact]\n[control]", "impactor", "missing; a contact needs one"),
        ("[control]", "[outputs]\nnode_interval = 1\n[control]", "outputs.nodes", "missing"),
        ("[control]", "[sets.a]\n[control]", "sets.a", "needs one of box"),
        (
            "[control]",
            "[[loads]]\nkind = 'pressure'\nvalue = 1\ncurve = 'up'\n[control]",
            "loads[1].curve",
            "there is none",
        ),
        (
            "[control]",
            "[[laminate.refine]]\nplies = [3, 5]\norder = 2\n[control]",
            "laminate.refine[1].plies",
            "from 1 to 4",
        ),
    ],
)
def test_errors_name_the_keys_and_what_would_be_right(
    tmp_path: Path, old: str, new: str, path: str, words: str
) -> None:
    file = recipe(tmp_path, SMALL.replace(old, new))
    with pytest.raises(pre.RecipeError) as caught:
        pre.load_recipe(file)
    assert caught.value.path == f"{file}: {path}"
    assert words in caught.value.message


@pytest.mark.parametrize(
    ("more", "path", "words"),
    [
        ("[[supports]]\nset = 'lfet'", "supports[1].set", "did you mean 'left'?"),
        ("[[supports]]\nset = 'a'\n[sets.a]\nat = [1, 1]", "sets.a.at", "nearest is at [0, 0]"),
        ("[[supports]]\nset = 'a'\n[sets.a]\nbox = [1, 2, 1, 2]", "sets.a.box", "no node"),
        ("[[loads]]\nkind = 'pressure'\nvalue = 1\nset = 'core'", "loads[1].set", "known: all, pl"),
        ("[sets.left]\nat = [0, 0]", "sets.left", "the mesh has a set of this name"),
        ("[outputs]\nnodes = ['core']", "outputs.nodes[1]", "not a node set"),
        ("[laminates.skin]\nlayup = '[metal]'\nthickness = 1", "laminates.skin", "no part"),
    ],
)
def test_names_that_the_mesh_does_not_have_are_told(
    tmp_path: Path, more: str, path: str, words: str
) -> None:
    study = pre.load_recipe(recipe(tmp_path, f"{SMALL}{more}"), ["mesh.order=1"])
    with pytest.raises(pre.RecipeError) as caught:
        list(pre.deck_text(study, pre.make_mesh(study.mesh)))
    assert caught.value.path == path
    assert words in caught.value.message


def test_a_recipe_lies_on_top_of_its_base(tmp_path: Path) -> None:
    recipe(tmp_path, SMALL)
    (tmp_path / "fine").mkdir()
    fine = recipe(
        tmp_path,
        'base = "../small.toml"\nmesh.quads = [4, 8]\nlaminate.order = 3',
        "fine/fine.toml",
    )
    finest = recipe(tmp_path, 'base = "fine.toml"\nlaminate.layers = 2', "fine/finest.toml")
    below, study = pre.load_recipe(tmp_path / "small.toml"), pre.load_recipe(finest)
    assert study.mesh == pre.Rectangle(sides=(10.0, 20.0), quads=(4, 8))
    assert (study.laminate.order, study.laminate.layers) == (3, 2)
    assert study.materials == below.materials
    assert pre.load_recipe(fine).laminate.layers == 1


def test_a_table_of_another_kind_replaces_the_one_below() -> None:
    below = {"mesh": {"kind": "rectangle", "sides": [1, 1]}, "title": "a"}
    above = {"mesh": {"kind": "ogrid_disc", "core": 2}}
    assert merged(below, above) == {"mesh": above["mesh"], "title": "a"}
    assert merged(below, {"mesh": {"sides": [2, 2]}})["mesh"]["kind"] == "rectangle"


def test_the_file_of_a_mesh_is_relative_to_the_recipe_that_names_it(tmp_path: Path) -> None:
    (tmp_path / "deep").mkdir()
    mesh = '[mesh]\nkind = "gmsh"\nfile = "plate.msh"'
    recipe(tmp_path, SMALL)
    recipe(tmp_path, f'base = "../small.toml"\n{mesh}', "deep/base.toml")
    study = pre.load_recipe(recipe(tmp_path, 'base = "deep/base.toml"', "top.toml"))
    assert study.mesh == pre.GmshFile(tmp_path / "deep" / "plate.msh")


def test_recipes_that_cannot_be_read_are_told(tmp_path: Path) -> None:
    with pytest.raises(pre.RecipeError, match="there is no file"):
        pre.load_recipe(tmp_path / "none.toml")
    with pytest.raises(pre.RecipeError, match=r"not TOML.*line 1"):
        pre.load_recipe(recipe(tmp_path, "title = 1 2"))
    with pytest.raises(pre.RecipeError, match=r"base: there is no file .*none\.toml"):
        pre.load_recipe(recipe(tmp_path, 'base = "none.toml"'))
    with pytest.raises(pre.RecipeError, match="based on itself"):
        pre.load_recipe(recipe(tmp_path, 'base = "small.toml"'))
    with pytest.raises(pre.RecipeError, match="3 was given"):
        pre.load_recipe(recipe(tmp_path, "base = 3"))


def test_overrides_have_the_last_word(tmp_path: Path) -> None:
    overrides = ["mesh.quads=[6, 6]", "control.kinematics=linear", 'title="Other"']
    study = pre.load_recipe(recipe(tmp_path, SMALL), overrides)
    assert study.mesh.quads == (6, 6)
    assert study.control.kinematics == "linear"
    assert study.title == "Other"


@pytest.mark.parametrize("text", ["mesh.n", "=3", "mesh n=3", 'a="b" c"'])
def test_overrides_that_cannot_be_read_are_told(text: str) -> None:
    with pytest.raises(pre.RecipeError, match=r"is no override such as mesh\.n=6"):
        parse_override(text)


def test_two_frame_accelerations_in_one_direction_are_refused(study: pre.Study) -> None:
    frame = pre.FrameAcceleration("z", 1.0)
    with pytest.raises(pre.RecipeError, match="one frame acceleration at most"):
        replace(study, loads=(frame, frame))


def test_what_is_defined_and_not_used_is_found(study: pre.Study) -> None:
    assert pre.unused(study) == []
    bare = replace(study, loads=(), outputs=pre.Outputs())
    assert pre.unused(bare) == ["sets.line", "sets.gauge", "curves.ramp"]
    laminate = pre.Laminate(layup="[metal]", thickness=1.0)
    assert pre.unused(replace(study, laminate=laminate)) == ["materials.carbon", "materials.resin"]
