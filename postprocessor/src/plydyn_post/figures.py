"""Figures of curves: force, displacement, velocity and energy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from plydyn_post.contact import touching
from plydyn_post.curves import is_noisy, mean_window, running_mean
from plydyn_post.errors import ResultsError
from plydyn_post.results import Results, labelled
from plydyn_post.style import (
    COLOURS,
    MEASURED,
    NARROW,
    QUIET,
    figure,
    finish,
    legend_above,
    literal,
    look_of,
    name_job,
    span,
)
from plydyn_post.table import Table, read_table, whole_words
from plydyn_post.units import Scale, factor, in_brackets, readable

# Energies that are drawn, in this order, with their names in print; others are parts of no impact
ENERGIES = {
    "impactor": "impactor",
    "internal": "internal",
    "dissipated": "internal, dissipated",
    "kinetic": "kinetic of the plate",
    "damping": "damping",
    "contact": "contact",
    "contact friction": "friction in contact",
    "external": "external work",
    "total": "total",
}
# An energy smaller than this share of the largest is not drawn
UNSEEN = 1e-4
# Words of axes
WORDS = {
    "time": "Time",
    "force": "Contact force",
    "displacement": "Impactor displacement",
    "velocity": "Impactor velocity, upwards",
}


@dataclass(frozen=True)
class Curve:
    """A history with its name in the legend."""

    label: str
    table: Table
    measured: bool = False


def curves_of(
    jobs: Sequence[Results], measured: Sequence[Path] = (), impactor: int | None = None
) -> list[Curve]:
    """The impactor's history of every job, and tests laid over them."""
    curves = [Curve(name, job.impactor(impactor)) for name, job in labelled(jobs)]
    return curves + [_test(path) for path in measured]


def _test(path: Path) -> Curve:
    """A measured history."""
    table = read_table(path, from_solver=False)
    if len(WORDS.keys() & set(table.names)) < 2:
        raise ResultsError(
            f"{path} names {', '.join(table.names)}; expected two of {', '.join(WORDS)}"
        )
    return Curve(path.stem, table, True)


def draw_history(
    curves: Sequence[Curve],
    across: str,
    upwards: str,
    path: Path | None = None,
    window: float | None = None,
) -> Figure:
    """Draw a column over another, such as force over time.

    Noisy forces are drawn faintly, with their running mean over a window of time on top.
    """
    if not {across, upwards} <= WORDS.keys():
        raise ResultsError(f"{across!r} is no history; expected one of {', '.join(WORDS)}")
    scales = [_scale(curves, across), _scale(curves, upwards)]
    with figure() as (made, axes):
        for place, curve in enumerate(curves):
            _draw_curve(axes, curve, (across, upwards), scales, place, window)
        if len(curves) == 1:
            _tell_mean(axes, curves[0], window)
        axes.set_xlabel(in_brackets(WORDS[across], scales[0].unit))
        axes.set_ylabel(in_brackets(WORDS[upwards], scales[1].unit))
        axes.margins(x=0.0 if across == "time" else 0.03)
        if len(axes.get_legend_handles_labels()[1]) > 1:
            legend_above(made, axes)
        if len(curves) == 1:
            name_job(made, curves[0].label, whole_words(curves[0].table.copies))
        return finish(made, path)


def _tell_mean(axes: Axes, curve: Curve, window: float | None) -> None:
    """Name the faint and the strong line of one noisy curve."""
    lines = axes.get_lines()
    if len(lines) != 2:
        return
    span = mean_window(curve.table) if window is None else window
    scale = readable(curve.table.unit("time"), span)
    lines[0].set_label("as computed")
    lines[1].set_label(f"mean over {span * scale.factor:.3g} {scale.unit}".rstrip())


def _values(curve: Curve, column: str) -> np.ndarray:
    """Numbers as they are drawn: a displacement counts in the direction of the push."""
    values, force = curve.table[column], curve.table.get("force")
    if column != "displacement":
        return values
    deepest = np.argmax(np.abs(values if force is None else force))
    return values if values[deepest] > 0 else -values


