"""The command, as it is typed."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from programs import plydyn_pre

import plydyn_pre as pre


def test_a_deck_tells_how_large_it_is(tmp_path: Path, decks: Path) -> None:
    result = plydyn_pre(tmp_path, "deck", decks / "elastic_impact" / "le1.toml")
    assert result.returncode == 0
    for words in ("48 of 9 nodes", "209", "17", "10,659", "le1.k"):
        assert words in result.stdout
    assert (tmp_path / "le1.k").read_text().endswith("*END\n")
    assert [path.name for path in tmp_path.iterdir()] == ["le1.k"]


def test_a_deck_goes_where_it_is_told_with_the_values_it_is_told(
    tmp_path: Path, decks: Path
) -> None:
    words = ("-o", "other.k", "--set", "mesh.n=6", "--set", "contact.method=points_on_plate")
    result = plydyn_pre(tmp_path, "deck", decks / "elastic_impact" / "le2.toml", *words)
    assert result.returncode == 0
    assert "84 of 9 nodes" in result.stdout
    title = (tmp_path / "other.k").read_text().split("*TITLE\n")[1].splitlines()[0]
    assert title == (
        "Elastic impact on a quasi-isotropic plate LE2; mesh.n=6 contact.method=points..."
    )


def test_a_deck_goes_into_a_folder_that_is_made(tmp_path: Path, decks: Path) -> None:
    recipe = decks / "elastic_impact" / "le1.toml"
    for output, path in (("new/", "new/le1.k"), ("new", "new/le1.k"), ("a/b/x.k", "a/b/x.k")):
        assert plydyn_pre(tmp_path, "deck", recipe, "-o", output).returncode == 0
        assert (tmp_path / path).is_file()
        (tmp_path / path).unlink()
    (tmp_path / "file").write_text("")
    for output in ("file/", "file/x.k"):
        result = plydyn_pre(tmp_path, "deck", recipe, "-o", output)
        assert result.returncode == 5
        assert "file cannot be made: " in result.stderr
        assert "Traceback" not in result.stderr


def test_a_mesh_tells_its_sizes_and_sets(tmp_path: Path, decks: Path) -> None:
    result = plydyn_pre(tmp_path, "mesh", decks / "elastic_impact" / "le1.toml")
    assert result.returncode == 0
    for words in ("area             10000 mm2", "5 to 28.28 mm", "0.500 x mean", "boundary (32)"):
        assert words in result.stdout
    assert not list(tmp_path.iterdir())


def test_a_layup_is_shown_with_its_bottom_ply_last(tmp_path: Path) -> None:
    result = plydyn_pre(tmp_path, "layup", "[10/Al/-20]", "--thickness", "0.25")
    assert result.returncode == 0
    top, middle, bottom = [line for line in result.stdout.splitlines() if line.startswith("│")]
    assert top.replace("│", " ").split() == ["3", "-20", "-", "0.5", "0.75"]
    assert middle.replace("│", " ").split() == ["2", "0", "Al", "0.25", "0.5"]
    assert bottom.replace("│", " ").split() == ["1", "10", "-", "0", "0.25"]
    assert "first of the notation, is the bottom one" in result.stdout


def test_a_new_recipe_can_be_used_and_is_never_overwritten(tmp_path: Path) -> None:
    assert plydyn_pre(tmp_path, "new", "mine.toml").returncode == 0
    assert (tmp_path / "mine.toml").read_text() == pre.example_recipe()
    assert plydyn_pre(tmp_path, "deck", "mine.toml").returncode == 0
    again = plydyn_pre(tmp_path, "new", "mine.toml")
    assert again.returncode == 2
    assert "is there already" in again.stderr


def test_errors_are_words_and_an_exit_code(tmp_path: Path, decks: Path) -> None:
    result = plydyn_pre(tmp_path, "layup", "[45/x:/90]s")
    assert result.returncode == 2
    assert result.stderr.splitlines()[0].startswith("error: column 7: ")
    assert result.stderr.splitlines()[-1].index("^") == result.stderr.splitlines()[-2].index("/90")
    result = plydyn_pre(
        tmp_path, "deck", decks / "elastic_impact" / "le1.toml", "--set", "mesh.m=6"
    )
    assert result.returncode == 2
    assert "le1.toml: mesh.m: there is no such key" in result.stderr
    assert "Traceback" not in result.stderr
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(("command", "end"), [("deck", ".k"), ("mesh", ".svg")])
def test_a_name_longer_than_any_file_has_is_told(
    tmp_path: Path, decks: Path, command: str, end: str
) -> None:
    name = f"{300 * 'x'}{end}"
    result = plydyn_pre(tmp_path, command, decks / "elastic_impact" / "le1.toml", "-o", name)
    assert result.returncode == 5
    assert result.stderr.strip() == f"error: {name} cannot be written: File name too long"


def test_keys_without_effect_are_noted(tmp_path: Path) -> None:
    """How strengths scatter where none does, and how quads grow where none has to."""
    recipe = tmp_path / "plate.toml"
    recipe.write_text("""title = "plate"
