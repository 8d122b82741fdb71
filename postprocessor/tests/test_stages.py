"""One page over the stages of a chain."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import synthetic
from test_compression import write_test
from typer.testing import CliRunner

from plydyn_post.cli import app
from plydyn_post.compression import read_compression
from plydyn_post.errors import ResultsError
from plydyn_post.motion_figures import draw_motions, moves
from plydyn_post.plan import Plan
from plydyn_post.results import open_results
from plydyn_post.stages_report import stage_table, tasks_of_stage


def call(*words: object) -> tuple[int, str]:
    """Exit code and print of the command."""
    result = CliRunner().invoke(app, ["stages", *map(str, words), "--plain"])
    return result.exit_code, result.output


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
    assert "strength, peak force" in printed
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
