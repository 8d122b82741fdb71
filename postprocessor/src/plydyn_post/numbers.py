"""The numbers of jobs side by side, in units that read well."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from plydyn_post.areas import DAMAGED, damaged_areas
from plydyn_post.curves import MOVING, Numbers, read_numbers, usual_mean
from plydyn_post.dent import is_moving, read_permanent_dent
from plydyn_post.dissipation import MECHANISMS, mechanisms
from plydyn_post.errors import ResultsError
from plydyn_post.header import read_header
from plydyn_post.interfaces import area_columns
from plydyn_post.results import Results, labelled, notes_of_runs
from plydyn_post.table import Table, cell, write_csv
from plydyn_post.units import Scale, factor, in_brackets, kind_of, readable

# Name in print, attribute of Numbers, and the columns whose units it has
QUANTITIES = (
    ("peak force", "peak_force", ("force",)),
    ("peak of its 20 µs mean", "mean_peak_force", ("force",)),
    ("time of peak force", "peak_time", ("time",)),
    ("start of contact", "contact_start", ("time",)),
    ("contact duration", "contact_duration", ("time",)),
    ("impulse", "impulse", ("force", "time")),
    ("largest displacement", "largest_displacement", ("displacement",)),
    ("largest indentation", "largest_indentation", ("displacement",)),
    ("dent depth at the end", "dent_depth", ("displacement",)),
    ("impact velocity", "impact_velocity", ("velocity",)),
    ("rebound velocity", "rebound_velocity", ("velocity",)),
    ("absorbed energy", "absorbed_energy", ("absorbed",)),
    ("largest energy passed on", "largest_absorbed_energy", ("absorbed",)),
    ("energy error", "energy_error", ()),
)
# The dent after a stage without an impactor, such as one that brings the plate to rest
LATER = "permanent dent, after settling"
# Its parts: the dent is the bulge, plus what the plies have lost, less the gaps between them
BULGE = "bulge of the opposite face, after settling"
THINNER = "plies thinner below the impact, after settling"
GAPS = "gaps between plies below the impact, after settling"
# Those that grow until the contact ends
GROWING = ("contact duration", "impulse")
#: Fall of the 20 µs mean, as a share of its peak, that is a drop of the force
DROP = 0.05
#: Delaminated area at which the force is read off, mm2
BEGUN = 1.0
_MM2 = {"m2": 1e-6, "cm2": 1e-2, "um2": 1e6}

Number = tuple[str, float | None, str]  # name, value, unit


@dataclass(frozen=True)
class Row:
    """A quantity with its value for each impact; nothing where it is not known."""

    name: str
    unit: str
    values: tuple[float | None, ...]
    growing: tuple[bool, ...]  # whether the value is that of a contact that has not ended

    def known(self) -> tuple[float | None, ...]:
        """The values but those that still grow."""
        pairs = zip(self.values, self.growing, strict=True)
        return tuple(None if growing else value for value, growing in pairs)

    def texts(self) -> list[str]:
        """The values for print."""
        return [
            "–" if value is None else f"{value:.4g}" + (" so far" if growing else "")
            for value, growing in zip(self.values, self.growing, strict=True)
        ]


@dataclass(frozen=True)
class Comparison:
    """Quantities of several impacts."""

    labels: tuple[str, ...]
    rows: tuple[Row, ...]
    ended: tuple[bool, ...]  # whether the contact of each has
    notes: tuple[str, ...]


def compare(jobs: list[Results]) -> Comparison:
    """The numbers of every impactor of every job, in the same units."""
    impacts = list(_impacts(jobs))
    if not impacts:
        raise ResultsError(f"no impactor has a history in {', '.join(job.job for job in jobs)}")
    found: list[dict[str, tuple[float | None, str]]] = []
    settled: list[bool] = []
    for _, job, number, numbers in impacts:
        own = {
            name: (getattr(numbers, attribute), _unit(job, number, columns))
            for name, attribute, columns in QUANTITIES
        }
        later = _later_dent(jobs, job, number)
        own |= later
        settled.append(bool(later))
        broken = _damage_numbers(job, job.impactor(number))
        found.append(own | {name: (value, unit) for name, value, unit in broken})
    names = list(dict.fromkeys(name for own in found for name in own))
    units = {name: next(own[name][1] for own in found if name in own) for name in names}
    scales = _scales(found, units)
    ended = tuple(numbers.has_ended for *_, numbers in impacts)
    rows = tuple(
        Row(
            name,
            scales[name].unit,
            tuple(_scaled(own.get(name, (None, "")), units[name], scales[name]) for own in found),
            tuple(name in GROWING and not over for over in ended),
        )
        for name in names
    )
    of_impacts = (
        f"{label}: {note}"
        for (label, *_, numbers), is_settled in zip(impacts, settled, strict=True)
        for note in numbers.notes
        if not (is_settled and note == MOVING)
    )
    notes = (*notes_of_runs(jobs), *of_impacts)
    return Comparison(tuple(label for label, *_ in impacts), rows, ended, notes)


def _damage_numbers(job: Results, history: Table) -> Iterator[Number]:
    """Forces of the threshold, areas at the end, and energies by mechanism."""
    force, unit = np.abs(usual_mean(history)), history.unit("force")
    drop = first_drop(force)
    yield "force at the first drop", None if drop is None else force[drop], unit
    if job.has("delamination"):
        table = job.delamination()
        area = table.unit("projected area")
        each = np.sum([table[name] for name in area_columns(table).values()], axis=0)
        begun = BEGUN * _MM2.get(area, 1.0)
        found = np.interp(table["time"][np.argmax(each >= begun)], history["time"], force)
        known = found if each[-1] >= begun else None
        yield f"force at {BEGUN * _MM2.get(area, 1.0):g} {area} delaminated", known, unit
        yield "projected area, half of the fracture energy", table["projected area"][-1], area
        yield "sum of the interfaces, half of the fracture energy", each[-1], area
        yield from _damaged_areas(job, area)
    if job.has("energy"):
        energy = job.energy()
        for name, taken in mechanisms(energy).items():
            yield f"dissipated, {MECHANISMS[name]}", taken[-1], energy.unit(name)


def first_drop(force: np.ndarray) -> int | None:
    """Sample from which a force first falls by a share of its peak, before the peak; or none."""
    so_far = np.maximum.accumulate(force)
    peak = int(np.argmax(force))
    fallen = np.flatnonzero(so_far[:peak] - force[:peak] > DROP * force[peak])
    return int(np.argmax(force[: fallen[0]])) if len(fallen) else None


def _damaged_areas(job: Results, unit: str) -> Iterator[Number]:
    """Areas of the last state beyond a damage."""
    found: tuple[float | None, float | None] = (None, None)
    if job.interface_fields.is_file():
        areas = damaged_areas(job)
        found = areas.projected, areas.total
    for name, value in zip(("projected area", "sum of the interfaces"), found, strict=True):
        yield f"{name}, damage {DAMAGED:g}", value, unit


def _scales(
    found: list[dict[str, tuple[float | None, str]]], units: dict[str, str]
) -> dict[str, Scale]:
    """One unit of print for all quantities of a kind, in which the largest one reads well."""
    first: dict[str, str] = {}
    largest: dict[str, float] = {}
    for own in found:
        for value, unit in own.values():
            kind = kind_of(unit)
            size = abs(value or 0.0) * factor(unit, first.setdefault(kind, unit))
            largest[kind] = max(largest.get(kind, 0.0), size)
    chosen = {kind: readable(unit, largest[kind]).unit for kind, unit in first.items()}
    return {
        name: Scale(factor(unit, chosen[kind_of(unit)]), chosen[kind_of(unit)])
        for name, unit in units.items()
    }


def _scaled(own: tuple[float | None, str], unit: str, scale: Scale) -> float | None:
    """A value in the unit of print."""
    value, given = own
    return None if value is None else float(value) * factor(given, unit) * scale.factor


def _impacts(jobs: list[Results]) -> Iterator[tuple[str, Results, int, Numbers]]:
    """Label, job, number of the impactor, and its numbers."""
    for label, job in labelled(jobs):
        for number in job.impactors:
            own = label if len(job.impactors) == 1 else f"{label} impactor {number}"
            yield own, job, number, read_numbers(job, number)


def _later_dent(
    jobs: list[Results], job: Results, number: int
) -> dict[str, tuple[float | None, str]]:
    """The dent at the end of the next job and its parts, where that goes on without an impactor."""
    place = jobs.index(job) + 1
    if place == len(jobs) or jobs[place].impactors or not goes_on(job, jobs[place]):
        return {}
    found = read_permanent_dent(jobs[place], read_header(job.fields).impactors[number])
    if found is None or is_moving(jobs[place], job):
        return {}
    unit = _unit(job, number, ("displacement",))
    scale = factor(found.length or unit, unit)
    parts = {LATER: found.struck, BULGE: found.bulge, THINNER: found.thinner, GAPS: found.gaps}
    return {name: (None if one is None else scale * one, unit) for name, one in parts.items()}


def goes_on(job: Results, later: Results) -> bool:
    """Whether a job begins at the time at which another one ends."""
    end, start = float(job.energy()["time"][-1]), float(later.energy()["time"][0])
    return abs(start - end) <= 1e-6 * abs(end)


def _unit(job: Results, number: int, columns: tuple[str, ...]) -> str:
    """The unit of the numbers of a quantity; a share without columns."""
    if not columns:
        return "-"
    table = job.impactor(number)
    units = [table.unit(column) if column in table else "" for column in columns]
    return ".".join(units) if all(units) else ""


def as_json(comparison: Comparison) -> str:
    """All numbers with their units for programs; unknown ones are null."""
    jobs = [
        {
            "job": label,
            "contact ended": comparison.ended[place],
            "numbers": {
                row.name: {"value": row.values[place], "unit": row.unit} for row in comparison.rows
            },
        }
        for place, label in enumerate(comparison.labels)
    ]
    words = {"jobs": jobs, "notes": list(comparison.notes)}
    return json.dumps(words, indent=2, ensure_ascii=False)


def write_numbers(comparison: Comparison, path: Path) -> Path:
    """Write a CSV with one line per impact; unknown numbers are left empty."""
    names = (in_brackets(row.name, row.unit) for row in comparison.rows)
    lines = [["job", *names, "contact ended"]]
    for place, label in enumerate(comparison.labels):
        values = (row.values[place] for row in comparison.rows)
        ended = "yes" if comparison.ended[place] else "no"
        lines.append([label, *map(cell, values), ended])
    return write_csv(path, lines)
