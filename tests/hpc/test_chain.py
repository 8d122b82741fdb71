"""A chain of stages from one recipe: impact, settling, compression."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest

from broken import unlike
from recipes import make_deck
from runs import ROOT, SOLVER, Results

CHAIN = ROOT / "decks" / "hpc" / "plydyn-chain"
PRE = ROOT / ".venv" / "bin" / "plydyn-pre"
NORMAL, INPUT, STOPPED = 0, 2, 4
#: Exit codes of a script that Ctrl-C or a closed terminal ended, and of one that was killed
ENDED, LEFT, KILLED = -signal.SIGINT, -signal.SIGHUP, -signal.SIGKILL
#: Longest wait for a stage to have made some steps, s
PATIENCE = 60.0
LONG, WIDE, THICK, MODULUS = 60.0, 40.0, 2.0, 70.0e3
SPEED, END = 100.0, 1.0e-3

RECIPE = f"""
title = "chain"
[materials.metal]
kind = "elastic"
density = 2.7e-9
E = {MODULUS}
nu = 0.3
[laminate]
layup = "[0_2]"
material = "metal"
thickness = {THICK / 2}
[mesh]
kind = "rectangle"
corner = [0.0, 0.0]
sides = [{LONG}, {WIDE}]
quads = [6, 4]
[[supports]]
set = "rim"
hold = "z"
[[supports]]
set = "far"
hold = "z"
[[supports]]
set = "corner"
hold = "xy"
[sets]
rim.box = [0.0, 0.0, 0.0, {WIDE}]
far.box = [{LONG}, {LONG}, 0.0, {WIDE}]
corner.at = [0.0, 0.0]
near.line = [1.0, 4.0, 59.0, 4.0]
away.line = [1.0, 36.0, 59.0, 36.0]
[impactor]
radius = 8.0
mass = 1.0e-5
velocity = [0.0, 0.0, -2000.0]
guided = true
gap = 0.01
[contact]
method = "points_on_plate"
[control]
end_time = 1.0e-4
[outputs]
energy_interval = 1.0e-6
[[stages]]
name = "settle"
remove = ["impactor"]
at_rest = 1.0e-5
end_time = 0.1
[[stages]]
name = "press"
end_time = {END}
supports = [
  {{ set = "rim", hold = "x" }},
  {{ set = "rim", hold = "z", face = "bottom" }},
  {{ set = "corner", hold = "y" }},
  {{ set = "near", hold = "z", face = "bottom" }},
  {{ set = "away", hold = "z", face = "bottom" }},
]
outputs.support_interval = 1.0e-6
outputs.restart_steps = 1000
[[stages.loads]]
kind = "motion"
set = "far"
direction = "x"
quantity = "velocity"
value = {-SPEED}
face = "all"
curve = "start"
[curves.start]
time = [0.0, {END / 2}]
value = [0.0, 1.0]
"""


def write_decks(folder: Path) -> list[Path]:
    """Write the decks of the chain."""
    (folder / "c.toml").write_text(RECIPE)
    make_deck(folder / "c.toml", folder / "c.k")
    return [folder / name for name in ("c.k", "c_settle.k", "c_press.k")]


@pytest.fixture
def decks(tmp_path: Path) -> list[Path]:
    """The decks of the chain."""
    return write_decks(tmp_path)


def environment() -> dict[str, str]:
    """Where the solver is found."""
    path = f"{SOLVER.parent}:{os.environ['PATH']}"
    return os.environ | {"PATH": path, "OMP_NUM_THREADS": "1"}


def run_chain(folder: Path, *decks: Path) -> subprocess.CompletedProcess[str]:
    """Run the command on some decks."""
    line = [CHAIN, folder, *decks]
    return subprocess.run(line, env=environment(), capture_output=True, text=True, check=False)


def stop_chain(how: signal.Signals, when: Path, folder: Path, *decks: Path) -> int:
    """Send a signal as soon as a file is there: to the command, SIGKILL to all it started."""
    # a test that runs in the background would pass on that Ctrl-C or a closed terminal is ignored
    line = ["env", "--default-signal=INT,HUP", CHAIN, folder, *decks]
    with subprocess.Popen(
        line, env=environment(), stdout=subprocess.DEVNULL, start_new_session=True
    ) as chain:
        until = time.monotonic() + PATIENCE
        while not when.exists():
            assert chain.poll() is None, "the chain ended before it could be stopped"
            assert time.monotonic() < until
            time.sleep(0.01)
        if how is signal.SIGKILL:
            os.killpg(chain.pid, how)
        else:
            chain.send_signal(how)
        return chain.wait()


def continued_from(done: subprocess.CompletedProcess[str]) -> str:
    """The restart file that a command went on from first."""
    found = re.search(r"continues from (\S+) at cycle", done.stdout)
    assert found is not None, done.stdout
    return Path(found[1]).name


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Results of a chain in one piece."""
    folder = tmp_path_factory.mktemp("whole")
    assert run_chain(folder / "results", *write_decks(folder)).returncode == NORMAL
    return folder / "results"


