"""One page over the stages of a chain."""

from __future__ import annotations

import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest
import synthetic
import synthetic_damage
from test_compression import write_test
from test_dent import BOTTOM, MIDDLE, TOP, write_dent
from typer.testing import CliRunner

from plydyn_post.cli import app
from plydyn_post.compression import read_compression
from plydyn_post.errors import ResultsError
from plydyn_post.numbers import BULGE, GAPS, LATER, THINNER, compare
from plydyn_post.plan import Plan
from plydyn_post.results import open_results
from plydyn_post.stages_report import draw_motions, moves, stage_table, tasks_of_stage


def call(*words: object) -> tuple[int, str]:
    """Exit code and print of the command."""
    result = CliRunner().invoke(app, ["stages", *map(str, words), "--plain"])
    return result.exit_code, result.output


def settle(impact: Path, share: float, late: float = 0.0) -> Path:
    """A stage without an impactor after an impact, at whose end a share of the motion is left."""
    later = impact.with_name("settle")
    shutil.copy(impact.with_name(f"{impact.name}.vtkhdf"), impact.with_name("settle.vtkhdf"))
    with h5py.File(impact.with_name("settle.vtkhdf"), "r+") as file:
        del file["plydyn/impactors"]
        file["VTKHDF/PointData/displacement"][...] *= share
    head, *rows = impact.with_name(f"{impact.name}.energy.csv").read_text().splitlines()
    names, values = head.split(","), np.loadtxt(rows, delimiter=",")
    time = next(k for k, name in enumerate(names) if name.startswith("time"))
    values[:, time] += values[-1, time] - values[0, time] + late
    synthetic.write_csv(impact.with_name("settle.energy.csv"), names, values)
    return later


def pull(folder: Path) -> None:
    """Turn the forces and motions of a compression test round."""
    write_test(folder, "pulled")
    for path in (folder / "pulled.supports.csv", *folder.glob("pulled.profile_*.csv")):
        head, *rows = path.read_text().splitlines()
        values = np.loadtxt(rows, delimiter=",")
        turned = [
            k for k, name in enumerate(head.split(",")) if name[:2] in ("mo", "ux", "ex", "sp")
        ]
        values[:, turned] *= -1.0
        synthetic.write_csv(path, head.split(","), values)


def test_a_compression_test_is_found_at_the_end(own_job: Path, tmp_path: Path) -> None:
    write_test(tmp_path)
    code, printed = call(own_job, tmp_path / "pressed", "-o", tmp_path / "page")
    assert code == 0, printed
    assert "strength, peak force / (w h) [MPa]" in printed
    assert "peak force [kN]" in printed
    assert "end shortening at the peak [mm]" in printed
    page = (tmp_path / "page/report.html").read_text()
    assert 'src="compression_stress.png"' in page
    assert (tmp_path / "page/strength.csv").is_file()


def test_a_plate_that_is_pulled_has_an_elongation(own_job: Path, tmp_path: Path) -> None:
    """The same numbers as in compression, by their names in tension."""
    pull(tmp_path)
    pressed = write_test(tmp_path)
    pulled = read_compression(open_results(tmp_path / "pulled"))
    assert pulled.pulled
    assert not pressed.pulled
    assert pulled.strength == pytest.approx(pressed.strength)
    assert pulled.strain == pytest.approx(pressed.strain)
    code, printed = call(own_job, tmp_path / "pulled", "-o", tmp_path / "page")
    assert code == 0, printed
    assert "elongation at the peak" in printed
    assert "buckling" not in printed
    page = (tmp_path / "page/report.html").read_text()
    assert "<h2>Tension</h2>" in page
    assert 'src="compression_stress.png"' in page


def test_a_plate_without_profiles_gets_its_force(own_job: Path, tmp_path: Path) -> None:
    """There is no strength, and the page says why."""
    write_test(tmp_path)
    for path in tmp_path.glob("pressed.profile_*.csv"):
        path.unlink()
    code, printed = call(own_job, tmp_path / "pressed", "-o", tmp_path / "page")
    assert code == 0, printed
    assert "no strength is computed: pressed has no profile" in printed
    page = (tmp_path / "page/report.html").read_text()
    assert 'src="motions_pressed.png"' in page
    assert "<h2>Stages</h2>" in page
    code, printed = call(tmp_path / "pressed", "--pristine", own_job)
    assert code == 2
    assert "--pristine needs a test of strength" in printed


