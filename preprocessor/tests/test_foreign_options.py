"""Options of keywords of LS-DYNA: taken as they are meant, or refused by their names."""

from __future__ import annotations

from itertools import pairwise
from math import pi, sin, sqrt
from pathlib import Path

import pytest
from foreign_decks import SPEED, Foreign, contact, control, rigid, rim, sphere_profile, standard
from foreign_forms import angles, plain, refused, same, tiebreak, tied, translated, with_more
from test_foreign_bonds import law_of

TEXT = standard()[0].text()
SET = TEXT[TEXT.index("*SET_NODE_LIST") : TEXT.index("*BOUNDARY")]
VELOCITY = TEXT[TEXT.index("*INITIAL_VELOCITY") : TEXT.index("*CONTROL_TERMINATION")]
LAW = TEXT[TEXT.index("*MAT_ENHANCED") : TEXT.index("*NODE", TEXT.index("*MAT_ENHANCED"))]
PART = TEXT[TEXT.index("*PART_INERTIA") : TEXT.index("*CONTACT")]
BRICKS = "1,1.6e-9,153000,10300,10300,.0202,.0202,.4\n6000,3700,6000,{}\n"


@pytest.mark.parametrize(
    "form",
    [
        "*SET_NODE_LIST_GENERATE_INCREMENT\n1\n1,9,1\n73,81,1\n1,73,9\n9,81,9\n",
        SET.replace("LIST", "LIST_COLLECT"),
    ],
)
def test_sets_by_steps_and_sets_that_are_collected(form: str, tmp_path: Path) -> None:
    same(tmp_path, TEXT.replace(SET, form), TEXT)


def test_a_form_that_is_not_translated_is_the_cause(tmp_path: Path) -> None:
    smooth = TEXT.replace(SET, SET.replace("LIST", "LIST_SMOOTH"))
    said = refused(tmp_path, smooth, "NSID: 1 is of *SET_NODE_LIST_SMOOTH (line ")
    assert "there is no set" not in said
    curve = with_more("*DEFINE_CURVE_SMOOTH\n7,,1,1,0,1\n*LOAD_BODY_Z\n7,9810.\n")
    refused(tmp_path, curve, "LCID: 7 is of *DEFINE_CURVE_SMOOTH (line ")


@pytest.mark.parametrize("word", ["COMPOSITE", "TIEBREAK_USER", "LUBRICATION"])
def test_contacts_with_other_options_are_refused(word: str, tmp_path: Path) -> None:
    name = "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE"
    words = f"{word.rpartition('_')[2]} of a contact is not translated"
    refused(tmp_path, TEXT.replace(name, f"{name}_{word}"), words)


@pytest.mark.parametrize(
    ("keyword", "speed"),
    [
        ("*INITIAL_VELOCITY\n77\n0,0,-2000.\n", -3000.0),
        ("*INITIAL_VELOCITY\n77,,,-1\n0,0,-2000.\n", -2000.0),
        ("*INITIAL_VELOCITY\n77,,,5\n0,0,-2000.\n*SET_PART\n5\n9\n", -2000.0),
        ("*INITIAL_VELOCITY_GENERATION\n9,2,,0,0,-2000.\n,,,,,,,1\n", -2000.0),
        ("*INITIAL_VELOCITY_GENERATION\n9,2,,0,0,-2000.\n,\n", -3000.0),
        ("*INITIAL_VELOCITY\n,77,,-1\n0,0,5.\n0,0,-2000.\n", -2000.0),
    ],
)
def test_the_velocity_of_an_inertia_holds_where_nothing_overwrites_it(
    keyword: str, speed: float, tmp_path: Path
) -> None:
    """The last one is that of exempted nodes; 0, 0, 5 is the velocity of the others."""
    own = TEXT.replace(VELOCITY, "*SET_NODE_GENERAL\n77\nPART,9\n")
    own = own.replace("       0.0       0.0       0.0", "       0.0       0.0   -3000.0", 1)
    deck, _ = translated(tmp_path, own.replace("*END", f"{keyword}*END"))
    assert float(deck.split("*IMPACTOR_SPHERE")[1].splitlines()[5].split()[2]) == speed
    assert ("*INITIAL_VELOCITY\n" in deck) == ("5." in keyword)


def test_implicit_solutions_that_are_not_asked_for_have_no_effect(tmp_path: Path) -> None:
    words = "*CONTROL_IMPLICIT_GENERAL\n{},0.001\n*CONTROL_IMPLICIT_AUTO\n0\n"
    same(tmp_path, with_more(words.format(0)), TEXT)
    refused(tmp_path, with_more(words.format(1)), "IMFLAG: 1 is not translated")


