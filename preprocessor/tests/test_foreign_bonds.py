"""Contacts that bond plies, in every form."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from foreign_decks import Foreign, contact, standard
from foreign_forms import (
    SIDES,
    TIEBREAK,
    plain,
    refused,
    same,
    stacked,
    tiebreak,
    tied,
    translated,
)
from user_decks import cohesive


@pytest.mark.parametrize("kind", SIDES[1:])
def test_a_tiebreak_by_any_sides(kind: str, tmp_path: Path) -> None:
    same(tmp_path, tiebreak(kind), tiebreak("parts"))


@pytest.mark.parametrize(
    "name",
    [
        f"{TIEBREAK}_MORTAR",
        f"{TIEBREAK}_SMOOTH",
        "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK",
        "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK_MORTAR",
        "CONTACT_AUTOMATIC_SINGLE_SURFACE_TIEBREAK",
    ],
)
def test_a_tiebreak_by_any_name(name: str, tmp_path: Path) -> None:
    if "SINGLE" in name:
        text = tiebreak("part sets", name).replace(
            "SET_PART_LIST\n        11\n         1",
            "SET_PART_LIST\n        11\n         1         2",
        )
        same(tmp_path, text, tiebreak("parts"))
        return
    same(tmp_path, tiebreak("parts", name), tiebreak("parts"))


def test_the_cards_of_mpp_and_of_the_number_are_in_front(tmp_path: Path) -> None:
    text = tiebreak("parts").replace(
        f"*{TIEBREAK}\n", f"*{TIEBREAK}_MPP_ID\n7,glue\n0,200,,3,2,1.0005\n& 1,1\n"
    )
    same(tmp_path, text, tiebreak("parts"))
    one = tiebreak("parts").replace(f"*{TIEBREAK}\n", f"*{TIEBREAK}_ID_MPP\n7,glue\n0,200\n")
    same(tmp_path, one, tiebreak("parts"))


def law_of(deck: str) -> list[list[float]]:
    """The numbers of the first bond of a deck."""
    rows = re.search(r"\*MAT_COHESIVE_MIXED_MODE_TITLE\+?\n.*\n\$.*\n(.*)\n\$.*\n(.*)", deck)
    assert rows
    return [[float(word) for word in row.split()] for row in rows.groups()]


@pytest.mark.parametrize(
    ("card", "energies"),
    [
        ((7, 60.0, 90.0, 0.0, 0.3, 0.8, 0.4, 1.0e5), (0.3, 0.8)),
        ((9, 60.0, 90.0, 1.0, 0.3, 0.8, 0.4, 1.0e5), (0.3, 0.8)),
        ((11, 60.0, 90.0, 1.0, 0.3, 0.8, 0.4, 1.0e5), (0.3, 0.8)),
        ((6, 60.0, 90.0, 0.02, 0.0, 0.0, 0.4, 1.0e5), (0.6, 0.9)),
        ((8, 60.0, 90.0, 0.02, 0.0, 0.0, 0.4, 1.0e5), (0.6, 0.9)),
        ((2, 60.0, 90.0, 0.0, 0.0, 0.0, 0.4, 1.0e5), (1.05 * 0.018, 1.05 * 0.10125)),
    ],
)
def test_every_option_of_failure_keeps_strength_and_energy(
    card: tuple[float, ...], energies: tuple[float, float], tmp_path: Path
) -> None:
    first, second = law_of(translated(tmp_path, tiebreak("parts", TIEBREAK, card))[0])
    # stiffness CN and CN CT2CN; the energy at the strength is 60^2/(2 CN) and 90^2/(2 CN CT2CN)
    assert first[4:6] == [1.0e5, 4.0e4]
    assert first[6:] == pytest.approx(energies, rel=1e-12)
    assert second[1:3] == [60.0, 90.0]


def test_the_classic_tiebreak_breaks_at_its_strengths(tmp_path: Path) -> None:
    name = "CONTACT_TIEBREAK_SURFACE_TO_SURFACE"
    deck, notes = translated(tmp_path, tiebreak("parts", name, (60.0, 90.0, 2.0, 2.0)))
    first, second = law_of(deck)
    assert second[1:3] == [60.0, 90.0]
    assert first[4] == 50.0 * 10300.0 / 0.25
    assert first[6] == pytest.approx(1.05 * 60.0**2 / (2.0 * first[4]))
    assert any("a bond that breaks at once" in note for note in notes)
    nodes = "CONTACT_TIEBREAK_NODES_TO_SURFACE"
    same(
        tmp_path,
        tiebreak("nodes", nodes, (60.0, 90.0, 2.0, 2.0)),
        tiebreak("parts", name, (60.0, 90.0, 2.0, 2.0)),
    )
    words = "NEN: 1 is not translated"
    refused(tmp_path, tiebreak("parts", nodes, (60.0, 90.0, 1.0, 2.0)), words)


@pytest.mark.parametrize("kind", SIDES)
def test_tied_parts_share_their_points(kind: str, tmp_path: Path) -> None:
    deck, _ = translated(tmp_path, tied(kind))
    assert "INTERFACE_COHESIVE" not in deck
    whole = standard()[0].text()
    assert (
        plain(deck).split("*NODE")[0].split("*IMPACTOR")[0]
        == plain(translated(tmp_path, whole)[0]).split("*NODE")[0].split("*IMPACTOR")[0]
    )


@pytest.mark.parametrize(
    "name",
    [
        "CONTACT_TIED_SURFACE_TO_SURFACE",
        "CONTACT_TIED_NODES_TO_SURFACE_OFFSET",
        "CONTACT_TIED_SHELL_EDGE_TO_SURFACE_CONSTRAINED_OFFSET",
        "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIED",
        "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_MORTAR_TIED",
        "CONTACT_TIED_SURFACE_TO_SURFACE_MPP",
    ],
)
def test_tied_by_any_name(name: str, tmp_path: Path) -> None:
    text = tied("parts", name)
    text = text.replace(
        "*CONTACT_TIED_SURFACE_TO_SURFACE_MPP\n", "*CONTACT_TIED_SURFACE_TO_SURFACE_MPP\n0,200\n"
    )
    same(tmp_path, text, tied("parts"))


def test_a_bond_of_a_part_of_a_face_and_one_of_nothing_are_refused(tmp_path: Path) -> None:
    text = tied("segments")
    at = text.index("*SET_SEGMENT")
    lines = text[at:].splitlines()
    cut = text[:at] + "\n".join(lines[:2] + lines[10:])
    refused(tmp_path, cut, "SSID: it joins 56 of 64 faces")
    lonely = tied("parts").replace(
        "         1         2         3         3", "         1         1         3         3"
    )
    said = refused(tmp_path, lonely, "SSID MSID: joins no two neighbours of the stack of plies")
    line = lonely[: lonely.index("*CONTACT_TIED")].count("\n") + 1
    assert f"user.k:{line}: *CONTACT_TIED" in said


def test_a_contact_of_plies_alone_has_no_effect(tmp_path: Path) -> None:
    """Bodies that it should join with something else than the plate are refused."""
    own = "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n1,0,3,0\n0.2,0.2\n,\n*END"
    text = standard()[0].text()
    same(tmp_path, text.replace("*END", own), text)
    other = own.replace("1,0,3,0", "9,0,3,0")
    refused(tmp_path, text.replace("*END", other), "it joins no rigid body with the plate")


def test_a_contact_that_begins_late_and_a_box_are_refused(tmp_path: Path) -> None:
    text = standard()[0].text()
    card = "         1         9         3         3\n       0.2       0.2"
    assert card in text
    late = text.replace(card, card + " " * 40 + "    1.0e-4")
    refused(tmp_path, late, "BT: a contact that begins later is not translated")
    box = text.replace(card, card.replace("3         3\n", "3         3         7\n"))
    refused(tmp_path, box, "SBOXID: a box that cuts a contact is not translated")
    ever = text.replace(card, card + " " * 50 + "    1.0e20")
    same(tmp_path, ever, text)


LAW = "*MAT_COHESIVE_MIXED_MODE\n11,0,0,1,1.0e6,5.0e5,0.28,0.79\n-1.634,62.3,92.3\n"
CURVES = "*DEFINE_CURVE\n5\n0,0\n0.1,1\n0.6,1\n1,0\n*DEFINE_CURVE\n6\n0,0\n0.5,1\n1,0\n"


def glued(law: str) -> str:
    """Plies with layers of bricks between them of another law."""
    text = cohesive("comma")
    start = text.index("*MAT_COHESIVE")
    return text[:start] + law + text[text.index("\n*", start) + 1 :]


@pytest.mark.parametrize(("kind", "exponent"), [(0, 1.5), (1, -1.5), (2, 1.0)])
def test_a_curve_mixes_modes_by_its_separation(kind: int, exponent: float, tmp_path: Path) -> None:
    """TES 0 is the power law, 1 that of Benzeggagh and Kenane.

    TES 2 has one separation over both of failure, so that the shares of the energies add up to 1.
    """
    law = f"*MAT_186\n11,0,0,1,{kind},5,0.3,0.8\n1.5,60.,90.\n{CURVES}"
    assert law_of(translated(tmp_path, glued(law))[0])[1][0] == exponent


def test_a_second_curve_is_that_of_sliding(tmp_path: Path) -> None:
    """The first slope is that of the curve times its area, times strength^2 over the energy."""
    law = f"*MAT_186\n11,0,0,1,0,5,0.3,0.8\n1.,60.,90.,0,6\n{CURVES}"
    first, _ = law_of(translated(tmp_path, glued(law))[0])
    assert first[4] == pytest.approx(10.0 * 0.75 * 60.0**2 / 0.3)
    assert first[5] == pytest.approx(2.0 * 0.5 * 90.0**2 / 0.8)


def test_an_exponent_of_one_is_the_law_of_benzeggagh_and_kenane(tmp_path: Path) -> None:
    law = LAW.replace("62.3,92.3", "62.3,92.3,,,1.0")
    same(tmp_path, glued(law), glued(LAW))


@pytest.mark.parametrize(
    ("gap", "words"),
    [
        (0.29, "part 2 begins 0.04 above part 1; it is put onto it, so that the plate is thinner"),
        (0.2, "part 2 begins 0.05 inside part 1; it is put onto it, so that the plate is thicker"),
        (0.25, ""),
    ],
)
def test_halves_that_do_not_lie_on_each_other_are_noted(
    gap: float, words: str, tmp_path: Path
) -> None:
    """Shells of 0.25 each lie on each other where their middles are 0.25 apart."""
    _, notes = translated(tmp_path, stacked(bonded, gap)[0])
    assert [words] * bool(words) == [note[: len(words)] for note in notes if "begins" in note]


def bonded(deck: Foreign, *_: object) -> None:
    """A tiebreak contact between two parts."""
    contact(deck, 1, 2, "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK", (9, 60, 90, 1, 0.3, 0.8))


def test_halves_that_are_far_apart_are_refused(tmp_path: Path) -> None:
    far = stacked(bonded, 2.0)[0]
    refused(tmp_path, far, "PID: part 2 begins 1.75 above part 1, further than it is thick")
