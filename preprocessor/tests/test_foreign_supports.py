"""Supports, velocities and loads in every form."""

from __future__ import annotations

import re
from collections.abc import Callable
from math import cos, pi, sin
from pathlib import Path

import abaqus_decks
import nastran_decks
import pytest
from foreign_decks import (
    SPEED,
    Foreign,
    composite,
    contact,
    control,
    ply_law,
    rigid,
    rim,
    standard,
)
from foreign_forms import (
    LIKE,
    refused,
    same,
    translated,
    with_more,
)
from test_foreign_runs import bricks

from plydyn_pre.translate import Choices, translation

LAYER = 81  # nodes of one layer of a plate


def test_supports_in_every_form(tmp_path: Path) -> None:
    reference = standard()[0].text()
    deck, plate, _ = standard(held=False)
    edge = rim(plate)
    inner = sorted(set(plate) - set(edge))
    free = deck.text().removesuffix("*END\n")
    clamp = 6 * "         1"
    rows = "\n".join(f"{n:10d}         0{clamp}" for n in edge)
    same(tmp_path, f"{free}*BOUNDARY_SPC_NODE\n{rows}\n*END\n", reference)
    hold = f"*BOUNDARY_SPC_SET\n         1         0{clamp}\n*END\n"
    forms = {
        "GENERAL": "ALL\n" + "\n".join(f"     DNODE{n:10d}" for n in inner),
        "COLUMN": "\n".join(f"{n:10d}" for n in edge),
        "LIST_GENERATE": "\n".join(f"{n:10d}{n:10d}" for n in edge),
    }
    for form, lines in forms.items():
        same(tmp_path, f"{free}*SET_NODE_{form}\n         1\n{lines}\n{hold}", reference)
    two = f"*SET_NODE_LIST\n5\n{','.join(map(str, edge[:16]))}\n".replace(",", ",")
    halves = [edge[:16], edge[16:]]
    two = "".join(
        f"*SET_NODE\n{sid}\n" + "\n".join(map(str, ids)) + "\n"
        for sid, ids in zip((5, 6), halves, strict=True)
    )
    same(tmp_path, f"{free}{two}*SET_NODE_ADD\n1\n5,6\n{hold}", reference)
    box = "*DEFINE_BOX\n3,0.1,39.9,0.1,39.9,-1,1\n*SET_NODE_GENERAL\n1\nPART,1\nDBOX,3\n"
    same(
        tmp_path,
        free + box.replace("DBOX,3", "\n".join(f"DNODE,{n}" for n in inner)) + hold,
        reference,
    )
    timed = "*BOUNDARY_SPC_SET_BIRTH_DEATH_ID\n1,edge\n1,0,1,1,1,1,1,1\n0.0,1e20\n*END\n"
    ids = "*SET_NODE_COLUMN\n         1\n" + forms["COLUMN"] + "\n"
    same(tmp_path, f"{free}{ids}{timed}", reference)


def test_codes_of_nodes_hold(tmp_path: Path) -> None:
    deck, plate, _ = standard(held=False)
    edge = {f"{n:8d}" for n in rim(plate)}
    lines = deck.text().splitlines()
    first = lines.index("*NODE") + 1
    for at in range(first, first + len(plate)):
        lines[at] += "       7       7" if lines[at][:8] in edge else "       0       0"
    same(tmp_path, "\n".join(lines), standard()[0].text())


def planes(text: str) -> list[tuple[float, str]]:
    """Heights above the middle at which nodes are held, and along which axes."""
    rows = [row.split() for row in re.findall(r"\*BOUNDARY_FACE\n\$.*\n(.*)", text)]
    assert all(row[1] == "0" for row in rows)
    return [
        (float(row[2]), "".join(a for a, held in zip("xyz", row[3:], strict=True) if held == "1"))
        for row in rows
    ]


def whole(text: str) -> list[str]:
    """Axes along which nodes are held over the whole thickness."""
    rows = [row.split() for row in re.findall(r"\*BOUNDARY_SPC_SET\n\$.*\n(.*)", text)]
    return [
        "".join(a for a, held in zip("xyz", row[2:5], strict=True) if held == "1") for row in rows
    ]


