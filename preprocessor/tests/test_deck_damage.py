"""The cards of plies that are damaged and of interfaces that fail."""

from __future__ import annotations

from dataclasses import replace

import pytest
from deck_cards import cards_of, text_of

import plydyn_pre as pre

CRACKED = pre.PlyFracture3d(
    density=1.57e-9,
    E1=171420.0,
    E2=9080.0,
    E3=9080.0,
    nu12=0.32,
    nu13=0.32,
    nu23=0.45,
    G12=5290.0,
    G13=5290.0,
    G23=3131.0,
    XT=2326.2,
    XC=1200.1,
    YT=62.3,
    YC=199.8,
    SL=92.3,
    G1T=97.8,
    G1C=106.3,
    G2T=0.277,
    G2S=0.788,
)


def damaged(study: pre.Study, ply: pre.PlyCodam2, bond: pre.Cohesive) -> pre.Study:
    """The study with plies that are damaged and interfaces that fail."""
    return replace(
        study,
        materials={"ply": ply, "bond": bond},
        laminate=pre.Laminate("[0/90]s", 0.1, "ply", interfaces="bond"),
        outputs=pre.Outputs(
            fields=("damage_matrix",), delamination_interval=1e-6, restart_steps=2000
        ),
    )


def test_a_ply_that_is_damaged_says_all_that_it_is(
    study: pre.Study, ply: pre.PlyCodam2, bond: pre.Cohesive
) -> None:
    ply = replace(ply, shear="exponential", width_rule="gauss_point", closure=True, G2S=0.79)
    ply = replace(ply, FXT=0.75, FGXT=0.375)
    cards = cards_of(text_of(damaged(study, ply, bond)))["MAT_PLY_CODAM2_TITLE"]
    assert [line.split() for line in cards] == [
        ["ply"],
        ["1", "1.6e-09", "153000.0", "10300.0", "10300.0", "0.3", "0.3", "0.4"],
        ["6000.0", "6000.0", "3700.0"],
        ["2537.0", "1580.0", "82.0", "236.0", "90.0", "0.0"],
        ["91.6", "79.9", "0.22", "1.1", "0.0", "0.999", "0.79"],
        ["1", "0", "0.05", "0.0", "0.0"],
        ["1", "0", "1.05", "0", "0", "1", "0.0", "1"],
        ["0.0", "0.0", "0.0", "0.75", "0.375", "1.0", "1.0"],
    ]


def test_a_ply_can_average_over_its_neighbours(
    study: pre.Study, ply: pre.PlyCodam2, bond: pre.Cohesive
) -> None:
    ply = replace(ply, average_along=3.0, average_across=2.0)
    cards = cards_of(text_of(damaged(study, ply, bond)))["MAT_PLY_CODAM2_TITLE"]
    assert cards[7].split()[:3] == ["0.0", "3.0", "2.0"]
    assert cards[6].split()[5] == "0"  # cracks never close there


@pytest.mark.parametrize(
    ("keyword", "column"), [("MAT_PLY_CODAM2_TITLE", 1), ("MAT_PLY_FRACTURE_3D_TITLE", 5)]
)
def test_a_ply_can_take_its_shear_from_a_curve(
    keyword: str, column: int, study: pre.Study, ply: pre.PlyCodam2, bond: pre.Cohesive
) -> None:
    each = ply if column == 1 else CRACKED
    ply = replace(each, shear="curve", shear_curve="shear")
    curve = pre.Curve((0.0, 0.01, 0.05), (0.0, 44.3, 90.0))
    with_curve = damaged(replace(study, curves={**study.curves, "shear": curve}), ply, bond)
    cards = cards_of(text_of(with_curve))
    start = cards["DEFINE_CURVE_TITLE"].index("shear")
    lcid = cards["DEFINE_CURVE_TITLE"][start + 1].split()[0]
    fields = cards[keyword][5].split()
    assert [fields[0], fields[column]] == ["2", lcid]
    assert "curves.shear" not in pre.unused(with_curve)
    with pytest.raises(pre.RecipeError, match=r"materials\.ply\.shear_curve"):
        damaged(study, ply, bond)


