"""The text of decks, and what other programs read in it."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from deck_cards import TEXT_LINES, cards_of, fields_of, read_by_client, split_columns, text_of
from programs import solve

import plydyn_pre as pre


def test_a_deck_begins_and_ends_as_it_must(study: pre.Study) -> None:
    lines = text_of(study).splitlines()
    assert lines[0] == "*KEYWORD"
    assert lines[-1] == "*END"


def test_a_deck_is_the_same_whenever_it_is_written(study: pre.Study) -> None:
    assert text_of(study) == text_of(study)


def test_fields_lie_within_their_columns_with_none_left_blank(study: pre.Study) -> None:
    keyword, titles = "", 0
    for line in text_of(study).splitlines():
        if line.startswith("*"):
            keyword = line[1:]
            base = keyword.removesuffix("+").removesuffix("_TITLE")
            titles = TEXT_LINES.get(base, int("_TITLE" in keyword))
        elif titles and not line.startswith("$"):
            titles -= 1
        elif not line.startswith("$") and base != "DATABASE_FIELD":
            assert len(line) <= (160 if keyword.endswith("+") else 80)
            filled = [bool(field) for field in fields_of(keyword, line)]
            assert filled == sorted(filled, reverse=True), (keyword, line)


def test_headers_end_where_the_cards_below_them_end(study: pre.Study) -> None:
    text = text_of(study).split("*ELEMENT_PLATE_Q9")[0]
    for header, card in pairwise(text.splitlines()):
        if header.startswith("$#") and not card.startswith("$#"):
            assert len(header) == len(card), (header, card)


def test_every_keyword_of_the_study_is_there(study: pre.Study) -> None:
    names = {name.removesuffix("+").removesuffix("_TITLE") for name in cards_of(text_of(study))}
    assert names == {
        *("KEYWORD", "TITLE", "CONTROL_UNITS", "CONTROL_TERMINATION", "CONTROL_TIMESTEP"),
        *("CONTROL_LAYERWISE", "DAMPING_GLOBAL", "DATABASE_NODOUT", "DATABASE_SPCFORC"),
        *("DATABASE_BINARY_D3PLOT", "DATABASE_HISTORY_NODE_SET", "DATABASE_FIELD"),
        *("DATABASE_PROFILE", "PART_COMPOSITE_LONG", "SECTION_LAYERWISE", "INTERFACE_COHESIVE"),
        *("MAT_ELASTIC", "MAT_PLY_ELASTIC", "MAT_COHESIVE_ELASTIC", "IMPACTOR_SPHERE"),
        *("CONTACT_IMPACTOR", "BOUNDARY_SPC_SET", "BOUNDARY_FACE", "LOAD_FACE_PRESSURE"),
        *("LOAD_FACE_POINT", "LOAD_FACE_LINE", "LOAD_BODY_Z", "BOUNDARY_FACE_MOTION"),
        *("INITIAL_VELOCITY", "DEFINE_CURVE", "SET_NODE_LIST", "SET_SHELL_LIST", "NODE"),
        *("ELEMENT_PLATE_Q9", "END"),
    }


def test_plies_are_written_one_by_one_from_the_bottom_up(study: pre.Study) -> None:
    title, card, *plies = cards_of(text_of(study))["PART_COMPOSITE_LONG"]
    assert title == "plate [metal/0/90]s"
    assert card.split() == ["1", "0", "1.0", "0"]
    rows = [ply.split() for ply in plies]
    assert [row[0] for row in rows] == ["1", "2", "2", "2", "2", "1"]
    assert [float(row[1]) for row in rows] == [0.3, 0.125, 0.125, 0.125, 0.125, 0.3]
    assert [float(row[2]) for row in rows] == [0, 0, 90, 90, 0, 0]
    assert [row[4] for row in rows] == ["1", "2", "3", "4", "5", "6"]


def test_a_metal_has_hardening_and_rate_on_its_cards(study: pre.Study) -> None:
    metal = pre.PlasticKinematic(7.8e-9, 210000.0, 0.3, 210.0, 2100.0, 0.4, 40.0, 5.0)
    yields = replace(study, materials=study.materials | {"metal": metal})
    title, elastic, rate = cards_of(text_of(yields))["MAT_PLASTIC_KINEMATIC_TITLE"]
    assert title == "metal"
    assert [float(value) for value in elastic.split()] == [1, 7.8e-9, 2.1e5, 0.3, 210, 2100, 0.4]
    assert [float(value) for value in rate.split()] == [40, 5, 0, 0]


def test_ranges_of_plies_have_the_expansion_they_ask_for(study: pre.Study) -> None:
    section, refined = cards_of(text_of(study))["SECTION_LAYERWISE"]
    assert section.split() == ["1", "0", "2", "0", "0", "0", "0"]
    assert refined.split() == ["3", "4", "3", "2"]


def test_the_impactor_starts_its_gap_above_the_top_face(study: pre.Study) -> None:
    def height(face: str, reference: str) -> float:
        changed = replace(
            study,
            laminate=replace(study.laminate, reference=reference, thickness=0.5),
            impactor=replace(study.impactor, gap=0.25),
            contact=pre.Contact(face=face),
        )
        (place,) = [
            line for line in cards_of(text_of(changed))["IMPACTOR_SPHERE_TITLE"] if "1e-05" in line
        ]
        return float(split_columns(place, 10)[5])

    assert height("top", "middle") == 1.5 + 0.25 + 4.0
    assert height("top", "bottom") == 3.0 + 0.25 + 4.0
    assert height("top", "top") == 0.25 + 4.0
    assert height("bottom", "bottom") == -0.25 - 4.0


def two_parts(folder: Path) -> pre.GmshFile:
    """A mesh of two squares side by side, each a part."""
    path = folder / "two.geo"
    path.write_text("""
        SetFactory("OpenCASCADE");
        Rectangle(1) = {0, 0, 0, 1, 1}; Rectangle(2) = {1, 0, 0, 1, 1}; Coherence;
        Transfinite Curve{:} = 3; Transfinite Surface{:}; Recombine Surface{:};
        Physical Surface("left side") = {1}; Physical Surface("right side") = {2};
        Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 0;
    """)
    return pre.GmshFile(path)


def test_every_surface_group_is_a_part_and_the_impactor_hits_one(
    study: pre.Study, tmp_path: Path
) -> None:
    thick = pre.Laminate(layup="[metal]2", thickness=1.0)
    two = replace(
        study,
        mesh=two_parts(tmp_path),
        laminates={"right side": thick},
        sets={},
        supports=(),
        loads=(pre.Pressure(value=1.0, set="left side"),),
        outputs=pre.Outputs(),
    )
    with pytest.raises(pre.RecipeError, match=r"contact\.part: missing; .* left side, right side"):
        text_of(two)
    with pytest.raises(pre.RecipeError, match="did you mean 'right side'"):
        text_of(replace(two, contact=pre.Contact(part="right")))
    cards = cards_of(text_of(replace(two, contact=pre.Contact(part="right side"))))
    assert [cards["PART_COMPOSITE_LONG"][i] for i in (0, 8)] == [
        "left side [metal/0/90]s",
        "right side [metal]2",
    ]
    assert [line.split()[1] for line in cards["ELEMENT_PLATE_Q9"][::2]] == ["1"] * 4 + ["2"] * 4
    assert cards["CONTACT_IMPACTOR"][0].split()[2] == "2"
    assert float(split_columns(cards["IMPACTOR_SPHERE_TITLE"][1], 10)[5]) == 1.0 + 4.0
    quads = cards["ELEMENT_PLATE_Q9"][:8:2]
    ids = [line.split()[0] for line in quads]
    assert cards["SET_SHELL_LIST_TITLE"][2].split() == ids


def test_nodes_keep_their_places_to_nine_digits(study: pre.Study) -> None:
    mesh = pre.make_mesh(study.mesh)
    rows = [fields_of("NODE", line) for line in cards_of(text_of(study))["NODE"]]
    assert [int(row[0]) for row in rows] == mesh.node_ids.tolist()
    places = np.array([[float(x) for x in row[1:4]] for row in rows])
    assert places[:, :2] == pytest.approx(mesh.nodes, rel=1e-9)
    assert not places[:, 2].any()


def test_quads_name_their_nodes_in_order(study: pre.Study) -> None:
    mesh = pre.make_mesh(study.mesh)
    lines = cards_of(text_of(study))["ELEMENT_PLATE_Q9"]
    assert [line.split() for line in lines[::2]] == [[str(eid), "1"] for eid in mesh.quad_ids]
    nodes = np.array([line.split() for line in lines[1::2]], int)
    assert np.array_equal(nodes, mesh.node_ids[mesh.quads])


def test_sets_hold_the_nodes_of_the_mesh(study: pre.Study) -> None:
    mesh = pre.make_mesh(study.mesh)
    lines = cards_of(text_of(study))["SET_NODE_LIST_TITLE"]
    start = lines.index("left")
    ids = []
    for line in lines[start + 2 :]:
        if line[:1] != " ":
            break
        ids += line.split()
    assert [int(nid) for nid in ids] == mesh.node_ids[mesh.node_sets["left"]].tolist()


def test_four_node_quads_are_standard_shells(decks: Path) -> None:
    study = pre.load_recipe(decks / "elastic_impact" / "le1.toml", ["mesh.order=1"])
    mesh = pre.make_mesh(study.mesh)
    (shells,) = read_by_client(text_of(study))["ELEMENT_SHELL"]
    names = ["eid", "pid", "n1", "n2", "n3", "n4"]
    table = shells.elements[names].to_numpy(dtype=int)
    assert np.array_equal(table[:, 0], mesh.quad_ids)
    assert set(table[:, 1]) == {1}
    assert np.array_equal(table[:, 2:], mesh.node_ids[mesh.quads])


def test_another_program_reads_the_elastic_impact(decks: Path) -> None:
    study = pre.load_recipe(decks / "elastic_impact" / "3le1.toml")
    mesh = pre.make_mesh(study.mesh)
    found = read_by_client(text_of(study))
    nodes = found["NODE"][0].nodes
    assert nodes["nid"].tolist() == mesh.node_ids.tolist()
    assert nodes[["x", "y"]].to_numpy(dtype=float) == pytest.approx(mesh.nodes, rel=1e-9)
    assert found["CONTROL_TERMINATION"][0].endtim == 0.65e-3
    assert "CONTROL_TIMESTEP" not in found
    assert found["CONTROL_UNITS"][0].length == "mm"
    assert found["DATABASE_BINARY_D3PLOT"][0].dt == 5.0e-5
    assert found["BOUNDARY_SPC_SET"][0].dofz == 1
    # its *PART_COMPOSITE keeps the first ply only: the others are checked on the text
    assert "PART_COMPOSITE_LONG" in found
    clamped = [each for each in found["SET_NODE_LIST"] if each.title == "boundary"]
    assert [int(nid) for nid in clamped[0].nodes.data] == (
        mesh.node_ids[mesh.node_sets["boundary"]].tolist()
    )


def test_another_program_takes_our_own_keywords_as_a_whole(study: pre.Study) -> None:
    found = read_by_client(text_of(study))
    for name in ("SECTION_LAYERWISE", "MAT_PLY_ELASTIC_TITLE", "IMPACTOR_SPHERE_TITLE"):
        assert isinstance(found[name][0], str)
    assert len(found["ELEMENT_PLATE_Q9"][0].splitlines()) == 3 + 2 * 12


def test_a_load_without_a_curve_is_constant(study: pre.Study) -> None:
    cards = cards_of(text_of(study))
    ramp, constant = cards["LOAD_FACE_PRESSURE"]
    assert ramp.split() == ["1", "1", "1", "0.1"]
    assert constant.split() == ["0", "-1", "0", "0.2"]
    assert cards["LOAD_BODY_Z"][0].split() == ["2", "9810.0"]
    start = cards["DEFINE_CURVE_TITLE"].index("constant")
    points = [line.split() for line in cards["DEFINE_CURVE_TITLE"][start + 2 : start + 4]]
    assert points == [["0", "1"], ["0.0001", "1"]]


def test_a_deck_that_fails_leaves_no_file(study: pre.Study, tmp_path: Path) -> None:
    broken = replace(study, supports=(pre.Support("nowhere"),))
    with pytest.raises(pre.RecipeError):
        pre.write_deck(pre.deck_text(broken, pre.make_mesh(broken.mesh)), tmp_path / "x.k")
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(pre.PreError, match="cannot be written"):
        pre.write_deck(iter(["*KEYWORD"]), tmp_path / "none" / "x.k")


def test_a_deck_replaces_no_recipe_and_no_device(tmp_path: Path) -> None:
    recipe = tmp_path / "recipe.toml"
    recipe.write_text("kept")
    for path, words in ((recipe, "the name of a recipe"), (Path("/dev/null"), "is not a file")):
        with pytest.raises(pre.PreError, match=words):
            pre.write_deck(iter(["*KEYWORD"]), path)
    assert recipe.read_text() == "kept"
    assert Path("/dev/null").is_char_device()


def recipes() -> list[Path]:
    """All recipes that come with plydyn."""
    return sorted((Path(__file__).resolve().parents[2] / "decks").glob("*/*.toml"))


@pytest.mark.parametrize("path", recipes(), ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_the_solver_accepts_every_recipe(path: Path, solver: str, tmp_path: Path) -> None:
    study = pre.load_recipe(path)
    if study.bricks:
        # half a million of them want a minute, and are read as a sixteenth is
        study = pre.load_recipe(path, ["mesh.quads=[20, 20]"])
    check(study, solver, tmp_path)


def test_the_solver_accepts_everything_at_once(
    study: pre.Study, solver: str, tmp_path: Path
) -> None:
    check(study, solver, tmp_path)


def check(study: pre.Study, solver: str, folder: Path) -> None:
    """Have a deck checked by the solver."""
    pre.write_deck(pre.deck_text(study, pre.make_mesh(study.mesh)), folder / "job.k")
    solve(solver, folder, "check", "job.k")