@pytest.mark.parametrize(
    ("file", "text", "clamp", "hinge"),
    [
        ("user.k", standard()[0].text(), 8 * "{:>10}", (1, 0, 1, 1, 1, 0, 0, 0)),
        ("user.inp", abaqus_decks.standard(), "ENCASTRE", "PINNED"),
        ("user.bdf", nastran_decks.standard(), "1       123456", "1       123   "),
    ],
)
def test_edges_that_may_turn_are_hinges(
    file: str, text: str, clamp: str, hinge: str | tuple[int, ...], tmp_path: Path
) -> None:
    """At the height of the shells, the middle of the plies; the recipe has them, too."""
    if isinstance(hinge, tuple):
        clamp, hinge = clamp.format(1, 0, 1, 1, 1, 1, 1, 1), clamp.format(*hinge)
    assert text.count(clamp) == 1
    (tmp_path / file).write_text(text.replace(clamp, hinge))
    made = translation(tmp_path / file, tmp_path / "job.k", Choices(LIKE))
    deck = "\n".join(made.lines)
    assert planes(deck) == [(0.0, "xy")] and whole(deck) == ["z"]
    assert any("held along x and y at z = 0 alone" in note for note in made.notes)
    assert made.study is not None, made.causes
    assert [(s.hold, s.face, s.height) for s in made.study.supports] == [
        ("xy", "plane", 0.0),
        ("z", "all", 0.0),
    ]


def test_rotations_of_another_keyword_make_a_clamp(tmp_path: Path) -> None:
    """All about x and y: a clamp. About x alone: y over the thickness, x in the middle."""
    deck, plate, _ = standard(held=False)
    deck.set_of("SET_NODE_LIST", 1, rim(plate))
    deck.put("BOUNDARY_SPC_SET", (1, 0, 1, 1, 1))
    text = deck.text()
    turns = "*BOUNDARY_SPC_SET\n1,0,0,0,0,{}\n*END"
    same(tmp_path, text.replace("*END", turns.format("1,1")), standard()[0].text())
    one, _ = translated(tmp_path, text.replace("*END", turns.format("1,0")))
    assert planes(one) == [(0.0, "x")] and whole(one) == ["yz"]
    normal, _ = translated(tmp_path, text.replace("*END", turns.format("0,0,1")))
    assert planes(normal) == [(0.0, "xy")] and whole(normal) == ["z"]


def test_shells_on_their_bottom_face_are_hinged_there(tmp_path: Path) -> None:
    """NLOC -1: the nodes are half a thickness below the middle of the plies."""
    deck, plate, _ = standard(held=False)
    deck.set_of("SET_NODE_LIST", 1, rim(plate))
    deck.put("BOUNDARY_SPC_SET", (1, 0, 1, 0, 1))
    part = f"{1:>10}{16:>10}{0.833:>10}{0.0:>10}"
    text = deck.text()
    assert text.count(part) == 1
    found, _ = translated(tmp_path, text.replace(part, f"{1:>10}{16:>10}{0.833:>10}{-1.0:>10}"))
    assert planes(found) == [(-0.25, "x")] and whole(found) == ["z"]


def test_bricks_that_stand_on_their_lower_edge_are_held_there(tmp_path: Path) -> None:
    text = bricks()
    clamped, _ = translated(tmp_path, text)
    assert planes(clamped) == [] and whole(clamped) == ["xyz"]
    head, rest = text.split("edges\n", 1)
    rows = rest[: rest.index("*")].splitlines()[1:]
    lowest = [n for row in rows for n in map(int, row.split()) if n <= LAYER]
    rows = ["".join(f"{n:>10}" for n in lowest[i : i + 8]) for i in range(0, len(lowest), 8)]
    stands = "\n".join([f"{head}edges", "         1", *rows, rest[rest.index("*") :]])
    found, _ = translated(tmp_path, stands)
    assert planes(found) == [(-0.25, "xyz")] and whole(found) == []


def test_a_support_that_ends_is_a_motion_that_ends(tmp_path: Path) -> None:
    deck, plate, _ = standard(held=False)
    deck.set_of("SET_NODE_LIST", 1, rim(plate))
    deck.put("BOUNDARY_SPC_SET_BIRTH_DEATH", (1, 0, 1, 0, 1), (0.0, 1.0e-4))
    text, _ = translated(tmp_path, deck.text())
    rows = re.findall(r"\*BOUNDARY_PRESCRIBED_MOTION_SET\n\$.*\n(.*)", text)
    assert [row.split()[1] for row in rows] == ["1", "3"]
    assert all(float(row.split()[6]) == 1.0e-4 and row.split()[2] == "0" for row in rows)
    points = text.split(f"\ncurve {rows[0].split()[3]}\n")[1].split("*")[0].splitlines()[3:]
    assert [float(line.split()[1]) for line in points] == [0.0, 0.0]


