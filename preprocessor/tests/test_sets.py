"""Sets by place and delaminations before the run: members on the mesh, cards, and errors."""

from __future__ import annotations

import subprocess
from dataclasses import replace
from math import pi, sqrt
from pathlib import Path

import numpy as np
import pytest
from conftest import BOND, CARBON
from deck_cards import cards_of, split_columns, text_of
from programs import run_deck, solve
from test_chains import history

import plydyn_pre as pre
from plydyn_pre.deck.delaminations import delamination_keywords
from plydyn_pre.deck.names import Names
from plydyn_pre.mesh.quality import quad_areas
from plydyn_pre.mesh_picture import picture_lines
from plydyn_pre.study_text import set_lines

#: A plate of 60 x 40 with quads of 1
PLATE = pre.Rectangle((60.0, 40.0), (60, 40), corner=(-30.0, -20.0))
CIRCLE, RING, BOX = (3.0, -2.0, 10.0), (0.0, 0.0, 8.0, 16.0), (-20.0, -5.0, -10.0, 10.0)


def plate(**values: object) -> pre.Study:
    """Four plies with interfaces that fail."""
    laminate = pre.Laminate("[0/90]s", 0.25, "carbon", order=1, interfaces="bond")
    return pre.Study(
        **{
            "title": "Delaminated plate",
            "materials": {"carbon": CARBON, "bond": BOND},
            "laminate": laminate,
            "mesh": PLATE,
            "supports": (pre.Support("left"),),
            "control": pre.Control(end_time=1.0e-6),
        }
        | values
    )


def area_of(rule: pre.PlaceSet, mesh: pre.Mesh) -> float:
    """Area of the quads of a set."""
    names = Names(plate(sets={"it": rule}), mesh)
    return float(quad_areas(mesh)[names.quads_of("it", "")].sum())


def test_quads_of_a_set_cover_its_region() -> None:
    """Boxes along mesh lines exactly; circles by the quads whose middle is inside.

    No part of a quad of size h is further than h/sqrt(2) from its middle, so that the area lies
    between those of circles with a radius smaller and larger by that.
    """
    off = sqrt(0.5)

    def disc(radius: float) -> float:
        return pi * max(radius, 0.0) ** 2

    mesh = pre.make_mesh(PLATE)
    assert area_of(pre.PlaceSet(box=BOX), mesh) == pytest.approx(15.0 * 20.0)
    for radius in (6.0, 10.0, 15.0):
        found = area_of(pre.PlaceSet(circle=(3.0, -2.0, radius)), mesh)
        assert disc(radius - off) < found < disc(radius + off)
    inner, outer = RING[2:]
    ring = area_of(pre.PlaceSet(ring=RING), mesh)
    parts = [area_of(pre.PlaceSet(circle=(0.0, 0.0, r)), mesh) for r in (inner, outer)]
    assert ring == pytest.approx(parts[1] - parts[0])


def test_a_set_has_the_quads_whose_middle_is_inside_and_the_nodes_inside() -> None:
    """Whether it is nodes or quads is told by the keyword that uses it."""
    mesh = pre.make_mesh(PLATE)
    names = Names(plate(sets={"it": pre.PlaceSet(circle=CIRCLE)}), mesh)
    for places, found in (
        (mesh.nodes, names.nodes_of("it", "")),
        (mesh.nodes[mesh.quads[:, 8]], names.quads_of("it", "")),
    ):
        inside = np.hypot(*(places - CIRCLE[:2]).T) <= CIRCLE[2]
        assert found.tolist() == np.flatnonzero(inside).tolist()
    (line,) = set_lines(names.study, mesh)
    assert line.startswith("it: ") and line.endswith(" mm2")


