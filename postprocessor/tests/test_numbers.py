"""Numbers of an impact whose force is half a sine."""

import csv
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import synthetic
import synthetic_damage
from test_dent import MIDDLE, write_dent
from typer.testing import CliRunner

from plydyn_post.cli import app
from plydyn_post.contact import contact
from plydyn_post.curves import mean_window, read_numbers, running_mean
from plydyn_post.errors import ResultsError
from plydyn_post.numbers import compare, first_drop, write_numbers
from plydyn_post.results import open_results
from plydyn_post.table import read_table
from plydyn_post.units import factor, readable

MEASURES = ("half of the fracture energy", "damage 0.99")
SAMPLE = synthetic.END / 600  # time between two samples


def test_the_numbers_of_half_a_sine(job: Path) -> None:
    numbers = read_numbers(open_results(job))
    assert numbers.peak_force == pytest.approx(synthetic.PEAK)
    assert numbers.peak_time == pytest.approx(synthetic.DURATION / 2)
    assert numbers.contact_duration == pytest.approx(synthetic.DURATION, abs=SAMPLE)
    whole = 2 * synthetic.PEAK * synthetic.DURATION / np.pi
    # the trapezoidal rule errs by (pi h / T)^2 / 12 on half a sine
    assert numbers.impulse == pytest.approx(whole, rel=1e-5)
    assert numbers.largest_displacement == pytest.approx(synthetic.DEPTH)
    assert numbers.impact_velocity == pytest.approx(-synthetic.SPEED)
    assert numbers.rebound_velocity == pytest.approx(synthetic.REBOUND, rel=1e-4)
    given = 0.5e-3 * (synthetic.SPEED**2 - synthetic.REBOUND**2)
    assert numbers.absorbed_energy == pytest.approx(given, rel=1e-3)
    assert numbers.energy_error == pytest.approx(np.abs(open_results(job).energy()["error"]).max())
    assert numbers.notes == ()


@pytest.mark.parametrize(("header", "scale"), [("time [s]", 1.0), ("time [ms]", 1e3)])
def test_the_usual_running_mean_spans_20_microseconds(
    tmp_path: Path, header: str, scale: float
) -> None:
    path = tmp_path / "any.csv"
    path.write_text(f"{header},force [N]\n0,0\n{scale},1\n")
    assert mean_window(read_table(path)) == pytest.approx(20e-6 * scale)


def test_a_run_that_ends_in_contact_has_no_rebound(own_job: Path) -> None:
    path = own_job.with_name("plate.impactor_1.csv")
    path.write_text("\n".join(path.read_text().splitlines()[:300]) + "\n")
    numbers = read_numbers(open_results(own_job))
    assert numbers.rebound_velocity is None
    assert numbers.absorbed_energy is None
    assert "still in contact" in numbers.notes[0]
    comparison = compare([open_results(own_job)])
    texts = {row.name: row.texts()[0] for row in comparison.rows}
    assert texts["contact duration"].endswith(" so far")
    assert texts["impulse"].endswith(" so far")
    assert [name for name, text in texts.items() if "so far" in text] == [
        "contact duration",
        "impulse",
    ]
    line = next(csv.DictReader(write_numbers(comparison, own_job.with_name("a.csv")).open()))
    assert line["contact ended"] == "no"


def test_a_run_that_goes_on_in_contact_is_told(own_job: Path) -> None:
    path = own_job.with_name("plate.impactor_1.csv")
    lines = path.read_text().splitlines()
    path.write_text("\n".join(lines[:1] + lines[200:]) + "\n")
    assert "when the run begins" in read_numbers(open_results(own_job)).notes[0]


def test_an_impactor_that_never_touched_has_no_duration(own_job: Path) -> None:
    synthetic.write_impactor(own_job.parent, "plate", factor=0.0)
    numbers = read_numbers(open_results(own_job))
    assert (numbers.peak_force, numbers.contact_duration) == (0.0, 0.0)
    assert "never touched" in numbers.notes[0]


def test_contact_begins_and_ends_between_samples() -> None:
    time = np.arange(6.0)
    start, end = contact(time, np.array([0.0, 0.0, 10.0, 10.0, 0.0, 0.0]))
    assert (start, end) == pytest.approx((1.001, 3.999))


def test_a_contact_lost_and_found_again_is_one() -> None:
    time = np.arange(8.0)
    start, end = contact(time, np.array([0.0, 5.0, 0.0, 0.0, 5.0, 5.0, 0.0, 0.0]))
    assert start < 1.0
    assert end > 5.0


