"""Jobs: a recipe made into a deck, and its run by the solver."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from plydyn_post.results import Results

#: Top of the checkout
ROOT = Path(__file__).resolve().parents[2]
#: Exit code of the solver when it was stopped on request
STOPPED = 4
#: Gets the share of a run that is done
Tick = Callable[[float], None]
_DONE = re.compile(r"\s(\d+\.\d)%\s")


class StudyError(Exception):
    """Something that a study needs is missing or failed."""


@dataclass(frozen=True)
class Job:
    """A recipe with values replaced, under a name."""

    name: str
    recipe: Path
    overrides: tuple[str, ...] = ()


@dataclass(frozen=True)
class Effort:
    """What a run took."""

    wall: float  # s, from start to end of the process
    processor: float  # s, of the process on the processor
    loop: float  # s, of the time loop
    steps: int
    freedoms: int

    @property
    def grain(self) -> float:
        """Time of the loop per degree of freedom and step, ns."""
        return 1e9 * self.loop / (self.steps * self.freedoms)


@dataclass(frozen=True)
class Tools:
    """The programs."""

    pre: Path
    solver: Path

    def version(self) -> str:
        """What the solver says of itself, on one line."""
        told = subprocess.run(
            [self.solver, "--version"], capture_output=True, text=True, check=True
        )
        return "; ".join(line.strip() for line in told.stdout.splitlines() if line.strip())


def find_tools(solver: Path | None = None) -> Tools:
    """The programs of this checkout, else those on PATH."""
    bins = (Path(sys.executable).parent, ROOT / ".venv/bin")
    return Tools(
        _program("plydyn-pre", bins), solver or _program("plydyn", (ROOT / "build/release",))
    )


def _program(name: str, folders: Sequence[Path]) -> Path:
    """A program in one of some folders, else on PATH."""
    for folder in folders:
        if os.access(folder / name, os.X_OK):
            return folder / name
    found = shutil.which(name)
    if found is None:
        places = ", ".join(str(folder) for folder in folders)
        raise StudyError(f"there is no {name} in {places} or on PATH; decks/quickstart.sh makes it")
    return Path(found)


def make_deck(tools: Tools, job: Job, folder: Path) -> Path:
    """Write the deck of a job."""
    folder.mkdir(parents=True, exist_ok=True)
    deck = folder / f"{job.name}.k"
    replaced = [word for override in job.overrides for word in ("--set", override)]
    words = [tools.pre, "deck", job.recipe, "-o", deck, *replaced]
    made = subprocess.run(words, capture_output=True, text=True, check=False)
    if made.returncode:
        raise StudyError(f"{job.name}: {made.stderr.strip() or made.stdout.strip()}")
    return deck


def run_job(
    tools: Tools,
    job: Job,
    folder: Path,
    tick: Tick = lambda _: None,
    core: int | None = None,
    threads: int = 1,
    good: tuple[int, ...] = (0,),
) -> Effort:
    """Make the deck of a job and run it, on one core if its number is given.

    Other exit codes of the solver than the good ones are an error.
    """
    deck = make_deck(tools, job, folder)
    words = [tools.solver, "run", deck, "-j", job.name, "-o", folder, f"ncpu={threads}"]
    if core is not None and shutil.which("taskset"):
        words = ["taskset", "-c", str(core), *words]
    kept = folder / f"{job.name}.effort"
    kept.unlink(missing_ok=True)
    start = time.perf_counter()
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as process:
        last = _follow(process, folder / f"{job.name}.screen", tick)
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in good:
        raise StudyError(f"{job.name}: the solver left with {process.returncode}: {last.strip()}")
    took = {"wall": wall, "processor": usage.ru_utime + usage.ru_stime}
    kept.write_text(json.dumps(took), encoding="utf-8")
    return read_effort(folder / f"{job.name}.out", took["wall"], took["processor"])


def _follow(process: subprocess.Popen[str], log: Path, tick: Tick) -> str:
    """Keep what a process prints, and tell how far it is; gives its last line."""
    last = ""
    with log.open("w", buffering=1, encoding="utf-8") as file:
        for line in process.stdout or ():
            last = line
            file.write(line)
            if found := _DONE.search(line):
                tick(float(found[1]) / 100.0)
    return last


def read_effort(listing: Path, wall: float, processor: float) -> Effort:
    """Steps, freedoms and time of the loop from a listing."""
    text = listing.read_text(encoding="utf-8")
    return Effort(
        wall,
        processor,
        loop=float(_number(listing, text, r"seconds\s+(\S+) in the loop")),
        steps=int(_number(listing, text, r"cycle (\d+), time")),
        freedoms=int(_number(listing, text, r"degrees of freedom\s+(\d+)")),
    )


def kept_effort(job: Job, folder: Path) -> Effort | None:
    """What the run of a job took that lies in a folder, if it came to a good end."""
    kept, listing = folder / f"{job.name}.effort", folder / f"{job.name}.out"
    if not (kept.is_file() and listing.is_file()):
        return None
    took = json.loads(kept.read_text(encoding="utf-8"))
    return read_effort(listing, took["wall"], took["processor"])


def builds(jobs: Sequence[Job], folder: Path, lines: int = 1) -> str:
    """The builds that made the runs of jobs which lie in a folder; what they say of themselves."""
    done = [job for job in jobs if kept_effort(job, folder)]
    texts = [(folder / f"{job.name}.out").read_text(encoding="utf-8") for job in done]
    return " and ".join(sorted({"; ".join(text.splitlines()[:lines]) for text in texts}))


def made_by(jobs: Sequence[Job], folder: Path) -> str:
    """A sentence that names the builds which made those runs."""
    return f"Made by {builds(jobs, folder)}.\n"


def freedoms_of(results: Results) -> int:
    """Degrees of freedom of a job that has run."""
    return read_effort(results.folder / f"{results.job}.out", 0.0, 0.0).freedoms


def _number(listing: Path, text: str, pattern: str) -> str:
    found = re.search(pattern, text)
    if found is None:
        raise StudyError(f"{listing} has no line like {pattern!r}")
    return found[1]


def is_done(tools: Tools, job: Job, folder: Path) -> bool:
    """Whether the same deck was run to its end by the same solver already."""
    deck, listing = folder / f"{job.name}.k", folder / f"{job.name}.out"
    if not (deck.is_file() and listing.is_file()):
        return False
    before, text = deck.read_bytes(), listing.read_text(encoding="utf-8")
    same = make_deck(tools, job, folder).read_bytes() == before
    version = tools.version().split(";")[0]
    return same and text.startswith(version) and "\nnormal end" in text
