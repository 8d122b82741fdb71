"""Whole jobs, from the recipe to the report, beside what the check predicts of their runs.

    .venv/bin/python tests/bench/whole_jobs.py [--print]

Takes as long as the jobs that it runs, some minutes; needs build/release and both Python packages.
The quick start and a small recipe are run; of the others, which take hours, the time of the deck
and the prediction are given. Last comes a coupon of 3.6 million degrees of freedom: its deck, and
its report after a few steps with damage. Times are processor time on one thread. Puts tables into
manual/performance.md between its marks. No test: nothing is compared with a limit.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from run import BUILD, PAGE, ROOT, clock, machine, publish, table

MARKS = ("<!-- jobs -->", "<!-- /jobs -->")
BIN = ROOT / ".venv/bin"
MEGA, KIBI = 1.0e6, 1024.0


@dataclass(frozen=True)
class Job:
    """A recipe, and whether it is run here."""

    name: str
    recipe: str
    settings: tuple[str, ...] = ()
    runs: bool = False


JOBS = (
    Job("quick start", "decks/small_coupon/quickstart.toml", runs=True),
    Job("quarter of a disc with damage", "decks/damage_impact/quarter.toml", runs=True),
    Job("25 J, quads of 1 mm", "decks/validation/t700gc_25J.toml", ("mesh.quad=1.0",)),
    Job("ASTM D7136, standard", "template astm-d7136", ("mesh.level=standard",)),
    Job("chain of ASTM D7137, its impact", "template astm-d7137"),
)
# 24 plies that are not cracked along lines; hit ten times as fast, for a few steps
LARGE = ("cracks=false", "laminate.join_alike=false", "mesh.order=2", "mesh.quad=1.0")
HIT = ("impactor.energy=3.0e6", "control.end_time=4.0e-6", "outputs.field_interval=2.0e-6")


@dataclass(frozen=True)
class Spent:
    """What a command took."""

    seconds: float  # of processor time
    memory: float  # bytes at most
    said: str


def spend(words: Sequence[str | Path], folder: Path) -> Spent:
    """Run a command on one thread."""
    alone = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    with subprocess.Popen(
        words, cwd=folder, stdout=subprocess.PIPE, text=True, env=alone
    ) as process:
        assert process.stdout is not None
        said = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise SystemExit(f"{words[0]} {words[1]} ended with code {process.returncode}")
    return Spent(usage.ru_utime + usage.ru_stime, KIBI * usage.ru_maxrss, said)


def written(job: Job, folder: Path) -> Spent:
    """Write the decks of a job; the first is job.k."""
    recipe = ROOT / job.recipe
    if job.recipe.startswith("template "):
        recipe = folder / "recipe.toml"
        spend([BIN / "plydyn-pre", "new", recipe, "--template", job.recipe.split()[1]], folder)
    sets = [word for each in job.settings for word in ("--set", each)]
    return spend([BIN / "plydyn-pre", "deck", recipe, "-o", folder / "job.k", *sets], folder)


def predicted(folder: Path) -> float:
    """Seconds that the check of job.k predicts for its run."""
    said = spend([BUILD / "plydyn", "check", folder / "job.k"], folder).said
    found = re.search(r"time to come, predicted .*\(([\d.]+) s\)", said)
    if found is None:
        raise SystemExit("a check predicts no time")
    return float(found[1])


def row(job: Job) -> list[str]:
    """A row of the table of jobs."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        deck, told = written(job, folder), predicted(folder)
        cells = [job.name, f"{deck.seconds:.1f}", clock(told)]
        if not job.runs:
            return [*cells, "–", "–", "–", "–"]
        run = spend([BUILD / "plydyn", "run", folder / "job.k", "-o", folder], folder)
        report = spend([BIN / "plydyn-post", "report", folder / "job.vtkhdf"], folder)
    whole = deck.seconds + run.seconds + report.seconds
    cells += [clock(run.seconds), f"{told / run.seconds:.2f}", f"{report.seconds:.1f}"]
    return [*cells, clock(whole)]


def large() -> list[list[str]]:
    """Time and memory of both Python packages on a large coupon."""
    job = Job("large", "template astm-d7136", (*LARGE, *HIT))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        deck = written(job, folder)
        spend([BUILD / "plydyn", "run", folder / "job.k", "-o", folder], folder)
        report = spend([BIN / "plydyn-post", "report", folder / "job.vtkhdf"], folder)
    return [
        [words, f"{spent.seconds:.1f}", f"{spent.memory / MEGA:.0f}"]
        for words, spent in (("plydyn-pre deck", deck), ("plydyn-post report", report))
    ]


def main() -> None:
    """Measure, and print or write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--print", action="store_true", help="leave the page alone")
    page = None if parser.parse_args().print else PAGE
    heads = ["job", "deck [s]", "run, predicted", "taken", "predicted over taken", "report [s]"]
    jobs = table([*heads, "recipe to report"], [row(job) for job in JOBS])
    both = table(["3.6 million degrees of freedom", "seconds", "most memory [MB]"], large())
    publish(f"{machine()}\n\n{jobs}\n\n{both}", page, MARKS)


if __name__ == "__main__":
    main()