def copied(whole: Path, folder: Path, *stages: str) -> Path:
    """A folder with the results of some stages: as if the chain had come to the end of these.

    They are written in their order, and after the decks.
    """
    folder.mkdir()
    for path in sorted(whole.iterdir(), key=lambda path: path.stat().st_mtime_ns):
        if path.name.partition(".")[0] in stages:
            shutil.copy(path, folder)
    return folder


def test_chain_ends_in_the_stiffness_of_the_plate(whole: Path) -> None:
    """An elastic plate is as stiff after the impact as before: E A / L between its ends.

    The edges are free to move sideways, and the plies to become thinner. What the far end lags
    behind by its inertia is of the order of the transit time of a wave over the time of loading,
    1 %.
    """
    rest = Results(whole, "c_settle").table("energy")
    assert rest["kinetic"][-1] < 1.1e-5 * rest["kinetic"].max()
    assert rest["internal"][-1] < 1e-3 * rest["internal"].max()
    press = Results(whole, "c_press")
    table = press.table("supports")
    moved = SPEED * END * 0.75
    pushing = next(n for n in table.names if n.startswith("face motion") and n.endswith("fx"))
    force = table[pushing][-1]
    assert abs(force) == pytest.approx(MODULUS * WIDE * THICK * moved / LONG, rel=0.02)
    assert np.abs(press.table("energy")["error"]).max() < 1e-6


def test_chain_goes_on_where_it_was(decks: list[Path], whole: Path, tmp_path: Path) -> None:
    """What has ended is left alone; what is missing is refused by name."""
    folder = copied(whole, tmp_path / "results", "c", "c_settle")
    before = (folder / "c.energy.csv").stat().st_mtime_ns
    done = run_chain(folder, *decks)
    assert done.returncode == NORMAL, done.stderr
    assert done.stdout.count("has ended already") == 2
    assert (folder / "c.energy.csv").stat().st_mtime_ns == before
    for dump in folder.glob("c_settle.dump*"):
        dump.unlink()
    done = run_chain(folder, *decks)
    assert done.returncode == INPUT
    assert "the restart file at the end of c_settle is missing" in done.stderr


@pytest.mark.parametrize(("older", "last"), [("dump01", "dump02"), ("dump02", "dump01")])
def test_a_stage_goes_on_from_the_newest_restart_file(
    older: str, last: str, decks: list[Path], whole: Path, tmp_path: Path
) -> None:
    """Of the stage before: the one that was written last, whatever its number."""
    folder = copied(whole, tmp_path / "results", "c", "c_settle")
    newest = (folder / "c_settle.dump01").rename(folder / f"c_settle.{last}")
    other = folder / f"c_settle.{older}"
    other.write_text("not the end of the stage")
    day_before = newest.stat().st_mtime - 86400.0
    os.utime(other, (day_before, day_before))
    done = run_chain(folder, *decks)
    assert done.returncode == NORMAL, done.stdout + done.stderr
    assert continued_from(done) == newest.name
    assert unlike(whole, folder) == []


