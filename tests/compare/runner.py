"""Run a case with a build, each way in a folder of its own; results may be kept for later."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from cases import RANKS, RESTART, THREADS

LAUNCHER = ("mpirun", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none", "-n", "2")
SECONDS = 600


class RunError(Exception):
    """A run that did not end well."""


@dataclass(frozen=True)
class Build:
    """A solver, and where the results of its runs are."""

    solver: Path
    folder: Path
    keeps: bool = False  # results of the same deck and solver are taken as they are

    def results(self, case: str, deck: Path, way: str) -> Path:
        """The folder of results of a case, run one way; deck is the folder of its deck."""
        name = f"{case.replace('/', '.')}.{way}"
        if not self.keeps:
            return self._run(case, deck, way, self.folder / name)
        kept = self.folder / f"{name}.{_sum_of([self.solver, *sorted(deck.iterdir())])}"
        if not kept.is_dir():
            self.folder.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryDirectory(dir=self.folder) as scratch:
                made = self._run(case, deck, way, Path(scratch) / "results")
                if not kept.is_dir():
                    _move(made, kept)
        return kept

    def _run(self, case: str, deck: Path, way: str, folder: Path) -> Path:
        """Run a case one way."""
        shutil.rmtree(folder, ignore_errors=True)
        if way == RESTART:
            shutil.copytree(self.results(case, deck, THREADS), folder)
            dumps = sorted(folder.glob("job.dump??"))
            if not dumps:
                raise RunError(f"{self.solver}: there is no restart file to go on from")
            self._call(folder, ["restart", dumps[(len(dumps) - 1) // 2].name, "ncpu=2"], ())
            return folder
        shutil.copytree(deck, folder)
        threads, launcher = ("ncpu=1", LAUNCHER) if way == RANKS else ("ncpu=2", ())
        self._call(folder, ["run", "deck.k", "-j", "job", threads], launcher)
        return folder

    def _call(self, folder: Path, words: list[str], launcher: tuple[str, ...]) -> None:
        """Run the solver to its end."""
        done = subprocess.run(
            [*launcher, self.solver, *words],
            cwd=folder,
            env={
                **os.environ,
                "OMP_WAIT_POLICY": "passive",
                "OMPI_MCA_mpi_yield_when_idle": "1",
            },
            capture_output=True,
            text=True,
            check=False,
            timeout=SECONDS,
        )
        if done.returncode:
            said = (done.stdout + done.stderr).strip()[-600:]
            raise RunError(f"{self.solver} {words[0]}: exit code {done.returncode}: {said}")


def _sum_of(paths: list[Path]) -> str:
    """A short name for the contents of files."""
    total = hashlib.sha256()
    for path in paths:
        total.update(path.read_bytes())
    return total.hexdigest()[:16]


def _move(made: Path, kept: Path) -> None:
    """Give results their place, unless another comparison was first."""
    try:
        made.rename(kept)
    except OSError:
        if not kept.is_dir():
            raise
