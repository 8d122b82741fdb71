"""Folders of a parameter study: the decks of each case, the list of cases, and a job for Slurm."""

from __future__ import annotations

import csv
import json
import shlex
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TextIO

from plydyn_pre.errors import OutputError, PreError
from plydyn_pre.mesh import make_mesh
from plydyn_pre.overrides import title_with
from plydyn_pre.recipe import load_recipe
from plydyn_pre.runs.chain import put_decks
from plydyn_pre.series.plan import Case, Series

CASES, JOB = "cases.csv", "study.slurm"

_HEAD = """\
#!/usr/bin/env bash
# sbatch study.slurm, in this folder: one task for each case. To go on, submit it again: what has
# ended is not run again, and what was broken off goes on. Change the settings between the lines.
#SBATCH --job-name={name}
#SBATCH --output=%x.%A_%a.log
#SBATCH --open-mode=append
#SBATCH --nodes=1
#SBATCH --ntasks=1
#SBATCH --signal=USR1@600
#SBATCH --requeue
#SBATCH --array=1-{count}
# ------------------------------------------------------------------------
#SBATCH --cpus-per-task=4
#SBATCH --mem=4G
#SBATCH --time=04:00:00
# ------------------------------------------------------------------------
set -euo pipefail

command -v plydyn-chain >/dev/null || module load plydyn
case $SLURM_ARRAY_TASK_ID in
"""


@dataclass(frozen=True)
class Written:
    """A case with its decks, that of the first run and those of its stages."""

    name: str
    decks: tuple[Path, ...]


def write_cases(
    series: Series, folder: Path, tick: Callable[[str], None] = lambda _: None
) -> list[Written]:
    """Write the decks of all cases into folders; results there must be of the same decks."""
    studies = []
    for case in series.cases:
        with _naming(case):
            studies.append(load_recipe(series.recipe, case.overrides))
    written: list[Written] = []
    mesh, shape = None, None
    for case, study in zip(series.cases, studies, strict=True):
        tick(case.name)
        with _naming(case):
            if mesh is None or study.mesh != shape:
                mesh, shape = make_mesh(study.mesh), study.mesh
            titled = replace(study, title=title_with(study.title, case.overrides))
            decks = put_decks(titled, mesh, series.recipe, folder / case.name)
        written.append(Written(case.name, tuple(decks)))
    _write_list(series, written, folder / CASES)
    _write_job(series.recipe.stem, written, folder / JOB)
    return written


@contextmanager
def _naming(case: Case) -> Iterator[None]:
    """Name the case in any error inside."""
    try:
        yield
    except PreError as error:
        words = f"case {case.name} ({', '.join(case.overrides)}): {error}"
        kind = OutputError if isinstance(error, OutputError) else PreError
        raise kind(words) from error


def _write_list(series: Series, written: list[Written], path: Path) -> None:
    """Write the cases as a CSV: folder, jobs, and the value of each key."""
    with _opened(path) as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", "jobs", *series.keys])
        for case, one in zip(series.cases, written, strict=True):
            jobs = " ".join(deck.stem for deck in one.decks)
            writer.writerow([case.name, jobs, *map(_text, case.values)])


def _text(value: Any) -> str:  # noqa: ANN401
    """A value in a cell."""
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def _write_job(name: str, written: list[Written], path: Path) -> None:
    """Write the array job."""
    with _opened(path) as file:
        file.write(_HEAD.format(name=shlex.quote(name), count=len(written)))
        for number, one in enumerate(written, start=1):
            words = [one.name, *(f"{one.name}/{deck.name}" for deck in one.decks)]
            file.write(f"  {number}) words=({shlex.join(words)}) ;;\n")
        file.write('esac\nexec plydyn-chain "${words[@]}"\n')
    path.chmod(0o755)


def _opened(path: Path) -> TextIO:
    """A file to write."""
    try:
        return path.open("w", encoding="utf-8", newline="")
    except OSError as error:
        raise OutputError(f"{path} cannot be written: {error.strerror}") from error


def written_cases(folder: Path) -> list[Written]:
    """The cases of a folder, as its list names them."""
    path = folder / CASES
    try:
        with path.open(encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))[1:]
    except OSError as error:
        raise PreError(f"{path} cannot be read: {error.strerror}") from error
    return [
        Written(row[0], tuple(folder / row[0] / f"{job}.k" for job in row[1].split()))
        for row in rows
    ]
