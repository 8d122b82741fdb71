"""Tests of the meshes that become finer and finer."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from plydyn_pre.recipe import load_recipe

from studies.damage import Answer, mesh_words, parts_of
from studies.jobs import StudyError, made_by
from studies.refinement import LADDERS, changes_text, collect, pick, sections_of, work
from studies.variants import VARIANTS, jobs_of, variants_text


def _answer(peak: float, projected: float) -> Answer:
    taken = {"delamination": 900.0, "matrix damage": 100.0}
    return Answer(peak, 1e-3, 1900.0, 3e-3, 3.0, 2000.0, projected, 3 * projected, taken, 1e-12)


def test_finer_meshes_are_set_against_the_ones_before():
    found = [(3.0, _answer(4000.0, 200.0)), (2.0, _answer(4100.0, 190.0)), (1.5, _answer(4100, 95))]
    head, _, *rows = changes_text(found).splitlines()
    assert head == "| change | 3 to 2 mm | 2 to 1.5 mm |"
    assert rows[0] == "| peak force | +2 % | – |"
    assert rows[2:5] == [
        "| projected area | -5 % | -50 % |",
        "| all interfaces | -5 % | -50 % |",
        "| energy of delamination | – | – |",
    ]
    assert rows[-1] == "| dissipated in all | – | – |"


@pytest.mark.parametrize("model", ["quarter", "quarter_elastic", "coarse"])
def test_meshes_are_refined_with_rings_in_proportion(model):
    (ladder,) = pick(model, "12, 8")
    jobs = ladder.jobs(["control.end_time=1e-3"])
    meshes = [load_recipe(job.recipe, job.overrides) for job in jobs]
    assert [job.name for job in jobs] == [f"{model}_n8", f"{model}_n12"]
    assert [(one.mesh.n, one.mesh.rings) for one in meshes] == [(8, 4), (12, 6)]
    assert meshes[0].control.end_time == 1e-3
    quarter = model != "coarse"
    assert parts_of(jobs[0].recipe, jobs[0].overrides) == (4 if quarter else 1)
    words = mesh_words(jobs[1].recipe, jobs[1].overrides)
    assert words == f"{'a quarter of ' if quarter else ''}432 Q9, 2 mm in the core"
    # as many more quads, and shorter steps
    assert work(jobs[1]) == pytest.approx(1.5**3 * work(jobs[0]))
    with pytest.raises(StudyError, match="2 and more"):
        pick(model, "1,8")


def test_without_a_recipe_the_ladders_of_the_page_are_run():
    assert pick("", "") == list(LADDERS)
    assert [one.model for one in pick("quarter_elastic", "")] == ["quarter_elastic"]
    assert pick("q192_le1", "8")[0].jobs()[0].name == "q192_le1_n8"
    with pytest.raises(StudyError, match="q192_le1 has no ladder"):
        pick("q192_le1", "")
    for ladder in LADDERS:
        ends = {load_recipe(one.recipe, one.overrides).control.end_time for one in ladder.jobs()}
        assert ends == {1.5e-3}


def test_variants_change_one_thing_of_a_quarter():
    jobs = jobs_of(())
    assert len({job.name for job in jobs}) == len(VARIANTS)
    for variant, job in zip(VARIANTS, jobs, strict=True):
        (plain,) = replace(LADDERS[0], sizes=(variant.n,)).jobs()
        ours, theirs = (load_recipe(one.recipe, one.overrides) for one in (job, plain))
        assert ours != theirs
        whole, larger = ("whole" in variant.words, "36 mm" in variant.words)
        assert parts_of(job.recipe, job.overrides) == (1 if whole else 4)
        assert (ours.mesh.core != theirs.mesh.core) == larger
        assert (ours.mesh == theirs.mesh) == (not whole and not larger)


def _write_run(folder: Path, name: str) -> None:
    """Files of a run: the force rises to 200 N and one interface fails."""
    rows = [f"{t:.6e},{1e6 * t:.9e},{-t:.6e},-5\n" for t in np.arange(201) * 1e-6]
    head = "time [s],force [N],displacement [mm],velocity [mm/s]\n"
    (folder / f"{name}.impactor_1.csv").write_text(head + "".join(rows))
    (folder / f"{name}.effort").write_text('{"wall": 1.0, "processor": 1.0}')
    (folder / f"{name}.out").write_text(
        "plydyn 0.1.0 (abc)\ndegrees of freedom  1\ncycle 200, time 1.0E-04 s\n"
        "seconds 1.0 in the loop\n"
    )
    head = "time [s],error [-],delamination [mJ]\n"
    (folder / f"{name}.energy.csv").write_text(head + "0,0,0\n2e-4,0,250\n")
    head = "time [s],interface 1 area [mm2],sum [mm2],projected area [mm2]\n"
    (folder / f"{name}.delamination.csv").write_text(head + "0,0,0,0\n2e-4,10,10,10\n")


def test_a_quarter_is_told_as_the_whole(tmp_path: Path):
    jobs = replace(LADDERS[0], sizes=(8, 12)).jobs()
    _write_run(tmp_path, jobs[0].name)
    (one,) = collect(jobs, tmp_path)
    assert (one.parts, one.size, one.answer.projected) == (4, 3.0, 40.0)
    sections = dict(sections_of([one]))
    assert "| a quarter of 192 Q9, 3 mm in the core | 40 |" in sections["Areas"]
    assert sections["Changes"].startswith("| change |\n")
    assert "| 1.00 |" in sections["Refinement"]
    assert made_by(jobs, tmp_path) == "Made by plydyn 0.1.0 (abc).\n"
    row = variants_text([(VARIANTS[-1], one)]).splitlines()[-1]
    assert VARIANTS[-1].words in row
    assert row.endswith("| 40 | 40 | 40 |")
