"""Parameter studies: cases, folders, an array job, runs side by side, one table and one figure."""

from __future__ import annotations

import csv
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from programs import plydyn_pre
from test_runs import RECIPE, SOLVER, environment

from plydyn_pre import PreError
from plydyn_pre.series.folders import Written, write_cases, written_cases
from plydyn_pre.series.plan import read_series
from plydyn_pre.series.pool import run_cases

NORMAL, INPUT, STOPPED = 0, 2, 4
COMMAND = [sys.executable, "-m", "plydyn_pre", "study"]
STUDY = """
recipe = "short.toml"

[values]
laminate.layup = ["[0]", "[90/0]"]
impactor.velocity = [[0.0, 0.0, -1000.0], [0.0, 0.0, -2000.0]]
"""


@pytest.fixture
def study(tmp_path: Path) -> Path:
    """A study of four cases of a recipe with a stage."""
    (tmp_path / "short.toml").write_text(RECIPE)
    path = tmp_path / "layups.toml"
    path.write_text(STUDY)
    return path


def ran(*words: object, code: int = NORMAL) -> str:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PATH", environment()["PATH"])
        done = plydyn_pre(Path.cwd(), "study", *words)
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout + done.stderr


def rows_of(path: Path) -> list[dict[str, str]]:
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def test_cases_are_all_combinations(study: Path) -> None:
    """The last key changes fastest; folders are numbered."""
    series = read_series(study)
    assert series.keys == ("laminate.layup", "impactor.velocity")
    assert [case.name for case in series.cases] == ["1", "2", "3", "4"]
    assert [case.values[0] for case in series.cases] == ["[0]", "[0]", "[90/0]", "[90/0]"]
    assert series.cases[1].overrides == (
        'laminate.layup="[0]"',
        "impactor.velocity=[0.0, 0.0, -2000.0]",
    )


def test_folders_hold_the_decks_of_their_cases(study: Path, tmp_path: Path) -> None:
    written = write_cases(read_series(study), tmp_path / "made")
    assert written == written_cases(tmp_path / "made")
    decks = {case.name: case.decks[0].read_text() for case in written}
    assert all(len(case.decks) == 2 for case in written)
    assert len(set(decks.values())) == 4
    assert "-2000" in decks["2"] and "-2000" not in decks["1"]
    listed = rows_of(tmp_path / "made/cases.csv")
    assert listed[2]["laminate.layup"] == "[90/0]"
    assert listed[2]["jobs"] == "short short_on"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("recipe = 1\n[values]\na = [1]", "recipe: the name of a recipe in quotes is needed"),
        ('recipe = "short.toml"', "values: a table of lists is needed"),
        ('recipe = "short.toml"\n[values]\nmesh.n = 6', "values.mesh.n: a list of values"),
        ('recipe = "short.toml"\n[values]\nmesh.n = [6, 6]', "values.mesh.n: [6] stands in it tw"),
        (
            'recipe = "short.toml"\nvalue = 1\n[values]\na = [1]',
            "value: a study has no such key; d",
        ),
        ('recipe = "none.toml"\n[values]\na = [1]', "none.toml"),
        ('recipe = "short.toml"\n[values]\nlaminate.layup = ["[0]", "[x]"]', "case 2 (laminate.l"),
        ("recipe =", "it is not TOML"),
        ('recipe = "short.toml"\n[values]\na = [{b = 1}]', "values.a: {'b': 1} was given; values"),
    ],
)
def test_a_wrong_study_is_told_and_writes_nothing(study: Path, text: str, words: str) -> None:
    study.write_text(text)
    said = ran(study, study.parent / "made", code=INPUT)
    assert words in said
    assert not (study.parent / "made").exists()


