"""Strengths of plies between others, against published numbers, and what decks make of them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from deck_cards import cards_of, text_of
from programs import plydyn_pre, solve

import plydyn_pre as pre

#: Constants that the strengths depend on; the others are those of any ply
IM7 = {"E1": 171420.0, "E2": 9080.0, "nu12": 0.32, "G12": 5290.0, "YT": 62.3, "SL": 92.3}
IM7 |= {"YC": 199.8, "GIC": 0.277, "GIIC": 0.788, "cubic": 2.98e-8}
HTS40 = {"GIC": 0.28, "GIIC": 0.79}
T700 = {"E1": 130000.0, "E2": 7700.0, "nu12": 0.3, "G12": 4800.0, "YT": 60.0, "SL": 110.0}
T700 |= {"GIC": 0.5, "GIIC": 1.6}


@pytest.mark.parametrize(
    ("constants", "thickness", "tension", "shear"),
    [
        # Camanho et al. (2006) print 160.2, 101.4, 130.2 and 107.0
        (IM7, 0.125, (160.1, 101.3), (130.2, 107.0)),
        (IM7, 0.131, (156.4, 98.9), (128.5, 105.6)),
        (IM7, 0.183, (132.3, 83.7), (117.0, 95.7)),
        (IM7, 0.262, (110.5, 69.9), (113.0, 92.3)),
        (HTS40, 0.25, (129.9, 82.0), (219.7, 155.4)),
        (HTS40, 0.5, (129.9, 82.0), (155.4, 109.9)),
        (T700, 0.26, (137.3, 86.9), (274.0, 194.0)),
        (T700, 0.52, (97.1, 61.4), (194.0, 137.0)),
    ],
)
def test_strengths_are_those_of_the_published_formulae(
    constants: dict[str, float],
    thickness: float,
    tension: tuple[float, float],
    shear: tuple[float, float],
    ply: pre.PlyCodam2,
) -> None:
    ply = replace(ply, **constants)
    for outer, across, along in zip((False, True), tension, shear, strict=True):
        found = pre.in_situ(ply, thickness, outer)
        # the table has a digit behind the point, cut or rounded, or none
        assert pytest.approx(across, abs=0.1) == found.YT
        assert pytest.approx(along, abs=0.5 if along == round(along) else 0.1) == found.SL
        assert pytest.approx(ply.YC * found.SL / ply.SL, rel=1e-12) == found.YC


def test_without_nonlinear_shear_a_thick_ply_has_root_two_of_its_strength(
    ply: pre.PlyCodam2,
) -> None:
    thick = pre.in_situ(replace(ply, **HTS40), 100.0, False)
    assert pytest.approx(2.0**0.5 * ply.SL, rel=1e-12) == thick.SL
    assert pytest.approx(1.12 * 2.0**0.5 * ply.YT, rel=1e-12) == thick.YT
    free = pre.in_situ(replace(ply, **HTS40), 100.0, True)
    assert (free.YT, free.SL) == (ply.YT, ply.SL)


def test_the_work_of_shear_at_the_strength_pays_for_the_crack(ply: pre.PlyCodam2) -> None:
    # of Ramberg and Osgood's curve, integrated by its points: 4 GIIC / (pi t) per volume
    power = {"shear": "ramberg_osgood", "shear_coefficient": 7.675e-13, "shear_exponent": 5.4}
    ply = replace(ply, **(IM7 | power | {"cubic": 0.0}))
    strength = pre.in_situ(ply, 0.1, False).SL
    steps = 20000
    stress = [strength * i / steps for i in range(steps + 1)]
    strain = [s / 5290.0 + 7.675e-13 * s**5.4 for s in stress]
    work = sum(
        0.5 * (stress[i] + stress[i + 1]) * (strain[i + 1] - strain[i]) for i in range(steps)
    )
    assert work == pytest.approx(4.0 * 0.788 / (3.141592653589793 * 0.1), rel=1e-6)


def test_a_ply_with_planes_of_fracture_has_the_work_of_its_hardening_shear() -> None:
    # thin: tau^2/2G + (tau^2 - SP^2)/(2 G KP) = 4 G2S/(pi t), solved for tau
    card = pre.find_card("IM7/8552 3D")
    ply = pre.PlyFracture3d(**{key: entry.value for key, entry in card.values.items()})
    thickness, gain = 0.05, 0.05
    work = 4.0 * 0.788 / (3.141592653589793 * thickness)
    shear = ((2.0 * 5290.0 * work * gain + 66.9**2) / (1.0 + gain)) ** 0.5
    found = pre.in_situ(ply, thickness, False)
    assert pytest.approx(shear, rel=1e-9) == found.SL
    assert pytest.approx(199.8 * shear / 92.3, rel=1e-9) == found.YC
    # in opening it is the ply of the published table
    assert pytest.approx(160.1, abs=0.1) == pre.in_situ(ply, 0.125, False).YT


def test_clusters_of_plies_with_planes_of_fracture_have_materials_of_their_own(
    study: pre.Study, bond: pre.Cohesive
) -> None:
    card = pre.find_card("IM7/8552 3D")
    ply = pre.PlyFracture3d(**{key: entry.value for key, entry in card.values.items()})
    laminate = pre.Laminate("[0/90_2]s", 0.131, "C", strengths="in-situ", interfaces="bond")
    text = text_of(replace(study, materials={"C": ply, "bond": bond}, laminate=laminate))
    lines = cards_of(text)["MAT_PLY_FRACTURE_3D_TITLE"]
    strengths = [line.split() for line in lines if line.split()[0] == "2326.2"]
    # outer as published; four plies of 90 degrees are thick: 1.12 sqrt(2) YT
    thick = 1.12 * 2.0**0.5 * 62.3
    assert [float(words[2]) for words in strengths] == pytest.approx([98.9, thick], abs=0.1)
    assert {words[5] for words in strengths} == {"53.0"}


def test_toughnesses_of_the_matrix_stand_in_for_those_of_cracks_through_the_ply(
    ply: pre.PlyCodam2,
) -> None:
    own = replace(ply, GIC=0.3, GIIC=0.8)
    others = replace(ply, G2T=0.3, G2S=0.8)
    assert pre.in_situ(own, 0.1, False) == pre.in_situ(others, 0.1, False)


def test_neighbours_of_one_direction_and_material_are_one_cluster() -> None:
    laminate = pre.Laminate("[90/0_2/180/0/M:0/-90]", {"C": 0.1, "M": 0.2}, "C")
    found = [(c.first, c.last, round(c.thickness, 9), c.outer) for c in pre.clusters(laminate)]
    assert found == [(1, 1, 0.1, True), (2, 5, 0.4, False), (6, 6, 0.2, False), (7, 7, 0.1, True)]


@pytest.fixture
def damaged(study: pre.Study, ply: pre.PlyCodam2, bond: pre.Cohesive) -> pre.Study:
    """A study of damaged plies with in-situ strengths, apart where their directions differ."""
    return replace(
        study,
        materials={"C": replace(ply, **IM7), "bond": bond},
        laminate=pre.Laminate(
            "[45/0_2/-45/90]s", 0.131, "C", strengths="in-situ", interfaces="bond"
        ),
    )


def test_each_cluster_has_a_material_of_its_own_in_the_deck(damaged: pre.Study) -> None:
    cards = cards_of(text_of(damaged))
    mids = [line.split()[0] for line in cards["PART_COMPOSITE_LONG"][2:]]
    assert mids == ["1", "2", "2", "3", "2", "2", "3", "2", "2", "1"]
    lines = cards["MAT_PLY_CODAM2_TITLE"]
    assert [line for line in lines if line[0] == "C"] == [
        "C in situ 0.131 outer",
        "C in situ 0.262 embedded",
        "C in situ 0.131 embedded",
    ]
    strengths = [[float(word) for word in line.split()] for line in lines[3::8]]
    assert [row[2] for row in strengths] == pytest.approx([98.9, 110.55, 156.4], abs=0.06)
    assert [row[4] for row in strengths] == pytest.approx([105.6, 113.0, 128.5], abs=0.06)
    given = replace(damaged, laminate=replace(damaged.laminate, strengths="given"))
    assert cards_of(text_of(given))["MAT_PLY_CODAM2_TITLE"][0] == "C"
    assert pre.unused(damaged) == pre.unused(given)


def test_like_plies_are_tied_and_unlike_ones_are_not(damaged: pre.Study) -> None:
    laminate = replace(damaged.laminate, interfaces="bond between unlike plies")
    unlike = replace(damaged, laminate=laminate)
    rows = [line.split()[1:3] for line in cards_of(text_of(unlike))["INTERFACE_COHESIVE"]]
    assert rows == [["1", "1"], ["3", "4"], ["6", "7"], ["9", "9"]]
    assert laminate.opened == (1, 3, 4, 6, 7, 9)
    # ten plies of order 2 have 21 levels, and one more for each interface that opens
    assert (laminate.levels, damaged.laminate.levels) == (21 + 6, 21 + 9)
    alike = replace(damaged.laminate, layup="[0]4", interfaces="bond between unlike plies")
    assert alike.tied and alike.levels == 9
    assert "INTERFACE_COHESIVE" not in cards_of(text_of(replace(damaged, laminate=alike)))


RECIPE = """
title = "Unlike"
[laminate]
layup = "[0_2/90]s"
material = "IM7/8552"
thickness = 0.131
interfaces = "between unlike plies"
strengths = "in-situ"
[mesh]
kind = "rectangle"
sides = [10, 10]
quads = [2, 2]
[control]
end_time = 1e-6
"""


def test_the_interface_of_the_ply_is_meant_where_none_is_named(tmp_path: Path) -> None:
    path = tmp_path / "job.toml"
    path.write_text(RECIPE, encoding="utf-8")
    study = pre.load_recipe(path)
    assert study.laminate.joint == "IM7/8552 interface"
    assert study.laminate.opened == (2, 4)
    own = '[materials.glue]\nkind = "springs"\nnormal = 1e6\nshear = 1e6\n[laminate]'
    path.write_text(RECIPE.replace("[laminate]", own), encoding="utf-8")
    assert pre.load_recipe(path).laminate.joint == "glue"


def test_in_situ_strengths_without_what_they_need_are_refused(damaged: pre.Study) -> None:
    elastic = {"C": pre.Elastic(density=1e-9, E=1e4, nu=0.3)}
    with pytest.raises(pre.RecipeError, match=r'laminate\.strengths: "in-situ" needs a material'):
        replace(damaged, materials=damaged.materials | elastic)
    without = replace(damaged.materials["C"], GIIC=0.0)
    with pytest.raises(pre.RecipeError, match=r"materials\.C\.GIIC: 0; in-situ strengths need"):
        replace(damaged, materials=damaged.materials | {"C": without})


def test_strengths_are_printed_and_linear_shear_is_told(tmp_path: Path) -> None:
    (tmp_path / "job.toml").write_text(RECIPE, encoding="utf-8")
    result = plydyn_pre(tmp_path, "strengths", "job.toml")
    assert result.returncode == 0, result.stderr
    cells = [line.split() for line in result.stdout.splitlines()[1:]]
    assert [row[:4] for row in cells] == [
        ["1-2", "0", "0.262", "outer"],
        ["3-4", "90", "0.262", "embedded"],
        ["5-6", "0", "0.262", "outer"],
    ]
    assert [float(row[5]) for row in cells] == pytest.approx([69.9, 110.5, 69.9], abs=0.1)
    assert not result.stderr
    words = ("--set", "laminate.material=T700/M21")
    result = plydyn_pre(tmp_path, "strengths", "job.toml", *words)
    assert "materials.T700/M21: its shear is taken as linear" in result.stderr


def test_the_solver_accepts_them(solver: str, tmp_path: Path) -> None:
    (tmp_path / "job.toml").write_text(RECIPE, encoding="utf-8")
    study = pre.load_recipe(tmp_path / "job.toml")
    pre.write_deck(pre.deck_text(study, pre.make_mesh(study.mesh)), tmp_path / "job.k")
    solve(solver, tmp_path, "check", "job.k")
