"""Cases of a study, and the runs that are kept of them in a folder."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Generic, TypeVar

from plydyn_post.results import Results, open_results
from plydyn_pre.recipe import load_recipe
from plydyn_pre.study import Study as Model

#: Top of the checkout
ROOT = Path(__file__).resolve().parents[2]
#: A process that had less than this share of its time on the processor was disturbed
UNDISTURBED = 0.97


class StudyError(Exception):
    """Something that a study needs is missing or failed."""


@dataclass(frozen=True)
class Case:
    """A recipe with values replaced, under the name of its job.

    What ``common`` replaces, ``--set`` may replace again; what ``varied`` replaces is what makes
    this case, and stands.
    """

    name: str
    recipe: str  # folder and name below decks, without ending
    label: str = ""  # in tables and legends
    varied: tuple[str, ...] = ()
    common: tuple[str, ...] = ()
    given: tuple[str, ...] = ()  # by --set
    threads: int = 1
    stages: tuple[str, ...] = ()  # names of those of its recipe that are run, in their order

    @property
    def jobs(self) -> tuple[str, ...]:
        """The names of its jobs: the first run, and the stages that follow."""
        return (self.name, *(f"{self.name}_{stage}" for stage in self.stages))

    @property
    def path(self) -> Path:
        """The file of the recipe."""
        return ROOT / f"decks/{self.recipe}.toml"

    @property
    def overrides(self) -> tuple[str, ...]:
        """All that is replaced in the recipe; the last one counts."""
        return (*self.common, *self.given, *self.varied)

    @cached_property
    def model(self) -> Model:
        """The model that the deck is made from."""
        return load_recipe(self.path, self.overrides)


#: A kind of cases
Kind_co = TypeVar("Kind_co", bound=Case, covariant=True)


@dataclass(frozen=True)
class Spent:
    """Times of the processes of a run, one after another where it was broken off and went on."""

    wall: float  # s, from start to end
    processor: float  # s, on the processor


@dataclass(frozen=True)
class Effort(Spent):
    """What a run took."""

    loop: float  # s, of the time loop
    steps: int
    dofs: int

    @property
    def ns_per_dof_step(self) -> float:
        """Time of the loop per degree of freedom and step, ns."""
        return 1e9 * self.loop / (self.steps * self.dofs)

    @property
    def is_disturbed(self) -> bool:
        """Whether the machine was busy with something else."""
        return self.processor < UNDISTURBED * self.wall


@dataclass(frozen=True)
class RunOf(Generic[Kind_co]):
    """A case that has run, to its end or until it was asked to stop; of a chain its last stage."""

    case: Kind_co
    effort: Effort
    results: Results

    @property
    def listing(self) -> str:
        """The text of the listing of its first job, which names the build."""
        return _listing(self.results.folder, self.case).read_text(encoding="utf-8")


Run = RunOf[Case]


def read_runs(cases: Sequence[Case], folder: Path) -> list[Run]:
    """The runs of those cases that have run in a folder."""
    return [
        Run(case, effort, open_results(folder / case.jobs[-1]))
        for case in cases
        if (effort := read_effort(case, folder))
    ]


def read_effort(case: Case, folder: Path) -> Effort | None:
    """What the run of a case took, nothing if there is none that came to a good end.

    Of a chain the time of the loop is that of the last stage, and steps count from its beginning;
    the listing of the first job has the degrees of freedom.
    """
    kept, last = effort_file(case, folder), _listing(folder, case, last=True)
    if not (kept.is_file() and last.is_file()):
        return None
    if not json.loads(kept.read_text(encoding="utf-8")).get("whole", True):
        return None
    spent = read_spent(case, folder)
    return Effort(
        spent.wall,
        spent.processor,
        loop=sum(map(float, _numbers(last, r"seconds\s+(\S+) in the loop"))),
        steps=int(_numbers(last, r"cycle (\d+), time")[-1]),
        dofs=int(_numbers(_listing(folder, case), r"degrees of freedom\s+(\d+)")[0]),
    )


def read_spent(case: Case, folder: Path) -> Spent:
    """What all parts of a run took so far, also of one that was broken off."""
    kept = effort_file(case, folder)
    took = json.loads(kept.read_text(encoding="utf-8")) if kept.is_file() else {}
    return Spent(took.get("wall", 0.0), took.get("processor", 0.0))


def keep_spent(case: Case, folder: Path, spent: Spent, *, is_whole: bool) -> None:
    """Keep what the parts of a run took, and whether they came to a good end."""
    took = {"wall": spent.wall, "processor": spent.processor, "whole": is_whole}
    effort_file(case, folder).write_text(json.dumps(took), encoding="utf-8")


def _numbers(listing: Path, pattern: str) -> list[str]:
    """A number of each part of a listing: a run that was broken off and went on has several."""
    found = re.findall(pattern, listing.read_text(encoding="utf-8"))
    if not found:
        raise StudyError(f"{listing} has no line like {pattern!r}")
    return found


def effort_file(case: Case, folder: Path) -> Path:
    """Where the times of a run are kept."""
    return folder / f"{case.name}.effort"


def is_whole(case: Case, folder: Path, version: str) -> bool:
    """Whether a build has run a case to its end."""
    if read_effort(case, folder) is None or not _is_by(version, _listing(folder, case)):
        return False
    return "\nnormal end" in _listing(folder, case, last=True).read_text(encoding="utf-8")


def is_of(case: Case, folder: Path, version: str) -> bool:
    """Whether a build has begun a case, and made all that there is of it."""
    made = [listing for job in case.jobs if (listing := folder / f"{job}.out").is_file()]
    return bool(made) and all(_is_by(version, each) for each in made)


def _is_by(version: str, listing: Path) -> bool:
    """Whether a build made all parts of a listing; each names its own."""
    named = re.findall(r"^plydyn \d.*", listing.read_text(encoding="utf-8"), re.MULTILINE)
    return set(named) == {version}


def _listing(folder: Path, case: Case, *, last: bool = False) -> Path:
    """The listing of the first job of a case, or of the last one."""
    return folder / f"{case.jobs[-1 if last else 0]}.out"


def builds(runs: Sequence[Run], lines: int = 1) -> str:
    """The builds that made some runs, by the first lines of their listings."""
    return " and ".join(sorted({"; ".join(run.listing.splitlines()[:lines]) for run in runs}))


def made_by(runs: Sequence[Run]) -> str:
    """A sentence that names the builds which made some runs."""
    return f"Made by {builds(runs)}.\n"


def by_build(runs: Sequence[Run], text: Callable[[list[Run]], str]) -> str:
    """What a text says of the runs of each build by itself, and the build: a table has one."""
    groups: dict[str, list[Run]] = {}
    for run in runs:
        groups.setdefault(builds([run]), []).append(run)
    return "\n".join(f"{text(own)}\n{made_by(own)}" for own in groups.values())