def test_the_format_of_an_included_file_ends_with_it(tmp_path: Path) -> None:
    numbers = "".join(f"{n:>20}" for n in (1, 2))
    (tmp_path / "set.k").write_text(f"*KEYWORD LONG=Y\n*SET_NODE_LIST\n{55:>20}\n{numbers}\n*END\n")
    same(tmp_path, TEXT.replace("*KEYWORD\n", "*KEYWORD\n*INCLUDE\nset.k\n"), TEXT)


def test_a_part_with_a_contact_card_and_a_mass_in_grams(tmp_path: Path) -> None:
    old = "        16     0.833       0.0\n"
    assert old in TEXT
    other = TEXT.replace("*PART_COMPOSITE\n", "*PART_COMPOSITE_CONTACT\n")
    same(tmp_path, other.replace(old, f"{old}{0.2:>10}{0.2:>10}\n"), TEXT)
    refused(tmp_path, other.replace(old, f"{old}{'':40}{0.5:>10}\n"), "OPTT: 0.5 is not translated")
    units = translated(tmp_path, with_more("*CONTROL_UNITS\nmm,ms,gram\n"))[0]
    assert "        mm        ms         g\n" in units


def mass_of(deck: str) -> float:
    """The mass of the impactor."""
    rows = deck.split("*IMPACTOR_SPHERE_TITLE")[1].splitlines()
    return float(rows[3].split()[2])


def test_masses_that_are_added_to_an_impactor(tmp_path: Path) -> None:
    bare = TEXT.replace(PART, "*PART\nball\n         9         9         9\n")
    own = mass_of(translated(tmp_path, bare)[0])
    for words, mass in (
        ("*ELEMENT_MASS_PART\n       9                          2.0e-4\n", 2.0e-4),
        ("*ELEMENT_MASS_PART\n9,1.0e-4\n", own + 1.0e-4),
        ("*ELEMENT_MASS\n501,100,1.0e-4\n502,101,2.0e-4\n", own + 3.0e-4),
    ):
        deck, _ = translated(tmp_path, bare.replace("*END", f"{words}*END"))
        assert mass_of(deck) == pytest.approx(mass, rel=1e-9)
    refused(tmp_path, with_more("*ELEMENT_MASS\n501,100,1.0e-4\n"), "*PART_INERTIA is TM alone")
    plate = "*ELEMENT_MASS\n501,100,1.0e-4\n502,41,1.0e-4\n"
    refused(tmp_path, bare.replace("*END", f"{plate}*END"), "NID: a mass that is added to no rigid")


def ball_of_tetrahedra(ten: bool) -> tuple[str, float]:
    """A deck with a ball of tetrahedra around its centre, and its volume.

    Between two rings of n nodes is a frustum over regular polygons of area n r^2 sin(2 pi/n)/2.
    """
    deck = Foreign(standard()[0].text().split("*NODE")[0].splitlines())
    plate = deck.layer()
    deck.quads(1, plate)
    around, half = 12, [*sphere_profile(0.25)[:-1]]
    centre = 0.25 + 0.1 + 8.0
    profile = [(0.0, 0.35), *half[1:], (8.0, centre)]
    profile += [(r, 2.0 * centre - z) for r, z in profile[-2::-1]]
    rings = []
    for r, z in profile:
        count = around if r else 1
        places = [
            (20.0 + r * sin(2 * pi * i / count), 20.0 + r * sin(2 * pi * (i / count + 0.25)), z)
            for i in range(count)
        ]
        rings.append(deck.nodes(places) * (around // count))
    (middle,) = deck.nodes([(20.0, 20.0, centre)])
    deck.lines.append("*ELEMENT_SOLID")
    for low, high in pairwise(rings):
        for i in range(around):
            j = (i + 1) % around
            for face in ((low[i], low[j], high[j]), (low[i], high[j], high[i])):
                if len(set(face)) == 3:
                    deck.element += 1
                    ids = [*face, *[middle] * (1 if ten else 5)]
                    head = f"{deck.element:8d}{9:8d}"
                    deck.lines.append(head)
                    row = "".join(f"{n:8d}" for n in [*ids, *[0] * (6 if ten else 0)])
                    deck.lines += [row] if ten else []
                    deck.lines[-1] += "" if ten else row
    areas = [around * r * r * sin(2 * pi / around) / 2.0 for r, _ in profile]
    steps = [b[1] - a[1] for a, b in pairwise(profile)]
    pairs = zip(areas, areas[1:], steps, strict=False)
    volume = sum(h / 3.0 * (a + b + sqrt(a * b)) for a, b, h in pairs)
    deck.put("PART", "ball", (9, 8, 9))
    deck.put("SECTION_SOLID", (8, 10))
    deck.put("MAT_RIGID", (9, 7.8e-9, 210000.0, 0.3), (1.0, 4.0, 7.0), (None,))
    part = TEXT[TEXT.index("*PART_COMPOSITE") : TEXT.index("*NODE", TEXT.index("*MAT_ENHANCED"))]
    deck.lines += part.splitlines()
    contact(deck, 1, 9)
    deck.set_of("SET_NODE_LIST", 1, rim(plate))
    deck.put("BOUNDARY_SPC_SET", (1, 0, 1, 1, 1))
    deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0, 0, -SPEED))
    control(deck)
    return deck.text(), volume