def _scale(curves: Sequence[Curve], column: str) -> Scale:
    """The unit of print of the first curve, for numbers up to the largest of all."""
    first = curves[0].table.unit(column)
    largest = max(
        float(np.max(np.abs(_values(curve, column)))) * factor(curve.table.unit(column), first)
        for curve in curves
    )
    return readable(first, largest)


def _draw_curve(
    axes: Axes,
    curve: Curve,
    columns: tuple[str, str],
    scales: list[Scale],
    place: int,
    window: float | None,
) -> None:
    x, y = (
        _values(curve, column) * factor(curve.table.unit(column), scale.unit)
        for column, scale in zip(columns, scales, strict=True)
    )
    if columns[0] == "displacement" and not curve.measured:
        # the free flight before and after the contact says nothing here
        inside = touching(curve.table["force"])
        if len(inside):
            x = x.copy()
            x[: max(inside[0] - 1, 0)] = np.nan
            x[inside[-1] + 2 :] = np.nan
    look: dict[str, Any] = (
        {"color": MEASURED, "linestyle": "-"} if curve.measured else look_of(place)
    )
    look["linewidth"] = 1.0 if curve.measured else 1.3
    if columns[1] != "force" or curve.measured:
        axes.plot(x, y, label=literal(curve.label), **look)
        return
    span = mean_window(curve.table) if window is None else window
    mean = running_mean(curve.table["time"], y, span)
    if is_noisy(y, mean):
        axes.plot(x, y, color=look["color"], linewidth=0.5, alpha=0.35)
        axes.plot(x, mean, label=literal(curve.label), **look)
    else:
        axes.plot(x, y, label=literal(curve.label), **look)


def draw_energy(job: Results, path: Path | None = None, stacked: bool = False) -> Figure:
    """Draw where the energy of a job is, and the error of the balance below."""
    table = job.energy()
    time = readable(table.unit("time"), float(np.max(table["time"])))
    names = _drawn_energies(table)
    size = max((float(np.max(np.abs(table[name]))) for name in names), default=0.0)
    energy = readable(table.unit(names[0] if names else "total"), size)
    x = table["time"] * time.factor
    with figure(2, size=(NARROW, 3.9), sharex=True, height_ratios=[4, 1]) as (made, (upper, lower)):
        values = {name: table[name] * energy.factor for name in names}
        (_stack if stacked else _lines)(upper, x, values)
        upper.set_ylabel(in_brackets("Energy", energy.unit))
        upper.set_ylim(bottom=min(0.0, upper.get_ylim()[0]) if not stacked else 0.0)
        share = table["error"] * factor("-", "%")
        lower.plot(x, share, color=QUIET, linewidth=1.0)
        lower.axhline(0.0, color="#c8c8c8", linewidth=0.6, zorder=0)
        lower.set(xlabel=in_brackets("Time", time.unit), ylabel="Error [%]")
        lower.margins(y=0.2)
        span(lower, x)
        made.align_ylabels([upper, lower])
        legend_above(made, upper)
        name_job(made, job.job, whole_words(table.copies))
        return finish(made, path)


def _drawn_energies(table: Table) -> list[str]:
    """Energies that are there and can be seen beside the largest."""
    sizes = {name: float(np.max(np.abs(table[name]))) for name in ENERGIES if name in table}
    largest = max(sizes.values(), default=0.0)
    return [name for name, size in sizes.items() if size > UNSEEN * largest]


def _lines(axes: Axes, x: np.ndarray, values: dict[str, np.ndarray]) -> None:
    for place, (name, y) in enumerate(values.items()):
        look = look_of(place)
        if name == "total":
            look = {"color": "black", "linestyle": "-", "linewidth": 0.9}
        axes.plot(x, y, label=ENERGIES[name], **look)


def _stack(axes: Axes, x: np.ndarray, values: dict[str, np.ndarray]) -> None:
    """Parts on top of each other; the total as a line."""
    parts = [name for name in values if name not in ("dissipated", "total", "external")]
    if parts:
        axes.stackplot(
            x,
            [values[name] for name in parts],
            labels=[ENERGIES[name] for name in parts],
            colors=COLOURS,
            alpha=0.75,
            linewidth=0,
        )
    if "total" in values:
        axes.plot(x, values["total"], color="black", linewidth=0.9, label="total")
