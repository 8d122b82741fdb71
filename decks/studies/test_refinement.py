"""Tests of the meshes that become finer and finer."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from readings.damage import Impact, core_size, mesh_words, read_impact
from runner.cases import Case, Run, StudyError, read_runs
from studies.refinement import PAGE, VARIANTS, changes_text, pick, refined, variants_text, work
from studies.refinement import _report as report


def _impact(case: Case, peak: float, projected: float) -> Impact:
    areas, energies = {1: 3 * projected}, {"delamination": 900.0, "matrix damage": 100.0}
    run = Run(case, None, None)
    return Impact(run, peak, 1e-3, 1900.0, 3e-3, 3.0, 2000.0, projected, areas, energies, 1e-12)


def test_finer_meshes_are_set_against_the_ones_before() -> None:
    cases, numbers = refined("quarter", (8, 12, 16)), ((4000, 200), (4100, 190), (4100, 95))
    found = [_impact(case, *own) for case, own in zip(cases, numbers, strict=True)]
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
def test_meshes_are_refined_with_rings_in_proportion(model: str) -> None:
    (sizes,) = pick(model, "12, 8").values()
    cases = [replace(one, given=("control.end_time=1e-3",)) for one in refined(model, sizes)]
    meshes = [case.model for case in cases]
    assert [case.name for case in cases] == [f"{model}_n8", f"{model}_n12"]
    assert [(one.mesh.n, one.mesh.rings) for one in meshes] == [(8, 4), (12, 6)]
    assert meshes[0].control.end_time == 1e-3
    quarter = model != "coarse"
    words = mesh_words(cases[1])
    assert words == f"{'a quarter of ' if quarter else ''}432 Q9, 2 mm in the core"
    # as many more quads, and shorter steps
    assert work(cases[1]) == pytest.approx(1.5**3 * work(cases[0]))
    with pytest.raises(StudyError, match="2 and more"):
        pick(model, "1,8")


def test_without_a_recipe_the_meshes_of_the_page_are_run() -> None:
    assert pick("", "") == PAGE
    assert list(pick("quarter_elastic", "")) == ["quarter_elastic"]
    assert pick("q192_le1", "8") == {"q192_le1": (8,)}
    assert refined("q192_le1", (8,))[0].name == "q192_le1_n8"
    with pytest.raises(StudyError, match="q192_le1 has no meshes"):
        pick("q192_le1", "")
    for model, sizes in PAGE.items():
        assert {one.model.control.end_time for one in refined(model, sizes)} == {1.5e-3}


def test_variants_change_one_thing_of_a_quarter() -> None:
    for case in VARIANTS:
        n = int(case.name.rpartition("_n")[2])
        (plain,) = refined("quarter", (n,))
        ours, theirs = case.model, plain.model
        assert ours != theirs
        whole, larger = ("whole" in case.label, "36 mm" in case.label)
        assert case.model.share == (1.0 if whole else 0.25)
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
    head = "time [s],error [-],delamination [mJ],share of the whole plate [-]\n"
    (folder / f"{name}.energy.csv").write_text(head + "0,0,0,0.25\n2e-4,0,250,0.25\n")
    head = "time [s],interface 1 area [mm2],sum [mm2],projected area [mm2]"
    rows = "0,0,0,0,0.25\n2e-4,10,10,10,0.25\n"
    (folder / f"{name}.delamination.csv").write_text(f"{head},share of the whole plate [-]\n{rows}")


def test_a_quarter_is_reported_as_the_whole(tmp_path: Path) -> None:
    cases = refined("quarter", (8, 12))
    _write_run(tmp_path, cases[0].name)
    (run,) = read_runs(cases, tmp_path)
    impact = read_impact(run)
    assert (core_size(run.case), impact.projected) == (3.0, 40.0)
    (page,) = report([run], tmp_path)
    sections = {section.heading: section.text for section in page.sections}
    assert "| a quarter of 192 Q9, 3 mm in the core | 40 |" in sections["Areas"]
    assert sections["Changes"].startswith("| change |\n")
    assert "| 1.00 |" in sections["Refinement"]
    assert sections["Builds"] == "Made by plydyn 0.1.0 (abc).\n"
    case = VARIANTS[-1]
    row = variants_text([read_impact(replace(run, case=case))]).splitlines()[-1]
    assert case.label in row
    assert row.endswith("| 40 | 40 | 40 |")
