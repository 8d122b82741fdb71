"""Run the solver on a deck and read what it wrote."""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import h5py
import numpy as np

from decks import Deck
from elasticity import Array

ROOT = Path(__file__).resolve().parents[2]
SOLVER = Path(os.environ.get("PLYDYN", ROOT / "build" / "release" / "plydyn"))

# Histories have ten significant digits: a number is known to half of the last one at best
DIGITS = 1.0e-9
_SHARED = tempfile.TemporaryDirectory(prefix="plydyn-runs-")


@dataclass(frozen=True)
class Table:
    """A CSV file: columns by the words of their headers, units left out."""

    names: list[str]
    values: Array  # (rows, columns)

    def __getitem__(self, name: str) -> Array:
        """Column of a name."""
        if name not in self.names:
            raise KeyError(f"no column {name!r} among {', '.join(self.names)}")
        return self.values[:, self.names.index(name)]

    def has(self, name: str) -> bool:
        """Whether there is a column of this name."""
        return name in self.names


@dataclass(frozen=True)
class Results:
    """The files of one job."""

    folder: Path
    job: str

    def table(self, name: str) -> Table:
        """Table of a history such as "energy" or "impactor_1"."""
        path = self.folder / f"{self.job}.{name}.csv"
        with path.open() as file:
            names = [head.split("[")[0].strip() for head in file.readline().split(",")]
            values = np.loadtxt(file, delimiter=",", ndmin=2)
        return Table(names, values)

    def profile(self, number: int) -> Table:
        """The last profile through the thickness at a place."""
        table = self.table(f"profile_{number}")
        return Table(table.names, table.values[table["time"] == table["time"][-1]])

    def interface_field(self, name: str) -> Array:
        """A point field of the interfaces at the last state, (points, components)."""
        return self.field(name, "interfaces.vtkhdf")

    def field(self, name: str, grid_file: str = "vtkhdf") -> Array:
        """A point field of the last state, (points, components)."""
        with h5py.File(self.folder / f"{self.job}.{grid_file}") as file:
            grid = file["VTKHDF"]
            points = int(grid["NumberOfPoints"][-1])
            return np.array(grid["PointData"][name][-points:])

    def points(self, grid_file: str = "vtkhdf") -> Array:
        """Places of the points of fields, (points, 3)."""
        with h5py.File(self.folder / f"{self.job}.{grid_file}") as file:
            grid = file["VTKHDF"]
            return np.array(grid["Points"][-int(grid["NumberOfPoints"][-1]) :])

    def interface_points(self) -> Array:
        """Places of the points of the interfaces, (points, 3)."""
        return self.points("interfaces.vtkhdf")

    def listing(self) -> str:
        """The listing."""
        return (self.folder / f"{self.job}.out").read_text()


def run(deck: Deck, folder: Path, job: str = "job") -> Results:
    """Write a deck into a folder and run it there."""
    folder.mkdir(parents=True, exist_ok=True)
    return run_deck(deck.write(folder / f"{job}.k"), folder, job)


def run_once(deck: Deck) -> Results:
    """The results of a deck, which runs once for all tests of a process: leave them as they are."""
    return _run_text(deck.text())


@cache
def _run_text(text: str) -> Results:
    folder = Path(tempfile.mkdtemp(dir=_SHARED.name))
    path = folder / "job.k"
    path.write_text(text)
    return run_deck(path, folder, "job")


def run_deck(path: Path, folder: Path, job: str) -> Results:
    """Run a deck, with its results in a folder, and expect it to end well."""
    return _ended_well([SOLVER, "run", path, "-j", job, "-o", folder], path, Results(folder, job))


def run_stage(before: Results, body: str, job: str) -> Results:
    """Go on from the last restart file of a run with the keywords of a stage, as another job."""
    path = before.folder / f"{job}.k"
    path.write_text(f"*KEYWORD\n*CONTROL_STAGE\n1\n{body}*END\n")
    dump = sorted(before.folder.glob(f"{before.job}.dump??"))[-1]
    command = [SOLVER, "restart", dump, path, "-j", before.folder / job]
    return _ended_well(command, path, Results(before.folder, job))


def _ended_well(command: Sequence[str | Path], deck: Path, results: Results) -> Results:
    """The results of a command that has to end well."""
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    if ended.returncode != 0:
        said = (ended.stdout + ended.stderr)[-3000:]
        raise AssertionError(f"{deck} ended with code {ended.returncode}:\n{said}")
    return results
