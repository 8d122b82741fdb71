"""What is suspicious in a deck but may be meant: a warning with its line, and the deck is taken."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from runs import SOLVER

GOOD = Path(__file__).parent / "errors" / "good"
SPHERE = "*IMPACTOR_SPHERE\n1,5.0,1.0e-3,{x},1.0,6.0\n0.0,0.0,{speed}\n*CONTACT_IMPACTOR\n1,1,1,1\n"
MOVED = "*INITIAL_VELOCITY\n0\n0.0,0.0,1.0\n"
DAMAGED = (
    "*MAT_PLY_CODAM2\n1,1.6e-9,153000.0,10300.0,10300.0,0.3,0.3,0.4\n6000.0,6000.0,3700.0\n"
    "2537.0,1580.0,82.0,236.0,90.0,40.0\n91.6,79.9,0.22,1.1,0.5\n{shear}\n1\n"
)


def checked(folder: Path, files: list[str], cards: str) -> str:
    """What is said of a deck of some files and cards, which must be taken."""
    deck = folder / "deck.k"
    parts = "".join(f"*INCLUDE\n{GOOD / name}.k\n" for name in files)
    deck.write_text(f"*KEYWORD\n{cards}{parts}*END\n")
    done = subprocess.run([SOLVER, "check", deck], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize(
    ("cards", "line", "fragment"),
    [
        ("*DATABASE_NODOUT\n0.0\n", 3, "*DATABASE_NODOUT card 1 DT: there are no nodes to write"),
        ("*DATABASE_SPCFORC\n1.0e-6\n", 3, "there are no supports to write"),
        ("*DATABASE_IMPACTOR\n1.0e-6\n", 3, "there are no impactors to write"),
        ("*INCLUDE_PATH\nno/such/folder\n", 3, "*INCLUDE_PATH: there is no folder"),
        ("*DATABASE_BNDOUT\n1.0e-6\n", 2, "right would be: *DATABASE_SPCFORC, which writes"),
        ("*DATABASE_TRHIST\n1.0e-6\n", 2, "'*DATABASE_TRHIST' is ignored"),
    ],
    ids=["no nodes", "no supports", "no impactors", "no folder", "other", "none"],
)
def test_warning_with_its_line(cards: str, line: int, fragment: str, tmp_path: Path) -> None:
    """What can have no effect is told, once."""
    said = checked(tmp_path, ["mesh", "ply", "part", "run"], cards)
    assert said.count(f"deck.k:{line}: ") == 1
    assert fragment in said


def test_good_deck_has_no_warning(tmp_path: Path) -> None:
    """A sphere that comes down on the plate, and nodes of their own places."""
    sphere = SPHERE.format(x=1.0, speed=-1e4)
    assert "warning:" not in checked(tmp_path, ["mesh", "ply", "part", "run"], sphere)


def test_blanks_between_filled_fields_take_their_defaults(tmp_path: Path) -> None:
    """In columns and between commas: the Poisson's ratio of a metal is 0 where it is blank."""
    metal = "*MAT_PIECEWISE_LINEAR_PLASTICITY\n{}\n"
    columns = f"{1:>10}{7.8e-9:>10}{2.1e5:>10}{'':>10}{300.0:>10}"
    for cards in (columns, "1,7.8e-9,2.1e5,,300.0"):
        said = checked(tmp_path, ["mesh", "part", "run"], metal.format(cards) + MOVED)
        assert "warning:" not in said


def test_integer_with_a_point(tmp_path: Path) -> None:
    """Many fields of LS-DYNA are real where ours are integers: 1.0 is the material 1."""
    metal = "*MAT_PLASTIC_KINEMATIC\n1.0,7.8e-9,2.1e5,0.3,300.0\n"
    assert "warning:" not in checked(tmp_path, ["mesh", "part", "run"], metal + MOVED)


@pytest.mark.parametrize(
    ("shear", "names"),
    [
        ("0,0,0.06,1.0e-9,3.0", ["GAMU", "ALPHA", "N"]),
        ("1,7,0.05,0.0,3.0", ["LCID", "N"]),
        ("3,7,0.06,1.0e-9,3.0", ["LCID", "GAMU"]),
    ],
    ids=["line", "exponential", "power"],
)
def test_constants_of_another_shear_curve(shear: str, names: list[str], tmp_path: Path) -> None:
    """Each curve has constants of its own."""
    said = checked(tmp_path, ["mesh", "part", "run"], DAMAGED.format(shear=shear))
    for name in names:
        assert f"deck.k:7: *MAT_PLY_CODAM2 card 5 {name}: {name} is without effect" in said
    assert said.count("card 5") == len(names)


FRACTURED = """*MAT_PLY_FRACTURE_3D
1,1.6e-9,153000.,10300.,10300.,0.3,0.3,0.4
6000.,6000.,3700.
2537.,1580.,82.,236.,90.
91.6,79.9,0.22,1.1,{width}
{shear}
0.3,0.0,{rule}
"""


@pytest.mark.parametrize(
    ("shear", "names"),
    [
        ("0,1.0e-12,5.4,60.0,0.05,7", ["ALPHA", "N", "SP", "KP", "LCID"]),
        ("2,1.0e-12,5.4,60.0,0.05,7", ["ALPHA", "N", "SP", "KP"]),
        ("3,1.0e-12,5.4,60.0,0.05,7", ["SP", "KP", "LCID"]),
        ("4,1.0e-12,5.4,60.0,0.05,7", ["ALPHA", "N", "LCID"]),
    ],
    ids=["none", "curve", "power", "hardening"],
)
def test_constants_of_another_permanent_shear(shear: str, names: list[str], tmp_path: Path) -> None:
    """Each kind of permanent shear has constants of its own; LSTAR goes before LRULE."""
    text = FRACTURED.format(width=0.1, shear=shear, rule=1)
    if shear.startswith("2"):
        text += "*DEFINE_CURVE\n7,\n0.0,0.0\n0.01,40.0\n0.05,80.0\n"
    said = checked(tmp_path, ["mesh", "part", "run"], text)
    fields = ("ALPHA", "N", "SP", "KP", "LCID")
    assert [name for name in fields if f" {name} is without" in said] == names
    assert "LRULE is without effect" in said


