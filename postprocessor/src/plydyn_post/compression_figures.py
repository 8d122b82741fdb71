"""Figures of a compression test: stress, gauges, faces, delamination and energies."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from plydyn_post.compression import EVENTS, MOST_BENDING, Compression
from plydyn_post.errors import ResultsError
from plydyn_post.style import (
    MEASURED,
    NARROW,
    QUIET,
    figure,
    legend_above,
    literal,
    look_of,
    name_job,
    save,
)
from plydyn_post.units import in_brackets, readable


def stress_label(test: Compression) -> str:
    """Label of an axis of stress."""
    return in_brackets("Stress", test.units.get("stress", ""))


def shortening_label(test: Compression) -> str:
    """Label of an axis of end shortening or elongation."""
    return in_brackets(test.moved.capitalize(), test.units.get("length", ""))


def draw_stress(tests: Sequence[Compression], path: Path) -> Path:
    """Draw stress over end shortening; a pristine plate comes second, in black."""
    with figure() as (made, axes):
        for place, test in enumerate(tests):
            look = look_of(0) if place == 0 else {"color": MEASURED, "linestyle": "--"}
            axes.plot(test.shortening, test.stress, label=literal(test.job.job), **look)
            axes.plot(test.shortening[test.peak], test.strength, "o", color=look["color"])
        axes.set_xlabel(shortening_label(tests[0]))
        axes.set_ylabel(stress_label(tests[0]))
        axes.set_ylim(bottom=0.0)
        if len(tests) > 1:
            legend_above(made, axes)
        else:
            name_job(made, tests[0].job.job)
        return save(made, path)


def draw_gauges(test: Compression, path: Path) -> Path:
    """Draw strains back to back over end shortening up to the peak, and percent bending below."""
    if not test.gauges:
        raise ResultsError(f"{test.job.job} has no profiles at gauges; see --gauge")
    loaded, moved = test.loaded(), test.shortening
    with figure(2, size=(NARROW, 4.2), sharex=True, height_ratios=[3, 1.4]) as (made, (upper, low)):
        for place, gauge in enumerate(test.gauges):
            colour = look_of(place)["color"]
            name = f"profile {gauge.number}"
            for face, dash in (("bottom", "-"), ("top", "--")):
                strain = 1e6 * getattr(gauge, face)[: test.peak + 1]
                label = f"{name}, {face}"
                upper.plot(moved[: test.peak + 1], strain, dash, color=colour, label=label)
            low.plot(moved[loaded], gauge.bending[loaded], color=colour)
        for limit in (-MOST_BENDING, MOST_BENDING):
            low.axhline(limit, color=QUIET, linewidth=0.7, linestyle=":")
        upper.set_ylabel("Strain [µm/m]")
        low.set(xlabel=shortening_label(test), ylabel="Bending [%]")
        made.align_ylabels([upper, low])
        legend_above(made, upper)
        name_job(made, test.job.job)
        return save(made, path)


def draw_faces(test: Compression, path: Path) -> Path:
    """Draw the deflection of both faces in the middle over end shortening."""
    if test.faces is None:
        raise ResultsError(f"{test.job.job} has no profile in the middle; see --middle")
    with figure() as (made, axes):
        for place, name in enumerate(("bottom", "top")):
            axes.plot(test.shortening, test.faces[:, place], label=name, **look_of(place))
        axes.set_ylabel(in_brackets("Deflection in the middle", test.units.get("length", "")))
        _finish(made, axes, test)
        return save(made, path)


def draw_delamination(test: Compression, path: Path) -> Path:
    """Draw the delaminated area, of all interfaces and seen from above, over end shortening."""
    table = test.job.delamination()
    moved = np.interp(table["time"], test.time, test.shortening)
    with figure() as (made, axes):
        for place, (column, name) in enumerate(
            (("sum", "sum of all interfaces"), ("projected area", "seen from above"))
        ):
            axes.plot(moved, table[column], label=name, **look_of(place))
        axes.set_ylabel(in_brackets("Delaminated area", table.unit("sum").replace("2", "²")))
        _finish(made, axes, test)
        return save(made, path)


def _finish(made: Figure, axes: Axes, test: Compression) -> None:
    """Mark the peak of the stress, and name the axis and the job."""
    axes.axvline(test.shortening[test.peak], color=QUIET, linewidth=0.7, linestyle=":")
    axes.set_xlabel(shortening_label(test))
    legend_above(made, axes)
    name_job(made, test.job.job)


def draw_event(test: Compression, path: Path) -> Path:
    """Draw what breaks over end shortening, with the stress above."""
    energy = test.job.energy()
    with figure(2, size=(NARROW, 4.2), sharex=True) as (made, (upper, lower)):
        upper.plot(test.shortening, test.stress, color=QUIET)
        upper.set_ylabel(stress_label(test))
        moved = np.interp(energy["time"], test.time, test.shortening)
        _energies(lower, test, moved)
        lower.set_xlabel(shortening_label(test))
        for axes in (upper, lower):
            axes.axvline(test.shortening[test.peak], color=QUIET, linewidth=0.7, linestyle=":")
        made.align_ylabels([upper, lower])
        legend_above(made, lower)
        name_job(made, test.job.job)
        return save(made, path)


def _energies(axes: Axes, test: Compression, moved: np.ndarray) -> None:
    """What each mechanism has taken since the start of the stage."""
    energy = test.job.energy()
    taken = {name: energy[name] - energy[name][0] for name in EVENTS if name in energy}
    size = max((float(np.max(values)) for values in taken.values()), default=0.0)
    scale = readable(energy.unit("internal"), size)
    for place, (name, values) in enumerate(taken.items()):
        axes.plot(moved, values * scale.factor, label=EVENTS[name], **look_of(place))
    axes.set_ylabel(in_brackets("Dissipated", scale.unit))
