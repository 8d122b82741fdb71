"""Decks as others and their tools write them: columns, remarks, parameters, units."""

from __future__ import annotations

from pathlib import Path

import pytest
from foreign_decks import (
    standard,
)
from foreign_forms import (
    LAYUPS,
    refused,
    same,
    tiebreak,
    tied,
    translated,
)


def test_text_behind_the_columns_ends_of_lines_and_letters(tmp_path: Path) -> None:
    text = standard()[0].text()
    lines = text.splitlines()
    remarked = "\n".join(
        line if line[:1] in "*" or not line else f"{line:<80}  a remark, with 1 number"
        for line in lines
        if line not in ("plate", "ball")
    )
    titles = remarked.replace("*PART_COMPOSITE\n", "*PART_COMPOSITE\nplate\n")
    titles = titles.replace("*PART_INERTIA\n", "*PART_INERTIA\nball\n")
    cut = "\n".join(line[:80] if "," in line else line for line in titles.splitlines())
    same(tmp_path, cut.replace("  a remark, with", "  a remark with"), text)
    same(tmp_path, text.replace("\n", "\r\n").encode(), text)
    same(tmp_path, text.lower().encode(), text)
    same(tmp_path, text.replace("plate", "Plättchen 45°").encode("latin-1"), text)


def test_cards_that_others_tools_write(tmp_path: Path) -> None:
    text = standard()[0].text()
    saved = text.replace(
        "*SET_NODE_LIST\n         1\n",
        "*SET_NODE_LIST\n         1       0.0       0.0       0.0       0.0MECH      1         \n",
    )
    assert saved != text
    plot = "*DATABASE_BINARY_D3PLOT\n    0.0001         0         0         0         0\n"
    more = "         0       0.0       0.0       0.0         0         0\n"
    for each in (
        "*CONTROL_SHELL\n 20.0,0,-1,0,2,2,1\n",
        "*CONTROL_HOURGLASS\n1,0.1\n",
        "*HOURGLASS\n1,4\n",
    ):
        saved = saved.replace("*END", each + "*END")
    whole = saved.replace("*END", plot + more + "*END")
    same(tmp_path, whole, text.replace("*END", plot + "*END"))


@pytest.mark.parametrize(
    "names",
    [
        f"*PARAMETER\n{'R side':10}{90.0:>10}{'R none':10}{0.0:>10}\n",
        f"*PARAMETER_LOCAL\n{'R side':10}{90.0:>10}\n",
        "*PARAMETER_EXPRESSION\nR half            45.0\nR side      half*2\n",
        "*PARAMETER_EXPRESSION_LOCAL\nRside     &half*2\n".replace("&half", "sqrt(2025.0)"),
        "*PARAMETER_EXPRESSION\nR side,max(90.0, 2.0**3) + (1.0 -\n          1.0)\n",
        "*PARAMETER\nI n,2\n*PARAMETER_EXPRESSION\nR side    45*n^1\n",
    ],
)
def test_parameters_in_every_form(names: str, tmp_path: Path) -> None:
    text = standard()[0].text()
    named = text.replace("      90.0", "     &side", 1).replace("*KEYWORD\n", f"*KEYWORD\n{names}")
    same(tmp_path, named, text)
    same(tmp_path, text.replace("      90.0", "<45.0*2.0>", 1), text)


def test_a_parameter_of_an_included_file_stays_there(tmp_path: Path) -> None:
    text = standard()[0].text()
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "part.k").write_text("*PARAMETER_LOCAL\nR x,1.0\n*PARAMETER\nR side,90.0\n")
    include = "*INCLUDE_PATH_RELATIVE\nsub\n*INCLUDE\npart.k\n"
    named = text.replace("      90.0", "     &side", 1).replace(
        "*KEYWORD\n", f"*KEYWORD\n{include}"
    )
    same(tmp_path, named, text)
    refused(tmp_path, named.replace("&side", "   &x"), "B2: there is no parameter 'x'")


@pytest.mark.parametrize("form", ["R side,{}", "R pi,3.14\n*PARAMETER\nR side,{}"])
def test_a_parameter_of_two_values_is_refused(form: str, tmp_path: Path) -> None:
    """LS-DYNA keeps the first or the last, by *PARAMETER_DUPLICATION; pi is no name of the deck."""
    text = standard()[0].text()
    named = text.replace("      90.0", "     &side", 1)
    first, other = (f"*PARAMETER\n{form.format(value)}\n" for value in (90.0, 45.0))
    same(tmp_path, named.replace("*KEYWORD\n", f"*KEYWORD\n{first}{first}"), text)
    two = named.replace("*KEYWORD\n", f"*KEYWORD\n{first}{other}")
    refused(tmp_path, two, "*PARAMETER side: '45.0' is a second value: side is 90.0 already")