VELOCITIES: dict[str, Callable[[Foreign, list[int], list[int]], None]] = {
    "part": lambda d, *_: d.put("INITIAL_VELOCITY_GENERATION", (9, 2, 0, 0, 0, -SPEED), (None,)),
    "node set": lambda d, _, nodes: (
        d.set_of("SET_NODE_LIST", 5, nodes),
        d.put("INITIAL_VELOCITY_GENERATION", (5, 3, 0, 0, 0, -SPEED), (None,)),
    ),
    "part set": lambda d, *_: (
        d.put("SET_PART_LIST", (5,), (9,)),
        d.put("INITIAL_VELOCITY_GENERATION", (5, 1, 0, 0, 0, -SPEED), (None,)),
    ),
    "set": lambda d, _, nodes: (
        d.set_of("SET_NODE_LIST", 5, nodes),
        d.put("INITIAL_VELOCITY", (5,), (0, 0, -SPEED)),
    ),
    "box": lambda d, *_: (
        d.put("DEFINE_BOX", (4, -1e3, 1e3, -1e3, 1e3, 0.3, 1e3)),
        d.put("INITIAL_VELOCITY", (0, 0, 4), (0, 0, -SPEED)),
    ),
    "nodes": lambda d, _, nodes: d.put(
        "INITIAL_VELOCITY_NODE", *[(n, 0, 0, -SPEED) for n in nodes]
    ),
}


@pytest.mark.parametrize("form", VELOCITIES)
def test_velocities_in_every_form(form: str, tmp_path: Path) -> None:
    deck, plate, nodes = standard(moved=False)
    VELOCITIES[form](deck, plate, nodes)
    same(tmp_path, deck.text(), standard()[0].text())


def test_the_velocity_of_the_inertia_and_that_of_all_nodes(tmp_path: Path) -> None:
    text = standard(moved=False)[0].text()
    own = text.replace("       0.0       0.0       0.0", "       0.0       0.0   -2000.0", 1)
    same(tmp_path, own, standard()[0].text())
    deck = standard(moved=False)[0]
    deck.put("INITIAL_VELOCITY", (None,), (0, 0, -SPEED))
    new, _ = translated(tmp_path, deck.text())
    assert "*INITIAL_VELOCITY\n" in new and "-2000.0" in new.split("*IMPACTOR_SPHERE")[1]


def test_a_motion_wins_over_a_support_of_the_same_points(tmp_path: Path) -> None:
    motion = "*DEFINE_CURVE\n7\n0,0\n1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n1,1,2,7,0.1\n"
    deck, notes = translated(tmp_path, with_more(motion))
    assert any("64 points that it holds along x have a prescribed motion" in n for n in notes)
    held = re.search(r"\*BOUNDARY_SPC_SET\n\$.*\n(.*)", deck)
    assert held and held[1].split()[2:5] == ["0", "1", "1"]
    twice = "*BOUNDARY_SPC_NODE\n1,0,1,1,1\n"
    same(tmp_path, with_more(twice), standard()[0].text())


def test_two_motions_of_the_same_points_are_refused(tmp_path: Path) -> None:
    """The second one was left out; one that is written twice is one."""
    start = "*DEFINE_CURVE\n7\n0,0\n1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n1,1,2,7,0.1,,1e-4\n"
    text = with_more(start + "1,1,2,7,0.2,,,1e-4\n")
    said = refused(tmp_path, text, "set 1: 64 points have another motion along x already")
    assert f"user.k:{text[: text.index('1,1,2,7,0.2')].count(chr(10)) + 1}: " in said
    same(tmp_path, with_more(start + "1,1,2,7,0.1,,1e-4\n"), with_more(start))


