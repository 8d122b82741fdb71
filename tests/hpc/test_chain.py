"""A chain of stages from one recipe: impact, settling, compression."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from runs import ROOT, SOLVER, Results

CHAIN = ROOT / "decks" / "hpc" / "plydyn-chain"
PRE = ROOT / ".venv" / "bin" / "plydyn-pre"
NORMAL, INPUT, STOPPED = 0, 2, 4
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
quads = [12, 8]
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
[[stages]]
name = "settle"
remove = ["impactor"]
at_rest = 1.0e-5
end_time = 0.1
[[stages]]
name = "press"
end_time = {END}
supports = [
  {{ set = "rim", hold = "xz" }},
  {{ set = "corner", hold = "y" }},
  {{ set = "near", hold = "z" }},
  {{ set = "away", hold = "z" }},
]
outputs.support_interval = 1.0e-6
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


@pytest.fixture
def decks(tmp_path: Path) -> list[Path]:
    """The decks of the chain."""
    (tmp_path / "c.toml").write_text(RECIPE)
    done = subprocess.run(
        [PRE, "deck", "c.toml"], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == NORMAL, done.stderr
    return [tmp_path / name for name in ("c.k", "c_settle.k", "c_press.k")]


def run_chain(folder: Path, *decks: Path) -> subprocess.CompletedProcess[str]:
    """Run the command on some decks."""
    path = {"PATH": f"{SOLVER.parent}:{os.environ['PATH']}", "OMP_NUM_THREADS": "1"}
    line = [CHAIN, folder, *decks]
    return subprocess.run(line, env=os.environ | path, capture_output=True, text=True, check=False)


def test_chain_ends_in_the_stiffness_of_the_plate(decks: list[Path], tmp_path: Path) -> None:
    """An elastic plate is as stiff after the impact as before: E A / L between its ends.

    The edges are free to move sideways. What the far end lags behind by its inertia is of the order
    of the transit time of a wave over the time of loading, 1 %.
    """
    folder = tmp_path / "results"
    done = run_chain(folder, *decks)
    assert done.returncode == NORMAL, done.stdout + done.stderr
    rest = Results(folder, "c_settle").table("energy")
    assert rest["kinetic"][-1] < 1.1e-5 * rest["kinetic"].max()
    assert rest["internal"][-1] < 1e-3 * rest["internal"].max()
    press = Results(folder, "c_press")
    table = press.table("supports")
    moved = SPEED * END * 0.75
    force = table["face motion 2005 fx"][-1]
    assert abs(force) == pytest.approx(MODULUS * WIDE * THICK * moved / LONG, rel=0.02)
    assert np.abs(press.table("energy")["error"]).max() < 1e-6


def test_chain_goes_on_where_it_was(decks: list[Path], tmp_path: Path) -> None:
    """What has ended is left alone; what is missing is refused by name."""
    folder = tmp_path / "results"
    assert run_chain(folder, *decks[:2]).returncode == NORMAL
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


def test_results_of_another_laminate_are_refused(decks: list[Path], tmp_path: Path) -> None:
    """Decks made anew with other plies do not go on from the plate that was there."""
    folder = tmp_path / "results"
    assert run_chain(folder, *decks[:2]).returncode == NORMAL
    before = {path: path.stat().st_mtime_ns for path in folder.iterdir()}
    line = [PRE, "deck", "c.toml", "--set", "laminate.thickness=1.1"]
    subprocess.run(line, cwd=tmp_path, capture_output=True, check=True)
    done = run_chain(folder, *decks)
    assert done.returncode == INPUT
    assert f"the results {folder / 'c'}.* are of another deck than {decks[0]}" in done.stderr
    assert {path: path.stat().st_mtime_ns for path in folder.iterdir()} == before
