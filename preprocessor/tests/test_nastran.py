"""Bulk data of Nastran: forms that say the same, and what is refused."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path

import pytest
from foreign_decks import rim
from models_of_others import numbers, refused_model, translated_model
from nastran_decks import ANGLES, END, Layout, Nastran, law, standard

NAME = "user.bdf"
translated, refused = partial(translated_model, NAME), partial(refused_model, NAME)


def plies(cards: dict[str, list[str]]) -> list[tuple[float, float]]:
    """Thickness and angle of the plies."""
    return [(row[1], row[2]) for row in numbers(cards["PART_COMPOSITE_LONG"])[1:]]


def test_a_plate_of_shells_below_a_ball(tmp_path: Path) -> None:
    cards, page = translated(tmp_path, standard())
    assert plies(cards) == [(0.125, angle) for angle in ANGLES]
    constants = numbers(cards["MAT_PLY_ELASTIC_TITLE+"])
    assert constants[0][1:5] == [1.6e-9, 153000.0, 10300.0, 10300.0]
    # nu23 = E2/(2 G23) - 1
    assert constants[0][5:] == pytest.approx([0.300058, 0.300058, 10300.0 / 7400.0 - 1.0])
    assert constants[1] == [6000.0, 6000.0, 3700.0]
    place, motion = numbers(cards["IMPACTOR_SPHERE_TITLE"])
    assert place[1:5] == pytest.approx([8.0, 2.0e-4, 20.0, 20.0], abs=1e-4)
    assert motion[:4] == [0.0, 0.0, -4000.0, 1.0]
    assert numbers(cards["CONTACT_IMPACTOR"])[1] == [0.2, 0.2, 0.0]
    assert numbers(cards["BOUNDARY_SPC_SET"])[0][2:5] == [1.0, 1.0, 1.0]
    assert numbers(cards["CONTROL_TERMINATION"])[0][0] == pytest.approx(END)
    assert "### PCOMP, line" in page and "result of Nastran" in page


@pytest.mark.parametrize("layout", ["large", "comma"])
def test_a_file_is_the_same_in_every_layout(layout: Layout, tmp_path: Path) -> None:
    assert translated(tmp_path, standard(layout))[0] == translated(tmp_path, standard())[0]


def test_strengths_need_fracture_energies(tmp_path: Path) -> None:
    text = standard("comma", 1500.0, 1200.0, 50.0, 200.0, 75.0)
    refused(tmp_path, text, "MAT8 XT XC YT YC S: its card has no fracture energy")
    cards, _ = translated(tmp_path, text, like="IM7/8552")
    rows = numbers(cards["MAT_PLY_CODAM2_TITLE+"])
    assert rows[2][:5] == [1500.0, 1200.0, 50.0, 200.0, 75.0]
    assert rows[3][:2] == [205.0, 61.0]
    # a blank strength of compression is that of tension
    tension = standard("comma", 1500.0, "", 50.0, "", 75.0)
    rows = numbers(translated(tmp_path, tension, like="IM7/8552")[0]["MAT_PLY_CODAM2_TITLE+"])
    assert rows[2][:5] == [1500.0, 1500.0, 50.0, 50.0, 75.0]


def plate(
    angles: tuple[float, ...], *more: float | str, lam: str = "", z0: float | str = ""
) -> str:
    """A plate with its plies and what its elements add."""
    deck = Nastran("comma")
    ids = deck.layer()
    deck.quads(1, ids, *more)
    rows = [word for angle in angles for word in (1, 0.125, angle, "YES")]
    deck.put("PCOMP", 1, z0, "", "", "", "", "", lam, *rows)
    law(deck)
    deck.ball()
    deck.put("SPC1", 1, 123456, *rim(ids))
    deck.put("TSTEPNL", 3, 100, END / 100, 1)
    deck.put("CORD2R", 5, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0)
    return deck.text()


def test_symmetric_plies_and_the_axes_of_elements(tmp_path: Path) -> None:
    cards, _ = translated(tmp_path, plate((0.0, 90.0), lam="SYM"))
    assert plies(cards) == [(0.125, angle) for angle in ANGLES]
    cards, _ = translated(tmp_path, plate((0.0, 45.0), 30.0))
    assert [angle for _, angle in plies(cards)] == pytest.approx([30.0, 75.0])
    # a whole number is a coordinate system, whose first axis is along y
    cards, _ = translated(tmp_path, plate((0.0, 45.0), 5))
    assert [angle for _, angle in plies(cards)] == pytest.approx([90.0, -45.0])


def test_an_offset_moves_the_plate(tmp_path: Path) -> None:
    """The bottom face at the nodes: the ball 0.25 above begins 0.02 + 0.125 from the top face."""
    cards, _ = translated(tmp_path, plate((0.0, 90.0), z0=0.0))
    assert {float(row[40:56]) for row in cards["NODE"]} == {0.125}
    cards, _ = translated(tmp_path, plate((0.0, 90.0), 0.0, -0.125))
    assert {float(row[40:56]) for row in cards["NODE"]} == {-0.125}


def test_quads_of_eight_nodes_keep_their_edges(tmp_path: Path) -> None:
    """The middle of the first edge is 0.3 inside: the new node is there, too."""
    deck = Nastran("comma")
    ids = deck.layer()
    middles: dict[frozenset[int], int] = {}
    places = {n: (5.0 * (k % 9), 5.0 * (k // 9)) for k, n in enumerate(ids)}

    def between(a: int, b: int) -> int:
        if frozenset((a, b)) not in middles:
            x, y = (0.5 * (places[a][i] + places[b][i]) for i in (0, 1))
            y += 0.3 if (a, b) == (1, 2) else 0.0
            middles[frozenset((a, b))] = deck.nodes([(x, y, 0.0)])[0]
        return middles[frozenset((a, b))]

    for k, low in enumerate(ids[:-10]):
        if k % 9 != 8:
            quad = [low, low + 1, low + 10, low + 9]
            ring = [between(a, b) for a, b in zip(quad, quad[1:] + quad[:1], strict=True)]
            deck.element += 1
            deck.put("CQUAD8", deck.element, 1, *quad, *ring)
    deck.put("PSHELL", 1, 1, 0.5, 1)
    law(deck)
    deck.ball()
    deck.put("SPC1", 1, 123456, *rim(ids))
    deck.put("TSTEPNL", 3, 100, END / 100, 1)
    cards, _ = translated(tmp_path, deck.text())
    found = {(float(row[8:24]), float(row[24:40])) for row in cards["NODE"]}
    assert {(2.5, 0.3), (2.5, 2.65)} <= found and (2.5, 0.0) not in found
    assert len(found) == 17 * 17


def test_masses_are_multiplied_by_wtmass(tmp_path: Path) -> None:
    text = standard("comma").replace("BEGIN BULK", "BEGIN BULK\nPARAM,WTMASS,0.5")
    cards, page = translated(tmp_path, text)
    assert page.count("all densities and masses are multiplied by WTMASS") == 1
    assert numbers(cards["IMPACTOR_SPHERE_TITLE"])[0][2] == 1.0e-4
    assert numbers(cards["MAT_PLY_ELASTIC_TITLE+"])[0][1] == 8.0e-10


def test_masses_of_a_body_add_up_with_their_inertia(tmp_path: Path) -> None:
    text = re.sub(r"(?m)^SPC1,1,12456,.*\n", "", standard("comma"))
    mass = re.search(r"(?m)^CONM2,5002,(\d+),0,.*\n", text)
    assert mass is not None
    both = "".join(
        f"CONM2,{5002 + k},{mass[1]},0,{m},,,,,+\n+,{inertia}\n"
        for k, (m, inertia) in enumerate([("1.-4", "3.-3"), ("3.-4", "4.-3")])
    )
    cards, _ = translated(tmp_path, text.replace(mass[0], both))
    ball = numbers(cards["IMPACTOR_SPHERE_TITLE"])
    assert ball[0][2] == pytest.approx(4.0e-4)
    assert 7.0e-3 in [number for row in ball for number in row]


def test_contacts_by_a_table(tmp_path: Path) -> None:
    table = (
        "BCTABLE,1,,,1,,,,,\n,SLAVE,7,,,0.3,,,\n,MASTERS,8\n"
        "BCBODY,8,3D,RIGID,8\nBSURF,7,1,THRU,64\nBSURF,8,65,THRU,136\nTSTEPNL"
    )
    text = standard("comma").replace("BCONTACT = ALLBODY", "BCONTACT = 1")
    text = text.replace("TSTEPNL,", f"{table},", 1)
    cards, _ = translated(tmp_path, text)
    assert numbers(cards["CONTACT_IMPACTOR"])[1] == [0.3, 0.3, 0.0]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("CQUAD4,1,1,1,2,11,10", "CQUAD4,1,1,1,2,11,999", "CQUAD4 G4: there is no node 999"),
        ("CQUAD4,1,1,1,2,11,10", "CBAR,1,1,1,2", "CBAR: these elements are not translated"),
        ("CQUAD4,1,1,1,2,11,10", "CTRIA3,1,1,1,2,11", "element 1 is a triangle"),
        ("CQUAD4,1,1,1,2,11,10", "CQUAD4,1,3,1,2,11,10", "there is no PCOMP, PSHELL or PSOLID 3"),
        ("CQUAD4,1,1,1,2,11,10", "CQUAD4,1,1,1,2,11,10,20.", "CQUAD4 THETA: the axis of element"),
        ("MAT8,1,", "MAT8,2,", "there is no material 1"),
        ("MAT8,1,153000.", "MAT8,1,15E", "MAT8 E1: '15E' was given, a number is needed"),
        ("TSTEPNL,3", "RLOAD1,7\nTSTEPNL,3", "RLOAD1: a load over frequencies"),
        ("TSTEPNL,3", "TSTEPNL,4", "TSTEPNL or TSTEP is missing"),
        ("TIC,2,166,3", "TIC,2,166,6", "TIC C: a rotation at time zero"),
        ("TIC,2,166,3", "TIC,2,999,3", "TIC G: there is no node 999"),
        (
            "CONM2,5002",
            "FORCE,9,41,0,1.,0.,0.,1.\nCONM2,5002",
            "FORCE SID: LOAD of the case control",
        ),
        ("RBE2,5001,166,123456", "RBE2,5001,166,123", "RBE2 CM: 123 is not translated"),
        ("MAT1,9,210000.", "MAT9,1,2.\nMAT1,9,210000.", "MAT9: this keyword is not translated"),
        ("PCOMP,1,,,,", "PCOMP,1,,0.1,,", "PCOMP NSM: is not translated"),
        ("SPC1,1,123456", "SPC1,1,7", "SPC1 C: 7 are no directions"),
        ("GRID,1,,0.", "GRID,1,5,0.", "GRID CP: coordinates in a system of their own"),
        ("SPC1,1,123456,1,2,3,4,5,6", "SPC1,1,123456,1,2,3,4,5,6,7", "'7' is a field too many"),
        ("MAT1,9,", "MAT1,8,1.e4,1.e4,0.3\nPSHELL,1,8,0.5,8\nMAT1,9,", "MAT1 G: with E and NU"),
        ("CONM2,5002,", "CONM2,5003,41,0,1.-6\nCONM2,5002,", "CONM2 G: a mass that is added to no"),
        ("PCOMP,1,,,,,,,\n", "PSHELL,1,1,0.5\n$", "PSHELL MID2: a membrane, which does not bend"),
    ],
)
def test_what_is_not_taken_is_refused_with_its_line(
    old: str, new: str, words: str, tmp_path: Path
) -> None:
    text = standard("comma")
    assert old in text
    said = refused(tmp_path, text.replace(old, new, 1), words)
    assert "user.bdf is a deck of Nastran" in said
    assert re.search(r"user\.bdf:\d+: [A-Z]", said) or "is missing" in said


def test_every_entry_is_on_the_page(tmp_path: Path) -> None:
    _, page = translated(tmp_path, standard())
    names = set(re.findall(r"(?m)^### (\S+?), line", page))
    executive = {"SOL", "CEND", "TITLE", "SPC", "IC", "TSTEPNL", "BCONTACT"}
    bulk = {"GRID", "CQUAD4", "PCOMP", "MAT8", "PSHELL", "MAT1", "RBE2", "CONM2", "SPC1", "TIC"}
    assert names == executive | bulk | {"BCBODY"}
    rows = re.findall(r"(?m)^\| (?!field|---).*\|$", page)
    assert all(re.search(r"\| (taken|replaced|no effect here)[^|]*\|$", row) for row in rows)


def test_plies_with_global_numbers_are_plies(tmp_path: Path) -> None:
    text = standard("comma")
    first = text.index("PCOMP,1,")
    last = text.index("MAT8,1,")
    rows = [
        f",{90 + n},1,{t},{a},YES"
        for n, (t, a) in enumerate(zip(("0.125", "", "", ""), ANGLES, strict=True))
    ]
    own = "\n".join(["PCOMPG,1,-0.25", *rows, ""])
    cards, _ = translated(tmp_path, text[:first] + own + text[last:])
    assert plies(cards) == [(0.125, angle) for angle in ANGLES]
    refused(tmp_path, text[:first] + "PCOMPG,1,,0.1\n" + rows[0] + "\n" + text[last:], "PCOMPG NSM")