@pytest.mark.parametrize(
    ("how", "code"), [(signal.SIGTERM, STOPPED), (signal.SIGHUP, LEFT), (signal.SIGINT, ENDED)]
)
def test_a_stage_that_was_stopped_goes_on_from_there(
    how: signal.Signals, code: int, decks: list[Path], whole: Path, tmp_path: Path
) -> None:
    """The command passes the signal on; called again, it ends with the results of one piece."""
    folder = copied(whole, tmp_path / "broken", "c", "c_settle")
    assert stop_chain(how, folder / "c_press.runrsf", folder, *decks) == code
    done = run_chain(folder, *decks)
    assert done.returncode == NORMAL, done.stdout + done.stderr
    assert done.stdout.count("has ended already") == 2
    assert continued_from(done) == "c_press.dump01"
    assert unlike(whole, folder) == []


@pytest.mark.parametrize(
    ("ended", "when", "after"),
    [
        (("c", "c_settle"), "c_press.runrsf", "c_press.runrsf"),
        (("c",), "c_settle.out", "c.dump01"),
    ],
)
def test_a_chain_that_was_killed_goes_on(
    ended: tuple[str, ...], when: str, after: str, decks: list[Path], whole: Path, tmp_path: Path
) -> None:
    """From the last restart file of the stage, or without one from the end of the stage before."""
    folder = copied(whole, tmp_path / "broken", *ended)
    assert stop_chain(signal.SIGKILL, folder / when, folder, *decks) == KILLED
    done = run_chain(folder, *decks)
    assert done.returncode == NORMAL, done.stdout + done.stderr
    assert continued_from(done) == after
    assert unlike(whole, folder) == []


def test_bad_chains_are_refused(decks: list[Path], tmp_path: Path) -> None:
    """Stages out of order, of another laminate, or no stages at all: nothing is run."""
    folder = tmp_path / "results"
    first, settle, press = decks
    for line, words in [
        ((first, press), "is stage 2 but is given as stage 1"),
        ((first, settle, settle), "is stage 1 but is given as stage 2"),
        ((first, first), "is no stage"),
        ((first, tmp_path / "none.k"), "there is no deck"),
    ]:
        done = run_chain(folder, *line)
        assert done.returncode == INPUT
        assert words in done.stderr
    first.write_text(first.read_text().replace("7.0e-05", "8e-05") + "$ another laminate\n")
    done = run_chain(folder, first, settle)
    assert done.returncode == INPUT
    assert "belongs to another deck" in done.stderr
    assert not folder.exists()


def test_results_of_another_laminate_are_refused(
    decks: list[Path], whole: Path, tmp_path: Path
) -> None:
    """Decks made anew with other plies do not go on from the plate that was there."""
    folder = copied(whole, tmp_path / "results", "c", "c_settle")
    before = {path: path.stat().st_mtime_ns for path in folder.iterdir()}
    make_deck(tmp_path / "c.toml", tmp_path / "c.k", "laminate.thickness=1.1")
    done = run_chain(folder, *decks)
    assert done.returncode == INPUT
    assert f"the results {folder / 'c'}.* are of another deck than {decks[0]}" in done.stderr
    assert {path: path.stat().st_mtime_ns for path in folder.iterdir()} == before


def test_results_of_a_run_by_hand_are_refused(decks: list[Path], tmp_path: Path) -> None:
    """Nobody knows of which deck they are, so that they are not called those of another one."""
    folder = tmp_path / "results"
    folder.mkdir()
    (folder / "c.out").write_text("End\n---\n\nnormal end\n")
    done = run_chain(folder, *decks)
    assert done.returncode == INPUT
    assert f"the results {folder / 'c'}.* were not made by a chain of runs" in done.stderr
    assert [path.name for path in folder.iterdir()] == ["c.out"]


def free_environment(folder: Path) -> dict[str, str]:
    """Without the programs on PATH, as in a fresh clone whose programs are built."""
    (folder / "bin").mkdir()
    (folder / "bin/plydyn").symlink_to(SOLVER)
    path = {"PATH": f"{folder / 'bin'}:/usr/bin:/bin", "OMP_NUM_THREADS": "1"}
    return os.environ | path


