"""Tests of the meshes that become finer and finer."""

from __future__ import annotations

import numpy as np
import pytest
from plydyn_pre.recipe import load_recipe

from studies.damage import Answer, mesh_words, parts_of
from studies.jobs import StudyError
from studies.refinement import changes_text, collect, jobs_of, sections_of


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
    jobs = jobs_of(model, "12, 8", ["control.end_time=1e-3"])
    meshes = [load_recipe(job.recipe, job.overrides) for job in jobs]
    assert [job.name for job in jobs] == [f"{model}_n8", f"{model}_n12"]
    assert [(one.mesh.n, one.mesh.rings) for one in meshes] == [(8, 4), (12, 6)]
    assert meshes[0].control.end_time == 1e-3
    quarter = model != "coarse"
    assert parts_of(jobs[0].recipe, jobs[0].overrides) == (4 if quarter else 1)
    words = mesh_words(jobs[1].recipe, jobs[1].overrides)
    assert words == f"{'a quarter of ' if quarter else ''}432 Q9, 2 mm in the core"
    with pytest.raises(StudyError, match="2 and more"):
        jobs_of(model, "1,8", ())


def test_a_quarter_is_told_as_the_whole(tmp_path):
    jobs = jobs_of("quarter", "8,12", ())
    name = jobs[0].name
    rows = [f"{t:.6e},{1e6 * t:.9e},{-t:.6e},-5\n" for t in np.arange(201) * 1e-6]
    head = "time [s],force [N],displacement [mm],velocity [mm/s]\n"
    (tmp_path / f"{name}.impactor_1.csv").write_text(head + "".join(rows))
    (tmp_path / f"{name}.effort").write_text('{"wall": 1.0, "processor": 1.0}')
    (tmp_path / f"{name}.out").write_text(
        "degrees of freedom  1\ncycle 200, time 1.0E-04 s\nseconds 1.0 in the loop\n"
    )
    head = "time [s],error [-],delamination [mJ]\n"
    (tmp_path / f"{name}.energy.csv").write_text(head + "0,0,0\n2e-4,0,250\n")
    head = "time [s],interface 1 area [mm2],sum [mm2],projected area [mm2]\n"
    (tmp_path / f"{name}.delamination.csv").write_text(head + "0,0,0,0\n2e-4,10,10,10\n")
    (one,) = collect(jobs, tmp_path)
    assert (one.parts, one.size, one.answer.projected) == (4, 3.0, 40.0)
    sections = dict(sections_of([one]))
    assert "| a quarter of 192 Q9, 3 mm in the core | 40 |" in sections["Areas"]
    assert sections["Changes"].startswith("| change |\n")
    assert "| 1.00 |" in sections["Refinement"]
