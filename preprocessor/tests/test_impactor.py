"""Impactors of every shape in decks: their cards, and where the solver sees them touch."""

from __future__ import annotations

import re
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from deck_cards import cards_of, fields_of, text_of

import plydyn_pre as pre

DOWN = (0.0, 0.0, -1000.0)
GAP = 0.05
#: One of each, with what it reaches below its centre
BODIES = {
    "sphere": (pre.Impactor(4.0, 1.0e-5, DOWN, gap=GAP), 4.0),
    "tup": (pre.Impactor(4.0, 1.0e-5, DOWN, gap=GAP, kind="tup", length=20.0), 4.0),
    "cylinder": (
        pre.Impactor(4.0, 1.0e-5, DOWN, gap=GAP, kind="cylinder", length=10.0, edge=0.5),
        5.0,
    ),
    "lying": (
        pre.Impactor(
            *(2.0, 1.0e-5, DOWN), gap=GAP, kind="cylinder", length=8.0, edge=0.5, axis=(1, 0, 0)
        ),
        2.0,
    ),
    "cone": (pre.Impactor(3.0, 1.0e-5, DOWN, gap=GAP, kind="cone", angle=45.0, tip=1.0), 3.0),
}


@pytest.mark.parametrize("name", BODIES)
@pytest.mark.parametrize("method", ["nodes_on_impactor", "points_on_plate"])
def test_the_solver_sees_the_gap(
    study: pre.Study, name: str, method: str, solver: str, tmp_path: Path
) -> None:
    """The distance to first contact, which the solver computes from the body, is the gap.

    It follows the body until a millionth of the radius is left.
    """
    impactor, reach = BODIES[name]
    assert impactor.reach == pytest.approx(reach)
    deck = tmp_path / "deck.k"
    contact = pre.Contact(method=method)
    deck.write_text(text_of(replace(study, impactor=impactor, contact=contact)))
    told = subprocess.run([solver, "check", deck], check=True, capture_output=True, text=True)
    found = re.search(r"distance to first contact\s+(\S+)", told.stdout)
    assert found is not None, told.stdout
    assert float(found[1]) == pytest.approx(GAP, abs=1.01e-6 * impactor.radius)


def test_a_shape_has_a_card_of_its_own(study: pre.Study) -> None:
    cards = cards_of(text_of(replace(study, impactor=BODIES["lying"][0])))["IMPACTOR_CYLINDER"]
    assert [float(word) for word in fields_of("", cards[1])] == [8.0, 0.5, 1.0, 0.0, 0.0]
    assert [float(word) for word in fields_of("", cards[2])][:3] == list(DOWN)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"kind": "cylinder"}, "length"),
        ({"kind": "cylinder", "length": 4.0, "edge": 2.0}, "edge: must be less"),
        ({"kind": "cone"}, "angle: must be above 0"),
        ({"kind": "cone", "angle": 45.0, "tip": 8.0}, "tip: must be less"),
        ({"edge": 1.0}, "edge: a sphere has none"),
        ({"kind": "tup", "hemisphere": True}, "hemisphere: a tup has none"),
        ({"kind": "tup", "axis": (0.0, 0.0, 0.0)}, "axis: has no direction"),
    ],
)
def test_what_is_no_body_is_refused(given: dict[str, object], message: str) -> None:
    with pytest.raises(pre.RecipeError, match=message):
        pre.Impactor(8.0, 1.0e-5, DOWN, **given)
