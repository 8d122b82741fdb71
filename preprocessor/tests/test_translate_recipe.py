"""A translated deck as a recipe: the same study, or the cause why there is none."""

from __future__ import annotations

from pathlib import Path

import abaqus_decks
import nastran_decks
import numpy as np
import pytest
from foreign_decks import Foreign, standard
from programs import plydyn_pre, run_deck
from test_abaqus import stacked
from test_foreign_runs import BASE, CASES, RECIPE, STACK

import plydyn_pre as pre
from plydyn_pre.recipe_text import recipe_lines
from plydyn_pre.translate import Choices, Translation, translation

LAWS = ("E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23", "density")
OTHERS = {
    "Abaqus": ("inp", abaqus_decks.standard(), {}),
    "Abaqus, a bond": ("inp", stacked("contact"), STACK),
    "Nastran": ("bdf", nastran_decks.standard(), {}),
}
EVERY = {name: ("k", make(), changes) for name, (make, changes) in CASES.items()} | OTHERS


def made(folder: Path, text: str, suffix: str = "k", like: str = "") -> Translation:
    """The translation of a deck."""
    (folder / f"user.{suffix}").write_text(text)
    return translation(folder / f"user.{suffix}", folder / "job.k", Choices(like))


def recipe_of(folder: Path, study: pre.Study) -> pre.Study:
    """The study of the recipe that is written of it."""
    (folder / "written.toml").write_text("\n".join(recipe_lines(study)) + "\n")
    return pre.load_recipe(folder / "written.toml")


@pytest.mark.parametrize("name", EVERY)
def test_the_recipe_of_a_deck_is_that_of_the_same_model(name: str, tmp_path: Path) -> None:
    suffix, text, changes = EVERY[name]
    whole = made(tmp_path, text, suffix)
    assert whole.study is not None, whole.causes
    own = recipe_of(tmp_path, whole.study)
    assert own == whole.study
    (tmp_path / "own.toml").write_text(RECIPE.format(**(BASE | changes)))
    other = pre.load_recipe(tmp_path / "own.toml")
    same = pytest.approx
    assert (own.mesh.sides, own.mesh.quads) == (same(other.mesh.sides), other.mesh.quads)
    for ply, reference in zip(own.laminate.stack, other.laminate.stack, strict=True):
        assert (ply.thickness, ply.angle % 180.0) == same((reference.thickness, reference.angle))
        laws = own.materials[ply.material], other.materials[reference.material]
        one, two = ([getattr(law, key) for key in LAWS] for law in laws)
        assert one == same(two, rel=1e-9 if suffix == "k" else 0.03)
    assert own.laminate.opened == other.laminate.opened
    assert own.materials.get("bond", None) == other.materials.get("bond", None)
    assert own.impactor.kind == other.impactor.kind
    for key in ("radius", "gap"):
        assert getattr(own.impactor, key) == same(getattr(other.impactor, key), abs=1e-4)
    assert own.supports == other.supports
    assert own.contact.friction == 0.2 and own.contact.method == other.contact.method
    assert own.control.end_time == same(other.control.end_time)
    assert own.control.step_factor == other.control.step_factor


def test_the_command_writes_a_recipe_with_the_same_force(solver: str, tmp_path: Path) -> None:
    (tmp_path / "user.inp").write_text(abaqus_decks.standard(meshed=True))
    translate = ["translate", "user.inp", "--recipe", "user.toml"]
    for words in (translate, ["deck", "user.toml", "-o", "own.k"]):
        result = plydyn_pre(tmp_path, *words)
        assert result.returncode == 0, result.stdout + result.stderr
    forces = []
    for stem in ("user_plydyn", "own"):
        run_deck(solver, tmp_path, f"{stem}.k")
        rows = np.loadtxt(tmp_path / f"{stem}.impactor_1.csv", delimiter=",", skiprows=1)
        forces.append(rows[:, 1])
    assert forces[1].max() > 50.0
    assert forces[0] == pytest.approx(forces[1], abs=0.02 * forces[1].max())
    result = plydyn_pre(tmp_path, *translate)
    assert result.returncode == 2 and "no name of a new recipe" in result.stderr


def test_fixtures_and_supports_along_edges_arrive(tmp_path: Path) -> None:
    deck, plate, _ = standard(held=False)
    left = [n for k, n in enumerate(plate) if k % 9 == 0]
    inner = [n for k, n in enumerate(plate) if k % 9 in (4, 5) and k // 9 in (2, 3)]
    for sid, ids, row in ((1, left, (1,) * 6), (2, inner, (0, 0, 1))):
        deck.set_of("SET_NODE_LIST", sid, ids)
        deck.put("BOUNDARY_SPC_SET", (sid, 0, *row))
    deck.put("RIGIDWALL_GEOMETRIC_FLAT", (0,), (5, 10, -1, 5, 10, 0, 0.1), (15, 10, -1, 20, 10))
    bar = (20.0, 0.0, -5.25, 20.0, 40.0, -5.25, 0.1)
    deck.put("RIGIDWALL_GEOMETRIC_CYLINDER", (0,), bar, (5.0, 40.0))
    whole = made(tmp_path, deck.text(), like="IM7/8552")
    assert whole.study is not None, whole.causes
    study = recipe_of(tmp_path, whole.study)
    punch, bar = study.fixtures
    assert (punch.size, punch.centre, punch.gap) == ((20.0, 10.0), (15.0, 15.0), 0.75)
    assert (bar.radius, bar.start, bar.end) == (5.0, (20.0, 0.0), (20.0, 40.0))
    assert {(support.set, support.hold) for support in study.supports} == {
        ("left", "xyz"),
        ("held-2", "z"),
    }
    assert study.sets["held-2"].box == (20.0, 25.0, 10.0, 15.0)
    assert isinstance(study.materials["ply"], pre.PlyCodam2)


def graded() -> Foreign:
    """A deck whose quads are not equal."""
    deck, _, _ = standard()
    first = deck.lines.index("*NODE") + 1
    for at in range(first, first + 81):
        x = float(deck.lines[at][8:24])
        deck.lines[at] = f"{deck.lines[at][:8]}{x * x / 40.0:16.8f}{deck.lines[at][24:]}"
    return deck


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "its mesh is no grid of equal quads over a rectangle"),
        ("*DEFINE_CURVE\n7\n0,1\n1,1\n*LOAD_BODY_Z\n7,9810.0\n", "it has gravity"),
        ("*DEFINE_CURVE\n7\n0,1\n1,1\n*LOAD_NODE_POINT\n41,3,7,-5.0\n", "it has forces at nodes"),
        ("*DATABASE_HISTORY_NODE\n41\n", "it has histories of single nodes"),
        (
            "*DEFINE_CURVE\n7\n0,0\n1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n1,1,2,7,0.1\n",
            "set 1 moves or is let go",
        ),
    ],
)
def test_why_there_is_no_recipe(text: str, words: str, tmp_path: Path) -> None:
    deck = standard()[0] if text else graded()
    whole = made(tmp_path, deck.text().replace("*END", f"{text}*END"), like="IM7/8552")
    assert whole.study is None and whole.lines
    assert words in "; ".join(whole.causes)
