"""The commands write what they say, and tell what is wrong in one line."""

import os
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path
from xml.etree import ElementTree

import pytest
import pyvista as pv
import synthetic
from typer.testing import CliRunner

from plydyn_post.cli import app

runner = CliRunner()


def run(*words: object) -> str:
    result = runner.invoke(app, [str(word) for word in words])
    assert result.exit_code == 0, result.output
    return result.output


def test_a_report_of_two_jobs_holds_everything(job: Path, own_job: Path, tmp_path: Path) -> None:
    folder = tmp_path / "report"
    output = run("report", job, own_job, "-o", folder, "--plain")
    names = {path.name for path in folder.iterdir()}
    assert {"report.html", "numbers.csv", "force.png", "profile_1_in_plane.png"} <= names
    assert len([name for name in names if name.startswith(("energy_", "stress_"))]) == 4
    page = (folder / "report.html").read_text()
    for path in folder.glob("*.png"):
        assert f'src="{path.name}"' in page
    assert "&lt;sphere&gt;" in page
    assert str(folder / "report.html") in output
    assert "peak force" in output


def test_a_report_goes_beside_the_results(own_job: Path) -> None:
    run("report", f"{own_job}.vtkhdf", "--plain")
    assert (own_job.parent / "plate_report" / "report.html").is_file()


def test_a_report_tells_what_it_could_not_draw(own_job: Path) -> None:
    own_job.with_name("plate.vtkhdf").unlink()
    path = own_job.with_name("plate.energy.csv")
    path.write_text(path.read_text()[:-5])
    output = run("report", own_job)
    assert "plate.vtkhdf: there is no such file" in output
    assert "plate.energy.csv: the last line was cut short" in output
    page = (own_job.parent / "plate_report" / "report.html").read_text()
    assert "cut short" in page


@pytest.mark.parametrize(
    ("words", "names"),
    [
        (["force"], ["plate_force.png"]),
        (["force", "--over", "displacement"], ["plate_force_displacement.png"]),
        (["velocity"], ["plate_velocity.png"]),
        (["energy", "--stacked"], ["plate_energy.png"]),
        (["profile"], ["plate_profile_in_plane.png", "plate_profile_interlaminar.png"]),
        (["profile", "--component", "syz"], ["plate_profile.png"]),
        (["picture", "--plain", "--show", "szz", "--cut"], ["plate_szz_cut.png"]),
        (["picture", "--plain", "--limits", "-1", "0", "--view", "30", "40"], ["plate_uz.png"]),
    ],
)
def test_each_command_writes_its_figure(own_job: Path, words: list[str], names: list[str]) -> None:
    output = run(words[0], own_job, *words[1:])
    for name in names:
        assert own_job.with_name(name).is_file()
        assert name in output


@pytest.mark.parametrize("command", ["force", "velocity", "energy", "profile", "picture"])
def test_a_figure_of_a_run_that_stopped_says_so(command: str, own_job: Path) -> None:
    """A listing without its normal end, and a table whose last line is cut."""
    assert "note:" not in run(command, own_job)
    energy = own_job.with_name("plate.energy.csv")
    energy.write_text(energy.read_text() + "0.1,0.")
    own_job.with_name("plate.out").write_text("the motion is unstable\n")
    output = run(command, own_job)
    assert "note: plate: the run has not come to its normal end (see the listing)" in output
    assert "plate.energy.csv: the last line was cut short" in output


def test_numbers_are_printed_and_written(job: Path, tmp_path: Path) -> None:
    output = run("numbers", job, "-o", tmp_path / "numbers.csv")
    assert "1.5" in output
    assert "peak force [kN]" in (tmp_path / "numbers.csv").read_text()