def test_cases_run_here_and_make_a_table_and_a_figure(study: Path, tmp_path: Path) -> None:
    """Numbers are those of the histories; what has ended is not run again."""
    folder = tmp_path / "made"
    said = ran(study, folder, "--run", "--table")
    assert "4 of 4" in said
    table = rows_of(folder / "table.csv")
    assert [row["impact velocity [m/s]"] for row in table] == ["-1", "-2", "-1", "-2"]
    for row in table:
        history = rows_of(folder / row["case"] / "short.impactor_1.csv")
        peak = max(float(one["force [N]"]) for one in history)
        column = next(name for name in row if name.startswith("peak force"))
        scale = 1e-3 if column.endswith("[kN]") else 1.0
        assert float(row[column]) == pytest.approx(scale * peak, rel=1e-5)
        assert "normal end" in (folder / row["case"] / "short_on.out").read_text()
    assert (folder / "peak_force.png").read_bytes().startswith(b"\x89PNG")
    written = {path: path.stat().st_mtime_ns for path in folder.glob("*/*.csv")}
    ran(study, folder, "--run")
    assert {path: path.stat().st_mtime_ns for path in folder.glob("*/*.csv")} == written


def test_a_table_says_which_cases_are_missing(study: Path, tmp_path: Path) -> None:
    folder = tmp_path / "made"
    cases = write_cases(read_series(study), folder)
    assert run_cases(cases[2:3], 1, solver=SOLVER) == {"3": NORMAL}
    said = ran(study, folder, "--table")
    assert "3 of 4 cases have not come to a normal end: 1, 2, 4" in said
    filled = [row["case"] for row in rows_of(folder / "table.csv") if row["impact velocity [m/s]"]]
    assert filled == ["3"]


def test_a_case_that_fails_stops_no_other(study: Path, tmp_path: Path) -> None:
    cases = write_cases(read_series(study), tmp_path / "made")
    (tmp_path / "bad").mkdir()
    (tmp_path / "bad/bad.k").write_text("*KEYWORD\n*NONSENSE\n*END\n")
    bad = Written("bad", (tmp_path / "bad/bad.k",))
    codes = run_cases([bad, *cases[:2]], 1, solver=SOLVER)
    assert codes == {"bad": INPUT, "1": NORMAL, "2": NORMAL}


def test_a_task_of_the_array_job_runs_its_case(study: Path, tmp_path: Path) -> None:
    folder = tmp_path / "made"
    write_cases(read_series(study), folder)
    script = (folder / "study.slurm").read_text()
    assert "#SBATCH --array=1-4\n" in script
    chain = Path(__file__).parents[2] / "decks/hpc"
    path = {"PATH": f"{SOLVER.parent}:{chain}:{os.environ['PATH']}", "SLURM_ARRAY_TASK_ID": "2"}
    done = subprocess.run(
        ["bash", "study.slurm"],
        cwd=folder,
        env=os.environ | path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == NORMAL, done.stdout + done.stderr
    assert [path.name for path in folder.glob("*/short_on.out")] == ["short_on.out"]
    assert "normal end" in (folder / "2/short_on.out").read_text()


def test_a_signal_stops_all_cases_and_the_same_command_goes_on(study: Path, tmp_path: Path) -> None:
    folder = tmp_path / "made"
    study.write_text(f"{STUDY}control.end_time = [6e-4]\nstages = [[]]\n")
    words = [*COMMAND, str(study), str(folder), "--run"]
    with subprocess.Popen(words, env=environment(), stdout=subprocess.PIPE, text=True) as process:
        begun = time.monotonic()
        tables = [folder / name / "short.energy.csv" for name in "12"]
        while not all(path.is_file() and path.stat().st_size > 2000 for path in tables):
            assert time.monotonic() - begun < 60.0
            assert process.poll() is None
            time.sleep(0.02)
        process.send_signal(signal.SIGTERM)
        said, _ = process.communicate(timeout=60)
    assert process.returncode == STOPPED, said
    assert "ended            0 of 4" in said
    assert all(list((folder / name).glob("short.dump*")) for name in "12")
    ran(study, folder, "--run")
    for name in "1234":
        assert "normal end" in (folder / name / "short.out").read_text()
    assert "restart" in (folder / "1/short.out").read_text()


def test_a_folder_without_cases_is_told(study: Path, tmp_path: Path) -> None:
    with pytest.raises(PreError, match=r"cases\.csv cannot be read"):
        written_cases(tmp_path)
    assert "cases.csv cannot be read" in ran(study, tmp_path / "none", "--table", code=INPUT)