@pytest.mark.parametrize("name", ["sub/ +\npart.k", ".\\sub\\part.k", "sub/pa +\n  rt.k"])
def test_names_of_files_over_two_lines_and_with_slashes_of_windows(
    name: str, tmp_path: Path
) -> None:
    text = standard()[0].text()
    start, end = (text.index(each) for each in ("*BOUNDARY", "*INITIAL"))
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "part.k").write_text(text[start:end])
    same(tmp_path, f"{text[:start]}*INCLUDE\n{name}\n{text[end:]}", text)


def test_a_tab_is_refused_where_columns_are_counted(tmp_path: Path) -> None:
    text = standard()[0].text()
    row = text[text.index("*BOUNDARY") :].splitlines()[1]
    words = "*BOUNDARY_SPC_SET: columns are counted in blanks, of which a tab is none"
    refused(tmp_path, text.replace(row, "\t".join(row.split())), words)
    same(tmp_path, text.replace(row, ",\t".join(row.split())), text)


def test_all_obstacles_are_told_at_once(tmp_path: Path) -> None:
    text = standard()[0].text()
    bad = text.replace("      90.0", "      9O.0", 1)
    bad = bad.replace("*BOUNDARY_SPC_SET\n         1", "*BOUNDARY_SPC_SET\n         4")
    bad = bad.replace("*END", "*ELEMENT_BEAM\n1,1,1,2\n*LOAD_BLAST\n1,2\n*END")
    refused(
        tmp_path,
        bad,
        "B2: '9O.0' was given, a number is needed",
        "NSID: there is no set of nodes 4",
        "*ELEMENT_BEAM: these elements are not translated",
        "*LOAD_BLAST: this load is not translated",
    )


def test_a_blank_last_card_below_a_title_is_a_card(tmp_path: Path) -> None:
    titled = standard()[0].text().replace("*MAT_RIGID\n", "*MAT_RIGID_TITLE\nsteel\n")
    same(tmp_path, titled, standard()[0].text())


@pytest.mark.parametrize("text", [LAYUPS["icomp"], tied("parts"), tiebreak("parts")])
def test_a_deck_that_a_library_of_ansys_has_written_is_the_same(text: str, tmp_path: Path) -> None:
    """The library keeps the first card of plies of a part only; these decks have one at most."""
    from ansys.dyna.core import Deck

    deck = Deck()
    deck.loads(text)
    same(tmp_path, deck.write(), text)


def test_a_long_run_offers_the_implicit_thickness(tmp_path: Path) -> None:
    text = standard()[0].text()
    long = text.replace("*CONTROL_TERMINATION\n    0.0005", "*CONTROL_TERMINATION\n     0.005")
    # a wave crosses 0.125 mm in 0.125/sqrt(10300/1.6e-9) s = 4.9e-8 s; 0.3 of it is a step
    assert any("about 3e+05 steps" in n and "IMPL 2" in n for n in translated(tmp_path, long)[1])
    assert not any("IMPL 2" in n for n in translated(tmp_path, text)[1])


def test_units_are_found_from_the_plies_alone(tmp_path: Path) -> None:
    """The density of a rigid body is often one that gives it its mass."""
    heavy = standard()[0].text().replace("   7.8e-09", "   6.8e-03")
    _, notes = translated(tmp_path, heavy)
    assert any(note.startswith("units mm-s-t, found from the densities") for note in notes)
    named = heavy.replace("*END", "*CONTROL_UNITS\n        mm       sec  mtrc_ton\n*END")
    assert (
        "*CONTROL_UNITS\n$#  length      time      mass\n        mm         s         t"
        in (translated(tmp_path, named)[0])
    )
    refused(tmp_path, named.replace("mtrc_ton", "   stone"), "'stone' is no unit of mass")


@pytest.mark.parametrize("asked", [True, False])
def test_units_that_the_plies_contradict_are_noted(asked: bool, tmp_path: Path) -> None:
    """Toughnesses of the library would be converted to units in which no ply is a solid."""
    text = standard()[0].text()
    units = {"units": "mm,ms,kg"} if asked else {}
    card = "" if asked else "*CONTROL_UNITS\n        mm        ms        kg\n"
    _, notes = translated(tmp_path, text.replace("*END", f"{card}*END"), **units)
    assert any("mm-ms-kg are named, but densities and moduli" in note for note in notes)
    assert any("are those of mm-s-t" in note for note in notes)
    assert not any("are named" in n for n in translated(tmp_path, text, units="mm,s,t")[1])
