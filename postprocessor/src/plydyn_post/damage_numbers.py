"""What an impact broke: areas by two measures, energies, and the forces at which it began."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from plydyn_post.areas import DAMAGED, damaged_areas
from plydyn_post.curves import mean_window, running_mean
from plydyn_post.dissipation import MECHANISMS, mechanisms
from plydyn_post.interfaces import area_columns
from plydyn_post.results import Results
from plydyn_post.table import Table

#: Fall of the 20 µs mean, as a share of its peak, that is a drop of the force
DROP = 0.05
#: Delaminated area at which the force is read off, mm2
BEGUN = 1.0
_MM2 = {"m2": 1e-6, "cm2": 1e-2, "um2": 1e6}

Number = tuple[str, float | None, str]  # name, value, unit


def damage_numbers(job: Results, history: Table) -> Iterator[Number]:
    """Forces of the threshold, areas at the end, and energies by mechanism."""
    force, unit = _mean_force(history), history.unit("force")
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


def _mean_force(history: Table) -> np.ndarray:
    """The usual running mean of the size of the contact force."""
    return np.abs(running_mean(history["time"], history["force"], mean_window(history)))


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
