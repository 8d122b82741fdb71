"""A run on several ranks is stopped, or loses one of them, and goes on to the same bits."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from pathlib import Path

import h5py
import pytest

from broken import impact, said, unlike
from decks import Deck, Ply
from elasticity import CARBON
from failing_disk import failing_disk, launch_failing, watched_writes
from meshes import regular
from ranks import PATIENT, command, launch
from small_disk import enlarge, small_disk

__all__ = ["failing_disk", "small_disk"]

NORMAL, STOPPED, OUTPUT = 0, 4, 5
END = 1.0e-4
SECONDS = 60.0


def start(folder: Path, ranks: int) -> subprocess.Popen[str]:
    """Start a long run in a folder, and wait until it has a restart file."""
    folder.mkdir()
    deck = impact(1, end=END)
    deck.add("DATABASE_BINARY_RUNRSF", (20,))
    words = command(ranks, ["run", deck.write(folder / "job.k"), "-o", folder])
    pipe = subprocess.PIPE
    environment = {**os.environ, **PATIENT, "OMP_NUM_THREADS": "1"}
    run = subprocess.Popen(words, stdout=pipe, stderr=subprocess.STDOUT, text=True, env=environment)
    while not (folder / "job.runrsf").exists():
        assert run.poll() is None, run.communicate()[0]
        time.sleep(0.01)
    return run


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The run in one piece, on one rank."""
    folder = tmp_path_factory.mktemp("runs") / "whole"
    run = start(folder, 1)
    text = run.communicate()[0]
    assert run.returncode == NORMAL, text
    return folder


def ranks_of(run: subprocess.Popen[str]) -> list[int]:
    """Processes that the launcher has started."""
    told = subprocess.run(
        ["pgrep", "-P", str(run.pid), "plydyn"], capture_output=True, text=True, check=False
    )
    return [int(word) for word in told.stdout.split()]


def goes_on(folder: Path, dump: Path, whole: Path) -> None:
    """The run ends as the run in one piece, on one rank."""
    code, text = said("restart", dump)
    assert code == NORMAL, text
    assert unlike(whole, folder) == []


@pytest.mark.parametrize("rank", [0, 1])
def test_rank_dies(rank: int, whole: Path, tmp_path: Path) -> None:
    """The job ends with a message within seconds, and its last restart file is good."""
    run = start(tmp_path / "broken", 2)
    processes = ranks_of(run)
    assert len(processes) == 2
    began = time.monotonic()
    os.kill(processes[rank], signal.SIGKILL)
    text = run.communicate(timeout=SECONDS)[0]
    assert time.monotonic() - began < SECONDS
    assert run.returncode != NORMAL
    assert "signal 9" in text
    goes_on(tmp_path / "broken", tmp_path / "broken" / "job.runrsf", whole)


def test_killed_ranks_leave_all_states_of_fields(whole: Path, tmp_path: Path) -> None:
    """What was counted is whole, as in the run in one piece."""
    run = start(tmp_path / "broken", 3)
    for rank in ranks_of(run):
        os.kill(rank, signal.SIGKILL)
    run.communicate(timeout=SECONDS)
    with (
        h5py.File(whole / "job.vtkhdf") as alone,
        h5py.File(tmp_path / "broken" / "job.vtkhdf") as file,
    ):
        states = int(file["VTKHDF/Steps"].attrs["NSteps"])
        assert states > 0
        for name, field in file["VTKHDF/PointData"].items():
            rows = states * int(file["VTKHDF/NumberOfPoints"][0])
            assert (field[:rows] == alone["VTKHDF/PointData"][name][:rows]).all()


@pytest.mark.parametrize("ranks", [2, 3])
def test_disk_is_full(ranks: int, small_disk: Path, tmp_path: Path) -> None:
    """All ranks end with one message, none waits for another; with more room the run goes on."""
    deck = impact(1, "cohesive", end=6.0e-5)
    deck.add("DATABASE_BINARY_RUNRSF", (20,))
    path = deck.write(tmp_path / "job.k")
    (tmp_path / "whole").mkdir()
    code, text = said("run", path, "-o", tmp_path / "whole")
    assert code == NORMAL, text
    done = launch(ranks, "run", path, "-o", small_disk, seconds=SECONDS)
    assert done.returncode == OUTPUT, done.stdout + done.stderr
    assert done.stderr.count("disk must have room") == 1
    enlarge(small_disk)
    done = launch(ranks, "restart", small_disk / "job.runrsf")
    assert done.returncode == NORMAL, done.stdout + done.stderr
    assert unlike(tmp_path / "whole", small_disk) == []


@pytest.mark.parametrize("rank", [0, 1])
def test_signal_to_one_rank_stops_all(rank: int, whole: Path, tmp_path: Path) -> None:
    """Batch systems may tell one process only: all ranks leave with a restart file."""
    folder = tmp_path / "broken"
    run = start(folder, 2)
    os.kill(ranks_of(run)[rank], signal.SIGUSR1)
    text = run.communicate(timeout=SECONDS)[0]
    assert run.returncode == STOPPED, text
    assert "stopped by" in text
    goes_on(folder, folder / "job.dump01", whole)


def test_words_steer_all_ranks(whole: Path, tmp_path: Path) -> None:
    """A file of requests stops a run of several ranks; nonsense in it stops nothing."""
    folder = tmp_path / "broken"
    run = start(folder, 2)
    (folder / "job.ctl").write_text("please hurry\nplot\nstatus\nflush\n")
    while not (folder / "job.ctl.read").exists():
        assert run.poll() is None, run.communicate()[0]
        time.sleep(0.01)
    (folder / "job.ctl").write_text("stop")
    text = run.communicate(timeout=SECONDS)[0]
    assert run.returncode == STOPPED, text
    assert "not understood" in text
    code, text = said("restart", folder / "job.dump01")
    assert code == NORMAL, text


@pytest.mark.parametrize("name", ["job.vtkhdf.part", "job.vtkhdf", "job.runrsf.part"])
def test_disk_fails_for_the_root(name: str, failing_disk: Path, tmp_path: Path) -> None:
    """Whichever write of a file fails, all ranks end with one message.

    Six writes, from the first to the last; the root alone writes.
    """
    deck = Deck("strip", 1.0, end_cycle=4)
    deck.control()
    mesh = regular(16.0, 4.0, 16, 4, 4)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.25, angle) for angle in (0.0, 90.0)], 1)
    deck.hold(mesh.where(x=0.0), "xyz")
    deck.intervals(binary_d3plot=1.0e-8)
    deck.add("DATABASE_BINARY_RUNRSF", (2,))
    path = deck.write(tmp_path / "job.k")
    words = ("run", path, "-o", tmp_path)
    done = launch_failing(failing_disk, (0, name, 0), 2, *words, seconds=2 * SECONDS)
    assert done.returncode == NORMAL, done.stdout + done.stderr
    writes = watched_writes(done)
    for first in {1 + k * (writes - 1) // 5 for k in range(6)}:
        done = launch_failing(failing_disk, (0, name, first), 2, *words, seconds=2 * SECONDS)
        assert done.returncode == OUTPUT, f"write {first} of {writes}: {done.stdout + done.stderr}"
        told = [line for line in done.stderr.splitlines() if "cannot " in line]
        assert len(told) == 1, told
        assert not (tmp_path / "job.runrsf.part").exists()
