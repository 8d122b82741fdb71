"""One run at a time writes the results of a job; the second one ends and touches nothing."""

from __future__ import annotations

import os
import platform
import re
import shutil
import signal
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from broken import impact, said, unlike
from ranks import PATIENT, command
from runs import SOLVER

NORMAL, OUTPUT = 0, 5
END = 1.0e-5
SOURCE = Path(__file__).parents[1] / "support" / "no_locks.c"
# larger than the kernel gives to any process
NO_PROCESS = 2**30


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    """A short impact with a restart file now and then."""
    deck = impact(1, "cohesive", end=END)
    deck.add("DATABASE_BINARY_RUNRSF", (10,))
    return deck.write(tmp_path / "job.k")


@pytest.fixture
def without_locks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Runs whose file system knows no locks."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("this machine has no compiler of C")
    library = tmp_path / "no_locks.so"
    subprocess.run([compiler, "-O1", "-shared", "-fPIC", "-o", library, SOURCE], check=True)
    monkeypatch.setenv("LD_PRELOAD", str(library))


@contextmanager
def held_still(folder: Path, *words: object, ranks: int = 1) -> Iterator[subprocess.Popen[bytes]]:
    """A run that has written a restart file and waits while the caller looks; then it ends."""
    call = [str(word) for word in words]
    run = subprocess.Popen(
        [SOLVER, *call] if ranks == 1 else command(ranks, call),
        env={**os.environ, **PATIENT},
        stdout=subprocess.DEVNULL,
    )
    while not (folder / "job.runrsf").exists():
        assert run.poll() is None
        time.sleep(0.001)
    holder = int((folder / "job.lock").read_text().split()[1])
    os.kill(holder, signal.SIGSTOP)
    yield run
    os.kill(holder, signal.SIGCONT)
    assert run.wait() == NORMAL


def contents(folder: Path) -> dict[str, tuple[int, bytes]]:
    """Time and bytes of all files."""
    return {path.name: (path.stat().st_mtime_ns, path.read_bytes()) for path in folder.iterdir()}


@pytest.mark.parametrize("ranks", [1, 2])
def test_second_run_is_refused(deck: Path, tmp_path: Path, ranks: int) -> None:
    """Run, restart and run on ranks: each ends with 5, says who holds the job, and leaves it."""
    folder, whole = tmp_path / "folder", tmp_path / "whole"
    assert said("run", deck, "-o", whole)[0] == NORMAL
    with held_still(folder, "run", deck, "-o", folder, ranks=ranks):
        before = contents(folder)
        holder = before["job.lock"][1].decode().strip()
        assert re.fullmatch(rf"process \d+ on {platform.node()} since [-\d]+ [:\d]+", holder)
        for words in (["run", deck, "-o", folder], ["restart", folder / "job.runrsf"]):
            code, text = said(*words)
            assert code == OUTPUT, text
            assert f"another run of job {folder}/job is active: {holder}" in text
        done = subprocess.run(
            command(2, ["run", str(deck), "-o", str(folder)]),
            env={**os.environ, **PATIENT},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == OUTPUT
        assert holder in done.stderr
        assert contents(folder) == before
        # another job in the same folder is another job
        assert said("run", deck, "-o", folder, "-j", "other")[0] == NORMAL
    for other in folder.glob("other.*"):
        assert other.suffix != ".lock"
        other.unlink()
    assert unlike(whole, folder) == []
    assert not (folder / "job.lock").exists()


def test_killed_run_leaves_no_lock(deck: Path, tmp_path: Path) -> None:
    """The lock ends with the process; its file does not stop the next run."""
    folder = tmp_path / "folder"
    run = subprocess.Popen([SOLVER, "run", deck, "-o", folder], stdout=subprocess.DEVNULL)
    while not (folder / "job.runrsf").exists():
        time.sleep(0.001)
    run.kill()
    run.wait()
    assert (folder / "job.lock").exists()
    code, text = said("restart", folder / "job.runrsf")
    assert code == NORMAL, text
    assert not (folder / "job.lock").exists()


def test_failed_run_gives_its_lock_back(deck: Path, tmp_path: Path) -> None:
    """Also where the run is refused after it has taken it."""
    folder = tmp_path / "folder"
    assert said("run", deck, "-o", folder)[0] == NORMAL
    (folder / "job.energy.csv").unlink()
    assert said("restart", folder / "job.runrsf")[0] != NORMAL
    assert not (folder / "job.lock").exists()


@pytest.mark.parametrize(
    "line", ["process 17 on elsewhere since 2020-01-01 00:00:00\n", "\0\1x", ""]
)
def test_line_of_another_host_holds_nothing(deck: Path, tmp_path: Path, line: str) -> None:
    """With locks it is the lock that counts: a job comes back on another host after a crash."""
    (tmp_path / "job.lock").write_text(line)
    code, text = said("run", deck, "-o", tmp_path)
    assert code == NORMAL, text
    assert "lock" not in text


def test_lock_is_written_through_no_link(deck: Path, tmp_path: Path) -> None:
    """What a link of that name leads to is not written."""
    precious, folder = tmp_path / "precious", tmp_path / "folder"
    precious.write_text("precious\n")
    folder.mkdir()
    (folder / "job.lock").symlink_to(precious)
    assert said("run", deck, "-o", folder)[0] == NORMAL
    assert precious.read_text() == "precious\n"


def test_without_locks_a_live_process_holds_the_job(
    deck: Path, tmp_path: Path, without_locks: None
) -> None:
    """On one host the line in the file says who is there."""
    folder = tmp_path / "folder"
    with held_still(folder, "run", deck, "-o", folder):
        before = contents(folder)
        code, text = said("run", deck, "-o", folder)
        assert code == OUTPUT, text
        assert "is active: process" in text
        assert contents(folder) == before


@pytest.mark.parametrize(
    ("holder", "named"),
    [
        ("", False),
        (f"process {NO_PROCESS} on {platform.node()} since 2020-01-01 00:00:00\n", True),
        ("process 1 on elsewhere since 2020-01-01 00:00:00\n", True),
    ],
)
def test_without_locks_the_run_says_so(
    deck: Path, tmp_path: Path, without_locks: None, holder: str, named: bool
) -> None:
    """A process that has gone, or that of another host, stops no run; the listing names it."""
    folder = tmp_path / "folder"
    folder.mkdir()
    (folder / "job.lock").write_text(holder)
    code, text = said("run", deck, "-o", folder)
    assert code == NORMAL, text
    for place in (text, (folder / "job.out").read_text()):
        assert "file system without locks" in place
        assert (holder.strip() in place and "has not ended as it should" in place) == named
