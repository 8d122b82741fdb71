"""Fixtures: force, contact, slip, uplift and friction of each, and the balance of momentum."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from plydyn_post.curves import mean_window, running_mean
from plydyn_post.errors import ResultsError
from plydyn_post.results import Results
from plydyn_post.style import NARROW, figure, finish, legend_above, look_of, name_job, span
from plydyn_post.symmetry import part_of
from plydyn_post.table import Table
from plydyn_post.units import in_brackets, readable

#: A line of the listing that says what a fixture is
_KIND = re.compile(r"^fixture (\d+)\s+(\w+) (below|above) the", re.MULTILINE)
#: Headings of the table, and the columns whose units the numbers have
_QUANTITIES = (
    ("largest force", "force z"),
    ("impulse", "impulse z"),
    ("largest area", "area"),
    ("smallest area", "area"),
    ("slip", "slip"),
    ("largest uplift", "uplift"),
    ("friction work", "friction"),
)


@dataclass(frozen=True)
class Fixture:
    """The history of a fixture, with its name for print."""

    number: int
    name: str
    table: Table

    @property
    def push(self) -> np.ndarray:
        """Force between plate and fixture over time, 20 us means, positive where it presses."""
        time, force = self.table["time"], self.table["force z"]
        mean = running_mean(time, force, mean_window(self.table))
        return mean if mean[np.argmax(np.abs(mean))] > 0.0 else -mean


@dataclass(frozen=True)
class FixtureSheet:
    """A table of all fixtures of a job: headings with units, and a row of texts for each."""

    job: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    words: str  # the balance of momentum, empty where it is not known


def read_fixtures(results: Results) -> tuple[Fixture, ...]:
    """All fixtures of a job."""
    listing = results.folder / f"{results.job}.out"
    text = listing.read_text(encoding="utf-8", errors="replace") if listing.is_file() else ""
    kinds = {int(found[1]): f"{found[2]} {found[3]}" for found in _KIND.finditer(text)}
    return tuple(
        Fixture(number, f"{number} {kinds.get(number, '')}".strip(), results.fixture(number))
        for number in results.fixtures
    )


def fixture_sheet(results: Results) -> FixtureSheet:
    """The numbers of all fixtures of a job; forces are 20 us means."""
    fixtures = read_fixtures(results)
    if not fixtures:
        raise ResultsError(f"{results.folder / results.job} has no fixtures")
    values = np.array([_numbers(one) for one in fixtures])
    scales = [
        readable(fixtures[0].table.unit(column), float(np.abs(values[:, place]).max()))
        for place, (_, column) in enumerate(_QUANTITIES)
    ]
    headings = [
        in_brackets(name, scale.unit) for (name, _), scale in zip(_QUANTITIES, scales, strict=True)
    ]
    rows = [
        (
            one.name,
            *(f"{value * scale.factor:.4g}" for value, scale in zip(row, scales, strict=True)),
        )
        for one, row in zip(fixtures, values, strict=True)
    ]
    return FixtureSheet(
        results.job, ("fixture", *headings), tuple(rows), _momentum(results, fixtures)
    )


def write_sheet(sheet: FixtureSheet, path: Path) -> Path:
    """Write the table as a CSV."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(sheet.headings)
        writer.writerows(sheet.rows)
    return path


def _numbers(fixture: Fixture) -> list[float]:
    """The numbers of a fixture, in the order of the table."""
    table = fixture.table
    began = table["area"][1:]  # nothing touches before the first step
    return [
        float(fixture.push.max()),
        float(table["impulse z"][-1]),
        float(table["area"].max()),
        float(began.min()) if len(began) else 0.0,
        float(table["slip"][-1]),
        float(table["uplift"].max()),
        float(table["friction"][-1]),
    ]


def _momentum(results: Results, fixtures: Iterable[Fixture]) -> str:
    """Whether what plate and impactors lost along z is what the fixtures have got."""
    try:
        energy = results.energy()
        own, unit = energy["momentum z"], energy.unit("momentum z")
    except ResultsError:
        return ""
    lost = float(own[0] - own[-1])
    given = sum(float(one.table["impulse z"][-1]) for one in fixtures)
    largest = max(abs(lost), abs(given), abs(float(own[0])))
    rest = abs(lost - given) / largest if largest > 0.0 else 0.0
    return (
        f"momentum along z: plate and impactors lost {lost:.6g} {unit}, fixtures got"
        f" {given:.6g} {unit}, {rest:.1e} of the largest is left for supports and loads"
    )


def draw_fixtures(results: Results, path: Path | None = None) -> Figure:
    """Draw force (a 20 µs mean), area in contact, slip and uplift of all fixtures over time."""
    fixtures = read_fixtures(results)
    if not fixtures:
        raise ResultsError(f"{results.folder / results.job} has no fixtures")
    time = readable(fixtures[0].table.unit("time"), float(fixtures[0].table["time"][-1]))
    shape = (NARROW, 6.2)
    with figure(4, size=shape, sharex=True, height_ratios=[3, 2, 2, 2]) as (made, panels):
        _draw(panels[0], fixtures, time.factor, "Force", "force z")
        _draw(panels[1], fixtures, time.factor, "Area", "area")
        _draw(panels[2], fixtures, time.factor, "Slip", "slip")
        _draw(panels[3], fixtures, time.factor, "Uplift", "uplift")
        panels[-1].set_xlabel(in_brackets("Time", time.unit))
        made.align_ylabels(panels)
        legend_above(made, panels[0])
        name_job(made, results.job, part_of(results))
        return finish(made, path)


def _draw(
    axes: Axes, fixtures: tuple[Fixture, ...], per_time: float, words: str, column: str
) -> None:
    """A column of all fixtures; of forces the running mean."""
    curves = [one.push if column == "force z" else one.table[column] for one in fixtures]
    largest = max(float(np.abs(curve).max()) for curve in curves)
    scale = readable(fixtures[0].table.unit(column), largest)
    for place, (one, curve) in enumerate(zip(fixtures, curves, strict=True)):
        x = one.table["time"] * per_time
        axes.plot(x, curve * scale.factor, label=one.name, linewidth=1.1, **look_of(place))
    axes.set_ylabel(in_brackets(words, scale.unit.replace("2", "²")))
    span(axes, x)
