"""Levers are constraints between pairs of nodes."""

from __future__ import annotations

import subprocess
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

import pytest
from deck_cards import cards_of, split_columns, text_of

import plydyn_pre as pre
from plydyn_pre.deck import stage_text
from plydyn_pre.study import Clamp, Stage

HALF_SPAN, ARM, WAY = 10.0, 8.0, -0.5
LEVER = pre.Lever("left", "middle", ARM, WAY, curve="ramp")


def beam(study: pre.Study) -> pre.Study:
    """A strip with a lever on its upper arm, over lines at its end and in the middle."""
    return replace(
        study,
        mesh=pre.Rectangle((2.0 * HALF_SPAN, 2.0), (8, 1)),
        sets={
            "middle": pre.PlaceSet(line=(HALF_SPAN, 0.0, HALF_SPAN, 2.0)),
            "one": pre.PlaceSet(at=(15.0, 1.0)),
        },
        supports=(
            pre.Support("left", hold="z", face="bottom"),
            pre.Support("right", hold="xyz", face="bottom"),
        ),
        impactor=None,
        contact=None,
        loads=(LEVER,),
        outputs=pre.Outputs(support_interval=1.0e-6),
    )


def test_coefficients_are_those_of_a_lever(study: pre.Study) -> None:
    """The end is at (1 + c/L) of the fulcrum less c/L of the hinge; as many pairs as nodes."""
    made = beam(study)
    mesh = pre.make_mesh(made.mesh)
    cards = cards_of(text_of(made))["CONSTRAINED_FACE_LINEAR"]
    assert len(cards) == 3 * len(mesh.node_sets["left"])
    places = {int(i): xy for i, xy in zip(mesh.node_ids, mesh.nodes, strict=True)}
    for head, hinge, fulcrum in zip(cards[0::3], cards[1::3], cards[2::3], strict=True):
        assert [float(field) for field in split_columns(head, 10)[1::2]] == [2, WAY]
        first, *low, turn = (float(field) for field in split_columns(hinge, 10))
        second, *high, whole = (float(field) for field in split_columns(fulcrum, 10))
        assert low == high == [1, 3]
        assert (turn, whole) == pytest.approx((-ARM / HALF_SPAN, 1.0 + ARM / HALF_SPAN))
        assert places[int(second)] - places[int(first)] == pytest.approx([HALF_SPAN, 0.0])


def test_the_solver_takes_it(study: pre.Study, solver: str, tmp_path: Path) -> None:
    """Curve and nodes are there."""
    deck = tmp_path / "beam.k"
    deck.write_text(text_of(beam(study)))
    done = subprocess.run([solver, "check", deck], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"fulcrum": "left"}, "the same set as the hinge"),
        ({"arm": -1.0}, "arm"),
        ({"arm": 0.0}, "arm: 0.0 must be above zero"),
        ({"fulcrum": "one"}, r"loads\[1\]\.fulcrum: .* nodes for .* at the hinge"),
        ({"fulcrum": "right"}, None),
        ({"face": "bottom"}, r"loads\[1\]\.hinge: node \d+ is held or moved along z"),
    ],
)
def test_levers_that_are_none(study: pre.Study, changes: dict, words: str | None) -> None:
    """Each is refused with its key; one over the whole span is a lever."""
    if words is None:
        assert "CONSTRAINED_FACE_LINEAR" in cards_of(text_of(_with(study, changes)))
        return
    with pytest.raises(pre.RecipeError, match=words):
        text_of(_with(study, changes))


def test_levers_and_implicit_inertia_are_refused(study: pre.Study) -> None:
    """So are levers of stages, which a restart could not add."""
    made = beam(study)
    with pytest.raises(pre.RecipeError, match='scheme: a lever needs "explicit"'):
        replace(made, control=replace(made.control, scheme="implicit_thickness"))
    with pytest.raises(pre.RecipeError, match="a lever is there from the start"):
        Stage("next", 1.0e-4, loads=(LEVER,))
    with pytest.raises(pre.RecipeError, match="not on a face that an impactor or a fixture meets"):
        replace(made, impactor=study.impactor)


@pytest.mark.parametrize("face", ["top", "bottom"])
def test_a_lever_is_not_on_a_face_with_a_fixture(study: pre.Study, face: str) -> None:
    """The solver would refuse it: contact moves the points that the lever leads."""
    made, clamp = beam(study), Clamp(face=face, force=1.0, outer=2.0)
    if face == LEVER.face:
        with pytest.raises(pre.RecipeError, match="impactor or a fixture meets"):
            replace(made, fixtures=(clamp,))
    else:
        assert replace(made, fixtures=(clamp,)).fixtures == (clamp,)


def test_a_lever_is_not_on_a_face_that_a_stage_meets(study: pre.Study) -> None:
    """The solver would refuse the restart, when the runs before it are over."""
    made = beam(study)
    for face in ("top", "bottom"):
        stages = (
            Stage("hit", 1.0e-6, impactor=study.impactor, contact=pre.Contact(face=face)),
            Stage("held", 1.0e-6, fixtures=(Clamp(face=face, force=1.0, outer=2.0),)),
        )
        for stage in stages:
            if face == LEVER.face:
                with pytest.raises(pre.RecipeError, match="impactor or a fixture meets"):
                    replace(made, stages=(stage,))
            else:
                assert replace(made, stages=(stage,)).stages == (stage,)


@pytest.mark.parametrize("key", ["hinge", "fulcrum"])
@pytest.mark.parametrize("kind", ["supports", "loads"])
def test_a_stage_neither_holds_nor_moves_what_a_lever_leads(
    study: pre.Study, kind: str, key: str
) -> None:
    """The levers stay, and the solver would refuse the restart, when the runs before are over."""
    nodes = getattr(LEVER, key)
    held = {
        "supports": pre.Support(nodes, face="top"),
        "loads": pre.Motion(nodes, "z", "velocity", 1.0),
    }
    beside = {
        "supports": pre.Support(nodes, "xy"),
        "loads": pre.Motion(nodes, "x", "velocity", 1.0),
    }
    made = beam(study)
    for thing, is_right in ((held[kind], False), (beside[kind], True)):
        chained = replace(made, stages=(Stage("next", 1.0e-6, **{kind: (thing,)}),))
        words = rf"stages\[1\]\.{kind}\[1\]\.set: node \d+ is part of a lever along z that stays"
        with nullcontext() if is_right else pytest.raises(pre.RecipeError, match=words):
            list(stage_text(chained, pre.make_mesh(chained.mesh), 1, "sum"))


def _with(study: pre.Study, changes: dict) -> pre.Study:
    """The beam with another lever."""
    return replace(beam(study), loads=(replace(LEVER, **changes),))
