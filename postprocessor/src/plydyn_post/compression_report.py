"""One page over a chain of stages that ends with a compression test."""

from __future__ import annotations

import csv
from collections.abc import Callable
from functools import partial
from pathlib import Path

from plydyn_post.compression import EVENTS, MOST_BENDING, QUASI_STATIC, Compression
from plydyn_post.compression_figures import (
    draw_delamination,
    draw_event,
    draw_faces,
    draw_gauges,
    draw_stress,
)
from plydyn_post.compression_place import place_words
from plydyn_post.damage_report import damage_tasks
from plydyn_post.page import PageTable
from plydyn_post.plan import Plan, Task
from plydyn_post.report import Report, make_report
from plydyn_post.stages_report import stage_table, tasks_of_stage
from plydyn_post.units import in_brackets, readable

#: Section of the impact that says nothing of the strength
LEFT_OUT = "Through the thickness"


def compression_report(
    plan: Plan,
    test: Compression,
    pristine: Compression | None,
    tick: Callable[[str], None] = lambda _: None,
) -> Report:
    """Write the page: stages, strength, figures of the test, and those of the impact."""
    plan.folder.mkdir(parents=True, exist_ok=True)
    numbers = strength_table(test, pristine)
    write_table(numbers, plan.folder / "strength.csv")
    return make_report(
        plan,
        report_tasks(plan, test, pristine),
        tick,
        (stage_table(plan.jobs), numbers),
        [note for one in (test, pristine) if one is not None for note in notes_of(one)],
    )


def report_tasks(plan: Plan, test: Compression, pristine: Compression | None) -> list[Task]:
    """Figures of the test, damage at its end, and all of the stages with an impactor."""
    tests = (test,) if pristine is None else (test, pristine)
    section = "Tension" if test.pulled else "Compression"
    wanted = (
        ("stress", f"Stress over {test.moved}; the peak is marked.", partial(draw_stress, tests)),
        (
            "gauges",
            "Strain gauges back to back, and percent bending from a fifth of the peak on.",
            partial(draw_gauges, test),
        ),
        ("faces", "Both faces in the middle of the plate.", partial(draw_faces, test)),
        ("event", "What breaks; the dotted line is the peak.", partial(draw_event, test)),
    )
    tasks = [Task(section, f"compression_{name}", text, draw) for name, text, draw in wanted]
    if test.job.has("delamination"):
        draw = partial(draw_delamination, test)
        text = f"Delaminated area over {test.moved}."
        tasks.append(Task(section, "compression_delamination", text, draw))
    for job in plan.jobs:
        if job.impactors:
            tasks += [task for task in tasks_of_stage(plan, job) if task.section != LEFT_OUT]
    if not test.job.impactors:
        tasks += damage_tasks(plan.alone(test.job))
    return tasks


def strength_table(test: Compression, pristine: Compression | None) -> PageTable:
    """The numbers of the test, and of the pristine plate beside it."""
    tests = [test] if pristine is None else [test, pristine]
    length, stress = (test.units.get(kind, "") for kind in ("length", "stress"))
    force = readable(test.units.get("force", ""), test.strength * test.width * test.thickness)
    quantities: list[tuple[str, str, Callable[[Compression], float]]] = [
        ("strength, peak force / (w h)", stress, lambda one: one.strength),
        (
            "peak force",
            force.unit,
            lambda one: one.strength * one.width * one.thickness * force.factor,
        ),
        (f"{test.moved} at the peak", length, lambda one: float(one.shortening[one.peak])),
        ("mean strain at the peak", "µm/m", lambda one: 1.0e6 * one.strain),
        ("bending at the peak", "%", lambda one: one.bending),
        ("largest kinetic / internal energy", "%", lambda one: 100.0 * one.kinetic_share()),
    ]
    rows = [
        (in_brackets(name, unit), *(f"{value(one):.4g}" for one in tests))
        for name, unit, value in quantities
    ]
    taken = [one.broken() for one in tests]
    scale = readable(test.job.energy().unit("internal"), max(taken[0].values(), default=0.0))
    for name in taken[0]:
        cells = (f"{each.get(name, 0.0) * scale.factor:.4g}" for each in taken)
        rows.append((in_brackets(f"taken by {EVENTS[name]} in the fall", scale.unit), *cells))
    if pristine is not None:
        rows.append(("strength / that of the pristine plate", f"{ratio(test, pristine):.4g}", "1"))
    heads = ("", *(one.job.job for one in tests))
    return PageTable("Strength", heads, tuple(rows), event_words(test))


def ratio(test: Compression, pristine: Compression) -> float:
    """Strength that is left."""
    return test.strength / pristine.strength


def event_words(test: Compression) -> str:
    """What ended the test, by the energy that it took."""
    if test.fallen is None:
        return "The stress has not fallen from its peak: the strength may be higher."
    taken = test.broken()
    whole = sum(taken.values())
    if whole <= 0.0:
        return "The stress fell and nothing broke: the plate gave way by bending."
    order = sorted(taken, key=lambda one: -taken[one])
    shares = ", ".join(f"{EVENTS[name]} {taken[name] / whole:.0%}" for name in order)
    fall = f"{test.stress[test.fallen] / test.strength:.0%}"
    words = f"Energy that broke while the stress fell to {fall} of its peak: {shares}."
    return " ".join(filter(None, (words, place_words(test))))


def notes_of(test: Compression) -> tuple[str, ...]:
    """What makes a test doubtful."""
    notes, name = [], test.job.job
    share = test.kinetic_share()
    if share > QUASI_STATIC:
        notes.append(
            f"{name}: the kinetic energy reaches {share:.1%} of the internal one, more than"
            f" {QUASI_STATIC:.0%}: not quasi-static; load more slowly"
        )
    if test.bending > MOST_BENDING:
        notes.append(
            f"{name}: the gauges bend by {test.bending:.3g} % at the peak, more than"
            f" {MOST_BENDING:g} %"
        )
    if test.fallen is None:
        notes.append(f"{name}: the stress has not fallen from its peak; the strength may be higher")
    return tuple(notes)


def write_table(table: PageTable, path: Path) -> Path:
    """Write a table as CSV."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("quantity", *table.headings[1:]))
        writer.writerows(table.rows)
    return path
