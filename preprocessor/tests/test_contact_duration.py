"""The estimated contact of an impactor: as the solver's, and as the tables of plates say."""

from __future__ import annotations

import re
import subprocess
from dataclasses import replace
from math import inf, pi, sqrt
from pathlib import Path

import numpy as np
import pytest
from deck_cards import cards_of

import plydyn_pre as pre
from plydyn_pre.deck import deck_text, stage_text, write_deck
from plydyn_pre.deck.contact_duration import contact_durations
from plydyn_pre.recipe import example_recipe, load_recipe
from plydyn_pre.study.bending import bending_stiffness, half_period, point_stiffness
from plydyn_pre.study_text import contact_lines, early_ends

METAL = pre.Elastic(density=2.7e-9, E=70.0e3, nu=0.3)
TEMPLATES = ("astm-d7136", "aitm-1-0010", "ring")


def template(name: str, folder: Path, *overrides: str) -> tuple[pre.Study, pre.Mesh]:
    """The study of a template on a coarse mesh."""
    path = folder / f"{name}.toml"
    path.write_text(example_recipe(name))
    study = load_recipe(path, ["mesh.quad=7.5", *overrides])
    return study, pre.make_mesh(study.mesh)


@pytest.mark.parametrize(
    ("sides", "factor"),
    # Timoshenko and Woinowsky-Krieger, table 23: w = factor F b^2 / D in the middle
    [((1.0, 1.0), 0.01160), ((1.4, 1.0), 0.01486), ((2.0, 1.0), 0.01651)],
)
def test_stiffness_is_that_of_the_tables(sides: tuple[float, float], factor: float) -> None:
    """A metal plate on simple supports; (1 - nu) / 2 of D is its twist."""
    laminate = pre.Laminate(layup="[metal]", thickness=2.0)
    d = bending_stiffness(laminate, {"metal": METAL})
    exact = 70.0e3 * 2.0**3 / (12.0 * (1.0 - 0.3**2))
    assert d[0, 0] == pytest.approx(exact)
    assert d[2, 2] == pytest.approx(0.35 * exact)
    arms = 0.5 * np.array(sides)[:, None].repeat(2, axis=1)
    found = point_stiffness(d, arms, (9.0, 9.0))
    assert found == pytest.approx(exact / factor, rel=1e-3)


def test_beam_is_that_of_the_books() -> None:
    """F = 3 E I L / (a b)^2 w of a force at a and b from its ends."""
    laminate = pre.Laminate(layup="[metal]", thickness=2.0)
    d = bending_stiffness(laminate, {"metal": METAL})
    inertia = 5.0 * 2.0**3 / 12.0
    arms = np.array([[30.0, 70.0], [inf, inf]])
    exact = 3.0 * 70.0e3 * inertia * 100.0 / (30.0 * 70.0) ** 2
    assert point_stiffness(d, arms, (100.0, 5.0)) == pytest.approx(exact)


def test_unsymmetric_laminate_bends_about_its_neutral_plane() -> None:
    """Two metals, E and 3 E, of one thickness: their common neutral plane lies in the stiff one."""
    stiff = replace(METAL, E=210.0e3, nu=0.0)
    soft = replace(METAL, nu=0.0)
    laminate = pre.Laminate(layup="[soft/stiff]", thickness=1.0)
    d = bending_stiffness(laminate, {"soft": soft, "stiff": stiff})
    # from the interface: 3 t / 2 to the middle of the stiff one, weights 3 and 1
    place = (3.0 * 0.5 - 1.0 * 0.5) / 4.0
    parts = [(70.0e3, -0.5 - place), (210.0e3, 0.5 - place)]
    assert d[0, 0] == pytest.approx(sum(young * (1.0 / 12.0 + arm**2) for young, arm in parts))


def test_half_a_period_is_between_its_limits() -> None:
    """It is pi sqrt(m/k) without a cubic term; K(1/2) sqrt(2 m/c) / W with that alone."""
    assert half_period(2.0, 8.0, 0.0, 5.0) == pytest.approx(pi * 0.5)
    cubic, energy, mass = 3.0, 7.0, 2.0
    amplitude = (4.0 * energy / cubic) ** 0.25
    # the complete elliptic integral of the first kind of k^2 = 1/2
    complete = 1.854074677301372
    exact = 2.0 * complete * sqrt(mass / cubic) / amplitude
    assert half_period(mass, 1.0e-12, cubic, energy) == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("name", TEMPLATES)
