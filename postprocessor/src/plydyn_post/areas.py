"""Delaminated areas over time, by the two usual measures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from plydyn_post.errors import ResultsError
from plydyn_post.grid import read_times
from plydyn_post.interfaces import Areas, read_interfaces
from plydyn_post.results import Results
from plydyn_post.scan import drawn_areas
from plydyn_post.sheets import sheets_of
from plydyn_post.table import Table

#: Damage from which on other codes and tests call an interface delaminated
DAMAGED = 0.99
#: Half of the fracture energy spent, or that damage
MEASURES = ("energy", "damage")


def damaged_areas(results: Results, time: float | None = None) -> Areas:
    """Areas beyond that damage at a state, halfway between the nodes beyond it and others."""
    state = read_interfaces(replace(results, mirror="auto"), time)
    beyond = sheets_of((one.places, (one.damage >= DAMAGED).astype(float)) for one in state.each)
    return drawn_areas(state, beyond)


def area_history(results: Results, measure: str = "energy") -> Table:
    """Areas of the interfaces over time, of the whole plate.

    Those of half of the fracture energy are the solver's at its own interval; those of complete
    damage are measured at the states of the fields.
    """
    if measure not in MEASURES:
        raise ResultsError(f"{measure!r} is no measure of areas; right would be energy or damage")
    if measure == "energy":
        return results.delamination()
    times = read_times(results.interface_fields)
    each = [damaged_areas(results, float(time)) for time in times]
    numbers = sorted({number for areas in each for number in areas.each})
    rows = [
        [time, *(areas.each.get(one, 0.0) for one in numbers), areas.total, areas.projected]
        for time, areas in zip(times, each, strict=True)
    ]
    names = ("time", *(f"interface {one} area" for one in numbers), "sum", "projected area")
    unit_of_time = read_interfaces(results).header.units.get("time", "")
    units = (unit_of_time, *[each[0].unit] * (len(numbers) + 2))
    return Table(results.interface_fields, names, units, np.array(rows))
