"""The installed tree runs from any folder, and batch scripts carry a run to its end."""

from __future__ import annotations

import ast
import os
import re
import shutil
import subprocess
import time
from pathlib import Path

import pytest

from broken import impact, unlike
from ranks import LAUNCHER, PATIENT
from runs import ROOT, SOLVER, run_deck

RECIPES = ROOT / "decks" / "hpc"
STOPPED, OUTPUT = 4, 5
# long enough that a run takes many clock ticks on a fast machine
END = 2.0e-4
# long enough that no run comes to its end before it is stopped
ENDLESS = 1.0


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An installed tree, moved after the installation."""
    first = tmp_path_factory.mktemp("first") / "tree"
    command = ["cmake", "--install", SOLVER.parent, "--prefix", first]
    subprocess.run(command, check=True, capture_output=True)
    moved = tmp_path_factory.mktemp("moved") / "plydyn"
    shutil.move(first, moved)
    return moved


def environment(tree: Path, **more: str) -> dict[str, str]:
    """What the module file of the tree makes of the environment."""
    module = next((tree / "share" / "modulefiles" / "plydyn").iterdir())
    script = f"""
        proc module-whatis {{words}} {{}}
        proc conflict {{name}} {{}}
        proc setenv {{name value}} {{ puts "$name=$value" }}
        proc prepend-path {{name value}} {{ puts "$name=$value:$::env($name)" }}
        set ModulesCurrentModulefile {{{module}}}
        source {{{module}}}
    """
    done = subprocess.run(["tclsh"], input=script, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    changed = dict(line.split("=", 1) for line in done.stdout.splitlines())
    return {**os.environ, **changed, **more}


def test_module_file_leads_to_the_tree(tree: Path) -> None:
    """The program is found by its name, says its version, and the manual lies beside it."""
    found = environment(tree)
    assert found["PLYDYN_ROOT"] == str(tree)
    said = subprocess.run(["plydyn", "--version"], env=found, capture_output=True, text=True)
    assert said.stdout.startswith(f"plydyn {next(tree.glob('share/modulefiles/plydyn/*')).name}")
    for path in ("doc/plydyn/manual/running.md", "doc/plydyn/LICENSE", "plydyn/hpc/job.slurm"):
        assert (tree / "share" / path).is_file()


def test_pages_lead_to_pages_of_the_tree(tree: Path) -> None:
    """No link of an installed page leaves the tree."""
    root = tree / "share" / "doc" / "plydyn"
    pages = list(root.rglob("*.md"))
    assert root / "manual" / "theory.md" in pages
    for page in pages:
        links = re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", page.read_text())
        here = [link for link in links if not link.startswith("http")]
        assert [link for link in here if not (page.parent / link).is_file()] == [], page


def fake_slurm(folder: Path) -> Path:
    """Commands of SLURM: srun sends the signal of the limit, scontrol notes what it is told.

    The limit counts clock ticks of the processor, whatever else the machine does.
    """
    folder.mkdir()
    scripts = {
        "module": "exit 0",
        "srun": """while [[ $1 == --* ]]; do shift; done
"$@" &
run=$!
trap 'kill -TERM $run' TERM
while kill -0 $run 2>/dev/null; do
  read -ra used </proc/$run/stat && ((used[13] > LIMIT)) && kill -USR1 $run && break
  sleep 0.01