def test_a_set_of_nodes_alone_or_of_quads_alone_is_listed() -> None:
    """An edge holds the middle of no quad, and a quad of four nodes has none in its middle."""
    mesh = pre.make_mesh(replace(PLATE, order=1))
    edge, middle = float(mesh.nodes[:, 0].max()), mesh.nodes[mesh.quads[0]].mean(axis=0)
    sets = {
        "end": pre.PlaceSet(box=(edge, edge, -1.0e3, 1.0e3)),
        "one": pre.PlaceSet(circle=(*map(float, middle), 1.0e-3)),
    }
    lines = list(set_lines(plate(sets=sets, mesh=PLATE), mesh))
    count = np.count_nonzero(mesh.nodes[:, 0] == edge)
    assert lines[0] == f"end: {count} nodes, 0 quads, 0 mm2"
    assert lines[1].startswith("one: 0 nodes, 1 quads, ")
    picture = "\n".join(picture_lines(plate(sets=sets, mesh=PLATE), mesh))
    assert f"set end: {count} nodes" in picture
    assert "set one: 1 quads" in picture
    nowhere = plate(sets={"off": pre.PlaceSet(circle=(1.0e3, 0.0, 1.0))}, mesh=PLATE)
    with pytest.raises(pre.RecipeError, match=r"sets\.off\.circle: neither a node nor the middle"):
        list(set_lines(nowhere, mesh))


