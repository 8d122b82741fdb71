"""Input files of Abaqus: forms that say the same, and what is refused."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path

import pytest
from abaqus_decks import ANGLES, ENGINEERING, HASHIN, LAMINA, Abaqus, stacked, standard
from cae_deck import cae
from models_of_others import numbers, refused_model, translated_model

NAME = "user.inp"
translated, refused = partial(translated_model, NAME), partial(refused_model, NAME)


def same(folder: Path, text: str, other: str) -> None:
    """Check that two files become the same deck, but for the numbers of nodes."""
    own, reference = (translated(folder, each)[0] for each in (text, other))
    for each in (own, reference):
        each["SET_NODE_LIST_TITLE"] = [str(len(" ".join(each["SET_NODE_LIST_TITLE"]).split()))]
        each["ELEMENT_PLATE_Q9"] = [str(len(each["ELEMENT_PLATE_Q9"]))]
        each["NODE"] = sorted(row[8:] for row in each["NODE"])
        laws = [name for name in each if name.startswith("MAT_")]
        each.update({name: each[name][1:] for name in laws})
    assert own == reference


def test_a_plate_of_shells_below_a_ball(tmp_path: Path) -> None:
    cards, page = translated(tmp_path, standard())
    plies = numbers(cards["PART_COMPOSITE_LONG"])[1:]
    assert [(ply[1], ply[2]) for ply in plies] == [(0.125, angle) for angle in ANGLES]
    law = numbers(cards["MAT_PLY_ELASTIC_TITLE+"])
    assert law[0][1:5] == [1.6e-9, 153000.0, 10300.0, 10300.0]
    assert law[0][5:] == pytest.approx([0.300058252427184, 0.300058252427184, 0.4])
    assert law[1] == [6000.0, 6000.0, 3700.0]
    place, motion = numbers(cards["IMPACTOR_SPHERE_TITLE"])
    assert place[1:] == [8.0, 2.0e-4, 20.0, 20.0, 8.27]
    assert motion[:4] == [0.0, 0.0, -4000.0, 1.0]
    assert numbers(cards["CONTACT_IMPACTOR"])[1] == [0.2, 0.2, 0.0]
    held = numbers(cards["BOUNDARY_SPC_SET"])
    assert held[0][2:5] == [1.0, 1.0, 1.0]
    assert numbers(cards["CONTROL_TERMINATION"])[0][0] == 1.2e-4
    assert "### *SHELL SECTION, line" in page and "result of Abaqus" in page


def test_a_meshed_ball_is_the_same(tmp_path: Path) -> None:
    same(tmp_path, standard(meshed=True), standard())


def test_an_export_of_the_pre_processor_is_taken_whole(tmp_path: Path) -> None:
    cards, page = translated(tmp_path, cae())
    plies = numbers(cards["PART_COMPOSITE_LONG"])[1:]
    assert [(ply[1], ply[2]) for ply in plies] == [(0.125, angle) for angle in ANGLES]
    place, sizes, motion = numbers(cards["IMPACTOR_TUP_TITLE"])
    assert place[1:] == [8.0, 2.0e-4, 20.0, 20.0, 8.27] and sizes[0] == 20.0
    assert motion[:4] == [0.0, 0.0, -4000.0, 1.0]
    law = numbers(cards["MAT_PLY_CODAM2_TITLE+"])
    assert law[2] == [2500.0, 1500.0, 80.0, 230.0, 90.0, 90.0]
    assert law[3][:4] == [205.0, 61.0, 0.277, 1.309]
    assert law[5][3] == 1.0  # matrix compression by Hashin
    assert numbers(cards["CONTACT_IMPACTOR"])[1] == [0.2, 0.2, 0.0]
    assert " lost" not in page.split("## Keyword by keyword")[1]


def test_an_extruded_surface_is_a_bar(tmp_path: Path) -> None:
    """Along y below the plate: the axes are those of x and z."""
    deck = Abaqus()
    plate = deck.plate()
    deck.material()
    deck.ball()
    deck.held(plate)
    deck.moved()
    deck.nodes([(20.0, 20.0, -5.3)], ", nset=Base")
    axes = ("20., 20., -5.3, 21., 20., -5.3", "20., 20., -4.3")
    arcs = ("START, -5., 0.", "CIRCL, 0., 5., 0., 0.", "CIRCL, 5., 0., 0., 0.")
    deck.put("Surface, type=CYLINDER, name=Bar", *axes, *arcs)
    deck.put("Rigid Body, ref node=Base, analytical surface=Bar")
    deck.put("Surface, type=ELEMENT, name=Under", "Plate, SNEG")
    deck.put("Boundary", "Base, 1, 6")
    pairs = "*Contact Pair, interaction=Int\nTop, Ball\n*Contact Pair, interaction=Int\nUnder, Bar"
    cards, _ = translated(tmp_path, deck.step(pairs))
    head, ends = numbers(cards["FIXTURE_BAR"])
    assert head[1:4] == pytest.approx([-1.0, 0.05, 5.0])
    assert ends[0] == ends[2] == 20.0 and abs(ends[3] - ends[1]) >= 40.0


def test_parts_and_instances_are_the_same(tmp_path: Path) -> None:
    """As a pre-processor writes it: each part in its own axes, placed by its instance."""
    deck = Abaqus()
    deck.put("Part, name=Plate")
    plate = deck.layer(-3.0)
    deck.quads("S4R", "Set-1", plate)
    deck.put("Shell Section, elset=Set-1, composite", *(f"0.125, 3, CFRP, {a}, P" for a in ANGLES))
    deck.put("End Part")
    deck.node = deck.element = 0
    deck.put("Part, name=Ball")
    deck.nodes([(0.0, 0.0, 0.0)], ", nset=Ref")
    deck.put(
        "Surface, type=REVOLUTION, name=Skin",
        *("0., 0., 0., 0., 1., 0.", "START, 0., -8.", "CIRCL, 8., 0., 0., 0.", "LINE, 8., 20."),
    )
    deck.put("Rigid Body, ref node=Ref, analytical surface=Skin")
    deck.put("End Part")
    deck.put("Assembly, name=Assembly")
    deck.put("Instance, name=Plate-1, part=Plate", "0., 0., 3.", "*End Instance")
    # its axis is along y, and stands up after a quarter of a turn about x
    turn = ("0., 8.27, 0.", "0., 0., 0., 1., 0., 0., 90.")
    turn = ("20., 8.27, -20.", "0., 0., 0., 1., 0., 0., 90.")
    deck.put("Instance, name=Ball-1, part=Ball", *turn, "*End Instance")
    deck.set_of("N", "Edge, instance=Plate-1", plate)
    edge = ("1, 9", "73, 81", "1, 73, 9", "9, 81, 9")
    deck.lines = deck.lines[: -1 - len(plate) // 16 - 1]
    deck.put("Nset, nset=Edge, instance=Plate-1, generate", *edge)
    deck.put("Nset, nset=RP, instance=Ball-1", "Ref,")
    deck.put("Surface, type=ELEMENT, name=Top", "Plate-1.Set-1, SPOS")
    deck.put("Element, type=MASS, elset=Point", "1, Ball-1.1")
    deck.put("Mass, elset=Point", "2.0e-4,")
    deck.put("End Assembly")
    deck.material()
    deck.put("Boundary", "Edge, ENCASTRE", "RP, 1, 2", "RP, 4, 6")
    deck.moved()
    cards, _ = translated(tmp_path, deck.step("*Contact Pair, interaction=Int\nTop, Ball-1.Skin"))
    place, _, motion = numbers(cards["IMPACTOR_TUP_TITLE"])
    assert place[1:] == [8.0, 2.0e-4, 20.0, 20.0, 8.27]
    assert motion[:4] == [0.0, 0.0, -4000.0, 1.0]
    reference = translated(tmp_path, standard())[0]
    assert cards["PART_COMPOSITE_LONG"] == reference["PART_COMPOSITE_LONG"]
    assert sorted(row[8:] for row in cards["NODE"]) == sorted(r[8:] for r in reference["NODE"])
    assert len(cards["SET_NODE_LIST_TITLE"]) == len(reference["SET_NODE_LIST_TITLE"])


@pytest.mark.parametrize("kind", ["S4", "S4RS", "S8R", "S9R5"])
def test_shells_of_more_nodes_are_raised(kind: str, tmp_path: Path) -> None:
    deck = Abaqus()
    plate = deck.layer()
    rows = []
    middles: dict[frozenset[int], int] = {}
    places = {n: (5.0 * (k % 9), 5.0 * (k // 9)) for k, n in enumerate(plate)}

    def between(*ids: int) -> int:
        if frozenset(ids) not in middles:
            x, y = (sum(places[n][i] for n in ids) / len(ids) for i in (0, 1))
            middles[frozenset(ids)] = deck.nodes([(x, y, 0.0)])[0]
        return middles[frozenset(ids)]

    for k, low in enumerate(plate[:-10]):
        if k % 9 != 8:
            quad = [low, low + 1, low + 10, low + 9]
            ring = [between(a, b) for a, b in zip(quad, quad[1:] + quad[:1], strict=True)]
            rows.append(
                {"S8R": quad + ring, "S9R5": [*quad, *ring, between(*quad)]}.get(kind, quad)
            )
    deck.elements(kind, "Plate", rows)
    deck.put("Shell Section, elset=Plate, composite", *(f"0.125, 3, CFRP, {a}" for a in ANGLES))
    deck.put("Surface, type=ELEMENT, name=Top", "Plate, SPOS")
    deck.material()
    deck.ball()
    deck.held(plate)
    deck.moved()
    same(tmp_path, deck.step(), standard())


def thick(kind: str) -> str:
    """Continuum shells, or one brick a ply."""
    deck = Abaqus()
    count = 1 if kind == "SC8R" else 4
    layers = [deck.layer(-0.25 + 0.5 * k / count) for k in range(count + 1)]
    for k in range(count):
        deck.quads(kind, f"Ply-{k}", layers[k], layers[k + 1])
    if kind == "SC8R":
        deck.put("Shell Section, elset=Ply-0, composite", *(f"0.25, 3, CFRP, {a}" for a in ANGLES))
    else:
        deck.put("Orientation, name=Across", "0., 1., 0., -1., 0., 0.", "3, 0.")
        deck.put("Orientation, name=Along", "0., 1., 0., -1., 0., 0.", "3, -90.")
        for k, name in enumerate(("Along", "Across", "Across", "Along")):
            deck.put(f"Solid Section, elset=Ply-{k}, material=CFRP, orientation={name}", ",")
    deck.put("Surface, type=ELEMENT, name=Top", f"Ply-{count - 1}, S2")
    deck.material()
    deck.ball()
    deck.held(*layers)
    deck.moved()
    return deck.step()


@pytest.mark.parametrize("kind", ["SC8R", "C3D8R"])
def test_thick_shells_and_bricks_are_plies(kind: str, tmp_path: Path) -> None:
    cards, _ = translated(tmp_path, thick(kind))
    reference, _ = translated(tmp_path, standard())
    own, other = (numbers(each["PART_COMPOSITE_LONG"])[1:] for each in (cards, reference))
    assert [row[1] for row in own] == pytest.approx([row[1] for row in other])
    assert [row[2] for row in own] == pytest.approx([row[2] for row in other])
    assert cards["IMPACTOR_SPHERE_TITLE"] == reference["IMPACTOR_SPHERE_TITLE"]


def test_thick_shells_that_are_stacked_aside_are_refused(tmp_path: Path) -> None:
    text = thick("SC8R").replace("composite\n0.25", "composite, stack direction=1\n0.25")
    refused(tmp_path, text, "*SHELL SECTION STACK DIRECTION: 1 is not translated")


def test_a_lamina_with_the_criterion_of_hashin(tmp_path: Path) -> None:
    text = standard().replace(
        "*Elastic, type=ENGINEERING CONSTANTS\n" + ENGINEERING,
        "*Elastic, type=LAMINA\n" + LAMINA + "\n" + HASHIN,
    )
    cards, page = translated(tmp_path, text)
    law = numbers(cards["MAT_PLY_CODAM2_TITLE+"])
    # nu23 = E2/(2 G23) - 1
    assert law[0][5:] == pytest.approx([0.300058252427184, 0.300058252427184, 10300 / 7400 - 1])
    assert law[2][:6] == [1500.0, 1200.0, 50.0, 200.0, 75.0, 65.0]
    assert law[3][:4] == [91.6, 79.9, 0.22, 1.1]
    assert "a lamina has no constants across" in page.replace("A lamina", "a lamina")
    no_growth = text.replace(HASHIN[HASHIN.index("*Damage Evolution") :], "")
    refused(tmp_path, no_growth, "its card has no fracture energy, so that the strengths are lost")
    cards, _ = translated(tmp_path, no_growth, like="IM7/8552")
    assert numbers(cards["MAT_PLY_CODAM2_TITLE+"])[3][:2] == [205.0, 61.0]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("*Dynamic, Explicit", "*Static", "*STATIC: there is no implicit solution"),
        ("*Dynamic, Explicit", "*Bulk Viscosity", "*DYNAMIC, EXPLICIT is missing"),
        ("*Friction\n", "*Friction, rough\n", "*FRICTION ROUGH: is not translated"),
        ("type=S4R", "type=B31", "*ELEMENT TYPE: elements of type B31 are not translated"),
        ("Edge, ENCASTRE", "Rim, ENCASTRE", "*BOUNDARY: there is no set of nodes Rim"),
        ("CFRP, 90.0", "GFRP, 90.0", "*SHELL SECTION MATERIAL: there is no material GFRP"),
        ("0.125, 3, CFRP, 90.0", "-1, 3, CFRP, 90.0", "*SHELL SECTION thickness: -1 must be above"),
        ("RP, 3, -4000.0", "RP, 6, 3.0", "a rotation at time zero is not translated"),
        ("1.6e-9,", "", "*DENSITY: 1 numbers are needed"),
        ("153000.0", "15300O", "'15300O' was given, a number is needed"),
        (", 0.00012", ", ", "*DYNAMIC time"),
        ("*End Step", "*Gizmo\n1.\n*End Step", "*GIZMO: this keyword is not translated"),
        ("Edge, ENCASTRE", ",", "*BOUNDARY: there is no set of nodes"),
        ("*Boundary\nEdge", "*MPC\nTIE,1,2\n*Boundary\nEdge", "*MPC: constraints between nodes"),
        ("*Boundary\nEdge", "*Boundary, op=NEW\nEdge", "*BOUNDARY OP: what earlier steps hold"),
        ("Top, Ball", "Top, Bell", "there is no such surface"),
        ("*Mass, elset=Mass", "*Mass, elset=Mass, alpha=9.", "*MASS ALPHA: is not translated"),
        (
            "0.2,\n*Step",
            "0.2,\n*Surface Behavior, no separation\n*Step",
            "*SURFACE BEHAVIOR NO SEPARATION: contact opens freely",
        ),
        ("START, 0., -8.", "START, 0.", "a START and then points are needed"),
        ("*Material, name=CFRP", "*Material", "*MATERIAL NAME: missing"),
        ("1, 1, 2, 11, 10", "1, 1, 2, 11, 999", "*ELEMENT: there is no node 999"),
        ("1, 1, 2, 11, 10", "1, 1, 2, 11", "S4R has 4 nodes"),
        (
            "*Elastic, type=ENGINEERING CONSTANTS",
            "*Elastic, type=ORTHOTROPIC",
            "ORTHOTROPIC is not",
        ),
        ("*End Step", "*End Step\n*Step\n*Dynamic, Explicit\n, 1.0\n*End Step", "a second step"),
    ],
)
def test_what_is_not_taken_is_refused_with_its_line(
    old: str, new: str, words: str, tmp_path: Path
) -> None:
    text = standard()
    assert old in text
    said = refused(tmp_path, text.replace(old, new, 1), words)
    assert "user.inp is a deck of Abaqus" in said
    assert re.search(r"user\.inp:\d+: \*", said) or "is missing" in said


def test_every_keyword_is_on_the_page(tmp_path: Path) -> None:
    text = stacked("contact")
    _, page = translated(tmp_path, text)
    names = [line[1:].split(",")[0].upper() for line in text.splitlines() if line[0] == "*"]
    assert re.findall(r"(?m)^### \*(.*), line", page) == names
    rows = re.findall(r"(?m)^\| (?!field|---).*\|$", page)
    assert all(re.search(r"\| (taken|replaced|no effect here)[^|]*\|$", row) for row in rows)


def metal(plastic: str) -> str:
    """The plain file with a metal."""
    text = standard()
    first = text.index("*Elastic")
    last = text.index("*Node", first)
    return f"{text[:first]}*Elastic\n70000., 0.3\n*Plastic{plastic}\n{text[last:]}"


@pytest.mark.parametrize(
    ("plastic", "law", "row"),
    [
        ("\n300.,0.\n400.,0.1", "PLASTIC_KINEMATIC", [300.0, 70000.0 / 71.0, 1.0]),
        (", hardening=KINEMATIC\n300.,0.\n400.,0.1", "PLASTIC_KINEMATIC", [300.0, 70000 / 71, 0.0]),
        ("\n300.,0.\n400.,0.1\n450.,0.3", "PIECEWISE_LINEAR_PLASTICITY", [300.0, 400.0, 450.0]),
        (
            ", hardening=JOHNSON COOK\n300.,200.,0.3,1.,900.,300.",
            "SIMPLIFIED_JOHNSON_COOK",
            [300.0, 200.0, 0.3],
        ),
    ],
)
def test_metals_by_their_hardening(
    plastic: str, law: str, row: list[float], tmp_path: Path
) -> None:
    cards, _ = translated(tmp_path, metal(plastic))
    (name,) = [name for name in cards if law in name]
    found = numbers(cards[name])
    if law == "PLASTIC_KINEMATIC":
        assert found[0][4:7] == pytest.approx(row)
    else:
        assert found[-1][: len(row)] == row
    if law.startswith("PIECEWISE"):
        assert found[-2][:3] == [0.0, 0.1, 0.3]


def test_what_acts_otherwise_is_noted(tmp_path: Path) -> None:
    """A contact that was soft, and the weight of one part alone."""
    soft = "0.2,\n*Surface Behavior, pressure-overclosure=LINEAR\n1000.\n*Step"
    weight = "*Dload\nPlate, GRAV, 9810., 0., 0., -1.\n*End Step"
    text = standard().replace("0.2,\n*Step", soft).replace("*End Step", weight)
    _, page = translated(tmp_path, text)
    for words in (
        "contact is hard, by Lagrange multipliers, and not LINEAR",
        "acts on all, not on",
    ):
        assert words in page


@pytest.mark.parametrize(
    ("plastic", "words"),
    [
        (", hardening=COMBINED\n300.,0.", "*PLASTIC HARDENING: COMBINED is not translated"),
        (", hardening=KINEMATIC\n300.,0.\n400.,.1\n450.,.3", "3 points of KINEMATIC hardening"),
        ("\n300.,0.,20.", "*PLASTIC: stress and plastic strain are needed"),
    ],
)
def test_other_hardening_is_refused(plastic: str, words: str, tmp_path: Path) -> None:
    refused(tmp_path, metal(plastic), words)
