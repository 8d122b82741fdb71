"""Ensembles: mean and band of the force, numbers with their spread, and where jobs delaminate."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from plydyn_post.curves import usual_mean
from plydyn_post.errors import ResultsError
from plydyn_post.interfaces import DELAMINATED
from plydyn_post.maps import (
    damage_bar,
    draw_damage,
    draw_plate,
    half_window,
    look_from_above,
    mark_impact,
    scale_bar,
)
from plydyn_post.numbers import Comparison
from plydyn_post.results import Results
from plydyn_post.scan import Scan, read_scan, worst_of
from plydyn_post.sheets import Sheet, edges_of
from plydyn_post.style import figure, save
from plydyn_post.table import cell, write_csv
from plydyn_post.units import in_brackets, readable

_MEASURES = ("mean", "deviation", "least", "most")


@dataclass(frozen=True)
class Spread:
    """A quantity over an ensemble."""

    name: str
    unit: str
    count: int  # of jobs in which it is known
    mean: float
    deviation: float
    least: float
    most: float


def spreads(comparison: Comparison, areas: list[float], unit: str) -> list[Spread]:
    """Mean and standard deviation of each quantity, and of the projected area if there is one."""
    rows = [(row.name, row.unit, row.known()) for row in comparison.rows]
    rows.append(("projected delaminated area", unit, tuple(areas)))
    found = []
    for name, own, values in rows:
        known = np.array([value for value in values if value is not None])
        if len(known) > 1:
            mean, deviation = float(known.mean()), float(known.std(ddof=1))
            ends = float(known.min()), float(known.max())
            found.append(Spread(name, own, len(known), mean, deviation, *ends))
    return found


def write_spreads(rows: list[Spread], path: Path) -> Path:
    """Write a CSV with one line per quantity."""
    lines: list[list[object]] = [["quantity", "unit", "jobs", *_MEASURES]]
    for row in rows:
        numbers = (cell(getattr(row, name)) for name in _MEASURES)
        lines.append([row.name, row.unit, row.count, *numbers])
    return write_csv(path, lines)


def draw_force_band(jobs: list[Results], path: Path) -> Path:
    """Running means of the force over time: all of them, their mean and their band."""
    tables = [job.impactor(job.impactors[0]) for job in jobs]
    time = tables[0]["time"]
    time = time[time <= min(table["time"][-1] for table in tables)]
    forces = np.array([np.interp(time, table["time"], usual_mean(table)) for table in tables])
    x = readable(tables[0].unit("time"), float(time.max()))
    y = readable(tables[0].unit("force"), float(forces.max()))
    with figure() as (made, axes):
        low, high = forces.min(axis=0) * y.factor, forces.max(axis=0) * y.factor
        axes.fill_between(time * x.factor, low, high, alpha=0.25, linewidth=0.0, label="band")
        mean = forces.mean(axis=0) * y.factor
        axes.plot(time * x.factor, mean, label=f"mean of {len(jobs)}")
        axes.set_xlabel(in_brackets("Time", x.unit))
        axes.set_ylabel(in_brackets("Contact force", y.unit))
        axes.margins(x=0.0)
        axes.legend()
        return save(made, path)


def probability(scans: list[Scan]) -> Sheet:
    """In which share of the jobs some interface is delaminated, over one mesh."""
    worst = [worst_of(scan.state, scan.sheets) for scan in scans]
    for one in worst[1:]:
        if one.places.shape != worst[0].places.shape or not np.allclose(
            one.places, worst[0].places, atol=1e-6
        ):
            raise ResultsError("the jobs of an ensemble have one mesh; these have several")
    share = np.mean([one.values >= DELAMINATED for one in worst], axis=0)
    return replace(worst[0], values=share)


def draw_probability(scans: list[Scan], path: Path) -> Path:
    """The probability of delamination as seen from above."""
    sheet, first = probability(scans), scans[0]
    half = half_window([sheet], first.middle, whole=False)
    with figure(size=(4.6, 4.0)) as (made, axes):
        look_from_above(axes, first.middle, half)
        draw_damage(axes, sheet)
        draw_plate(axes, edges_of(first.state.each[0].places))
        mark_impact(axes, first.middle)
        scale_bar(axes, first.middle, half, first.state.header.units.get("length", ""))
        damage_bar(made, [axes], f"Probability of delamination, {len(scans)} jobs")
        return save(made, path)


def read_scans(jobs: list[Results]) -> list[Scan]:
    """The interfaces of all jobs at their ends; none where one has no such fields."""
    if any(not job.has("delamination") for job in jobs):
        return []
    return [read_scan(job) for job in jobs]