def test_the_running_mean_keeps_straight_lines_and_removes_waves() -> None:
    time = np.sort(np.random.default_rng(3).uniform(0.0, 1.0, 4000))
    line = 2.0 + 3.0 * time
    inside = (time > time[0] + 0.05) & (time < time[-1] - 0.05)
    assert running_mean(time, line, 0.1)[inside] == pytest.approx(line[inside], abs=1e-9)
    wave = np.sin(2 * np.pi * time / 0.05)
    assert np.abs(running_mean(time, wave, 0.1)[inside]).max() < 0.01
    assert running_mean(time, wave, 0.0) is wave


def test_the_running_mean_takes_half_of_its_window_at_the_ends() -> None:
    time = np.linspace(0.0, 1.0, 101)
    blow = np.where(time < 0.015, 1.0, 0.0)
    # straight between samples: 0.015 of 0.05 at the first sample, and of up to 0.1 further on
    assert running_mean(time, blow, 0.1)[0] == pytest.approx(0.3)
    assert running_mean(time, blow, 0.1)[5] == pytest.approx(0.15)
    assert running_mean(time, blow[::-1], 0.1)[-1] == pytest.approx(0.3)


def test_jobs_in_other_units_are_compared_in_the_first_ones(own_job: Path) -> None:
    names = "time [ms],force [kN],displacement [mm],velocity [m/s],kinetic [J],absorbed [J]"
    rows = ["0,0,0,-3,4.5,0", "1,3,-1,0,0,4.5", "2,0,0,2,2,2.5", "3,0,2,2,2,2.5"]
    own_job.with_name("other.impactor_1.csv").write_text("\n".join([names, *rows]) + "\n")
    comparison = compare([open_results(own_job), open_results(own_job.with_name("other"))])
    rows = {row.name: row for row in comparison.rows}
    assert rows["peak force"].unit == "kN"
    assert rows["peak force"].values == pytest.approx((1.5, 3.0))
    assert rows["time of peak force"].values == pytest.approx((1.0, 1.0))
    assert rows["impact velocity"].values == pytest.approx((-3.0, -3.0))
    assert rows["impulse"].unit == "N.s"
    assert rows["impulse"].values == pytest.approx((1.9099, 3.0), rel=1e-4)
    assert rows["energy error"].values[1] is None
    path = write_numbers(comparison, own_job.with_name("numbers.csv"))
    lines = list(csv.DictReader(path.open()))
    assert [line["job"] for line in lines] == ["plate", "other"]
    assert float(lines[0]["peak force [kN]"]) == pytest.approx(1.5)
    assert lines[1]["energy error [%]"] == ""
    assert [line["contact ended"] for line in lines] == ["yes", "yes"]


def test_a_job_without_impactor_has_no_numbers(own_job: Path) -> None:
    own_job.with_name("plate.impactor_1.csv").unlink()
    with pytest.raises(ResultsError, match="plate"):
        compare([open_results(own_job)])


@pytest.mark.parametrize(
    ("unit", "largest", "shown"),
    [
        ("s", 3e-3, "ms"),
        ("s", 3e-4, "ms"),
        ("s", 5e-6, "µs"),
        ("ms", 3.0, "ms"),
        ("N", 1500.0, "kN"),
        ("N", 999.0, "N"),
        ("mJ", 4500.0, "J"),
        ("mm/s", 3000.0, "m/s"),
        ("mm/ms", 3.0, "m/s"),
        ("m", 0.01, "mm"),
        ("Pa", 1e8, "MPa"),
        ("kgf", 10.0, "kgf"),
        ("", 10.0, ""),
    ],
)
def test_units_of_print_read_well(unit: str, largest: float, shown: str) -> None:
    assert readable(unit, largest).unit == shown


def test_units_of_other_kinds_are_not_mixed() -> None:
    assert factor("mm/s", "m/s") == pytest.approx(1e-3)
    assert factor("kgf", "kgf") == 1.0
    with pytest.raises(ResultsError, match=r"\[N\].*\[mm\]"):
        factor("N", "mm")


def test_a_table_has_one_unit_for_each_kind(own_job: Path) -> None:
    rows = compare([open_results(own_job)]).rows
    for unit in ("kN", "ms", "J", "mm"):
        assert any(row.unit == unit for row in rows)
    assert not {row.unit for row in rows} & {"N", "s", "µs", "mJ", "m"}


def test_numbers_are_json_for_programs(own_job: Path) -> None:
    done = CliRunner().invoke(app, ["numbers", str(own_job), "--json"])
    assert done.exit_code == 0, done.output
    told = json.loads(done.output)
    peak = told["jobs"][0]["numbers"]["peak force"]
    assert (peak["value"], peak["unit"]) == (pytest.approx(1e-3 * synthetic.PEAK), "kN")
    assert told["jobs"][0]["contact ended"] is True


