"""Forms of decks that other programs write: the solver reads them as the plain ones."""

from __future__ import annotations

import subprocess
from pathlib import Path
from re import sub

import pytest

from runs import ROOT, SOLVER

PLATE = (ROOT / "manual/decks.md").read_text().split("```\n")[1]


def listing(folder: Path, deck: str) -> str:
    """The listing of a check, from the plies on; an error fails the test."""
    (folder / "job.k").write_text(deck)
    result = subprocess.run(
        [SOLVER, "check", "job.k"], cwd=folder, capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stdout + result.stderr
    found = result.stdout.split("\nPart 1")[1]
    timed = "a step, measured|a line of energies|  they take longer|time to come"
    return sub(rf"(?m)^({timed}).*$", "", found)


def test_a_remark_behind_the_columns_of_cards_is_left_out(tmp_path: Path) -> None:
    plain = "*CONTROL_TIMESTEP\n       0.0       0.7\n"
    remark = f"*CONTROL_TIMESTEP\n{'       0.0       0.7':80}9 a remark, with a comma\n"
    decks = [PLATE.replace("*END", f"{card}*END") for card in (plain, remark)]
    assert listing(tmp_path, decks[1]) == listing(tmp_path, decks[0])
    words = f"*CONTROL_TIMESTEP\n{'       0.0       0.7':75}words\n"
    (tmp_path / "job.k").write_text(PLATE.replace("*END", f"{words}*END"))
    result = subprocess.run(
        [SOLVER, "check", "job.k"], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert result.returncode == 2 and "words" in result.stdout + result.stderr


def test_a_number_may_begin_in_the_first_column_behind_a_blank_field(tmp_path: Path) -> None:
    cards = [f"*CONTROL_TIMESTEP\n{fields}\n" for fields in ("0.0, 0.7", f"{'':10}0.7")]
    decks = [PLATE.replace("*END", f"{card}*END") for card in cards]
    assert listing(tmp_path, decks[1]) == listing(tmp_path, decks[0])


@pytest.mark.parametrize(
    "names",
    [
        "*PARAMETER_LOCAL\nR share, 0.7\n",
        "*PARAMETER_EXPRESSION_LOCAL\nR share, 1.4/2\n",
        "*INCLUDE_PATH_RELATIVE\nsub\n*INCLUDE\nnames.k\n",
    ],
)
def test_names_that_are_local_and_folders_that_are_relative(names: str, tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "names.k").write_text("*KEYWORD\n*PARAMETER\nR share, 0.7\n*END\n")
    plain = PLATE.replace("*END", "*CONTROL_TIMESTEP\n0.0, 0.7\n*END")
    named = PLATE.replace("*END", f"{names}*CONTROL_TIMESTEP\n0.0, &share\n*END")
    assert listing(tmp_path, named) == listing(tmp_path, plain)


@pytest.mark.parametrize(
    ("units", "printed"),
    [
        ("in, s, slinch", "in, s, slinch, lbf, psi, in-lbf"),
        ("ft,s,slug", "ft, s, slug, lbf, psf, ft-lbf"),
    ],
)
def test_customary_units_are_named_and_numbers_looked_at_in_them(
    units: str, printed: str, tmp_path: Path
) -> None:
    deck = PLATE.replace("mm, s, t\n", f"{units}\n")
    (tmp_path / "job.k").write_text(deck)
    result = subprocess.run(
        [SOLVER, "check", "job.k"], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert printed in result.stdout
    # a density of 1.6e-9 t/mm3 is 1600 kg/m3; read as slinch/in3 it is 0.0171
    assert "kg/m3 in the units" in result.stdout + result.stderr