def test_solver_estimates_the_same(name: str, solver: str, tmp_path: Path) -> None:
    study, mesh = template(name, tmp_path)
    (found,) = contact_durations(study, mesh)
    deck = tmp_path / "job.k"
    write_deck(deck_text(study, mesh), deck)
    done = subprocess.run([solver, "check", deck], capture_output=True, text=True, check=True)
    line = re.search(r"duration, about +(\S+)", done.stdout)
    assert line is not None, done.stdout
    assert found.duration == pytest.approx(float(line[1]), rel=1e-4)


@pytest.mark.parametrize("name", [*TEMPLATES, "repeated-impact", "preload-impact"])
def test_templates_outlast_their_contact(name: str, tmp_path: Path) -> None:
    """And end after it; as long as the estimate says, half of the plies in, too."""
    study, mesh = template(name, tmp_path)
    assert list(contact_lines(study, mesh))
    assert not list(early_ends(study, mesh))
    runs = [study.control, *study.stages]
    hits = [run for run, body in zip(runs, [study, *study.stages], strict=True) if body.impactor]
    assert hits
    assert all(run.until_contact_ends == 5.0e-4 for run in hits)


def test_thin_plates_have_time_enough(tmp_path: Path) -> None:
    """11 plies of 0.183 mm are 2 mm thick: 13.4 J of the standard."""
    layup = "laminate.layup=[45/0/-45/90/45/0/45/90/-45/0/45]"
    study, mesh = template("astm-d7136", tmp_path, layup, "impactor.energy=13.4e3")
    (found,) = contact_durations(study, mesh)
    assert found.end > 5.2e-3
    assert found.end < study.control.end_time


def test_short_run_is_noted(tmp_path: Path) -> None:
    study, mesh = template("astm-d7136", tmp_path, "control.end_time=2.0e-3")
    (words,) = early_ends(study, mesh)
    assert words.startswith("control.end_time: the impactor will touch the plate for about 0.003 s")


def test_deck_has_the_card_and_stages_take_it_back(tmp_path: Path) -> None:
    """Each stage has its own time; one without has 0, and no chain without has the card."""
    study, mesh = template("repeated-impact", tmp_path)
    first = cards_of("\n".join(deck_text(study, mesh)))["CONTROL_END_OF_CONTACT"]
    assert float(first[0]) == 5.0e-4
    texts = ["\n".join(stage_text(study, mesh, k + 1, "")) for k in range(len(study.stages))]
    found = [float(cards_of(text)["CONTROL_END_OF_CONTACT"][0]) for text in texts]
    assert found == [0.0, 5.0e-4, 0.0, 5.0e-4]
    stages = tuple(replace(stage, until_contact_ends=0.0) for stage in study.stages)
    control = replace(study.control, until_contact_ends=0.0)
    never = replace(study, control=control, stages=stages)
    assert "CONTROL_END_OF_CONTACT" not in "\n".join(deck_text(never, mesh))
    assert "CONTROL_END_OF_CONTACT" not in "\n".join(stage_text(never, mesh, 1, ""))


def test_stage_may_wait_for_the_impactor_of_the_run_before(tmp_path: Path) -> None:
    study, mesh = template("repeated-impact", tmp_path)
    stage = replace(study.stages[0], remove=(), until_contact_ends=2.0e-4)
    kept = replace(study, stages=(stage,))
    (card,) = cards_of("\n".join(stage_text(kept, mesh, 1, "")))["CONTROL_END_OF_CONTACT"]
    assert float(card) == 2.0e-4


def test_nothing_to_wait_for_is_refused(tmp_path: Path) -> None:
    study, _ = template("astm-d7136", tmp_path)
    with pytest.raises(pre.RecipeError, match="impactor: missing"):
        replace(study, impactor=None, contact=None)
