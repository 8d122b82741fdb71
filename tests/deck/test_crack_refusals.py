"""What a deck with crack lines cannot have is refused at its card, by name and cause."""

from __future__ import annotations

from pathlib import Path

import pytest

from broken import check_changed, crack_lines

#: A set of the node in the middle of the zone, which lies on lines of all plies
MIDDLE = "*SET_NODE_LIST\n9\n41\n"


def found(folder: Path, *changes: tuple[str, str], more: str = "") -> tuple[int, str]:
    """Exit code and words of a check of the deck of crack lines with some changes."""
    return check_changed(crack_lines(), folder, *changes, more=more)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ([("\n1,0,1\n", "\n1,0,2\n"), ("\n2,0,1\n", "\n2,0,2\n")], "has 1 layers of order 2"),
        (
            [("\n1,0,1\n", "\n1,0,1\n1,4,1,2\n"), ("\n2,0,1\n", "\n2,0,1\n1,4,1,2\n")],
            "has 2 layers of order 1",
        ),
        ([("\n1,0.05,0,", "\n1,0.05,1,")], "interfaces or thickness are implicit"),
        ([("\n1,0.05,0,", "\n1,0.05,2,")], "interfaces or thickness are implicit"),
        ([("0.3,0\n2,0,0,201,1,0,0.3,0", "0.3,2\n2,0,0,201,1,0,0.3,2")], "are fitted to the mesh"),
        ([("0.3,0\n2,0,0,201,1,0,0.3,0", "0.3,3\n2,0,0,201,1,0,0.3,3")], "are fitted to the mesh"),
        ([("\n1,1,0,1,2,", "\n1,1,0,1,1,")], "contact by METHOD 1 spreads forces over facets"),
        ([("0.5,90.0", "0.5,60.0")], "at 60 degrees lie along no edge and no diagonal"),
        ([("\n41,10.0,10.0,", "\n41,10.3,10.0,")], "is no parallelogram equal to element"),
    ],
)
def test_plies_meshes_and_schemes_without_lines(
    changes: list[tuple[str, str]], words: str, tmp_path: Path
) -> None:
    code, text = found(tmp_path, *changes)
    assert code == 2, text
    line = next((line for line in text.splitlines() if words in line), "")
    assert "*CRACK_LINES" in line and "job.k:" in line, text


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (f"{MIDDLE}*BOUNDARY_SPC_SET\n9,0,1\n", "node 41 lies on a crack and is held by spc 9"),
        (
            f"{MIDDLE}*DEFINE_CURVE\n9\n0,0\n1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n9,1,2,9,1.0\n",
            "node 41 lies on a crack and is moved by motion 9",
        ),
        (f"{MIDDLE}*DEFINE_CURVE\n9\n0,1\n1,1\n*LOAD_NODE_SET\n9,3,9,1.0\n", "is loaded"),
        ("*FIXTURE_CLAMP\n1,1,10.0\n10.0,10.0,0.0,3.0\n", "is under clamp 1"),
        ("*INITIAL_DELAMINATION\n2,0,0\n", "interfaces that are damaged at time zero"),
    ],
)
def test_what_acts_on_one_copy_of_a_node(more: str, words: str, tmp_path: Path) -> None:
    code, text = found(tmp_path, more=more)
    assert code == 2, text
    line = next((line for line in text.splitlines() if words in line), "")
    assert "*CRACK_LINES" in line and "job.k:" in line, text


def test_interfaces_that_are_tied_are_no_interfaces(tmp_path: Path) -> None:
    """An interface of the zone alone that no card names."""
    every = "1,0,0,201,1,0,0.3,0\n2,0,0,201,1,0,0.3,0"
    some = "1,1,2,201,1,0,0.3,0\n2,1,2,201,1,0,0.3,0"
    code, text = found(tmp_path, (every, some))
    assert code == 2
    assert "plies 3 and 4 are tied to each other, and crack each by itself" in text


def test_a_fitted_shear_stiffness_and_profiles_go_with_cracks(tmp_path: Path) -> None:
    """FIT 1 leaves strengths alone."""
    fit = ("0.3,0\n2,0,0,201,1,0,0.3,0", "0.3,1\n2,0,0,201,1,0,0.3,1")
    profile = "*DATABASE_PROFILE\n2,10.0,10.0,5,4.3e-06\n"
    code, text = found(tmp_path, fit, more=profile)
    assert code == 0, text


@pytest.mark.parametrize(
    ("cards", "words"),
    [
        ("2,2.5,0.05,3.0", "FS: the friction coefficient of closed cracks is 3"),
        ("2,2.5,1.0e-9,0.3", "GC: a fracture energy of 1e-6 J/m2"),
        ("2,2.5,0.05,0.3\n20.0e6", "YT: YT is E2/5.15e-4"),
        ("2,2.5,0.05,0.3\n0,0.03", "SL: SL is G12/200000"),
    ],
)
def test_constants_that_no_cracks_have_are_told(cards: str, words: str, tmp_path: Path) -> None:
    code, text = found(tmp_path, ("2,2.5,0.05,0.3", cards))
    assert code == 0, text
    assert f"*CRACK_LINES card {1 + cards.count(chr(10))} {words}" in text


def test_no_advice_that_cracks_refuse(tmp_path: Path) -> None:
    """Strengths are not fitted to the mesh there."""
    code, text = found(tmp_path)
    assert code == 0
    assert "smaller quads help" in text
    assert "FIT 2" not in text
    fit = ("0.3,0\n2,0,0,201,1,0,0.3,0", "0.3,2\n2,0,0,201,1,0,0.3,2")
    assert "FIT 0 on *INTERFACE_COHESIVE" in found(tmp_path, fit)[1]


def test_each_material_of_interfaces_has_one_law(tmp_path: Path) -> None:
    """The last of two would count, in the order of the deck."""
    code, text = found(tmp_path, more="*INTERFACE_LAW\n201,1,0.3\n201,0\n")
    assert code == 2
    assert "*INTERFACE_LAW card 1 MID: the material has a law already" in text
    scatter = "*INTERFACE_SCATTER\n201,{},20.0,5.0\n"
    code, text = found(tmp_path, more=scatter.format(1) + scatter.format(2))
    assert code == 2
    assert "the strengths of the material scatter already" in text