def test_a_pvd_lists_states_that_vtk_reads(job: Path, tmp_path: Path) -> None:
    run("pvd", job, "-o", tmp_path)
    entries = ElementTree.parse(tmp_path / "plate.pvd").getroot().findall("Collection/DataSet")
    assert [float(entry.get("timestep")) for entry in entries] == pytest.approx(synthetic.STATES)
    grid = pv.read(tmp_path / entries[1].get("file"))
    assert grid.point_data["displacement"][:, 2].min() == pytest.approx(-synthetic.DEPTH)
    assert set(grid.celltypes) == {29}


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["numbers", "{job}_none"], "plate_none"),
        (["picture", "{job}", "--show", "heat"], "'heat'"),
        (["profile", "{job}", "--component", "sqq"], "plate.profile_1.csv"),
        (["force", "{job}", "--over", "heat"], "'heat'"),
        (["force", "{job}", "--measured", "{job}.none"], "plate.none"),
        (["numbers", "{job}", "-o", "{job}.energy.csv"], "is a result of job plate"),
        (["picture", "{job}", "--plain", "--time", "0.0025"], "not between 0 and 0.002"),
        (["picture", "{job}", "--plain", "--time", "-0.001"], "not between 0 and 0.002"),
        (["profile", "{job}", "--time", "0.0025"], "not between 0 and"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(own_job: Path, words: list[str], told: str) -> None:
    result = runner.invoke(app, [word.format(job=own_job) for word in words])
    assert result.exit_code == 2
    assert told in result.stderr
    assert result.stderr.count("\n") == 1
    assert own_job.with_name("plate.energy.csv").read_text().startswith("cycle")


@pytest.fixture(scope="module")
def help_of_the_module() -> str:
    command = [sys.executable, "-m", "plydyn_post", "--help"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_commands_that_most_need_stand_first(help_of_the_module: str) -> None:
    said = help_of_the_module
    places = [said.index(f" {name} ") for name in ("report", "numbers", "picture", "cscan")]
    assert places[3] > max(places[:3])
    assert places[3] < said.index(" dissipation ")


def test_the_version_is_that_of_the_package() -> None:
    assert run("--version") == f"plydyn-post {version('plydyn-post')}\n"


def test_a_shell_completes_commands_and_options() -> None:
    program = Path(sys.executable).parent / "plydyn-post"
    for typed, found in (
        ("plydyn-post rep", "report"),
        ("plydyn-post report --meas", "--measured"),
    ):
        words = {"COMP_WORDS": typed, "COMP_CWORD": str(len(typed.split()) - 1)}
        environment = os.environ | words | {"_PLYDYN_POST_COMPLETE": "complete_bash"}
        done = subprocess.run(
            [program], env=environment, capture_output=True, text=True, check=True
        )
        assert found in done.stdout.split()


def test_a_help_loads_nothing_that_draws() -> None:
    code = (
        "import sys, plydyn_post.cli;"
        "assert not {'matplotlib', 'pyvista', 'vtkmodules', 'h5py'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_a_narrow_screen_cuts_no_digits_off(job: Path, own_job: Path) -> None:
    words = [sys.executable, "-m", "plydyn_post", "numbers", job, own_job, job, own_job]
    environment = os.environ | {"COLUMNS": "40"}
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=True)
    rows = [line.split() for line in done.stdout.splitlines() if line.startswith("peak force")]
    assert rows == [["peak", "force", "1.5", "1.5", "1.5", "1.5", "kN"]]
    assert "…" not in done.stdout


def test_the_package_runs_as_a_module(help_of_the_module: str) -> None:
    assert "python -m plydyn_post" in help_of_the_module
    assert "cscan" in help_of_the_module


@pytest.mark.parametrize(
    ("words", "fragment"),
    [
        (["force", "--mean", "-1"], "--mean cannot be -1"),
        (["force", "--mean", "nan"], "--mean cannot be nan"),
        (["picture", "--zoom", "0"], "--zoom cannot be 0"),
        (["picture", "--view", "nan", "0"], "--view cannot be nan"),
        (["picture", "--thickness", "-5"], "--thickness cannot be -5"),
        (["picture", "--limits", "1", "0"], "--limits must rise"),
        (["section", "--angle", "inf"], "--angle cannot be inf"),
        (["damage", "--show", "displacement"], "'displacement' is no damage"),
        (["force", "-o", "curve.foo"], "curve.foo: no picture ends so"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_options_that_cannot_be(words: list[str], fragment: str, job: Path) -> None:
    result = runner.invoke(app, [words[0], str(job), *words[1:]])
    assert result.exit_code == 2, result.output
    assert fragment in result.output