@pytest.mark.parametrize("ten", [False, True])
def test_a_ball_of_tetrahedra_has_the_mass_of_its_polyhedron(ten: bool, tmp_path: Path) -> None:
    text, volume = ball_of_tetrahedra(ten)
    deck, _ = translated(tmp_path, text)
    assert mass_of(deck) == pytest.approx(7.8e-9 * volume, rel=1e-5)  # six digits are written
    assert 0.8 < volume / (4.0 / 3.0 * pi * 8.0**3) < 1.0


def bricks(law: str, order: tuple[int, ...] = tuple(range(8)), ten: bool = False) -> str:
    """A deck of two layers of bricks, whose nodes are in some order."""
    deck = Foreign()
    layers = [deck.layer(0.25 * k) for k in range(3)]
    for k in range(2):
        deck.quads(k + 1, layers[k], layers[k + 1], name="ELEMENT_SOLID")
        deck.put("PART", f"ply {k}", (k + 1, 1, 1))
    deck.put("SECTION_SOLID", (1, 1))
    deck.lines += law.splitlines()
    deck.revolved(9, sphere_profile(0.5))
    rigid(deck)
    contact(deck, 2, 9)
    deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0, 0, -SPEED))
    control(deck)
    lines, solid = [], False
    for line in deck.text().splitlines():
        solid = line.startswith("*ELEMENT_SOLID") if line.startswith("*") else solid
        if line.startswith("*") or not solid:
            lines.append(f"{line} (ten nodes format)" if solid and ten else line)
            continue
        ids = "".join(line[16 + 8 * k : 24 + 8 * k] for k in order)
        lines += [line[:16], f"{ids}       0       0"] if ten else [line[:16] + ids]
    return "\n".join(lines) + "\n"


def law(aopt: str, axes: str = ",,,\n,,,\n") -> str:
    """A law of plies of bricks."""
    return f"*MAT_002\n{BRICKS.format(aopt)}{axes}"


UP, DOWN, SIDE = tuple(range(8)), (4, 5, 6, 7, 0, 1, 2, 3), (0, 1, 5, 4, 3, 2, 6, 7)


def test_bricks_in_the_format_of_ten_nodes(tmp_path: Path) -> None:
    own = bricks(law("2", ",,,1,0,0\n,,,0,1,0\n"))
    same(tmp_path, bricks(law("2", ",,,1,0,0\n,,,0,1,0\n"), ten=True), own)


def test_the_axes_of_bricks_follow_their_nodes(tmp_path: Path) -> None:
    """The normal of v x n is that from nodes 1 to 4 to nodes 5 to 8, about which BETA turns."""
    about = law("3", ",,,\n0,1,0,,,,30\n")
    assert angles(translated(tmp_path, bricks(about, UP))[0]) == [30.0, 30.0]
    assert angles(translated(tmp_path, bricks(about, DOWN))[0]) == [-30.0, -30.0]
    refused(tmp_path, bricks(about, SIDE), "AOPT: 3: nodes 1 to 4 of a brick do not lie along")
    assert angles(translated(tmp_path, bricks(law("0"), UP))[0]) == [0.0, 0.0]
    refused(tmp_path, bricks(law("0"), SIDE), "AOPT: 0: nodes 1 to 4 of a brick do not lie along")
    along = law("2", ",,,1,0,0\n,,,0,0,1\n")
    refused(tmp_path, bricks(along), "D3: vector d of a brick must lie in the plate")
    changed = "*MAT_022\n" + BRICKS.format("0,2,2") + ",,,1,0,0\n,,,0,1,0\n90,2500,80,230\n"
    refused(tmp_path, bricks(changed), "MACF: 2: axes that change places are not translated")