def test_pictures_of_two_impacts_have_names_of_their_own(own_job: Path) -> None:
    job = open_results(own_job)
    one = {task.name for task in tasks_of_stage(Plan((job,), own_job.parent), job)}
    two = {task.name for task in tasks_of_stage(Plan((job, job), own_job.parent), job)}
    assert "force" in one
    assert f"force_{job.job}" in two
    assert all(job.job in name for name in two)


def test_only_what_moves_has_a_force(own_job: Path, tmp_path: Path) -> None:
    test = write_test(tmp_path)
    assert moves(test.job) == ["motion 7 fx"]
    assert draw_motions(test.job, tmp_path / "force.png").is_file()
    assert moves(open_results(own_job)) == []
    with pytest.raises(ResultsError, match="no prescribed motion"):
        draw_motions(open_results(own_job), tmp_path / "none.png")


def test_stages_are_in_their_order(own_job: Path, tmp_path: Path) -> None:
    test = write_test(tmp_path)
    table = stage_table((open_results(own_job), test.job))
    assert [row[0] for row in table.rows] == [own_job.name, "pressed"]


def test_the_dent_is_told_after_each_stage(tmp_path: Path) -> None:
    """Half of the dent is left after a stage without an impactor."""
    impact = write_dent(tmp_path, MIDDLE)
    later = settle(impact, 0.5)
    jobs = [open_results(impact), open_results(later)]
    table = stage_table(jobs)
    place = next(k for k, name in enumerate(table.headings) if name.startswith("dent"))
    assert table.headings[place] == "dent [mm]"
    assert [float(row[place]) for row in table.rows] == pytest.approx([TOP, 0.5 * TOP], abs=1e-6)
    rows = {row.name: row for row in compare(jobs).rows}
    assert rows[LATER].values == pytest.approx([0.5 * TOP], abs=1e-6)
    assert rows[LATER].unit == rows["dent depth at the end"].unit == "mm"
    assert LATER not in {row.name for row in compare(jobs[:1]).rows}


@pytest.mark.parametrize("gaps", [(), (0.01, 0.0, 0.05)])
def test_the_dent_has_parts(tmp_path: Path, gaps: tuple[float, ...]) -> None:
    """The struck face is as deep as the other one bulges, less the gaps, plus what plies lost."""
    impact = write_dent(tmp_path, MIDDLE)
    later = settle(impact, 0.5)
    if gaps:
        synthetic_damage.write_interfaces(tmp_path, "settle")
        synthetic_damage.add_opening(tmp_path, "settle", gaps)
    rows = {row.name: row for row in compare([open_results(impact), open_results(later)]).rows}
    lost = 0.5 * (TOP - BOTTOM) + sum(gaps)
    wanted = {LATER: 0.5 * TOP, BULGE: 0.5 * BOTTOM, GAPS: sum(gaps), THINNER: lost}
    for name, value in wanted.items():
        assert rows[name].values == pytest.approx([value], abs=1e-6), name


def keep_moving(impact: Path) -> None:
    """Let the plate of an impact have its largest kinetic energy at all times."""
    path = impact.with_name("plate.energy.csv")
    head, *rows = path.read_text().splitlines()
    values = np.loadtxt(rows, delimiter=",")
    place = next(k for k, name in enumerate(head.split(",")) if name.startswith("kinetic"))
    values[:, place] = values[:, place].max()
    synthetic.write_csv(path, head.split(","), values)


def test_there_is_no_dent_in_a_plate_that_moves(tmp_path: Path) -> None:
    """The table of stages says so in place of a depth."""
    impact = write_dent(tmp_path, MIDDLE)
    keep_moving(impact)
    table = stage_table((open_results(impact),))
    assert "still moves" in table.rows[0]
    assert any("no dent yet" in note for note in compare([open_results(impact)]).notes)


def test_a_plate_that_settles_later_needs_no_note(tmp_path: Path) -> None:
    """The impact ends in motion, and the stage after it does not."""
    impact = write_dent(tmp_path, MIDDLE)
    later = settle(impact, 0.5)
    keep_moving(impact)
    made = compare([open_results(impact), open_results(later)])
    assert LATER in {row.name for row in made.rows}
    assert not any("no dent yet" in note for note in made.notes)


def test_a_job_that_does_not_go_on_is_no_later_stage(tmp_path: Path) -> None:
    impact = write_dent(tmp_path, MIDDLE)
    later = settle(impact, 0.5, late=0.1)
    jobs = [open_results(impact), open_results(later)]
    assert LATER not in {row.name for row in compare(jobs).rows}