def test_areas_and_energies_have_both_measures(tmp_path: Path) -> None:
    job = open_results(synthetic_damage.write_job(tmp_path))
    rows = {row.name: row for row in compare([job]).rows}
    each = synthetic_damage.areas()
    sums = [rows[f"sum of the interfaces, {by}"].values[0] for by in MEASURES]
    assert sums[0] == pytest.approx(job.delamination()["sum"][-1])
    # damage falls to 0.99 on a hundredth of the rim; nodes resolve the ellipses to some per cent
    wide = (1.0 + 0.01 * synthetic_damage.RIM) ** 2
    assert sums[1] == pytest.approx(sum(each) * wide, rel=0.05)
    assert rows["projected area, damage 0.99"].values[0] < sums[1]
    energies = dict(zip(synthetic_damage.MECHANISMS, synthetic_damage.TAKEN, strict=False))
    assert rows["dissipated, matrix"].values[0] == pytest.approx(energies["matrix damage"] / 1e3)


@pytest.mark.parametrize(
    ("force", "drop"),
    [
        ([0, 5, 10, 9.6, 10, 5, 0], None),
        ([0, 5, 4, 10, 5, 0], 1),
        ([0, 5, 4.6, 10, 5, 0], None),
        ([0, 3, 5, 4, 7, 2, 10, 0], 2),
    ],
)
def test_a_drop_is_a_fall_of_a_twentieth_of_the_peak_before_it(
    force: list[float], drop: int | None
) -> None:
    assert first_drop(np.array(force, dtype=float)) == drop


def test_a_plate_that_still_moves_has_no_dent(tmp_path: Path) -> None:
    job = write_dent(tmp_path, MIDDLE)
    assert read_numbers(open_results(job)).dent_depth is not None
    path = job.with_name("plate.energy.csv")
    head, *rows = path.read_text().splitlines()
    place = head.split(",").index("kinetic [mJ]")
    largest = max(float(row.split(",")[place]) for row in rows)
    for share, known in ((0.9e-4, True), (1.1e-4, False)):
        last = rows[-1].split(",")
        last[place] = f"{share * largest}"
        path.write_text("\n".join([head, *rows[:-1], ",".join(last)]) + "\n")
        numbers = read_numbers(open_results(job))
        assert (numbers.dent_depth is not None) == known
        assert any("let it settle by a stage" in note for note in numbers.notes) != known


@pytest.mark.parametrize(
    "text",
    [
        "time [ms];force [kN]\n0;0\n0,5;1,5\n1;0\n",
        "\ufeffTest 7\nspecimen: A,B\ntime [ms],force [kN]\n0,0\n0.5,1.5\n1,0\n",
        "Prüfung 7;\ntime;force\nms;kN\n0;0\n0,5;1,5\n1;0\n",
        "time [ms]\tforce [kN]\n0\t0\n0,5\t1,5\n1\t0\n",
    ],
)
def test_files_of_tests_are_read_as_machines_write_them(text: str, tmp_path: Path) -> None:
    path = tmp_path / "test.csv"
    path.write_text(text, encoding="utf-8")
    table = read_table(path, from_solver=False)
    assert (table.names, table.units) == (("time", "force"), ("ms", "kN"))
    assert table["force"].tolist() == [0.0, 1.5, 0.0]


def test_no_result_is_replaced(own_job: Path) -> None:
    for name in ("constraints", "supports_2", "energy"):
        path = own_job.with_name(f"plate.{name}.csv")
        path.touch()
        with pytest.raises(ResultsError, match="-o needs another name"):
            open_results(own_job).spare(path)


@pytest.mark.parametrize("name", ["plate.k", "plate.runrsf", "plate.dump01", "mine.toml"])
def test_no_deck_and_no_restart_file_is_replaced(own_job: Path, name: str) -> None:
    path = own_job.with_name(name)
    path.write_text("precious")
    result = CliRunner().invoke(app, ["numbers", str(own_job), "-o", str(path)])
    assert result.exit_code == 2
    assert "-o needs another name" in result.stderr
    assert path.read_text() == "precious"


def test_importing_leaves_the_backend_of_matplotlib_alone() -> None:
    code = (
        "import matplotlib; matplotlib.use('svg'); import plydyn_post.cli, plydyn_post.report;"
        "assert matplotlib.get_backend() == 'svg', matplotlib.get_backend()"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
