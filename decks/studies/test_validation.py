"""What the page of the validation says of runs and of beams."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from plydyn_post.interfaces import Interface
from plydyn_pre.layup import parse
from plydyn_pre.library import find_card
from plydyn_pre.mesh import make_mesh
from runner.cases import StudyError
from studies import cross_ply, open_hole
from studies.blind import BANDS, BLIND, FIRST, SECOND
from studies.mechanisms import mechanisms
from studies.validation import AT_25, TESTS, beams_text

ROW = "| {} | 2 | {} | {} | 150.0 | 1.200 | 0.750 | 1.0 ± 0.1 | 1e-3 |"


def test_measured_and_theory_follow_from_the_ratios() -> None:
    """150 N are 1.2 of theory and 0.75 of the test; other meshes and variants are left out."""
    rows = [ROW.format(*cells) for cells in (("DCB", "1", ""), ("DCB", "2", ""), ("ENF", "1", "x"))]
    page = "\n".join(["<!-- delamination study -->", *rows, "<!-- end of delamination study -->"])
    text = beams_text(page).splitlines()
    assert text[2:] == ["| DCB | 200 | 125 | 150 | -25 % | +20 % |"]


def test_a_page_without_the_study_is_told() -> None:
    """Nothing is left out in silence."""
    with pytest.raises(StudyError, match="no table of the delamination of beams"):
        beams_text("nothing")


def test_blind_recipes_differ_from_the_known_one_by_material_and_energy() -> None:
    """Nothing else may differ, else they would not be the same default."""
    known = TESTS[0].case.model
    for test in BLIND:
        assert not test.measured
        model = test.case.model
        assert (model.mesh, model.laminate, model.control) == (
            known.mesh,
            known.laminate,
            known.control,
        )
        assert model.contact == known.contact
        assert model.fixtures == known.fixtures
        assert {card.title for card in model.materials.values()} == {
            "T700/M21",
            "bond, like T700/M21 interface",
        }
    assert all(Path(test.case.path).is_file() for test in (*TESTS, *BLIND))
    assert set(AT_25) == set(TESTS[0].measured)


def test_bands_are_the_blind_impacts_with_one_change_each() -> None:
    """The finer mesh changes nothing but the quads, a seed nothing but the scatter of the bond."""
    for blind, (meshes, seeds) in zip(BLIND, BANDS.values(), strict=True):
        assert [mesh.case.varied for mesh in meshes] == [(FIRST, "mesh.quad=2.0")]
        assert {one.case.path for one in (*meshes, *seeds)} == {blind.case.path}
        assert len({seed.case.varied for seed in seeds}) == 5
        assert all(word.startswith("materials.bond.") for s in seeds for word in s.case.varied[1:])


def test_the_second_prediction_is_the_recipe_on_three_meshes_with_five_seeds() -> None:
    """Nothing but the quads or the scatter of the bond is chosen: the rest is the default."""
    for blind, (meshes, seeds) in zip(BLIND, SECOND.values(), strict=True):
        assert {one.case.path for one in (*meshes, *seeds)} == {blind.case.path}
        assert [mesh.case.varied for mesh in meshes] == [(), ("mesh.quad=2.0",), ("mesh.quad=1.5",)]
        assert len({seed.case.varied for seed in seeds}) == 5
        assert all(word.startswith("materials.bond.") for s in seeds for word in s.case.varied)


def test_mechanisms_vary_the_impact_of_25_joule_alone() -> None:
    """Each row is the recipe of the test with some keys changed, which the recipe accepts."""
    known = TESTS[0].case
    study = mechanisms()
    assert study.cases[0].varied == ()
    for case in study.cases:
        assert case.path == known.path
        assert case.model.control == known.model.control
    assert len({case.varied for case in study.cases}) == len(study.cases)


def test_cross_ply_plates_have_measured_stiffnesses_and_borrowed_strengths() -> None:
    """The page says whose they are; plates differ by layup, energy, quads and toughness alone.

    Some have the default where crack bands are too wide.
    """
    own, lent = find_card("HS160/REM").values, find_card("IM7/8552").values
    ply = cross_ply.CASES[0].model.materials["ply"]
    for each in fields(ply):
        source = own.get(each.name, lent.get(each.name))
        if source is not None and each.name not in ("ST", "GIC", "GIIC", "cubic"):
            assert getattr(ply, each.name) == source.value, each.name
    first = cross_ply.CASES[0].model
    # a rectangle names the opening that a coupon has, less the edge of the frame
    (frame,) = first.fixtures
    opened = replace(frame, window=tuple(side - 2.0 * frame.edge for side in first.mesh.window))
    for case in cross_ply.CASES:
        model = case.model
        assert model.contact == first.contact
        assert model.fixtures == ((opened if "all over" in case.label else frame),)
        snaps = "reduce" if cross_ply.REDUCED[0] in case.varied else "drop"
        assert model.materials["ply"] == replace(ply, snap_back=snaps)
        assert f"{model.impactor.energy / 1e3:g} J" in case.label
    thick = [(ply.angle, 0.25) for ply in parse("[0_2/90_2]s")]
    assert [(ply.angle, first.laminate.thickness) for ply in parse(first.laminate.layup)] == thick


@pytest.mark.parametrize("below", [0.0, 90.0])
def test_the_shape_of_a_peanut_is_measured_along_the_fibres_below(below: float) -> None:
    """Two lobes over 6 and 4 mm that touch below the impactor over 2 mm; one may be shorter."""
    line = np.arange(-5.0, 6.0)
    x, y = (axis.ravel() for axis in np.meshgrid(line, line, indexing="ij"))
    spent = (np.abs(x) <= 3.0) & (np.abs(y) <= np.where(np.abs(x) < 1.0, 1.0, 2.0))
    along, across = (x, y) if below == 0.0 else (y, x)
    places = np.stack([along, across], axis=-1)[:, None, None, :]
    found = {"energy_share": spent.astype(float)[:, None, None], "damage": np.zeros((121, 1, 1))}
    interface = Interface(1, (below, 90.0 - below), 0.0, places, np.arange(121), found)
    assert cross_ply.shape_of(interface) == cross_ply.Shape(6.0, 4.0, 2.0)
    found["energy_share"] = (spent & (x > -2.5)).astype(float)[:, None, None]
    assert cross_ply.shape_of(interface) == cross_ply.Shape(5.0, 4.0, 2.0)
    found["energy_share"] = np.zeros((121, 1, 1))
    assert cross_ply.shape_of(interface) == cross_ply.Shape(0.0, 0.0, 0.0)


def test_the_coupon_with_a_hole_is_that_of_the_page() -> None:
    """Half of [45/0/-45/90]2s; the strip and its hole, whose circle the mesh follows."""
    for case in open_hole.CASES:
        model = case.model
        half = [ply.angle for ply in parse(model.laminate.layup)]
        assert [*half[::-1], *half] == [ply.angle for ply in parse("[45/0/-45/90]2s")]
        mesh = make_mesh(model.mesh)
        radius = np.hypot(*mesh.nodes[mesh.node_sets["hole"]].T)
        np.testing.assert_allclose(radius, 3.175, rtol=1e-9)
        low, high = mesh.nodes.min(axis=0), mesh.nodes.max(axis=0)
        np.testing.assert_allclose(high - low, [100.0, 38.1])


def test_a_case_of_the_hole_has_one_line_of_softening() -> None:
    """The others have those of the library, and one those of the earlier deck of its source."""
    shares = {
        case.name: [
            float(pair.split("=")[1]) for pair in case.varied if pair.split("=")[0].endswith("XT")
        ]
        for case in open_hole.CASES
    }
    assert shares["open_hole_coarse"] == []
    assert shares["open_hole_coarse_single"] == [1.0, 1.0]
    assert shares["open_hole_coarse_fibres"] == [open_hole.STRENGTH, open_hole.ENERGY]
