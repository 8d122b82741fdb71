"""The solver on mutants: bounds of a run, and what may come of it."""

from __future__ import annotations

import os
import resource
import subprocess
from pathlib import Path

import h5py
import numpy as np

from runs import SOLVER

NORMAL, USAGE, INPUT, RUN, STOPPED, OUTPUT = range(6)
# words of the run-time libraries, none of which is to be seen
CRASHES = ("Backtrace", "Fortran runtime error", "SIGSEGV", "Operating system error", "MPI_ABORT")
SECONDS, BYTES = 20.0, 4_000_000_000


def bound() -> None:
    """Limits of the child: memory and files of results."""
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    resource.setrlimit(resource.RLIMIT_FSIZE, (200_000_000, 200_000_000))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(folder: Path, *words: object) -> subprocess.CompletedProcess[bytes]:
    """The solver on some words, within bounds of time and memory."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_MCA_btl": "self"}
    return subprocess.run(
        [SOLVER, *map(str, words)],
        cwd=folder,
        capture_output=True,
        timeout=SECONDS,
        check=False,
        preexec_fn=bound,
        env=environment,
    )


def check(done: subprocess.CompletedProcess[bytes], codes: set[int], what: str) -> None:
    """An exit code that is documented, and words."""
    said = (done.stdout + done.stderr).decode("utf-8", "replace")
    assert done.returncode in codes, f"{what}: {done.returncode}\n{said[-3000:]}"
    assert not any(crash in said for crash in CRASHES), f"{what}\n{said[-3000:]}"
    assert done.returncode == NORMAL or done.stderr.strip(), f"{what}: no words"
    assert len(said) < 400_000, f"{what}: {len(said)} characters"
    assert "\x1b" not in said, f"{what}: steers the terminal"


def check_finite(folder: Path, job: str, what: str) -> None:
    """No number of a run that ended well or was stopped is infinite or missing in its results."""
    for path in folder.glob(f"{job}.*csv"):
        values = np.genfromtxt(path, delimiter=",", skip_header=1)
        assert np.all(np.isfinite(values)), f"{what}: {path.name} is not finite"
    for path in folder.glob(f"{job}*.vtkhdf"):
        with h5py.File(path) as file:
            for name, values in file["VTKHDF/PointData"].items():
                assert np.all(np.isfinite(values[()])), f"{what}: {name} of {path.name}"
