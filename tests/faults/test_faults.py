"""Whatever happens to a run, nothing is lost but the time since its last restart file."""

from __future__ import annotations

import random
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

import h5py
import numpy as np
import pytest

from broken import impact, said, unlike
from decks import Deck
from restart_files import change
from runs import SOLVER
from small_disk import enlarge, small_disk

__all__ = ["small_disk"]

NORMAL, INPUT, FAILED, OUTPUT = 0, 2, 3, 5
KILLS, SEED = 20, 5
# The first runs are killed on their way to a restart file, the others after less than so many; the
# whole run writes some two hundred
EARLY, FILES = 3, 16
# About what it takes to the loop on a quiet machine, and between two looks, s
START, POLL = 0.05, 0.0005


def long_deck(cycles: int, end: float = 1.5e-4) -> Deck:
    """An impact with a restart file now and then, always the same one."""
    deck = impact(1, "cohesive", end=end)
    deck.add("DATABASE_BINARY_RUNRSF", (cycles,))
    return deck


def run_whole(deck: Path, folder: Path) -> Path:
    """A run that nothing happens to."""
    folder.mkdir()
    code, text = said("run", deck, "-o", folder)
    assert code == NORMAL, text
    return folder


def when_written(path: Path) -> int:
    """When a file was put in its place, ns; nothing while there is none."""
    return path.stat().st_mtime_ns if path.exists() else 0


def kill(run: subprocess.Popen[bytes], dump: Path, files: int, share: float) -> int:
    """Kill a run so many restart files after its start and a share of the way to the next one.

    Counting files, not seconds, a machine that has other work kills as late. Gives the exit code.
    """
    before, event, way = when_written(dump), time.perf_counter(), START
    while files > 0 and run.poll() is None:
        time.sleep(POLL)
        if (written := when_written(dump)) != before:
            before, files, now = written, files - 1, time.perf_counter()
            event, way = now, now - event
    time.sleep(share * way)
    run.send_signal(signal.SIGKILL)
    return run.wait()


def test_kill_at_any_moment(tmp_path: Path) -> None:
    """Twenty times in a row the process is killed, whatever it does, and goes on from its file.

    Before the first restart file it begins anew. A file in the making is no file.
    """
    deck = long_deck(10).write(tmp_path / "job.k")
    whole, broken = run_whole(deck, tmp_path / "whole"), tmp_path / "broken"
    broken.mkdir()
    dump = broken / "job.runrsf"
    moments = random.Random(SEED)
    killed = restarted = 0
    while killed < KILLS:
        words = ["restart", dump] if dump.exists() else ["run", deck, "-o", broken]
        run = subprocess.Popen([SOLVER, *words], stdout=subprocess.DEVNULL)
        files = moments.randrange(FILES) if killed >= EARLY else 0
        code = kill(run, dump, files, moments.random())
        assert code in (NORMAL, -signal.SIGKILL)
        killed += code != NORMAL
        restarted += words[0] == "restart"
        if code == NORMAL:
            assert unlike(whole, broken) == []
            dump.unlink()
    words = ["restart", dump] if dump.exists() else ["run", deck, "-o", broken]
    code, text = said(*words)
    assert code == NORMAL, text
    assert restarted >= KILLS // 2
    assert unlike(whole, broken) == []


def test_disk_is_full(small_disk: Path, tmp_path: Path) -> None:
    """The run ends with a message and a good restart file; with more room it goes on."""
    deck = long_deck(20, 6.0e-5).write(tmp_path / "job.k")
    whole = run_whole(deck, tmp_path / "whole")
    code, text = said("run", deck, "-o", small_disk)
    assert code == OUTPUT, text
    assert "disk must have room" in text
    assert not (small_disk / "job.runrsf.part").exists()
    enlarge(small_disk)
    code, text = said("restart", small_disk / "job.runrsf")
    assert code == NORMAL, text
    assert unlike(whole, small_disk) == []