#: The coupon of the template, with quads of 20 mm, four plies, and a blow of 1 J
COARSE = (
    ("cracks", "false"),
    ("laminate.layup", "[0/90]s"),
    ("laminate.thickness", "1.0"),
    ("mesh.core", "40"),
    ("mesh.quad", "20"),
    ("mesh.largest", "25"),
    ("mesh.order", "2"),
    ("impactor.energy", "1.0e3"),
    ("control.end_time", "2.0e-4"),
    ("control.step_factor", "0.8"),
    ("stages[1].at_rest", "0.05"),
    ("stages[2].end_time", "1.0e-3"),
)


def test_one_command_leads_from_the_recipe_to_the_report(tmp_path: Path) -> None:
    """From a folder with nothing but the recipe; a second call runs and draws nothing."""
    line = [PRE, "new", tmp_path / "cai.toml", "--template", "astm-d7137"]
    subprocess.run(line, capture_output=True, check=True)
    line = [CHAIN, "cai.toml", "made", "--plain"]
    line += [word for key, value in COARSE for word in ("--set", f"{key}={value}")]
    found = free_environment(tmp_path)

    def call(*more: str) -> subprocess.CompletedProcess[str]:
        words = [*line, *more]
        return subprocess.run(words, cwd=tmp_path, env=found, capture_output=True, text=True)

    done = call()
    assert done.returncode == NORMAL, done.stdout + done.stderr
    page = (tmp_path / "made/cai_report/report.html").read_text()
    for name in ("force", "compression_stress", "displacement_cai"):
        assert f'src="{name}.png"' in page
        assert (tmp_path / f"made/cai_report/{name}.png").is_file()
    numbers = (tmp_path / "made/cai_report/strength.csv").read_text()
    assert numbers.startswith("quantity,cai_compression")
    files = {path: path.stat().st_mtime_ns for path in (tmp_path / "made").rglob("*")}
    again = call()
    assert again.returncode == NORMAL, again.stderr
    assert again.stdout.count("has ended already") == 3
    after = {path: path.stat().st_mtime_ns for path in (tmp_path / "made").rglob("*")}
    assert after == files
    other = call("--set", "laminate.layup=[90/0]s")
    assert other.returncode == INPUT
    assert "are of another deck than cai.toml" in other.stderr
    assert {path: path.stat().st_mtime_ns for path in files} == files


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["none.toml"], "none.toml"),
        (["c.toml", "--set", "stages[2].end_time=-1.0"], "stages[2].end_time"),
        (["c.toml", "--set"], "requires an argument"),
        (["c.toml", "--fast"], "No such option"),
        (["c.toml", "one", "two"], "unexpected extra argument"),
        (["results"], "plydyn-chain FOLDER DECK"),
        ([], "plydyn-chain FOLDER DECK"),
    ],
)
def test_bad_calls_are_refused(words: list[str], expected: str, tmp_path: Path) -> None:
    """By the name of what is wrong, and nothing is written."""
    (tmp_path / "c.toml").write_text(RECIPE)
    found = environment() | {"PATH": f"{PRE.parent}:{os.environ['PATH']}"}
    done = subprocess.run([CHAIN, *words], cwd=tmp_path, env=found, capture_output=True, text=True)
    assert done.returncode == INPUT
    assert expected in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["c.toml"]


@pytest.mark.parametrize("word", ["--help", "-h"])
def test_help_is_no_error(word: str) -> None:
    done = subprocess.run([CHAIN, word], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("plydyn-chain FOLDER DECK [STAGE...]")
    assert "plydyn-pre run" in done.stdout
    assert "set -uo" not in done.stdout
    assert done.stderr == ""


@pytest.mark.parametrize("name", ["plydyn-chain", "plydyn-batch"])
def test_a_script_tells_the_version_of_the_program(name: str) -> None:
    path = os.environ | {"PATH": f"{SOLVER.parent}:{os.environ['PATH']}"}
    told = [
        subprocess.run(words, env=path, capture_output=True, text=True, check=True).stdout
        for words in ([CHAIN.with_name(name), "--version"], [SOLVER, "--version"])
    ]
    assert told[0] == told[1] != ""