materials.ply = {like = "IM7/8552"}
materials.bond = {like = "IM7/8552 interface", scatter_length = 2.0, seed = 3}
laminate = {layup = "[0/90]s", thickness = 0.2, material = "ply", interfaces = "bond"}
mesh = {kind = "rectangle", sides = [4.0, 4.0], quads = [2, 2], growth = 1.2}
loads = [{kind = "frame_acceleration", direction = "z", value = 9810.0}]
control.end_time = 1e-6
""")
    result = plydyn_pre(tmp_path, "deck", "plate.toml")
    assert result.returncode == 0, result.stderr
    idle = ("materials.bond.scatter_length", "materials.bond.seed", "mesh.growth")
    assert result.stderr.splitlines() == [f"note: plate.toml: {key} is never used" for key in idle]
    result = plydyn_pre(tmp_path, "deck", "plate.toml", "--set", "mesh.growth=0.5")
    assert result.returncode == 2
    assert "mesh.growth: 0.5 must be from 1 to 2" in result.stderr


def test_what_is_never_used_is_noted(tmp_path: Path, decks: Path) -> None:
    words = ("--set", "curves.up={time=[0, 1], value=[0, 1]}")
    result = plydyn_pre(tmp_path, "deck", decks / "elastic_impact" / "le1.toml", *words)
    assert result.returncode == 0
    assert result.stderr.strip().endswith("le1.toml: curves.up is never used")


def test_a_nearly_folded_quad_is_noted_with_the_deck_and_with_the_mesh(
    tmp_path: Path, decks: Path
) -> None:
    # a core that all but reaches the circle leaves the outer corners of its rings flat; with quads
    # of nine nodes it would be refused
    sets = ("--set", "mesh.core=52.9", "--set", "mesh.order=1")
    words = (decks / "damage_impact" / "q192_le2.toml", *sets)
    for command in ("mesh", "deck"):
        result = plydyn_pre(tmp_path, command, *words)
        assert result.returncode == 0
        assert "is nearly folded: its least Jacobian is" in result.stderr
    assert "folded" not in plydyn_pre(tmp_path, "deck", words[0]).stderr


def test_the_version_is_told(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "plydyn_pre", "--version"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == f"plydyn-pre {pre.__version__}"


def test_a_shell_completes_commands_and_options() -> None:
    program = Path(sys.executable).parent / "plydyn-pre"
    for typed, found in (("plydyn-pre stre", "strengths"), ("plydyn-pre study --at", "--at-once")):
        words = {"COMP_WORDS": typed, "COMP_CWORD": str(len(typed.split()) - 1)}
        environment = os.environ | words | {"_PLYDYN_PRE_COMPLETE": "complete_bash"}
        done = subprocess.run(
            [program], env=environment, capture_output=True, text=True, check=True
        )
        assert found in done.stdout.split()