def test_files_may_not_grow(tmp_path: Path) -> None:
    """A limit of the shell on the size of files is told like a full disk."""
    deck = long_deck(20, 6.0e-5).write(tmp_path / "job.k")
    done = subprocess.run(
        ["bash", "-c", f"ulimit -f 16; exec {SOLVER} run {deck} -o {tmp_path}"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == OUTPUT, done.stdout + done.stderr
    assert "disk must have room" in done.stdout + done.stderr


@pytest.fixture(scope="module")
def stopped(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Results with a restart file."""
    folder = tmp_path_factory.mktemp("stopped")
    return run_whole(long_deck(20, 1.0e-5).write(folder / "job.k"), folder / "job")


@pytest.mark.parametrize("share", [0.0, 0.05, 0.5, 0.95])
def test_restart_file_is_cut(share: float, stopped: Path, tmp_path: Path) -> None:
    """A file that was copied in part is refused, and the results are left alone."""
    folder = tmp_path / "job"
    shutil.copytree(stopped, folder)
    content = (stopped / "job.runrsf").read_bytes()
    (folder / "job.runrsf").write_bytes(content[: int(share * len(content))])
    code, text = said("restart", folder / "job.runrsf")
    assert code == INPUT, text
    assert "is no restart file, or not a whole one" in text
    assert unlike(stopped, folder) == []


def test_restart_file_is_of_another_model(stopped: Path, tmp_path: Path) -> None:
    """A file whose arrays are not those of its deck is refused by the name of the array."""
    folder = tmp_path / "job"
    shutil.copytree(stopped, folder)
    with h5py.File(folder / "job.runrsf", "r+") as file:
        history = file["state/history"][()]
        del file["state/history"]
        file["state/history"] = history[:-1]
    code, text = said("restart", folder / "job.runrsf")
    assert code == INPUT, text
    assert "does not hold the history of the model" in text
    assert unlike(stopped, folder) == []


@pytest.mark.parametrize("value", [np.nan, 1.0e200, 1.0e30])
def test_not_a_number_is_found(value: float, stopped: Path, tmp_path: Path) -> None:
    """A state with a number that is none, or whose square is none, ends at once and is named.

    No file gets it. What is too large for single precision alone is in no file of fields.
    """
    folder = tmp_path / "job"
    shutil.copytree(stopped, folder)
    small = tmp_path / "small.k"
    small.write_text("*KEYWORD\n*CONTROL_TERMINATION\n2.0e-5,\n*END\n")
    with h5py.File(folder / "job.runrsf") as file:
        place = int(np.argmax(np.abs(file["state/displacement"])))
    change(folder / "job.runrsf", "state/displacement", place, value)
    before = (folder / "job.runrsf").read_bytes()
    code, text = said("restart", folder / "job.runrsf", small)
    assert code == FAILED, text
    assert re.search(r"at cycle \d+, time .* along [xyz] at node \d+, ply \d from the bottom", text)
    assert ", part 1" in text
    if value != 1.0e30:
        assert "the motion is no longer finite at cycle" in text
        assert "nan" not in (folder / "job.energy.csv").read_text().lower()
        assert "infinity" not in (folder / "job.energy.csv").read_text().lower()
    assert (folder / "job.runrsf").read_bytes() == before
    with h5py.File(folder / "job.vtkhdf") as file:
        for field in file["VTKHDF/PointData"].values():
            assert np.isfinite(field[()]).all()


def test_energy_that_is_no_number_is_found(tmp_path: Path) -> None:
    """Faces that fail under nothing cost what cannot be computed: the run says so at its end."""
    deck = impact(1, "cohesive", end=1.0e-5)
    path = deck.write(tmp_path / "job.k")
    words = path.read_text().splitlines()
    card = words.index("*MAT_COHESIVE_MIXED_MODE") + 2
    words[card] = ",".join([words[card].split(",")[0], "1.0e-30", "1.0e-30"])
    path.write_text("\n".join(words) + "\n")
    code, text = said("run", path, "-o", tmp_path)
    assert code == FAILED, text
    assert "have stored or dissipated is no longer finite at cycle" in text
