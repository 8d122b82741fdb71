"""Tests of what the studies compute and write."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from plydyn_post.results import Results, open_results
from readings.bimetal_figures import Face, along_y
from readings.damage import MODELS, DamageCase, Impact, mesh_words
from readings.differences import force_difference, velocity_difference
from readings.profiles import agreement, ply_means, read_component
from readings.symmetry import off_symmetry
from runner.cases import Case, Effort, Run, StudyError
from studies.bricks import TABLE_2, TABLE_4, Plate, bricks_text
from studies.bricks import pick as pick_models
from studies.choices import BASE, CHOICES, Choice, case_of, choices_text, pick
from studies.runs import BY_HAND, COARSE, ELASTIC, LINEAR, ORDERS, late_force
from studies.schemes import implicit_cases, implicit_text
from studies.timings import Timing, damage_text, elastic_text


def test_bricks_are_compared_with_the_last_model() -> None:
    effort = Effort(wall=10.0, processor=10.0, loop=9.0, steps=100, dofs=1000)
    large = Effort(wall=50.0, processor=50.0, loop=49.0, steps=200, dofs=20000)
    time = np.linspace(0.0, 1.0, 11)
    found = [
        Plate(Run(TABLE_4[0], effort, None), 110.0, time, 1.1 * time),
        Plate(Run(TABLE_4[-1], large, None), 100.0, time, time),
    ]
    text = bricks_text(found, "plydyn")
    line = next(row for row in text.splitlines() if "LE1" in row)
    assert [cell.strip() for cell in line.split("|")][5:10] == [
        "110",
        "0.0",
        "10.0",
        "1/20.0",
        "1/5.0",
    ]
    assert "claims 80 times fewer DOF and 3.6 times less time; here it is 20 and 5 times" in text
    assert "peak force +10 % off" in text


def test_a_run_that_was_stopped_counts_in_proportion() -> None:
    effort = Effort(wall=10.0, processor=10.0, loop=9.0, steps=100, dofs=1000)
    time = np.linspace(0.0, 1.0, 11)
    whole = Plate(Run(TABLE_2[0], effort, None), 1.0, time, time)
    half = Plate(Run(TABLE_2[-1], effort, None), 0.5, 0.5 * time, 0.5 * time, share=0.5)
    assert (half.processor, whole.off(half)) == (20.0, 0.0)
    line = bricks_text([whole, half], "plydyn").splitlines()[3]
    assert [cell.strip() for cell in line.split("|")][3:5] == ["200", "0:00:20"]


def test_models_of_a_table_are_picked_by_their_recipes() -> None:
    assert [row.label for row in pick_models(TABLE_2, "bricks_1,le1")] == ["LE1", "1 brick per ply"]
    assert pick_models(TABLE_4, "") == list(TABLE_4)
    with pytest.raises(StudyError, match="there is no model le9"):
        pick_models(TABLE_4, "le9")


def test_the_middle_line_is_the_nearest_column() -> None:
    place = np.array([[0.1, 1.0], [0.1, -1.0], [2.0, 0.0]])
    face = Face(place, np.array([1.0, 2.0, 3.0]), np.array([4.0, 5.0, 6.0]), 1.0)
    y, values = along_y(face, "strain")
    assert (y.tolist(), values.tolist()) == ([-1.0, 1.0], [5.0, 4.0])


IMPACTOR = "time [s],force [N],displacement [mm],velocity [mm/s]\n"
PROFILE = "time [s],z [mm],ply [-],syz [MPa]\n"


def _history(folder: Path, job: str, factor: float) -> Results:
    """A job whose force is a straight line up and whose velocity is another one."""
    rows = [f"{t:.6e},{factor * t:.9e},0,{-5.0 + factor * t:.9e}\n" for t in np.arange(201) * 1e-6]
    (folder / f"{job}.impactor_1.csv").write_text(IMPACTOR + "".join(rows))
    return open_results(folder / job)


def test_differences_are_shares_of_the_other(tmp_path: Path) -> None:
    one, other = _history(tmp_path, "one", 1.1), _history(tmp_path, "other", 1.0)
    assert force_difference(one, other) == pytest.approx(0.1, rel=1e-6)
    assert force_difference(one, other, 50e-6) == pytest.approx(0.1, rel=1e-6)
    assert velocity_difference(one, other) == pytest.approx(0.1 * 200e-6 / 5.0, rel=1e-6)


def test_profiles_of_different_rows_are_compared_at_the_same_places(tmp_path: Path) -> None:
    # two plies: linear in the first, constant in the second, with a jump of 2 between them
    coarse = [(0, 1, 0), (1, 1, 4), (1, 2, 6), (2, 2, 6)]
    fine = [(0, 1, 0), (0.5, 1, 2), (1, 1, 4), (1, 2, 6), (1.5, 2, 6), (2, 2, 6)]
    found = []
    for name, rows in (("coarse", coarse), ("fine", fine)):
        text = "".join(f"0,{z},{ply},{value}\n" for z, ply, value in rows)
        (tmp_path / f"{name}.profile_2.csv").write_text(PROFILE + text)
        found.append(read_component(open_results(tmp_path / name), 2, "syz"))
    assert found[0].values == pytest.approx(found[1].values)
    assert ply_means(found[0].values[0]) == pytest.approx([2.0, 6.0])
    same = agreement("coarse", *found, 0.0)
    assert (same.largest, same.size, same.whole, same.means) == (0.0, 0.0, 0.0, 0.0)
    assert same.jump == pytest.approx(2.0 / 6.0)
    assert same.end == pytest.approx(1.0)


def _impact(case: Case, peak: float, projected: float, effort: Effort | None = None) -> Impact:
    areas, energies = {1: 3 * projected}, {"delamination": 900.0, "matrix damage": 100.0}
    run = Run(case, effort, Results(case.name, Path()))
    return Impact(run, peak, 1e-3, 1900.0, 3e-3, 3.0, 2000.0, projected, areas, energies, 1e-12)


def test_choices_are_compared_with_the_recipes_as_they_are() -> None:
    other = next(choice for choice in CHOICES if choice.name == "eta_low")
    cases = [case_of(choice, "coarse") for choice in (BASE, other)]
    text = choices_text([_impact(cases[0], 4000.0, 200.0), _impact(cases[1], 3800.0, 250.0)])
    assert "| exponent of mixed modes | 1.45 | 3800 | -5 % | 250 | +25 % | 750 | 1.00 |" in text
    # the recipe has linear strains already
    assert [one.label for one in pick("large, linear, hashin", "q192_le1")] == [
        "base",
        "large",
        "hashin",
    ]
    assert [one.label for one in pick("large, hashin", "q192_le1", (), "large")] == [
        "base",
        "hashin",
    ]
    assert len(pick("", "q192_le1")) == 1 + len(CHOICES) - len(MADE_BY_Q192)


#: Choices that the recipes of 192 quads have made already
MADE_BY_Q192 = ("linear", "central", "core_15")


@pytest.mark.parametrize("choice", [BASE, *CHOICES], ids=lambda choice: choice.name)
def test_every_choice_is_a_recipe(choice: Choice) -> None:
    same = choice is BASE or choice.name in MADE_BY_Q192
    assert same == (case_of(choice, "q192_le1").model == case_of(BASE, "q192_le1").model)


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_the_models_are_those_of_their_labels(model: DamageCase) -> None:
    assert mesh_words(model).startswith(f"{model.quads} Q9, ")
    assert model.model.laminate.order == model.order
    assert model.label in model.model.title


def _timing(efforts: tuple[Effort | None, ...]) -> Timing:
    return Timing(MODELS[2].label, MODELS[2].paper, efforts, 8.6e-9, 4000.0)


def test_times_stand_beside_those_of_the_paper() -> None:
    efforts = (Effort(3723.0, 3700.0, 3600.0, 500_000, 57_672), Effort(2000.0, 3800.0, 1, 1, 1))
    text = damage_text([_timing(efforts)], (1, 2), "plydyn")
    row = text.splitlines()[2]
    assert "| 192 Q9/LE2 | 57,672 | 500,000 | 8.60 | 1:02:03 | 0:33:20 | 1:01:40 |" in row
    assert row.endswith("| 8:46:22 |")
    assert "Other work" not in text
    busy = (Effort(4000.0, 3700.0, 3600.0, 500_000, 57_672), efforts[1])
    text = damage_text([_timing(busy)], (1, 2), "plydyn")
    assert "Other work ran meanwhile" in text
    half = damage_text([_timing((efforts[0], None))], (1, 2), "plydyn")
    assert "| 1:02:03 | – | 1:01:40 | – |" in half


def test_the_middle_of_the_runs_is_shown_and_whether_any_was_disturbed() -> None:
    efforts = [Effort(wall, wall, 0.5 * wall, 1000, 1000) for wall in (3.0, 1.0, 2.0)]
    text = elastic_text([Timing("LE1", "0:10:29", tuple(efforts), 4e-8, 896.0)], "plydyn")
    row = text.splitlines()[2]
    assert row == (
        "| LE1 | 1,000 | 1,000 | 40.00 | 2.0 | 3.0, 1.0, 2.0 | 1000.00 | 896 | 0:10:29 |"
    )
    assert "Median of 3 runs" in text
    assert "not to be published" not in text
    efforts[0] = replace(efforts[0], processor=2.0)
    text = elastic_text([Timing("LE1", "0:10:29", tuple(efforts), 4e-8, 896.0)], "plydyn")
    assert "not to be published" in text


def test_implicit_interfaces_are_compared_with_central_differences(tmp_path: Path) -> None:
    wanted = implicit_cases("q192_le1", "implicit_interfaces:20,implicit_thickness")
    cases = [replace(case, given=("mesh.n=4",)) for case in wanted]
    assert [case.label for case in cases] == [
        "explicit",
        "implicit interfaces, 20 ns",
        "implicit thickness",
    ]
    assert [case.model.control.largest_step for case in cases] == [0.0, 2e-8, 0.0]
    assert cases[2].model.control.scheme == "implicit_thickness"
    assert {case.model.mesh.n for case in cases} == {4}
    effort = Effort(50.0, 48.0, 47.0, 250_000, 38_448)
    for case in cases:
        (tmp_path / f"{case.name}.out").write_text("largest step taken  2.0E-08 s\n")
    numbers = ((4000.0, 200.0), (4100.0, 190.0))
    found = [_impact(case, *own, effort) for case, own in zip(cases[:2], numbers, strict=True)]
    found = [
        replace(one, run=replace(one.run, results=Results(one.run.case.name, tmp_path)))
        for one in found
    ]
    first, second = implicit_text(found).splitlines()[2:]
    assert first.startswith("| q192_le1 | central differences | 20 | 250,000 | 48 | 4000 | – |")
    assert "| 4100 | +2 % | 190 | -5 % | 570 | -5 % | 0.90 | 0.10 | 0.00 | 0.00 | 1.00 |" in second
    with pytest.raises(StudyError, match="has not run with central differences"):
        implicit_text(found[1:])
    with pytest.raises(StudyError, match="is not a scheme"):
        implicit_cases("q192_le1", "implicit_interfaces:far")


def test_the_picture_of_the_page_has_the_orders_and_the_bounds_their_runs() -> None:
    assert [run.label for run in ORDERS] == ["192 Q9/LE1", "192 Q9/LE2", "192 Q9/LE3"]
    assert set(BY_HAND) == {run.name for run in (COARSE, ELASTIC, LINEAR)}


def test_the_late_force_is_the_mean_of_the_last_millisecond(tmp_path: Path) -> None:
    rows = [f"{t:.6e},{1000.0 * (t > 1.5e-3)},0,-1\n" for t in np.linspace(0.0, 2e-3, 2001)]
    (tmp_path / "job.impactor_1.csv").write_text(IMPACTOR + "".join(rows))
    assert late_force(open_results(tmp_path / "job")) == pytest.approx(500.0, rel=1e-2)


def test_displacements_are_held_against_their_mirror_images() -> None:
    # two layers of 2 x 2 cells with points of their own at the face between them
    line = np.array([-1.0, 0.0, 1.0])
    layers = [np.array([[x, y, z] for y in line for x in line for z in (k, k + 1)]) for k in (0, 1)]
    points = np.concatenate(layers)
    corner = np.array([0, 1, 2, 3, 6, 7, 8, 9])
    cells = np.array([start + corner for start in (0, 2, 6, 8, 18, 20, 24, 26)])
    moved = 0.1 * points * (1.0 + points[:, :1] ** 2)
    moved[18:] *= 2.0
    assert off_symmetry(points, cells, moved) == pytest.approx(0.0, abs=1e-15)
    moved[0, 2] += 0.012
    assert off_symmetry(points, cells, moved) == pytest.approx(0.012)