done
wait $run""",
        "scontrol": 'echo "$@" >>"$NOTES"',
    }
    for name, text in scripts.items():
        path = folder / name
        path.write_text(f"#!/usr/bin/env bash\n{text}\n")
        path.chmod(0o755)
    return folder


@pytest.mark.parametrize("script", ["job.slurm", "array.slurm"])
def test_job_comes_back_until_it_is_done(script: str, tree: Path, tmp_path: Path) -> None:
    """A run that needs several time limits ends as one that has all the time."""
    text = impact(1, "cohesive", END).text().replace("-8000.0", "-&velocity")
    text = text.replace("*KEYWORD\n", "*KEYWORD\n*PARAMETER\nR velocity,8000.0\n", 1)
    deck = tmp_path / "plate.k"
    deck.write_text(text)
    slurm = fake_slurm(tmp_path / "slurm")
    array = script == "array.slurm"
    job = "plate_velocity_3000" if array else "plate"
    whole = tmp_path / "whole"
    whole.mkdir()
    before = os.times().children_user
    if array:
        deck_of_task = tmp_path / "task.k"
        deck_of_task.write_text(text.replace("velocity,8000.0", "velocity,3000.0"))
        run_deck(deck_of_task, whole, job)
    else:
        run_deck(deck, whole, job)
    limit = int(0.4 * (os.times().children_user - before) * os.sysconf("SC_CLK_TCK"))
    slurm_says = {"SLURM_JOB_ID": "7", "SLURM_ARRAY_TASK_ID": "2"}
    found = environment(tree, LIMIT=str(limit), NOTES=str(tmp_path / "notes"), **slurm_says)
    found["PATH"] = f"{slurm}:{found['PATH']}"
    command = ["bash", tree / "share" / "plydyn" / "hpc" / script, deck]
    starts = 0
    while True:
        done = subprocess.run(command, env=found, cwd=tmp_path, capture_output=True, text=True)
        starts += 1
        if done.returncode == 0:
            break
        assert done.returncode == STOPPED, done.stdout + done.stderr
        assert (tmp_path / "notes").read_text().splitlines() == ["requeue 7"] * starts
    assert starts > 1
    assert unlike(whole, tmp_path / "results" / job) == []


def begin(command: list[str | Path], found: dict[str, str], listing: Path) -> subprocess.Popen:
    """Start a run, and wait until its loop has made some steps."""
    size = listing.stat().st_size if listing.exists() else 0
    run = subprocess.Popen(command, env=found, stdout=subprocess.DEVNULL)
    while not listing.exists() or listing.stat().st_size <= size:
        assert run.poll() is None
        time.sleep(0.02)
    time.sleep(0.2)
    return run


def test_who_stops_a_job_keeps_it_out_of_the_queue(tree: Path, tmp_path: Path) -> None:
    """Who stops a job by JOB.ctl or by scancel (SIGTERM) wants it to stay stopped."""
    deck = impact(1, end=1.0e-3).write(tmp_path / "plate.k")
    slurm = fake_slurm(tmp_path / "slurm")
    found = environment(tree, LIMIT="60000", NOTES=str(tmp_path / "notes"), SLURM_JOB_ID="7")
    found["PATH"] = f"{slurm}:{found['PATH']}"
    listing = tmp_path / "results" / "plate.out"
    for by_signal in (False, True):
        run = begin(["plydyn-batch", deck, "plate", listing.parent], found, listing)
        if by_signal:
            run.terminate()
        else:
            (tmp_path / "results" / "plate.ctl").write_text("stop\n")
        assert run.wait() == STOPPED
    assert not (tmp_path / "notes").exists()
    assert "stopped by SIGTERM" in listing.read_text()


def two_ranks(tree: Path) -> dict[str, str]:
    """The environment in which batch scripts start two ranks by mpirun."""
    return environment(tree, PLYDYN_LAUNCHER=" ".join([*LAUNCHER, "2"]), **PATIENT)


def test_ranks_of_another_launcher_hold_their_job(tree: Path, tmp_path: Path) -> None:
    """A second start is refused while the first runs, which mpirun then lets end in peace.

    mpirun kills its ranks a second after SIGTERM: they are sent another signal.
    """
    deck = impact(1, "cohesive", ENDLESS).write(tmp_path / "plate.k")
    listing = tmp_path / "results" / "plate.out"
    command = ["plydyn-batch", deck, "plate", listing.parent]
    run = begin(command, two_ranks(tree), listing)
    again = subprocess.run(command, env=two_ranks(tree), capture_output=True, text=True)
    assert again.returncode == OUTPUT
    assert f"another run of job {listing.parent}/plate is active: process" in again.stderr
    run.terminate()
    assert run.wait() == STOPPED
    assert "stopped by SIGUSR1" in listing.read_text()


def test_ranks_of_another_launcher_stop_and_go_on(tree: Path, tmp_path: Path) -> None:
    """A run that was stopped and goes on ends as one that has all the time."""
    deck = impact(1, "cohesive", END).write(tmp_path / "plate.k")
    listing = tmp_path / "results" / "plate.out"
    command = ["plydyn-batch", deck, "plate", listing.parent]
    run = begin(command, two_ranks(tree), listing)
    run.terminate()
    assert run.wait() == STOPPED
    again = subprocess.run(command, env=two_ranks(tree), stdout=subprocess.DEVNULL)
    assert again.returncode == 0
    whole = tmp_path / "whole"
    whole.mkdir()
    run_deck(deck, whole, "plate")
    assert unlike(whole, listing.parent) == []


def test_deck_that_was_changed_is_told(tree: Path, tmp_path: Path) -> None:
    """A job goes on with the deck that it began with, and says so where there is a newer one."""
    deck = impact(1, end=1.0e-4).write(tmp_path / "plate.k")
    found = environment(tree)
    words = ["run", deck, "-j", "plate", "-o", tmp_path, "--wall-time", "0.01"]
    assert subprocess.run(["plydyn", *words], env=found, capture_output=True).returncode == STOPPED
    command = ["plydyn-batch", deck, "plate", tmp_path]
    for newer in (False, True):
        stamp = (tmp_path / "plate.dump01").stat().st_mtime + (10.0 if newer else -10.0)
        os.utime(deck, (stamp, stamp))
        done = subprocess.run(command, env=found, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        assert ("remove the restart files of plate" in done.stderr) == newer


def test_recipes_can_be_read() -> None:
    """The grammar is Python's for Spack and EasyBuild; one script makes the containers."""
    (easybuild,) = RECIPES.glob("plydyn-*.eb")
    packages = sorted((RECIPES / "spack" / "packages").glob("*/package.py"))
    assert [path.parent.name for path in packages] == ["plydyn", "py-plydyn-post", "py-plydyn-pre"]
    for path in packages:
        ast.parse(path.read_text())
    nodes = [
        node for node in ast.walk(ast.parse(easybuild.read_text())) if isinstance(node, ast.Name)
    ]
    assert {node.id for node in nodes if isinstance(node.ctx, ast.Load)} == {"SOURCE_TAR_GZ"}
    definition = (RECIPES / "plydyn.def").read_text()
    sections = set(re.findall(r"^%(\w+)", definition, re.MULTILINE))
    assert sections == {"files", "post", "runscript", "test", "labels", "help"}
    for text in (definition, (RECIPES / "Containerfile").read_text()):
        for stage in ("build", "install"):
            assert f"bash /plydyn/decks/hpc/container.sh {stage}" in text