def test_a_bond_that_fails_says_all_that_it_is(
    study: pre.Study, ply: pre.PlyCodam2, bond: pre.Cohesive
) -> None:
    nodes = replace(bond, quadrature="nodes", closing="whole", friction=0.3, fit="strengths")
    cards = cards_of(text_of(damaged(study, ply, nodes)))
    assert [line.split() for line in cards["MAT_COHESIVE_MIXED_MODE_TITLE"]] == [
        ["bond"],
        ["2", "0.0", "0", "0", "1373300.0", "493300.0", "0.28", "0.79"],
        ["-1.634", "62.3", "92.3", "0.0", "0.0"],
    ]
    assert cards["INTERFACE_COHESIVE"][0].split() == ["1", "0", "0", "2", "1", "1", "0.3", "2"]
    assert cards["DATABASE_DELAM"][0].split() == ["1e-06"]
    assert cards["DATABASE_BINARY_RUNRSF"][0].split() == ["2000"]
    law = replace(
        bond, mode_mix="work", pressure_gain=0.74, scatter=12.0, scatter_length=1.5, seed=4
    )
    cards = cards_of(text_of(damaged(study, ply, law)))
    assert cards["INTERFACE_LAW"][0].split() == ["2", "1", "0.74"]
    assert cards["INTERFACE_SCATTER"][0].split() == ["2", "4", "12.0", "1.5"]
    other = replace(bond, mixing="power", exponent=1.0)
    cards = cards_of(text_of(damaged(study, ply, other)))
    assert cards["MAT_COHESIVE_MIXED_MODE_TITLE"][2].split()[0] == "1.0"


def test_a_ply_with_planes_of_fracture_says_all_that_it_is(
    study: pre.Study, bond: pre.Cohesive
) -> None:
    ply = replace(CRACKED, shear="hardening", shear_yield=66.9, shear_hardening=0.05)
    ply = replace(ply, friction=0.3, width_rule="root_point", crush_stress=300.0)
    ply = replace(ply, debris_limit=0.01, debris_share=0.2, FXC=0.614, FGXC=0.432)
    laminate = pre.Laminate("[0/90]s", 0.1, "ply", interfaces="bond")
    fields = ("damage_matrix", "plastic_strain", "dissipated")
    cracked = replace(
        study,
        materials={"ply": ply, "bond": bond},
        laminate=laminate,
        outputs=pre.Outputs(fields=fields),
    )
    cards = cards_of(text_of(cracked))["MAT_PLY_FRACTURE_3D_TITLE"]
    assert [line.split() for line in cards] == [
        ["ply"],
        ["1", "1.57e-09", "171420.0", "9080.0", "9080.0", "0.32", "0.32", "0.45"],
        ["5290.0", "5290.0", "3131.0"],
        ["2326.2", "1200.1", "62.3", "199.8", "92.3", "53.0"],
        ["97.8", "106.3", "0.277", "0.788", "0.0", "0.999", "1.45"],
        ["4", "0.0", "0.0", "66.9", "0.05", "0"],
        ["0.3", "0.0", "2", "300.0", "0.01", "0.2"],
        ["1.0", "1.0", "0.614", "0.432"],
    ]


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("fracture_angle", 45.0),
        ("friction", 1.5),
        ("debris_share", 0.2),
        ("XT", 2326.2e3),
        ("largest_damage", 1.0),
    ],
)
def test_a_plane_of_fracture_that_cannot_be_is_refused(key: str, value: float) -> None:
    with pytest.raises(pre.RecipeError, match=key):
        replace(CRACKED, **{key: value})


def test_permanent_shear_that_cannot_be_is_refused() -> None:
    with pytest.raises(pre.RecipeError, match="shear_yield"):
        replace(CRACKED, shear="hardening", shear_yield=95.0, shear_hardening=0.05)
    with pytest.raises(pre.RecipeError, match="shear_exponent"):
        replace(CRACKED, shear="ramberg_osgood", shear_coefficient=1e-12, shear_exponent=1.0)
    with pytest.raises(pre.RecipeError, match="shear_curve: the name of a curve"):
        replace(CRACKED, shear="curve")
    with pytest.raises(pre.RecipeError, match="shear_curve: the name of a curve"):
        replace(CRACKED, shear_curve="shear")
    assert replace(CRACKED, shear_yield=60.0).idle == ("shear_yield",)


def test_strengths_do_not_scatter_over_less_than_round_off(
    study: pre.Study, ply: pre.PlyCodam2, bond: pre.Cohesive
) -> None:
    """Far from the origin of their field, all strengths would be one in the end."""
    fine = replace(bond, scatter=10.0, scatter_length=1.0e-3)
    assert text_of(damaged(study, ply, fine))
    with pytest.raises(pre.RecipeError, match=r"materials\.bond\.scatter_length: 1e-12 is"):
        text_of(damaged(study, ply, replace(fine, scatter_length=1.0e-12)))
