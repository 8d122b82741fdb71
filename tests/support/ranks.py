"""Start the solver on several ranks."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

from runs import SOLVER

# as many ranks as a test wants, whatever the machine has, and by whoever runs it
LAUNCHER = ["mpirun", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none", "-n"]
# ranks that wait give way to those that work
PATIENT = {"OMPI_MCA_mpi_yield_when_idle": "1", "OMP_WAIT_POLICY": "passive"}


def command(ranks: int, words: list[str | Path]) -> list[str]:
    """The command line."""
    line = [str(SOLVER), *map(str, words)]
    return line if ranks == 1 else [*LAUNCHER, str(ranks), *line]


def launch(
    ranks: int, *words: str | Path, threads: int = 1, seconds: float = 300.0
) -> subprocess.CompletedProcess[str]:
    """Run to the end on some ranks and threads."""
    environment = {**os.environ, **PATIENT, "OMP_NUM_THREADS": str(threads)}
    return subprocess.run(
        command(ranks, list(words)),
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=seconds,
    )


def results(folder: Path) -> dict[str, bytes]:
    """Every file of a job but for the listing, which tells times and ranks."""
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix != ".out"}
