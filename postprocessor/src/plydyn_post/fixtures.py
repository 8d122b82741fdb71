"""Fixtures: force, contact, slip, uplift and friction of each, and the balance of momentum."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from plydyn_post.curves import usual_mean
from plydyn_post.errors import ResultsError
from plydyn_post.results import Results
from plydyn_post.style import NARROW, figure, finish, legend_above, look_of, name_job, span
from plydyn_post.symmetry import part_of
from plydyn_post.table import Table, write_csv
from plydyn_post.units import in_brackets, readable

#: A line of the listing that says what a fixture is
_KIND = re.compile(r"^fixture (\d+)\s+(\w+) (below|above) the", re.MULTILINE)


@dataclass(frozen=True)
class Fixture:
    """The history of a fixture, with its name for print."""

    number: int
    name: str
    table: Table

    @property
    def push(self) -> np.ndarray:
        """Force between plate and fixture over time, 20 us means, positive where it presses."""
        mean = usual_mean(self.table, "force z")
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


#: Headings of the table, the columns whose units the numbers have, and the numbers
_QUANTITIES: tuple[tuple[str, str, Callable[[Fixture], float]], ...] = (
    ("largest force", "force z", lambda one: one.push.max()),
    ("impulse", "impulse z", lambda one: one.table["impulse z"][-1]),
    ("largest area", "area", lambda one: one.table["area"].max()),
    # nothing touches before the first step
    ("smallest area", "area", lambda one: min(one.table["area"][1:], default=0.0)),
    ("slip", "slip", lambda one: one.table["slip"][-1]),
    ("largest uplift", "uplift", lambda one: one.table["uplift"].max()),
    ("friction work", "friction", lambda one: one.table["friction"][-1]),
)


def fixture_sheet(results: Results) -> FixtureSheet:
    """The numbers of all fixtures of a job; forces are 20 us means."""
    fixtures = read_fixtures(results)
    if not fixtures:
        raise ResultsError(f"{results.folder / results.job} has no fixtures")
    values = np.array([[number(one) for *_, number in _QUANTITIES] for one in fixtures])
    scales = [
        readable(fixtures[0].table.unit(column), float(np.abs(values[:, place]).max()))
        for place, (_, column, _) in enumerate(_QUANTITIES)
    ]
    headings = [
        in_brackets(name, scale.unit) for (name, *_), scale in zip(_QUANTITIES, scales, strict=True)
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
    return write_csv(path, (sheet.headings, *sheet.rows))


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
        for axes, column in zip(panels, ("force z", "area", "slip", "uplift"), strict=True):
            _draw(axes, fixtures, time.factor, column.split()[0].capitalize(), column)
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
