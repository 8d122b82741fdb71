"""Curves over time and the numbers read off them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plydyn_post.contact import SILENT, contact, touching
from plydyn_post.dent import is_moving, read_dent
from plydyn_post.errors import ResultsError
from plydyn_post.results import Results
from plydyn_post.table import Table, whole_words
from plydyn_post.units import factor
from plydyn_post.units import size as known

# Time that the running mean of a force spans when no other is asked for, s
MEAN_SPAN = 20e-6
# Share of the peak that noise must have for the running mean to be worth drawing
NOISE_SHARE = 0.02
# Why there is no dent yet
MOVING = (
    "the plate still moves, so there is no dent yet: let it settle by a stage with at_rest that"
    " removes the impactor, and give its job behind this one"
)


@dataclass(frozen=True)
class Numbers:
    """What an impact comes to, in the units of the job; nothing where it is not known yet.

    The displacement is the largest during the contact; energies are those the impactor gave.
    The indentation is that of the impactor against the opposite face, the dent the depth of the
    struck face below the plate around at a last state after the contact. Duration and impulse of
    a contact that has not ended are those so far.
    """

    peak_force: float
    peak_time: float
    contact_start: float
    contact_duration: float
    mean_peak_force: float
    impulse: float
    largest_displacement: float
    impact_velocity: float
    rebound_velocity: float | None
    absorbed_energy: float | None
    largest_absorbed_energy: float | None
    energy_error: float | None
    largest_indentation: float | None = None
    dent_depth: float | None = None
    has_ended: bool = True  # the contact
    notes: tuple[str, ...] = ()


def read_numbers(results: Results, impactor: int | None = None) -> Numbers:
    """Read the numbers of an impactor, of the first without its number."""
    table = results.impactor(impactor)
    time, force, velocity = table["time"], table["force"], table["velocity"]
    peak = int(np.argmax(np.abs(force)))
    start, end = contact(time, force)
    mean = usual_mean(table)
    during = (time >= start) & (time <= end)
    over = abs(force[-1]) <= SILENT * abs(force[peak]) and force[peak] != 0.0
    absorbed = table.get("absorbed")
    indentation, depth, told = _dent(results, impactor, table, end if over else np.inf)
    return Numbers(
        peak_force=float(force[peak]),
        peak_time=float(time[peak]),
        contact_start=start,
        contact_duration=end - start,
        mean_peak_force=float(mean[np.argmax(np.abs(mean))]),
        impulse=float(np.trapezoid(force, time)),
        largest_displacement=float(np.max(np.abs(table["displacement"][during]), initial=0.0)),
        impact_velocity=float(velocity[0]),
        rebound_velocity=float(np.interp(end, time, velocity)) if over else None,
        absorbed_energy=(
            float(np.interp(end, time, absorbed)) if over and absorbed is not None else None
        ),
        largest_absorbed_energy=None if absorbed is None else float(np.max(absorbed)),
        energy_error=_energy_error(results),
        largest_indentation=indentation,
        dent_depth=depth,
        has_ended=bool(over or not np.any(force)),
        notes=_notes(force) + ((part,) if (part := whole_words(table.copies)) else ()) + told,
    )


def _dent(
    results: Results, impactor: int | None, table: Table, end: float
) -> tuple[float | None, float | None, tuple[str, ...]]:
    """Largest indentation, dent at a last state after the contact, and what cannot be read."""
    try:
        dent = read_dent(results, impactor)
    except ResultsError as error:
        return None, None, (str(error),)
    if dent is None:
        return None, None, ()
    unit = table.unit("displacement")
    scale = factor(dent.length or unit, unit)
    seen = dent.indentation[np.isfinite(dent.indentation)]
    indentation = scale * float(np.max(seen)) if len(seen) else None
    over = dent.times[-1] >= end
    if over and is_moving(results, results):
        return indentation, None, (MOVING,)
    return indentation, scale * float(dent.struck[-1]) if over else None, ()


def _notes(force: np.ndarray) -> tuple[str, ...]:
    """What to know of the numbers of an impact."""
    if not np.any(force):
        return ("the impactor never touched the plate",)
    inside = touching(force)
    begun = ("the impactor is in contact when the run begins",) if inside[0] == 0 else ()
    still = ("the impactor is still in contact at the end of the run",)
    return begun + (still if inside[-1] == len(force) - 1 else ())


def running_mean(time: np.ndarray, values: np.ndarray, window: float) -> np.ndarray:
    """The mean over a window of time around each sample, or what there is of it, (samples,).

    Half of the window is left at either end, enough to take noise out there, too.
    """
    if window <= 0.0 or len(time) < 3 or time[-1] <= time[0]:
        return values
    first = np.maximum(time - 0.5 * window, time[0])
    last = np.minimum(time + 0.5 * window, time[-1])
    return (_integral(time, values, last) - _integral(time, values, first)) / (last - first)


def usual_mean(table: Table, column: str = "force") -> np.ndarray:
    """The running mean of a force over its usual window, (samples,)."""
    return running_mean(table["time"], table[column], mean_window(table))


def _integral(time: np.ndarray, values: np.ndarray, upto: np.ndarray) -> np.ndarray:
    """The integral of straight lines between the samples from the first one to some times."""
    steps = np.diff(time)
    whole = np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * steps)])
    slope = np.divide(np.diff(values), steps, out=np.zeros_like(steps), where=steps > 0.0)
    k = np.clip(np.searchsorted(time, upto, side="right") - 1, 0, len(steps) - 1)
    rest = upto - time[k]
    return whole[k] + rest * (values[k] + 0.5 * slope[k] * rest)


def mean_window(table: Table) -> float:
    """The usual window of the running mean of a force: 20 µs, in the unit of its times.

    Times without a known unit are taken as seconds.
    """
    unit = table.unit("time")
    return MEAN_SPAN * factor("s", unit if known(unit) else "s")


def is_noisy(values: np.ndarray, mean: np.ndarray) -> bool:
    """Whether a curve differs visibly from its running mean."""
    size = float(np.max(np.abs(values), initial=0.0))
    return size > 0.0 and float(np.max(np.abs(values - mean))) > NOISE_SHARE * size


def _energy_error(results: Results) -> float | None:
    """The largest error of the energy balance, a share; nothing without a history of energy."""
    if not (results.folder / f"{results.job}.energy.csv").is_file():
        return None
    table = results.energy()
    return float(np.max(np.abs(table["error"])))
