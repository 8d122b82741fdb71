"""The files of a job."""

from __future__ import annotations

import glob
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from plydyn_post.errors import ResultsError
from plydyn_post.table import Table, read_table

# What may follow the job's name in the name of a file of results
ENDINGS = re.compile(
    r"\.(((interfaces|cracks)\.)?vtkhdf|out"
    r"|(energy|nodes|constraints|supports(_\d+)?|delamination|cracks|contact|(impactor|profile|fixture)_\d+)\.csv)$",
    re.IGNORECASE,
)

# Files of a job that are no results: its deck, recipe, restart files, steering and lock
OTHERS = re.compile(r"\.(k|key|toml|runrsf|dump\d+|ctl|lock)$", re.IGNORECASE)

# Choices of the planes of symmetry about which pictures are mirrored
MIRRORS = ("auto", "x", "y", "xy", "none")


@dataclass(frozen=True)
class Results:
    """Where a job's results are; tables are read when asked for."""

    job: str
    folder: Path
    mirror: str = "auto"  # planes of symmetry of its pictures: auto, x, y, xy or none

    @property
    def fields(self) -> Path:
        """The file of fields, there or not."""
        return self.folder / f"{self.job}.vtkhdf"

    @property
    def interface_fields(self) -> Path:
        """The file of fields of the interfaces, there or not."""
        return self.folder / f"{self.job}.interfaces.vtkhdf"

    @property
    def crack_fields(self) -> Path:
        """The file of crack lines, there or not."""
        return self.folder / f"{self.job}.cracks.vtkhdf"

    @property
    def impactors(self) -> tuple[int, ...]:
        """Numbers of the impactors with a history."""
        return self._numbers("impactor")

    @property
    def profiles(self) -> tuple[int, ...]:
        """Numbers of the profiles through the thickness."""
        return self._numbers("profile")

    @property
    def fixtures(self) -> tuple[int, ...]:
        """Numbers of the fixtures with a history."""
        return self._numbers("fixture")

    def energy(self) -> Table:
        """Energies over time."""
        return self._table("energy")

    def impactor(self, number: int | None = None) -> Table:
        """History of an impactor, of the first without a number."""
        return self._table(f"impactor_{self.known('impactor', number)}")

    def fixture(self, number: int | None = None) -> Table:
        """History of a fixture, of the first without a number."""
        return self._table(f"fixture_{self.known('fixture', number)}")

    def profile(self, number: int | None = None) -> Table:
        """A profile through the thickness over time, the first without a number."""
        return self._table(f"profile_{self.known('profile', number)}")

    def delamination(self) -> Table:
        """Delaminated areas over time, and what they dissipated."""
        return self._table("delamination")

    def has(self, name: str) -> bool:
        """Whether the job has a table, such as ``delamination``."""
        return (self.folder / f"{self.job}.{name}.csv").is_file()

    @property
    def tables(self) -> tuple[str, ...]:
        """Names of the tables that are there."""
        start = len(self.job) + 1
        names = (one.name for one in self._files("*.csv") if ENDINGS.search(one.name))
        return tuple(name[start : -len(".csv")] for name in names)

    def table(self, name: str) -> Table:
        """A table by its name."""
        if name not in self.tables:
            listed = ", ".join(self.tables) or "none"
            raise ResultsError(f"{self.folder / self.job} has no table {name!r}; it has {listed}")
        return self._table(name)

    def nodes(self) -> Table:
        """Histories of nodes."""
        return self._table("nodes")

    def supports(self, number: int = 1) -> Table:
        """Forces of the supports; number 2 and up after restarts that brought other supports."""
        return self._table("supports" if number == 1 else f"supports_{number}")

    def spare(self, path: Path) -> None:
        """Refuse to write over one of the job's files, results or others."""
        files = (one for one in self._files("*") if ENDINGS.search(one.name))
        if path.resolve() in {one.resolve() for one in files}:
            raise ResultsError(f"{path} is a result of job {self.job}: -o needs another name")
        if path.exists() and OTHERS.search(path.name):
            raise ResultsError(f"{path} is a deck, recipe or restart file: -o needs another name")

    @property
    def has_ended(self) -> bool:
        """Whether the run came to its normal end; without a listing it is taken to have."""
        path = self.folder / f"{self.job}.out"
        if not path.is_file():
            return True
        return "normal end" in path.read_text(encoding="utf-8", errors="replace").splitlines()

    def notes(self) -> list[str]:
        """What was left out when the tables were read, and which cannot be read."""
        notes: list[str] = []
        for path in self._files("*.csv"):
            try:
                notes += read_table(path).notes
            except ResultsError as error:
                notes.append(str(error))
        return notes

    def _files(self, ending: str) -> list[Path]:
        return sorted(self.folder.glob(f"{glob.escape(self.job)}.{ending}"))

    def _numbers(self, kind: str) -> tuple[int, ...]:
        paths = self._files(f"{kind}_*.csv")
        endings = [path.stem.rpartition("_")[2] for path in paths]
        return tuple(sorted(int(ending) for ending in endings if ending.isdigit()))

    def known(self, kind: str, number: int | None) -> int:
        """A number of a kind that is there, the first one without a number."""
        known = self._numbers(kind)
        if not known:
            raise ResultsError(f"{self.folder / self.job}.{kind}_*.csv: there is no such file")
        if number is not None and number not in known:
            listed = ", ".join(str(one) for one in known)
            raise ResultsError(f"{self.folder / self.job} has no {kind} {number}; it has {listed}")
        return known[0] if number is None else number

    def _table(self, name: str) -> Table:
        path = self.folder / f"{self.job}.{name}.csv"
        if not path.is_file():
            raise ResultsError(f"{path}: there is no such file")
        return read_table(path)


def open_results(name: str | Path, mirror: str = "auto") -> Results:
    """Find the results of a job from its name, one of its files, or the folder of one job."""
    if mirror not in MIRRORS:
        raise ResultsError(f"--mirror cannot be {mirror!r}; right would be {', '.join(MIRRORS)}")
    path = Path(name)
    if path.is_dir():
        return replace(_only_job(path), mirror=mirror)
    results = Results(ENDINGS.sub("", path.name), path.parent, mirror)
    if not results.fields.is_file() and not results._files("*.csv"):
        raise ResultsError(
            f"{name}: no results there; expected {results.fields} or"
            f" {results.folder / results.job}.*.csv"
        )
    return results


def _only_job(folder: Path) -> Results:
    """The job whose results lie in a folder, if there is just one."""
    names = (path.name for path in folder.iterdir() if path.suffix in (".vtkhdf", ".csv", ".out"))
    jobs = sorted({ENDINGS.sub("", name) for name in names if ENDINGS.search(name)})
    if not jobs:
        raise ResultsError(f"{folder}: no results of plydyn in this folder")
    if len(jobs) > 1:
        raise ResultsError(f"{folder} holds several jobs; name one of {', '.join(jobs)}")
    return Results(jobs[0], folder)


def labelled(jobs: Sequence[Results]) -> list[tuple[str, Results]]:
    """Jobs with names that tell them apart in a legend."""
    names = [job.job for job in jobs]
    if len(set(names)) < len(names):
        names = [f"{job.folder.resolve().name}/{job.job}" for job in jobs]
    return list(zip(names, jobs, strict=True))


def notes_of_runs(jobs: Sequence[Results]) -> Iterator[str]:
    """What to know of the files of jobs, and which runs stopped on the way."""
    for label, job in labelled(jobs):
        if not job.has_ended:
            words = "the run has not come to its normal end (see the listing)"
            yield f"{label}: {words}: results are those so far"
        yield from job.notes()