def test_pressures_and_supports_take_sets_by_place() -> None:
    """One set, written as nodes and as quads."""
    study = plate(
        sets={"patch": pre.PlaceSet(box=BOX)},
        supports=(pre.Support("patch", hold="z", face="bottom"),),
        loads=(pre.Pressure(1.0, set="patch"),),
    )
    assert not pre.unused(study)
    cards = cards_of(text_of(study))
    assert len(cards["SET_SHELL_LIST_TITLE"][2:]) == -(-300 // 8)
    assert len(cards["SET_NODE_LIST_TITLE"][2:]) == -(-31 * 41 // 8)


def test_interfaces_are_written_in_ranges() -> None:
    """All, one, and several with a gap."""
    mesh = replace(PLATE, quads=(6, 4))
    laminate = replace(plate().laminate, layup="[0_2/90/0/45_2/0]")
    for interfaces, material, ranges in (
        ("all", "bond", [["1", "6"]]),
        (3, "bond", [["3", "3"]]),
        ((5, 1, 2), "bond", [["1", "2"], ["5", "5"]]),
        ("all", "bond between unlike plies", [["2", "4"], ["6", "6"]]),
    ):
        one = pre.InitialDelamination(interfaces, circle=(1.0, 2.0, 12.0))
        study = plate(
            mesh=mesh,
            laminate=replace(laminate, interfaces=material),
            initial_delamination=(one,),
        )
        rows = [split_columns(row, 10) for row in cards_of(text_of(study))["INITIAL_DELAMINATION"]]
        assert [row[1:3] for row in rows] == ranges
        assert all(row[3:] == ["0", "1.0", "2.0", "12.0"] for row in rows)


def test_regions_are_sets_of_their_own() -> None:
    """A box of a delamination needs no name; a damage below one is another keyword."""
    ring = pre.InitialDelamination((1,), ring=RING)
    part = pre.InitialDelamination((2,), box=BOX, damage=0.25)
    named = pre.InitialDelamination(3, set="it")
    study = plate(
        initial_delamination=(ring, part, named), sets={"it": pre.PlaceSet(circle=CIRCLE)}
    )
    assert not pre.unused(study)
    cards = cards_of(text_of(study))
    first, third = (split_columns(row, 10) for row in cards["INITIAL_DELAMINATION"])
    (second,) = (split_columns(row, 10) for row in cards["INITIAL_DAMAGE"])
    assert [first, second, third] == [
        ["1", "1", "1", "1"],
        ["1", "2", "2", "2", "0.25"],
        ["1", "3", "3", "3"],
    ]
    heads = [row for row in cards["SET_SHELL_LIST_TITLE"] if not row.strip()[:1].isdigit()]
    assert heads == ["initial_delamination[1]", "initial_delamination[2]", "it"]


def test_a_region_has_the_quads_of_its_part() -> None:
    """A box over two parts, and one beside the part."""
    study = plate()
    mesh = pre.make_mesh(PLATE)
    middles = mesh.nodes[mesh.quads[:, 8]]
    parts = {"one": middles[:, 0] < -10.0, "other": middles[:, 0] > -10.0}
    mesh = replace(mesh, parts={name: np.flatnonzero(inside) for name, inside in parts.items()})
    one = pre.InitialDelamination(1, box=BOX, part="one")
    names = Names(replace(study, initial_delamination=(one,)), mesh)
    assert next(delamination_keywords(names)).startswith("*INITIAL_DELAMINATION")
    # 10 of the 15 quads along x
    assert len(names.quads_of("initial_delamination[1]", "")) == 10 * 20
    beside = replace(one, box=(0.0, 5.0, 0.0, 5.0))
    names = Names(replace(study, initial_delamination=(beside,)), mesh)
    with pytest.raises(pre.RecipeError, match="no quad of the part 'one' has its middle in it"):
        list(delamination_keywords(names))


def test_the_solver_takes_delaminations(solver: str, tmp_path: Path) -> None:
    """Sets and circles of all kinds, without a warning of its own."""
    study = plate(
        mesh=replace(PLATE, quads=(30, 20)),
        initial_delamination=(
            pre.InitialDelamination((1, 3), circle=CIRCLE),
            pre.InitialDelamination(2, ring=RING, damage=0.5),
            pre.InitialDelamination(2, box=BOX),
        ),
    )
    (tmp_path / "job.k").write_text(text_of(study))
    solve(solver, tmp_path, "check", "job.k")


def test_the_run_has_failed_areas_of_the_inserts(solver: str, tmp_path: Path) -> None:
    """A circle whose edge is a mesh line and a box of whole quads have their area, others none.

    Sides of quads of nine nodes are parabolas: with 32 around the circle their area is right to
    1e-5. A damage of a half is no delamination.
    """
    radius = 12.0
    study = plate(
        mesh=pre.Coupon(plate=(60.0, 40.0), window=2.0 * radius, core=12.0, quad=1.5, largest=4.0),
        initial_delamination=(
            pre.InitialDelamination(1, circle=(0.0, 0.0, radius)),
            pre.InitialDelamination(2, box=(-6.0, 6.0, -6.0, 6.0)),
            pre.InitialDelamination(3, circle=(0.0, 0.0, radius), damage=0.25),
        ),
        outputs=pre.Outputs(delamination_interval=1.0e-7),
    )
    (tmp_path / "c.k").write_text(text_of(study))
    run_deck(solver, tmp_path, "c.k")
    table = history(tmp_path, "c.delamination")
    areas = [float(table[f"interface {k} failed area"][-1]) for k in (1, 2, 3)]
    assert areas == pytest.approx([pi * radius**2, 144.0, 0.0], rel=1.0e-4)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("quadrature", ["gauss", "nodes"])
def test_a_small_circle_has_points_for_the_solver_too(
    order: int, quadrature: str, solver: str, tmp_path: Path
) -> None:
    """Around a node and around a Gauss point: both say whether the interface is looked at there."""
    size = 5.0
    gauss = size / 2.0 * (1.0 + (sqrt(1.0 / 3.0) if order == 1 else sqrt(0.6)))
    for place, has_point in ((0.0, quadrature == "nodes"), (gauss, quadrature == "gauss")):
        one = pre.InitialDelamination(1, circle=(place, place, 0.1))
        bond = replace(BOND, quadrature=quadrature)
        study = plate(
            mesh=replace(PLATE, quads=(12, 8), order=order),
            materials={"carbon": CARBON, "bond": bond},
        )
        # what the solver says, whatever the recipe would
        head = text_of(study).removesuffix("*END\n")
        card = f"*INITIAL_DELAMINATION\n1,1,1,0,{place:.6f},{place:.6f},0.1\n*END\n"
        (tmp_path / "job.k").write_text(head + card)
        words = [solver, "check", "job.k"]
        done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert (done.returncode == 0) == has_point, done.stdout + done.stderr
        study = replace(study, initial_delamination=(one,))
        if has_point:
            assert "*INITIAL_DELAMINATION" in text_of(study)
        else:
            with pytest.raises(pre.RecipeError, match="no point of the interfaces lies in it"):
                text_of(study)


@pytest.mark.parametrize(
    ("values", "path", "words"),
    [
        ({"box": BOX, "circle": CIRCLE}, "", "one of set, box, circle and ring"),
        ({"set": "it", "circle": CIRCLE}, "", "one of set, box, circle and ring"),
        ({"interfaces": ()}, "interfaces", "empty"),
        ({"damage": 0.0}, "damage", "above 0"),
        ({"damage": 1.5}, "damage", "1 at most"),
        ({"ring": (0.0, 0.0, 3.0, 3.0)}, "ring", "inner < outer"),
        ({"interfaces": 4}, "initial_delamination[1].interfaces", "to 3"),
        ({"interfaces": (1, 0)}, "initial_delamination[1].interfaces", "0 must be from 1"),
        ({"interfaces": 2}, "initial_delamination[1].interfaces", "tied, for they have one"),
        ({"set": "insert"}, "initial_delamination[1].set", "did you mean 'inserts'?"),
        ({"part": "skin"}, "initial_delamination[1].part", "no part of the mesh"),
        ({"box": (40.0, 50.0, 0.0, 5.0)}, "initial_delamination[1].box", "no quad"),
        ({"circle": (0.5, 0.5, 0.1)}, "initial_delamination[1].circle", "no point of the"),
        ({"set": "spot"}, "sets.spot.at", "has nodes only"),
    ],
)
def test_delaminations_that_cannot_be_are_refused(
    values: dict[str, object], path: str, words: str
) -> None:
    """Each with its keys and what would be right."""
    sets = {"inserts": pre.PlaceSet(box=BOX), "spot": pre.PlaceSet(at=(0.0, 0.0))}
    laminate = replace(plate().laminate, interfaces="bond between unlike plies")
    with pytest.raises(pre.RecipeError) as caught:
        one = pre.InitialDelamination(**values)
        mesh = replace(PLATE, quads=(12, 8), order=1)
        text_of(plate(initial_delamination=(one,), sets=sets, mesh=mesh, laminate=laminate))
    assert caught.value.path == path
    assert words in caught.value.message


@pytest.mark.parametrize("interfaces", ["tied", "apart"])
def test_interfaces_that_cannot_fail_are_refused(interfaces: str) -> None:
    """Delamination needs a material that fails."""
    laminate = replace(plate().laminate, interfaces=interfaces)
    one = pre.InitialDelamination(1)
    with pytest.raises(pre.RecipeError, match="a cohesive material is needed"):
        text_of(plate(laminate=laminate, initial_delamination=(one,)))


def test_bricks_have_no_delaminations() -> None:
    """Their plies share nodes."""
    laminate = replace(plate().laminate, interfaces="tied")
    one = (pre.InitialDelamination(1),)
    with pytest.raises(pre.RecipeError, match=r"initial_delamination: plies of bricks are tied"):
        plate(laminate=laminate, bricks=pre.Bricks(), initial_delamination=one)


def test_recipes_have_delaminations(tmp_path: Path) -> None:
    """A word, a number or a list; what is none of these is told."""
    recipe = tmp_path / "insert.toml"
    text = """
title = "Insert"
laminate = { layup = "[0/90]s", material = "IM7/8552", thickness = 0.2, interfaces = "IM7/8552" }
mesh = { kind = "rectangle", sides = [60, 40], quads = [6, 4] }
control.end_time = 1e-3
[[initial_delamination]]
circle = [30, 20, 10]
"""
    for line, expected in (
        ("", "all"),
        ('interfaces = "all"', "all"),
        ("interfaces = 2", 2),
        ("interfaces = [1, 3]", (1, 3)),
    ):
        recipe.write_text(text + line)
        (one,) = pre.load_recipe(recipe).initial_delamination
        assert one == pre.InitialDelamination(expected, circle=(30.0, 20.0, 10.0))
    for line, words in (
        ('interfaces = "al"', "initial_delamination[1].interfaces: 'al' was given, one of \"all\""),
        ("interfaces = 1.5", "initial_delamination[1].interfaces: 1.5 was given, a whole number"),
        ("interface = 1", "interface: there is no such key; did you mean 'interfaces'?"),
    ):
        recipe.write_text(text + line)
        with pytest.raises(pre.RecipeError) as caught:
            pre.load_recipe(recipe)
        assert words in str(caught.value)