def test_rule_of_a_width_that_is_given(tmp_path: Path) -> None:
    """LSTAR goes before LRULE."""
    said = checked(tmp_path, ["mesh", "part", "run"], DAMAGED.format(shear="0"))
    assert "deck.k:8: *MAT_PLY_CODAM2 card 6 LRULE: LRULE is without effect" in said


@pytest.mark.parametrize(
    ("cards", "names"),
    [
        ("1,7.8e-9,2.1e5,0.3,300.0\n0,2.0\n", ["card 2 P: P"]),
        (
            "1,7.8e-9,2.1e5,0.3,300.0,1.0e3\n0,0\n0.0,0.1\n300.0,400.0\n",
            ["card 1 SIGY: SIGY", "card 1 ETAN: ETAN"],
        ),
        (
            "1,7.8e-9,2.1e5,0.3,300.0,1.0e3\n0,0,9\n0.0,0.1\n300.0,400.0\n",
            ["card 1 SIGY: SIGY", "card 1 ETAN: ETAN", "card 3 EPS2: EPS2", "card 4 ES1: ES1"],
        ),
        ("1,7.8e-9,2.1e5,0.3,300.0\n40.0,5.0,9,0,1\n", []),
    ],
    ids=["no rate", "points", "curve", "rate and curve"],
)
def test_fields_that_a_yield_curve_replaces(cards: str, names: list[str], tmp_path: Path) -> None:
    """SIGY counts beside a curve where the rate makes it rise."""
    curve = "*DEFINE_CURVE\n9,\n0.0,300.0\n0.1,400.0\n" if ",9" in cards else ""
    text = f"*MAT_PIECEWISE_LINEAR_PLASTICITY\n{cards}{curve}"
    said = checked(tmp_path, ["mesh", "part", "run"], text)
    assert said.count("is without effect") == len(names)
    for name in names:
        assert f"{name} is without effect" in said


def test_strength_that_the_onset_does_not_ask_for(tmp_path: Path) -> None:
    """ST belongs to Hashin's onset, MCOMP 1."""
    said = checked(tmp_path, ["mesh", "part", "run"], DAMAGED.format(shear="0"))
    assert "ST is without effect" in said
    assert "MCOMP 1, or 0 here" in said


def test_control_characters_of_a_title(tmp_path: Path) -> None:
    """A listing does nothing to a terminal."""
    said = checked(tmp_path, ["mesh", "ply", "part", "run"], "*TITLE\n\033[2Jplate\n")
    assert "\033" not in said
    assert "?[2Jplate" in said


def test_nodes_at_one_place(tmp_path: Path) -> None:
    """Quads side by side that share no nodes, as of meshes that were not merged."""
    apart = 1.0e-9
    nodes = "".join(
        f"{i + 1 + 4 * part},{x + part * (1.0 + apart)},{y},0.0\n"
        for part in range(2)
        for i, (x, y) in enumerate([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    )
    quads = "*ELEMENT_SHELL\n1,1,1,2,3,4\n2,1,5,6,7,8\n"
    said = checked(tmp_path, ["ply", "part", "run"], "*NODE\n" + nodes + quads)
    assert "deck.k:7: node 5 lies where node 2 does: nothing joins them" in said
    assert "deck.k:10: node 8 lies where node 3 does" in said


def test_bound_of_the_volume_without_large_displacement(tmp_path: Path) -> None:
    """VOLLIM watches with KINEM 1 alone."""
    for kinematics, words in ((0, 1), (1, 0)):
        text = f"*CONTROL_LAYERWISE\n{kinematics},,,,0.2\n"
        said = checked(tmp_path, ["mesh", "ply", "part", "run"], text)
        assert said.count("VOLLIM: VOLLIM is without effect") == words


@pytest.mark.parametrize(
    ("thickness", "words"),
    [
        ("0.25e-3", "a ply of a thickness of 2.5e-7 m in the units mm, s, t"),
        ("2.0e3", "a ply of a thickness of 2 m in the units mm, s, t"),
        ("0.25", ""),
    ],
)
def test_thickness_in_other_units(thickness: str, words: str, tmp_path: Path) -> None:
    """Nodes in mm and plies in m."""
    part = f"*PART_COMPOSITE_LONG\nplate\n1\n1,{thickness}\n"
    said = checked(tmp_path, ["mesh", "ply", "run"], part)
    assert ("a ply of a thickness of" in said) == bool(words)
    assert words in said


def test_springs_that_only_the_step_feels(tmp_path: Path) -> None:
    """The listing says why the step is short; usual stiffnesses are not blamed."""
    cards = "*PART_COMPOSITE_LONG\nplate\n1\n1,0.5\n1,0.5\n*INTERFACE_COHESIVE\n1,0,0,9\n"
    cards += "*MAT_COHESIVE_MIXED_MODE\n9,0,0,0,{0},{0},0.3,0.8\n1.0,30.0,50.0\n"
    for stiffness, is_blamed in (("1.0e6", False), ("1.0e13", True)):
        said = checked(tmp_path, ["mesh", "ply", "run"], cards.format(stiffness))
        assert ("and the step is short" in said) == is_blamed
