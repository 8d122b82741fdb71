"""A recipe and its stages, run one after the other; what has ended is not run again."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn

from plydyn_pre.deck import deck_text, write_deck, write_stages
from plydyn_pre.errors import OutputError, PreError
from plydyn_pre.mesh import Mesh, make_mesh
from plydyn_pre.runs.process import follow, share_done
from plydyn_pre.runs.programs import chain_of, find_program
from plydyn_pre.study import Study

#: Share of the time of the impact after which the run without a blow ends
BEFORE = 1.0e-3


@dataclass(frozen=True)
class Job:
    """A run of a deck and of its stages."""

    decks: tuple[Path, ...]
    code: int  # exit code of the solver: 0 at the normal end, 4 where it was stopped on request
    wall: float  # s
    processor: float  # s

    @property
    def results(self) -> tuple[Path, ...]:
        """Paths of the results of each stage without their endings."""
        return tuple(deck.with_suffix("") for deck in self.decks)

    @property
    def listing(self) -> str:
        """The listing of the stage that has run last; empty when none has begun."""
        found = [Path(f"{path}.out") for path in self.results]
        found = [path for path in found if path.is_file()]
        return found[-1].read_text(encoding="utf-8", errors="replace") if found else ""


def run(
    study: Study,
    folder: Path | str,
    *,
    recipe: Path | str = "job",
    mesh: Mesh | None = None,
    threads: int = 1,
    progress: bool = False,
    solver: Path | None = None,
    told: Callable[[str], None] = lambda _: None,
) -> Job:
    """Make the decks of a study in a folder, and run what has not run there.

    The job has the name of `recipe`, where the study comes from; `mesh` is that of the study where
    it has been made; `told` gets each line of the solver, `progress` shows a bar. A run that was
    stopped or killed goes on from its newest restart file. Raises PreError where the study is
    wrong, or the folder has results of another deck.
    """
    folder = Path(folder)
    decks = put_decks(study, mesh or make_mesh(study.mesh), Path(recipe), folder)
    chain, environment = chain_of(solver, threads)
    words = [chain, folder, *decks]
    bar = _Bar(len(decks), progress)
    with bar.bars:

        def tell(line: str) -> None:
            told(line)
            bar(line)

        ended = follow(words, tell, environment=environment)
    return Job(tuple(decks), ended.code, ended.wall, ended.processor)


def without_blow(study: Study) -> Study:
    """The chain whose impactor stands far away, and whose first run ends before it moves much.

    Raises PreError where there is no blow to leave out: the first run needs an impactor that a
    stage removes, and no stage may bring another one.
    """
    removed = any("impactor" in stage.remove for stage in study.stages)
    again = any(stage.impactor is not None for stage in study.stages)
    if study.impactor is None or not removed or again:
        raise PreError(
            "--with-pristine leaves out the impact of the first run; right would be a recipe with"
            " an impactor that a later stage removes, and without one in its stages"
        )
    far = max(study.impactor.gap, study.impactor.radius)
    # the velocity of a fall is known, and its energy may not stand beside it
    impactor = replace(study.impactor, gap=far, energy=None)
    control = replace(study.control, end_time=BEFORE * study.control.end_time)
    title = f"{study.title}; without the impact"
    return replace(study, title=title, impactor=impactor, control=control)


def make_report(job: Job, options: Iterable[str] = ()) -> Path:
    """Make the page over all stages, unless it is there and newer than their results."""
    folder = Path(f"{job.results[0]}_report")
    page, kept = folder / "report.html", folder / "made_by"
    words = ["stages", *map(str, job.results), *options]
    made = kept.read_text(encoding="utf-8") if kept.is_file() and page.is_file() else ""
    newest = max(Path(f"{path}.out").stat().st_mtime_ns for path in job.results)
    if made == " ".join(words) and page.stat().st_mtime_ns > newest:
        return page
    ended = follow([find_program("plydyn-post"), *words, "-o", folder], print_line)
    if ended.code:
        raise PreError(f"plydyn-post ended with {ended.code}: {ended.last}")
    kept.write_text(" ".join(words), encoding="utf-8")
    return page


def print_line(line: str) -> None:
    """Print a line as it is."""
    Console(highlight=False).print(line, markup=False, soft_wrap=True)


def put_decks(study: Study, mesh: Mesh, recipe: Path, folder: Path) -> list[Path]:
    """Write the decks into the folder, unless results there are of others."""
    with TemporaryDirectory() as new:
        first = Path(new) / f"{recipe.stem}.k"
        write_deck(deck_text(study, mesh), first)
        made = [first, *write_stages(study, mesh, first)]
        for deck in made:
            _check_results(folder / deck.stem, deck, recipe)
        try:
            folder.mkdir(parents=True, exist_ok=True)
            for deck in made:
                target = folder / deck.name
                if not target.is_file() or target.read_bytes() != deck.read_bytes():
                    shutil.copyfile(deck, target)
        except OSError as error:
            raise OutputError(f"{error.filename} cannot be written: {error.strerror}") from error
    return [folder / deck.name for deck in made]


def _check_results(job: Path, deck: Path, recipe: Path) -> None:
    """Refuse results of another deck, or of a run that kept no sum of its deck."""
    kept, listing = Path(f"{job}.sum"), Path(f"{job}.out")
    if not listing.exists():
        return
    if not kept.is_file():
        why = "take another folder, or remove them"
        raise PreError(f"the results {job}.* were not made by a chain of runs: {why}")
    if kept.read_text(encoding="utf-8").strip() != sha256(deck.read_bytes()).hexdigest():
        why = "remove them, or take another folder"
        raise PreError(f"the results {job}.* are of another deck than {recipe}: {why}")


class _Bar:
    """A bar of what is done of all stages, or nothing."""

    def __init__(self, stages: int, shown: bool) -> None:
        """Begin with no stage done."""
        self.bars = Progress(
            BarColumn(),
            TaskProgressColumn(),
            TimeElapsedColumn(),
            TextColumn("{task.description}", markup=False),
            console=Console(stderr=True),
            disable=not shown,
        )
        self.task = self.bars.add_task("stage 1", total=float(stages))
        self.before, self.last = 0, 0.0

    def __call__(self, line: str) -> None:
        """Move the bar at a line of progress."""
        share = share_done(line)
        if share is None:
            return
        if share < self.last:
            self.before += 1
        self.last = share
        words = f"stage {self.before + 1}"
        self.bars.update(self.task, completed=self.before + share, description=words)