def test_options_of_tiebreaks_have_their_own_meaning(tmp_path: Path) -> None:
    name = "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK"
    assert plain(translated(tmp_path, tiebreak("parts", name, (1,)))[0]) == plain(
        translated(tmp_path, tied("parts"))[0]
    )
    said = refused(tmp_path, tiebreak("parts", name, (4, 60.0, 90.0)), "4 is not translated; 1, 2,")
    assert "joins no two neighbours" not in said
    first, second = law_of(translated(tmp_path, tiebreak("parts", name, TEN))[0])
    assert (first[6:], second[0:3]) == ([0.3, 0.8], [1.0, 60.0, 90.0])
    steep = (*TEN[:3], 30.0, *TEN[4:])
    refused(tmp_path, tiebreak("parts", name, steep), "PARAM: a shear strength that grows with")
    curve = "*DEFINE_CURVE\n7\n0,1\n0.01,0\n*END"
    text = tiebreak("parts", name, (5, 60.0, 7, 0, 0, 0, 0.4, 1.0e5)).replace("*END", curve)
    first, second = law_of(translated(tmp_path, text)[0])
    # 60 falls to 0 over 0.01; von Mises' stress of shear is the root of 3 times as large
    assert first[6:] == pytest.approx([0.3, 0.3 / sqrt(3.0)])
    assert second[1:3] == pytest.approx([60.0, 60.0 / sqrt(3.0)])


TEN = (10, 60.0, 90.0, 0.0, 0.3, 0.8, 0.4, 1.0e5)


def shear_of(deck: str) -> tuple[list[float], list[list[float]]]:
    """Shear kind, coefficient and exponent of the ply, and the points of its curve."""
    rows = deck.split("*MAT_PLY_CODAM2")[1].split("\n*")[0].splitlines()
    card = next(row for at, row in enumerate(rows) if "shear" in rows[at - 1])
    kind, lcid, _, *power = (float(word) for word in card.split())
    if not lcid:
        return [kind, *power], []
    points = deck.split(f"\ncurve {lcid:g}\n")[1].split("*")[0].splitlines()[3:]
    return [kind, *power], [[float(word) for word in row.split()] for row in points]


PLY = "1,1.6e-9,153000,10300,10300,.0202,.0202,.4\n6000,3700,6000,"
AXES = ",,,1,0,0\n,,,0,1,0\n"
CURVE = "*DEFINE_CURVE\n5\n0,0\n.01,48\n.03,90\n"


@pytest.mark.parametrize(
    ("name", "cards", "kind", "points"),
    [
        (
            *("054", f"{PLY},2\n{AXES}0,2e-8\n1500,2500,230,80,90,54\n"),
            *([3.0, 2e-8, 3.0], []),
        ),
        (
            *("261", f"{PLY}2\n{AXES}61,205,.3,1.3,.8\n1500,2500,230,80,90\n53,30,5\n{CURVE}"),
            *([2.0, 0.0, 0.0], [[0, 0], [0.01, 48], [0.03, 90]]),
        ),
        (
            *("262", f"{PLY}2\n{AXES}61,205,1.3,.3,.8\n1500,2500,230,80,90\n53,30,2000\n"),
            # yields at 30/6000 and hardens by 2000 up to 90
            *([2.0, 0.0, 0.0], [[0, 0], [0.005, 30], [0.035, 90]]),
        ),
        (
            "058",
            "1,1.6e-9,153000,10300,10300,.0202,45,.0076\n6000,3700,6000,.1,1,.1,1,1\n2,,,,-1\n"
            ",,,1,0,0,.0202,.4\n,,,0,1,0\n.01,.017,.03,.01,.05\n1500,2500,230,80,90\n",
            *([2.0, 0.0, 0.0], [[0, 0], [0.0076, 45], [0.05, 90]]),
        ),
    ],
)
def test_nonlinear_shear_arrives(
    name: str, cards: str, kind: list[float], points: list[list[float]], tmp_path: Path
) -> None:
    deck, _ = translated(tmp_path, TEXT.replace(LAW, f"*MAT_{name}\n{cards}"))
    found = shear_of(deck)
    assert found[0] == kind
    assert len(found[1]) == len(points)
    for own, expected in zip(found[1], points, strict=True):
        assert own == pytest.approx(expected)


def test_a_coefficient_of_shear_in_another_unit_is_noted(tmp_path: Path) -> None:
    cards = f"{PLY},2\n{AXES}0,0.3\n1500,2500,230,80,90,54\n"
    deck, notes = translated(tmp_path, TEXT.replace(LAW, f"*MAT_054\n{cards}"))
    assert shear_of(deck) == ([0.0, 0.0, 0.0], [])
    words = "ALPH 0.3 is left out, and shear is linear: it makes a strain of 2.19e+05"
    assert any(words in note for note in notes)


def test_fibres_that_soften_on_two_lines_are_refused(tmp_path: Path) -> None:
    cards = f"{PLY}2\n{AXES}61,205,1.3,.3,.8,20,50\n1500,2500,230,80,90,800,1000\n53\n"
    words = "GXTO: fibres that soften on two lines are not translated"
    refused(tmp_path, TEXT.replace(LAW, f"*MAT_262\n{cards}"), words)
