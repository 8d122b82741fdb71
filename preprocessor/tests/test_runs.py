"""Runs from Python and by one command."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from programs import Done, plydyn_pre

from plydyn_pre import PreError, deck_text, load_recipe, make_mesh, run
from plydyn_pre.recipe import example_recipe
from plydyn_pre.runs.chain import without_blow

NORMAL, INPUT, STOPPED, OUTPUT, INTERRUPTED = 0, 2, 4, 5, 130
RECIPE = """
title = "short"
[materials.metal]
kind = "elastic"
density = 2.7e-9
E = 70.0e3
nu = 0.3
[laminate]
layup = "[0]"
material = "metal"
thickness = 1.0
[mesh]
kind = "rectangle"
corner = [0.0, 0.0]
sides = [20.0, 20.0]
quads = [4, 4]
[impactor]
radius = 8.0
mass = 1.0e-5
velocity = [0.0, 0.0, -2000.0]
gap = 0.01
[control]
end_time = 1.0e-5
[[stages]]
name = "on"
end_time = 2.0e-5
"""
SOLVER = Path(os.environ["PLYDYN"])
COMMAND = [sys.executable, "-m", "plydyn_pre", "run"]


@pytest.fixture
def recipe(tmp_path: Path) -> Path:
    """A recipe with a stage."""
    path = tmp_path / "short.toml"
    path.write_text(RECIPE)
    return path


def environment() -> dict[str, str]:
    """Where the solver is found first."""
    return os.environ | {"PATH": f"{SOLVER.parent}:{os.environ['PATH']}"}


def ran(*words: object) -> Done:
    """Run the command in a copy of this process, which finds the solver first."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PATH", environment()["PATH"])
        return plydyn_pre(Path.cwd(), "run", *words)


def test_job_has_paths_code_and_listing(recipe: Path, tmp_path: Path) -> None:
    """Each stage has its results; what has ended is not run again."""
    lines: list[str] = []
    study = load_recipe(recipe)
    job = run(study, tmp_path / "made", recipe=recipe, solver=SOLVER, told=lines.append)
    assert job.code == NORMAL, lines
    assert [path.name for path in job.results] == ["short", "short_on"]
    assert all(Path(f"{path}.energy.csv").is_file() for path in job.results)
    assert "normal end" in job.listing
    written = Path(f"{job.results[0]}.energy.csv").stat().st_mtime_ns
    again = run(study, tmp_path / "made", recipe=recipe, solver=SOLVER, told=lines.append)
    assert again.code == NORMAL
    assert Path(f"{job.results[0]}.energy.csv").stat().st_mtime_ns == written
    assert sum("has ended already" in line for line in lines) == 2


def test_results_of_another_study_are_refused(recipe: Path, tmp_path: Path) -> None:
    folder = tmp_path / "made"
    run(load_recipe(recipe), folder, recipe=recipe, solver=SOLVER)
    before = {path: path.stat().st_mtime_ns for path in folder.iterdir()}
    other = load_recipe(recipe, ["laminate.thickness=1.1"])
    with pytest.raises(
        PreError, match=r"results .*/short\.\* are of another deck than .*short.toml"
    ):
        run(other, folder, recipe=recipe, solver=SOLVER)
    assert {path: path.stat().st_mtime_ns for path in folder.iterdir()} == before


def test_missing_solver_is_named(
    recipe: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr("plydyn_pre.runs.programs._OF_CHECKOUT", ())
    with pytest.raises(PreError, match="no program plydyn on PATH; install the solver"):
        run(load_recipe(recipe), tmp_path / "made")


def test_one_command_runs_a_recipe(recipe: Path, tmp_path: Path) -> None:
    """Its lines are those of the solver; a wrong recipe leaves no folder."""
    folder = tmp_path / "made"
    done = ran(recipe, folder, "--set", "laminate.thickness=-1")
    assert done.returncode == INPUT
    assert "laminate.thickness" in done.stderr
    assert not folder.exists()
    done = ran(recipe, folder, "--no-report", "--threads", "2")
    assert done.returncode == NORMAL, done.stdout + done.stderr
    assert done.stdout.count("normal end") == 2
    assert re.search(r"^threads +2$", (folder / "short.out").read_text(), re.M)


def removing(recipe: Path) -> Path:
    """The recipe with a stage that removes the impactor."""
    recipe.write_text(RECIPE + 'remove = ["impactor"]\n')
    return recipe


def test_the_pristine_plate_is_not_hit(recipe: Path, tmp_path: Path) -> None:
    """The stages are the same, and no impactor touches the plate or is near it."""
    done = ran(removing(recipe), tmp_path / "made", "--no-report", "--with-pristine")
    assert done.returncode == NORMAL, done.stdout + done.stderr
    largest = []
    for folder in (tmp_path / "made", tmp_path / "made/pristine"):
        head, *rows = (folder / "short.impactor_1.csv").read_text().splitlines()
        place = [name.split(" [")[0] for name in head.split(",")].index("force")
        largest.append(max(abs(float(row.split(",")[place])) for row in rows))
        assert (folder / "short_on.energy.csv").is_file()
    assert largest[0] > 0.0
    assert largest[1] == 0.0


def test_without_an_impact_there_is_no_pristine_plate(recipe: Path) -> None:
    """The impactor must go again, and no other may come."""
    with pytest.raises(PreError, match="an impactor that a later stage removes"):
        without_blow(load_recipe(recipe))
    assert without_blow(load_recipe(removing(recipe))).impactor.gap == 8.0


@pytest.mark.parametrize("name", ["astm-d7137", "aitm-1-0010-compression"])
def test_pairs_of_templates_have_a_pristine_plate(name: str, tmp_path: Path) -> None:
    """The stages stay, and the impactor does not come near within the first run."""
    path = tmp_path / "pair.toml"
    path.write_text(example_recipe(name))
    study = load_recipe(path)
    other = without_blow(study)
    assert other.stages == study.stages
    assert other.impactor.velocity == study.impactor.velocity
    assert -other.impactor.velocity[2] * other.control.end_time < 0.01 * other.impactor.gap
    lines = list(deck_text(other, make_mesh(other.mesh)))
    assert lines[-1] == "*END"


@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_stops_the_run_with_a_restart_file(
    recipe: Path, tmp_path: Path, how: signal.Signals
) -> None:
    """The same command goes on from there."""
    folder = tmp_path / "made"
    line = [*COMMAND, recipe, folder, "--no-report", "--set", "control.end_time=5e-4"]
    line += ["--set", "stages[1].end_time=5.0001e-4", "--set", "outputs.restart_steps=50"]
    # a shell in the background may have Ctrl-C ignored
    line = ["env", "--default-signal=INT", *line]
    with subprocess.Popen(line, env=environment(), stdout=subprocess.DEVNULL) as running:
        while not (folder / "short.runrsf").exists():
            assert running.poll() is None
            time.sleep(0.01)
        running.send_signal(how)
        code = running.wait()
    assert code == (STOPPED if how is signal.SIGTERM else INTERRUPTED)
    assert (folder / "short.dump01").is_file()
    done = subprocess.run(line, env=environment(), capture_output=True, text=True, check=False)
    assert done.returncode == NORMAL, done.stdout + done.stderr
    assert "continues from" in done.stdout


def test_a_folder_that_cannot_be_made_ends_with_the_code_of_files(
    recipe: Path, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("")
    done = ran(recipe, tmp_path / "file", "--no-report")
    assert done.returncode == OUTPUT, done.stderr
    assert "file cannot be written" in done.stderr
