"""What converges on the ladder, in numbers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from plydyn_post.curves import read_numbers
from plydyn_post.results import Results

from studies.differences import PLATEAU, force_difference, mean_force, velocity_difference
from studies.jobs import freedoms_of
from studies.markdown import table
from studies.rungs import CONTACTS, Found, cases, pick
from studies.stress import agreements, percent

MS, METRES = 1e3, 1e-3


def numbers_text(found: Sequence[Found]) -> str:
    """What an analyst reads off each run of the usual order."""
    headings = (
        "mesh and contact",
        "quads",
        "DOF",
        "points apart [mm]",
        "most in contact",
        "peak force, raw [N]",
        "20 µs mean [N]",
        "first plateau [N]",
        "duration [ms]",
        "displacement [mm]",
        "rebound [m/s]",
        "energy error [-]",
    )
    return table(headings, [_numbers_row(one) for one in pick(found)])


def _numbers_row(one: Found) -> list[str]:
    numbers, (time, force) = read_numbers(one.results), mean_force(one.results)
    rebound = numbers.rebound_velocity
    return [
        f"{one.rung.case}_{one.rung.contact}",
        f"{one.rung.quads:,}",
        f"{freedoms_of(one.results):,}",
        f"{one.rung.spacing:.3g}",
        f"{one.results.impactor()['contacts'].max():.0f}",
        f"{numbers.peak_force:.0f}",
        f"{force.max():.0f}",
        f"{force[time < PLATEAU].max():.0f}",
        f"{numbers.contact_duration * MS:.3f}",
        f"{numbers.largest_displacement:.3f}",
        "in contact" if rebound is None else f"{rebound * METRES:.3f}",
        f"{numbers.energy_error or 0.0:.0e}",
    ]


def meshes_text(found: Sequence[Found]) -> str:
    """Differences to the finest run, and between both contact discretisations on each mesh."""
    finest = pick(found)[-1]
    headings = [f"mesh; to {finest.rung.case}_{finest.rung.contact}", "points apart [mm]"]
    for pair in (*CONTACTS, "points to nodes"):
        headings += [f"{pair}: force", "first contact", "velocity"]
    rows = []
    for case in cases(found):
        nodes, points = (pick(found, case, contact)[0] for contact in CONTACTS)
        texts = _differences(nodes.results, finest.results)
        texts += _differences(points.results, finest.results)
        texts += _differences(points.results, nodes.results)
        rows.append([case, f"{nodes.rung.spacing:.3g}", *texts])
    return table(headings, rows)


def _differences(ours: Results, theirs: Results) -> list[str]:
    """Differences in force over the run, over the first contact, and in velocity, in print."""
    if ours == theirs:
        return ["0"] * 3
    end = first_end(theirs)
    shares = (
        force_difference(ours, theirs),
        force_difference(ours, theirs, end),
        velocity_difference(ours, theirs),
    )
    return [percent(share) for share in shares]


def first_end(results: Results) -> float:
    """The end of the contact during which the mean force is largest."""
    time, force = mean_force(results)
    peak = int(np.argmax(force))
    silent = np.flatnonzero(force[peak:] <= 1e-3 * force[peak])
    return float(time[peak + silent[0]]) if len(silent) else float(time[-1])


def orders_text(found: Sequence[Found], orders: Sequence[int]) -> str:
    """Differences of lower orders to the highest: force and velocity, and shear at (40, 40)."""
    best = max(orders)
    headings = (
        f"mesh and contact; to LE{best}",
        "order",
        "force",
        "first contact",
        "velocity",
        "syz at (40, 40): largest",
        "relative L2",
        "over the run",
        "means of plies, L2",
        "largest jump between plies",
    )
    rows = []
    for case in cases(found, best):
        for contact in CONTACTS:
            jobs = {f"LE{n}": pick(found, case, contact, n)[0].results for n in orders}
            rows += _order_rows(f"{case}_{contact}", jobs, f"LE{best}")
    return table(headings, rows)


def _order_rows(name: str, jobs: dict[str, Results], best: str) -> list[list[str]]:
    shear = agreements(jobs, best, 2, "syz")
    rows = []
    for order, job in jobs.items():
        one = shear[order]
        shares = (one.largest, one.size, one.whole, one.means, one.jump)
        rows.append([name, order, *_differences(job, jobs[best]), *map(percent, shares)])
    return rows
