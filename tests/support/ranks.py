"""Start the solver on several ranks."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from runs import SOLVER

# as many ranks as a test wants, whatever the machine has, and by whoever runs it
LAUNCHER = ["mpirun", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none", "-n"]
# what starts a rank and tells its number and its peak at its end; one write, so that lines of ranks
# do not mix
WATCH = """
import os, subprocess, sys
done = subprocess.Popen(sys.argv[1:], stdout=subprocess.DEVNULL)
_, status, usage = os.wait4(done.pid, 0)
rank = os.environ.get("OMPI_COMM_WORLD_RANK", "0")
sys.stderr.write(f"memory {rank} {usage.ru_maxrss * 1.024e-3:.1f}\\n")
sys.exit(os.waitstatus_to_exitcode(status))
"""
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


def peaks(ranks: int, *words: str | Path) -> list[float]:
    """Most memory that each rank ever had in a run that ends well, MB, the root's first."""
    watch = [sys.executable, "-c", WATCH]
    line = command(ranks, list(words))
    place = line.index(str(SOLVER))
    environment = {**os.environ, **PATIENT, "OMP_NUM_THREADS": "1"}
    done = subprocess.run(
        [*line[:place], *watch, *line[place:]],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    told = [line.split()[1:] for line in done.stderr.splitlines() if line.startswith("memory ")]
    return [float(megabytes) for _, megabytes in sorted(told, key=lambda pair: int(pair[0]))]


def results(folder: Path) -> dict[str, bytes]:
    """Every file of a job but for the listing, which tells times and ranks."""
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix != ".out"}
