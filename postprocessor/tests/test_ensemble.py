"""Ensembles: mean, spread and probability of jobs that are known."""

from __future__ import annotations

import csv
from pathlib import Path

import h5py
import numpy as np
import pytest
import synthetic
import synthetic_damage as known
from typer.testing import CliRunner

from plydyn_post.cli import app
from plydyn_post.ensemble import probability, read_scans
from plydyn_post.errors import ResultsError
from plydyn_post.results import open_results
from plydyn_post.sheets import area_beyond


def write_jobs(folder: Path) -> list[Path]:
    """Two jobs with damage; the second one is hit harder and not delaminated."""
    jobs = [known.write_job(folder / name, name) for name in ("one", "two")]
    synthetic.write_impactor(folder / "two", "two", 1.5)
    with h5py.File(folder / "two" / "two.interfaces.vtkhdf", "r+") as file:
        file["VTKHDF/PointData/damage"][...] = 0.0
    return jobs


def test_probability_is_the_share_of_jobs_that_are_delaminated(tmp_path: Path) -> None:
    jobs = [open_results(job) for job in write_jobs(tmp_path)]
    sheet = probability(read_scans(jobs))
    assert set(np.unique(sheet.values)) == {0.0, 0.5}
    alone = probability(read_scans(jobs[:1]))
    assert area_beyond(sheet, 0.25) == pytest.approx(area_beyond(alone, 0.5))


def test_command_writes_numbers_and_pictures(tmp_path: Path) -> None:
    jobs = write_jobs(tmp_path)
    done = CliRunner().invoke(app, ["ensemble", *map(str, jobs), "-o", str(tmp_path / "all")])
    assert done.exit_code == 0, done.output
    assert {path.name for path in (tmp_path / "all").iterdir()} == {
        "numbers.csv",
        "force.png",
        "probability.png",
    }
    with (tmp_path / "all" / "numbers.csv").open() as file:
        rows = {row["quantity"]: row for row in csv.DictReader(file)}
    peak = rows["peak force"]
    assert float(peak["most"]) == pytest.approx(1.5 * float(peak["least"]), rel=1e-4)
    assert float(peak["mean"]) == pytest.approx(1.25 * float(peak["least"]), rel=1e-4)
    deviation = 0.5 * float(peak["least"]) / np.sqrt(2.0)
    assert float(peak["deviation"]) == pytest.approx(deviation, rel=1e-4)


def test_a_run_that_stopped_is_told_and_its_contact_is_none(tmp_path: Path) -> None:
    """A duration so far is no duration: one job is left, which has no spread."""
    jobs = write_jobs(tmp_path)
    table = tmp_path / "two" / "two.impactor_1.csv"
    lines = table.read_text().splitlines()
    table.write_text("\n".join(lines[: len(lines) // 2]) + "\n")
    (tmp_path / "two" / "two.out").write_text("the motion is unstable\n")
    words = "note: two: the run has not come to its normal end (see the listing)"
    for command in ("numbers", "ensemble"):
        done = CliRunner().invoke(app, [command, *map(str, jobs)])
        assert done.exit_code == 0, done.output
        assert words in " ".join(done.output.split()) and "note: one:" not in done.output
    with (tmp_path / "one" / "one_ensemble" / "numbers.csv").open() as file:
        names = {row["quantity"] for row in csv.DictReader(file)}
    assert "peak force" in names and not {"contact duration", "impulse"} & names


def test_one_job_is_no_ensemble(tmp_path: Path) -> None:
    job = known.write_job(tmp_path)
    done = CliRunner().invoke(app, ["ensemble", str(job)])
    assert done.exit_code == 2


def test_other_meshes_are_refused(tmp_path: Path) -> None:
    one, other = (known.write_job(tmp_path / name, name) for name in ("one", "two"))
    known.write_interfaces(tmp_path / "two", "two", quads=60)
    scans = read_scans([open_results(one), open_results(other)])
    with pytest.raises(ResultsError, match="one mesh"):
        probability(scans)
