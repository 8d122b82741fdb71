"""A run is stopped and steered from outside, and goes on to the same bits."""

from __future__ import annotations

import re
import signal
import subprocess
import time
from pathlib import Path

import pytest

from broken import impact, said, unlike
from runs import SOLVER

NORMAL, STOPPED = 0, 4
END = 2.5e-4  # long enough to be caught in the midst of it


def start(folder: Path, *words: object, hangs_up: str = "default") -> subprocess.Popen[str]:
    """Start a long run in a folder, and wait until it is in its loop.

    What a closed terminal means to it does not depend on how the test was started.
    """
    folder.mkdir(exist_ok=True)
    deck = impact(1, end=END).write(folder / "job.k")
    command = ["env", f"--{hangs_up}-signal=HUP", SOLVER, "run", deck, "-o", folder, *words]
    run = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    energy = folder / "job.energy.csv"
    while not energy.exists() or energy.stat().st_size < 1000:
        assert run.poll() is None, run.communicate()[0]
        time.sleep(0.01)
    return run


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The run in one piece."""
    folder = tmp_path_factory.mktemp("whole")
    run = start(folder)
    text = run.communicate()[0]
    assert run.returncode == NORMAL, text
    return folder


def goes_on(run: subprocess.Popen[str], folder: Path, whole: Path, by: str) -> str:
    """The run has stopped with a restart file that ends as the run in one piece; what it said."""
    said_before = run.communicate()[0]
    assert run.returncode == STOPPED, said_before
    dump = sorted(folder.glob("job.dump??"))[-1]
    for place in (said_before, (folder / "job.out").read_text()):
        assert f"stopped by {by}" in place
        assert f"continue with: plydyn restart {dump}" in place
    code, text = said("restart", dump)
    assert code == NORMAL, text
    assert unlike(whole, folder) == []
    return said_before


@pytest.mark.parametrize("name", ["SIGTERM", "SIGUSR1", "SIGUSR2", "SIGHUP"])
def test_signal_stops_the_run(name: str, whole: Path, tmp_path: Path) -> None:
    """Signals of batch systems, and that of a closed terminal, leave a restart file."""
    run = start(tmp_path / "broken")
    run.send_signal(getattr(signal, name))
    goes_on(run, tmp_path / "broken", whole, name)


def test_run_under_nohup_goes_on(whole: Path, tmp_path: Path) -> None:
    """A closed terminal means nothing to a run that was started so that it does not."""
    run = start(tmp_path / "ignored", hangs_up="ignore")
    run.send_signal(signal.SIGHUP)
    text = run.communicate()[0]
    assert run.returncode == NORMAL, text
    assert unlike(whole, tmp_path / "ignored") == []


def test_wall_time_stops_the_run(whole: Path, tmp_path: Path) -> None:
    """A limit below what the run takes leaves a restart file."""
    run = start(tmp_path / "broken", "--wall-time", "0:00.1")
    goes_on(run, tmp_path / "broken", whole, "the wall-clock limit of 0.1 s")


def test_words_steer_the_run(whole: Path, tmp_path: Path) -> None:
    """Nonsense is told and ignored, a restart file is written, and then the run is stopped.

    The line of progress is that of the step of the restart file.
    """
    folder = tmp_path / "broken"
    run = start(folder)
    words = folder / "job.ctl"
    words.write_text("please hurry\ndump\nflush\nstatus\nend-time 0\n\x07\n")
    wait_for(run, folder / "job.ctl.read")
    wait_for(run, folder / "job.dump01")
    assert not words.exists()
    words.write_text("stop")
    text = goes_on(run, folder, whole, str(words))
    cycle = re.search(r"job\.dump01 at cycle (\d+)", text)
    assert cycle and re.search(rf"(?m)^ *{cycle[1]} .*%", text), text
    assert len(list(folder.glob("job.dump??"))) == 2
    listing = (folder / "job.out").read_text()
    assert "'please hurry' not understood and ignored; right would be stop, dump" in listing
    assert "'dump' taken" in listing
    assert "all results are on the disk" in listing
    assert "'end-time 0' ignored: the run is at time" in listing
    assert "'?' not understood" in listing


def test_word_moves_the_end(tmp_path: Path) -> None:
    """The run ends when it is told to, well."""
    folder = tmp_path / "job"
    run = start(folder)
    (folder / "job.ctl").write_text("end-time = 2.0e-4\nplot\n")
    text = run.communicate()[0]
    assert run.returncode == NORMAL, text
    assert (folder / "job.energy.csv").read_text().splitlines()[-1].split(",")[1] == (
        "2.000000000E-04"
    )


def wait_for(run: subprocess.Popen[str], path: Path) -> None:
    """Wait until a running job has made a file."""
    while not path.exists():
        assert run.poll() is None, run.communicate()[0]
        time.sleep(0.01)
