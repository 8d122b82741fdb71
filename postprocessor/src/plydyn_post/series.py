"""The cases of a parameter study in one table and one figure.

`plydyn-pre study` lists the cases in `cases.csv`: folder, jobs, and the value of each key.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from plydyn_post.compression import read_compression
from plydyn_post.errors import ResultsError
from plydyn_post.numbers import compare
from plydyn_post.results import Results, open_results
from plydyn_post.style import NARROW, figure, finish, legend_above, literal, look_of
from plydyn_post.table import cell, write_csv
from plydyn_post.units import in_brackets

CASES = "cases.csv"
STRENGTH = "strength after impact"
_QUANTITY = re.compile(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(\D*)")


@dataclass(frozen=True)
class Case:
    """One combination of values, with the results of its run and of its stages."""

    name: str
    values: tuple[str, ...]  # in the order of the keys
    jobs: tuple[Results, ...]  # empty until all have ended


@dataclass(frozen=True)
class SeriesTable:
    """Numbers of all cases; nothing where a case has not ended, or a number is not known."""

    keys: tuple[str, ...]
    cases: tuple[Case, ...]
    numbers: dict[str, tuple[str, tuple[float | None, ...]]]  # unit, and the value of each case

    @property
    def notes(self) -> tuple[str, ...]:
        """Which cases are left out."""
        left = [case.name for case in self.cases if not case.jobs]
        words = f"{len(left)} of {len(self.cases)} cases have not come to a normal end"
        return (f"{words}: {', '.join(left)}",) if left else ()


def read_series(folder: Path) -> SeriesTable:
    """Read the list of cases in a folder, and the numbers of those that have ended."""
    path = folder / CASES
    if not path.is_file():
        raise ResultsError(f"{path}: there is no such file; plydyn-pre study writes it")
    with path.open(encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    if head[:2] != ["case", "jobs"] or any(len(row) != len(head) for row in rows) or not rows:
        raise ResultsError(f"{path} is no list of cases as plydyn-pre study writes it")
    cases = tuple(Case(row[0], tuple(row[2:]), _ended(folder / row[0], row[1])) for row in rows)
    if not any(case.jobs for case in cases):
        raise ResultsError(f"{folder}: no case has come to a normal end yet")
    return SeriesTable(tuple(head[2:]), cases, _numbers(cases))


def _ended(folder: Path, jobs: str) -> tuple[Results, ...]:
    """The results of a case; none unless all of its jobs ended normally."""
    names = jobs.split()
    for name in names:
        listing = folder / f"{name}.out"
        if not listing.is_file() or "\nnormal end\n" not in listing.read_text(encoding="utf-8"):
            return ()
    return tuple(open_results(folder / name) for name in names)


def _numbers(cases: Sequence[Case]) -> dict[str, tuple[str, tuple[float | None, ...]]]:
    """The numbers of the first impact of each case, and the strength of a test at its end."""
    found: dict[str, tuple[str, tuple[float | None, ...]]] = {}
    jobs = [job for case in cases for job in case.jobs]
    if any(job.impactors for job in jobs):
        columns, count = [], 0
        for case in cases:
            own = sum(len(job.impactors) for job in case.jobs)
            columns.append(count if own else None)
            count += own
        for row in compare(jobs).rows:
            known = row.known()
            values = tuple(None if at is None else known[at] for at in columns)
            found[row.name] = row.unit, values
    strengths = [_strength(case) for case in cases]
    if any(value is not None for value, _ in strengths):
        unit = next(unit for value, unit in strengths if value is not None)
        found[STRENGTH] = unit, tuple(value for value, _ in strengths)
    return found


def _strength(case: Case) -> tuple[float | None, str]:
    """The strength of the last stage and its unit, where that is a test of the plate."""
    if len(case.jobs) < 2:
        return None, ""
    try:
        test = read_compression(case.jobs[-1])
    except ResultsError:
        return None, ""
    return test.strength, test.units.get("stress", "")


def write_series(table: SeriesTable, path: Path) -> Path:
    """Write a CSV with one line for each case; what is not known is left empty."""
    heads = (in_brackets(name, unit) for name, (unit, _) in table.numbers.items())
    lines = [["case", *table.keys, *heads]]
    for place, case in enumerate(table.cases):
        cells = (cell(values[place]) for _, values in table.numbers.values())
        lines.append([case.name, *case.values, *cells])
    return write_csv(path, lines)


def draw_series(table: SeriesTable, show: str, path: Path | None = None) -> Figure:
    """Draw a number over the first key whose values are numbers, a curve for each other value."""
    if show not in table.numbers:
        raise ResultsError(f"{show!r} is no number; right would be {', '.join(table.numbers)}")
    unit, values = table.numbers[show]
    if all(value is None for value in values):
        raise ResultsError(f"no case has a value of {show!r} to draw; table.csv has the others")
    across, numbers, words = _abscissa(table)
    others = [place for place in range(len(table.keys)) if place != across]
    curves: dict[str, list[tuple[float, float]]] = {}
    for case, x, y in zip(table.cases, numbers, values, strict=True):
        name = ", ".join(case.values[place] for place in others)
        points = curves.setdefault(name, [])
        if y is not None:
            points.append((x, y))
    with figure(size=(NARROW, 3.2)) as (made, axes):
        _draw_curves(axes, curves)
        axes.set_xlabel(literal(words))
        axes.set_ylabel(in_brackets(show.capitalize(), unit))
        if not _all_numbers(table, across):
            known = _distinct(table, across)
            axes.set_xticks(range(len(known)), [literal(value) for value in known])
        if others:
            title = ", ".join(table.keys[place] for place in others)
            legend_above(made, axes, title=literal(title))
        return finish(made, path)


def _draw_curves(axes: Axes, curves: dict[str, list[tuple[float, float]]]) -> None:
    """Points of each curve, joined from left to right."""
    for place, (name, points) in enumerate(curves.items()):
        x, y = np.array(sorted(points)).reshape(-1, 2).T
        axes.plot(x, y, marker="o", markersize=3.5, label=literal(name), **look_of(place))
    axes.margins(x=0.05, y=0.08)


def _abscissa(table: SeriesTable) -> tuple[int, list[float], str]:
    """The place of the key to draw over, its number in each case, and words for the axis.

    Where no key has numbers, values of the first one stand side by side.
    """
    for place, key in enumerate(table.keys):
        if _all_numbers(table, place):
            found = [_QUANTITY.fullmatch(case.values[place]) for case in table.cases]
            numbers = [float(match[1]) for match in found if match]
            return place, numbers, in_brackets(key, found[0][2].strip() if found[0] else "")
    known = _distinct(table, 0)
    return 0, [float(known.index(case.values[0])) for case in table.cases], table.keys[0]


def _distinct(table: SeriesTable, place: int) -> list[str]:
    """The values of a key, each once."""
    return list(dict.fromkeys(case.values[place] for case in table.cases))


def _all_numbers(table: SeriesTable, place: int) -> bool:
    """Whether the values of a key are numbers, all without a unit or all with the same one."""
    found = [_QUANTITY.fullmatch(case.values[place]) for case in table.cases]
    return all(found) and len({match[2].strip() for match in found if match}) == 1