@pytest.mark.parametrize("name", ["RIGIDWALL_PLANAR_FINITE", "RIGIDWALL_GEOMETRIC_FLAT"])
def test_a_flat_wall_with_edges_is_a_punch(name: str, tmp_path: Path) -> None:
    """Below the plate, from x = 5, y = 10 along x by 20 and along y by 10."""
    wall = f"*{name}\n0\n5,10,-1,5,10,0,0.1\n15,10,-1,20,10\n"
    deck, _ = translated(tmp_path, with_more(wall))
    rows = deck.split("*FIXTURE_PUNCH\n")[1].splitlines()
    head, place = ([float(word) for word in rows[n].split()] for n in (1, 3))
    assert head[1:] == [-1.0, 0.75, 0.0, 0.1, 0.1, 0.0]
    assert place[1:5] == [15.0, 15.0, 20.0, 10.0]


@pytest.mark.parametrize("inertia", [True, False])
def test_a_body_that_is_held_needs_no_mass(inertia: bool, tmp_path: Path) -> None:
    """Its density, without which LS-DYNA takes no rigid part, changes nothing."""
    deck = Foreign()
    plate = deck.layer()
    deck.quads(1, plate)
    composite(deck)
    ply_law(deck)
    arc = [pi * n / 8 for n in range(9)]
    rows = [
        deck.nodes((20.0 + 3.0 * cos(a), y, 3.0 * sin(a) - 3.75) for a in arc) for y in (0.0, 40.0)
    ]
    deck.lines.append("*ELEMENT_SHELL")
    ends = zip(rows[0], rows[0][1:], rows[1][1:], rows[1], strict=False)
    deck.lines += [f"{500 + n},9," + ",".join(map(str, ids)) for n, ids in enumerate(ends)]
    rigid(deck, law=((1.0, 7.0, 7.0),))
    contact(deck, 1, 9)
    control(deck)
    text = deck.text()
    if not inertia:
        start, end = text.index("*PART_INERTIA"), text.index("*CONTACT")
        text = f"{text[:start]}*PART\nbar\n9,9,9\n{text[end:]}"
    made, _ = translated(tmp_path, text)
    rows_of_bar = re.split(r"\*FIXTURE_BAR\+?\n", made)[1].splitlines()
    head, ends_of_bar = ([float(word) for word in rows_of_bar[n].split()] for n in (1, 3))
    # the plate, of 0.5, is at -0.25, the top of the bar at -0.75
    assert head[1:4] == pytest.approx([-1.0, 0.5, 3.0])
    assert ends_of_bar[:4] == pytest.approx([20.0, 0.0, 20.0, 40.0])


def test_a_relaxation_that_is_not_asked_for_has_no_effect(tmp_path: Path) -> None:
    card = "*CONTROL_DYNAMIC_RELAXATION\n250,0.001,0.995,0,0,0,0.04,"
    same(tmp_path, with_more(f"{card}0\n"), standard()[0].text())
    refused(tmp_path, with_more(f"{card}1\n"), "IDRFLG: 1 is not translated")


def test_damping_that_the_impactor_loses_is_noted(tmp_path: Path) -> None:
    """LS-DYNA damps rigid bodies, too: to exp(-200 5e-4) of the velocity, 9.52 % less."""
    deck, notes = translated(tmp_path, with_more("*DAMPING_GLOBAL\n0,200.\n"))
    assert "*DAMPING_GLOBAL" in deck
    assert any("plate alone" in note and "lose 9.52 % of its velocity" in note for note in notes)


def test_velocities_that_begin_at_time_zero_are_the_usual_ones(tmp_path: Path) -> None:
    text = "*INITIAL_VELOCITY_GENERATION_START_TIME\n0.0\n"
    same(tmp_path, with_more(text), standard()[0].text())


def test_an_impactor_that_nothing_moves_is_noted(tmp_path: Path) -> None:
    words = "part 9 does not move at time zero, and nothing moves it"
    assert words in translated(tmp_path, standard(moved=False)[0].text())[1]
    text = standard()[0].text()
    assert words not in translated(tmp_path, text)[1]
    away, note = text.replace("-2000.0", "2000.0"), "part 9 moves away from the plate at time zero"
    assert away != text and note in translated(tmp_path, away)[1]
    assert note not in translated(tmp_path, text)[1]


def test_outputs_of_contacts_and_walls_have_no_effect(tmp_path: Path) -> None:
    outputs = (
        "*CONTACT_FORCE_TRANSDUCER_PENALTY_ID\n5,force\n9,0,3,0\n,\n,\n"
        "*DATABASE_RWFORC\n1e-6\n*DATABASE_FORCE_TRANSDUCER\n1\n*DATABASE_NCFORC\n1e-6\n"
    )
    same(tmp_path, with_more(outputs), standard()[0].text())


