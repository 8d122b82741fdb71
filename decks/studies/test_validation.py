"""What the page of the validation says of runs and of beams."""

from __future__ import annotations

from pathlib import Path

import pytest

from runner.cases import StudyError
from studies.mechanisms import mechanisms
from studies.validation import AT_25, BANDS, BLIND, TESTS, beams_text

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
            "T700/M21 interface",
        }
    assert all(Path(test.case.path).is_file() for test in (*TESTS, *BLIND))
    assert set(AT_25) == set(TESTS[0].measured)


def test_bands_are_the_blind_impacts_with_one_change_each() -> None:
    """The finer mesh changes nothing but the quads, a seed nothing but the scatter of the bond."""
    for blind, (fine, seeds) in zip(BLIND, BANDS.values(), strict=True):
        assert fine.case.path == blind.case.path
        assert fine.case.varied == ("mesh.quad=2.0",)
        assert [seed.case.path for seed in seeds] == [blind.case.path] * 5
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
