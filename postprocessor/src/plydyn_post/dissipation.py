"""What damage took: energy by mechanism over time, and delaminated areas over time."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from plydyn_post.errors import ResultsError
from plydyn_post.interfaces import FAILED_AREA, area_columns
from plydyn_post.maps import area_words
from plydyn_post.results import Results
from plydyn_post.style import (
    COLOURS,
    NARROW,
    QUIET,
    figure,
    finish,
    legend_above,
    look_of,
    name_job,
    span,
)
from plydyn_post.symmetry import part_of
from plydyn_post.table import Table
from plydyn_post.units import in_brackets, readable

#: Mechanisms in the order in which they are stacked, with their names in print
MECHANISMS = {
    "delamination": "delamination",
    "matrix damage": "matrix",
    "ply plasticity": "shear that stays",
    "fibre damage": "fibres",
    "metal plasticity": "plastic flow of metals",
    "friction": "friction",
}
#: A mechanism that took less than this share of all is not drawn
UNSEEN = 1e-3
#: Interfaces with a name in the legend of areas, those with the largest at the end
NAMED = 6


def mechanisms(table: Table) -> dict[str, np.ndarray]:
    """Energy that each mechanism took so far, (rows,) each."""
    return {name: table[name] for name in MECHANISMS if name in table}


def draw_dissipation(results: Results, path: Path | None = None) -> Figure:
    """Stack what each mechanism took over time, below what the impactor gave."""
    table = results.energy()
    found = mechanisms(table)
    whole = sum(found.values(), np.zeros(len(table["time"])))
    if not found or whole.max() <= 0.0:
        raise ResultsError(f"{table.path}: nothing was dissipated")
    shown = [name for name, taken in found.items() if taken.max() > UNSEEN * whole.max()]
    time = readable(table.unit("time"), float(table["time"][-1]))
    energy = readable(table.unit(shown[0]), float(whole.max()))
    x = table["time"] * time.factor
    with figure(size=(NARROW, 3.3)) as (made, axes):
        axes.stackplot(
            x,
            [found[name] * energy.factor for name in shown],
            labels=[
                f"{MECHANISMS[name]}, {_last(found[name] * energy.factor, energy.unit)}"
                for name in shown
            ],
            colors=[COLOURS[list(MECHANISMS).index(name) % len(COLOURS)] for name in shown],
            alpha=0.82,
            linewidth=0,
        )
        axes.plot(x, whole * energy.factor, color="black", linewidth=0.9)
        axes.set_xlabel(in_brackets("Time", time.unit))
        axes.set_ylabel(in_brackets("Dissipated energy", energy.unit))
        span(axes, x)
        axes.set_ylim(bottom=0.0)
        legend_above(made, axes)
        name_job(made, results.job, part_of(results))
        return finish(made, path)


def _last(values: np.ndarray, unit: str) -> str:
    """What a curve comes to."""
    return f"{values[-1]:.3g} {unit}".rstrip()


def _draw_interfaces(axes: Axes, x: np.ndarray, areas: dict[int, np.ndarray], unit: str) -> None:
    """Area of each interface; of many the largest have a name, one alone always has."""
    named = NAMED if len(areas) > NAMED + 1 else len(areas)
    largest = sorted(areas, key=lambda number: float(areas[number][-1]), reverse=True)[:named]
    others = [number for number in areas if number not in largest]
    for place, number in enumerate(others):
        label = f"{len(others)} others" if place == 0 else None
        axes.plot(x, areas[number], color=QUIET, linewidth=0.7, label=label)
    for place, number in enumerate(sorted(largest)):
        label = f"interface {number}, {area_words(areas[number][-1], unit)}"
        axes.plot(x, areas[number], label=label, **look_of(place))


def draw_areas(results: Results, path: Path | None = None) -> Figure:
    """Delaminated area of each interface over time, and the projected one."""
    table = results.delamination()
    columns = area_columns(table)
    unit = table.unit("projected area")
    time = readable(table.unit("time"), float(table["time"][-1]))
    x = table["time"] * time.factor
    with figure(size=(NARROW, 3.3)) as (made, axes):
        _draw_interfaces(axes, x, {it: table[name] for it, name in columns.items()}, unit)
        projected = table["projected area"]
        label = f"projected, {area_words(projected[-1], unit)}"
        # below the others: it is one of them where a single interface delaminates
        axes.plot(x, projected, color="black", linewidth=2.4, label=label, zorder=1.8)
        if FAILED_AREA in table:
            failed = table[FAILED_AREA]
            label = f"projected, failed, {area_words(failed[-1], unit)}"
            axes.plot(x, failed, color="black", linewidth=0.8, linestyle="--", label=label)
        axes.set_xlabel(in_brackets("Time", time.unit))
        axes.set_ylabel(in_brackets("Delaminated area", unit.replace("2", "²")))
        span(axes, x)
        axes.set_ylim(bottom=0.0)
        legend_above(made, axes)
        name_job(made, results.job, part_of(results))
        return finish(made, path)