def test_loads_are_taken(tmp_path: Path) -> None:
    curve = "*DEFINE_CURVE\n7\n0,1\n1,1\n"
    loads = (
        "*LOAD_BODY_Z\n7,9810.0\n*LOAD_NODE_POINT\n41,3,7,-5.0\n"
        "*SET_SHELL_LIST\n3\n1,2\n*LOAD_SHELL_SET\n3,7,0.1\n"
    )
    deck, _ = translated(tmp_path, with_more(curve + loads + "*LOAD_SEGMENT\n7,0.2,,1,10,11,2\n"))
    rows = {
        name: deck.split(f"*{name}\n")[1].splitlines()[1].split()
        for name in ("LOAD_BODY_Z", "LOAD_NODE_POINT")
    }
    assert [float(word) for word in rows["LOAD_BODY_Z"]] == [7.0, 9810.0]
    assert [float(word) for word in rows["LOAD_NODE_POINT"]] == [41.0, 3.0, 7.0, -5.0]
    pressed = re.findall(r"\*LOAD_FACE_PRESSURE\n\$.*\n(.*)", deck)
    # the segment runs clockwise from above: its pressure acts upwards
    assert [float(row.split()[3]) for row in pressed] == [0.1, -0.2]
    named = "*LOAD_SEGMENT_ID\n1,edge\n7,0.2,,1,10,11,2\n2,other\n7,0.2,,2,11,12,3\n"
    plain = named.replace("1,edge\n", "").replace("2,other\n", "").replace("_ID", "")
    same(tmp_path, with_more(curve + named), with_more(curve + plain))
    # the frame accelerates upwards: the weight of the impactor is downwards
    assert deck.split("*IMPACTOR_SPHERE")[1].splitlines()[5].split()[4] == "-9810.0"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("*MAT_ADD_EROSION\n1\n", "*MAT_ADD_EROSION: plies of plydyn fail by their own law"),
        (
            "*LOAD_NODE_POINT\n100,3,7,1.0\n*DEFINE_CURVE\n7\n0,0\n1,1\n",
            "node 100 is not of the plate",
        ),
        ("*LOAD_SHELL_SET\n9,7,1.0\n", "there is no set of shells 9"),
        ("*LOAD_BODY_Z\n8\n", "there is no *DEFINE_CURVE 8"),
        ("*CONSTRAINED_NODAL_RIGID_BODY\n1,0,1\n", "this constraint is not translated"),
        ("*RIGIDWALL_PLANAR_MOVING\n0\n0,0,-5,0,0,-4\n1,2\n", "a plane with a mass of its own"),
        (
            "*RIGIDWALL_PLANAR_MOVING_FORCES\n0\n0,0,-5,0,0,-4\n1\n",
            "a plane with a mass of its own",
        ),
        ("*RIGIDWALL_PLANAR_ORTHO\n0\n0,0,-5,0,0,-4\n1,2\n", "friction of a plane that differs"),
        (
            "*RIGIDWALL_GEOMETRIC_PRISM\n0\n0,0,-5,0,0,-4\n1,0,-5,1,1,1\n",
            "a prism is not translated; flat walls, spheres and cylinders are",
        ),
        ("*RIGIDWALL_FORCE_TRANSDUCER\n1\n", "this form of a rigid wall is not translated"),
        ("*BOUNDARY_PRESCRIBED_MOTION_SET\n1,5,2,7\n", "DOF 5 with VAD 2"),
        ("*INITIAL_VELOCITY_GENERATION_START_TIME\n1.0\n", "STIME: 1 is not translated"),
        ("*INITIAL_STRESS_SHELL\n1\n", "this initial state is not translated"),
        ("*FANCY_NEW\n1\n", "*FANCY_NEW: this keyword is not translated"),
    ],
)
def test_what_changes_the_result_is_never_lost_in_silence(
    text: str, words: str, tmp_path: Path
) -> None:
    deck = with_more(text)
    said = refused(tmp_path, deck, words)
    line = deck[: deck.index(text)].count("\n") + 1
    assert any(f"user.k:{line + step}: *" in said for step in range(3))
