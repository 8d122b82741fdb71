"""One page over a chain of stages that ends with a test of strength, and begins with that."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from plydyn_post.compression import Compression
from plydyn_post.compression_figures import (
    draw_delamination,
    draw_event,
    draw_faces,
    draw_gauges,
    draw_stress,
)
from plydyn_post.damage_report import damage_tasks
from plydyn_post.dent import struck_by
from plydyn_post.ending import Ending, ending_words, read_ending
from plydyn_post.header import read_header
from plydyn_post.maps import middle_of
from plydyn_post.page import PageTable
from plydyn_post.plan import Plan, Task
from plydyn_post.report import Report, cases_of, make_report
from plydyn_post.stages_report import stage_table, tasks_of_stage
from plydyn_post.strength import notes_of, strength_lights, strength_table, write_table
from plydyn_post.strength_assumed import assumed_table
from plydyn_post.sublaminate_figures import draw_gap, draw_sublaminates
from plydyn_post.units import readable
from plydyn_post.vtkhdf import layout_of

#: Section of the impact that says nothing of the strength
LEFT_OUT = "Through the thickness"
#: Sections with which the page begins
STRENGTH, ENDED, TRUSTED = "Strength", "What ended the test", "Can the strength be trusted?"


@dataclass(frozen=True)
class Judged:
    """A chain whose last stage is a test of strength, with what ended that."""

    plan: Plan
    test: Compression
    pristine: Compression | None
    ending: Ending


def judge(plan: Plan, test: Compression, pristine: Compression | None) -> Judged:
    """Find what ended a test."""
    plan = replace(plan, peak=float(test.time[test.peak]))
    return Judged(plan, test, pristine, read_ending(test))


def compression_report(judged: Judged, tick: Callable[[str], None] = lambda _: None) -> Report:
    """Write the page: the strength, what ended the test, lights, assumptions, and all stages."""
    plan, test, pristine = judged.plan, judged.test, judged.pristine
    plan.folder.mkdir(parents=True, exist_ok=True)
    write_table(strength_table(test, pristine), plan.folder / "strength.csv")
    notes = [note for one in (test, pristine) if one is not None for note in notes_of(one)]
    tables = (stage_table(plan.jobs),)
    return make_report(plan, report_tasks(judged), tick, tables, notes, first_tables(judged))


def first_tables(judged: Judged) -> tuple[PageTable, ...]:
    """The sections with which the page begins."""
    test, ending, jobs = judged.test, judged.ending, judged.plan.jobs
    cases = cases_of(judged.plan)
    return (
        strength_table(test, judged.pristine),
        ending_table(test, ending),
        PageTable(TRUSTED, lights=strength_lights(test, ending, cases)),
        assumed_table(jobs, test, ending, cases),
    )


def ending_table(test: Compression, ending: Ending) -> PageTable:
    """What ended the test, with what every interface did."""
    length = test.units.get("length", "")
    taken = [each for one in ending.interfaces for each in one.energies or ()]
    scale = readable(test.job.energy().unit("internal"), max(taken, default=0.0))
    heads = (
        "interface, plies below / above",
        f"thinner side [{length}]",
        f"gap at the start [{length}]",
        f"at the peak [{length}]",
        f"after the fall [{length}]",
        "open from, of the strength",
        f"taken up to the peak [{scale.unit}]",
        f"in the fall [{scale.unit}]",
    )
    rows = tuple(
        (
            f"{one.number}: {one.words}",
            f"{one.thickness:.3g}",
            *(f"{gap:.2g}" for gap in one.gaps),
            "–" if one.opened is None else f"{one.opened / test.strength:.0%}",
            *(f"{each * scale.factor:.3g}" for each in one.energies or ()),
        )
        for one in ending.interfaces
    )
    words = (
        "Gaps are the largest of each interface; it counts as open where its gap has grown by a"
        " tenth of its thinner side."
    )
    return PageTable(ENDED, heads, rows, words if rows else "", ending_words(test, ending))


def report_tasks(judged: Judged) -> list[Task]:
    """Figures of the test, damage at its end, and all of the stages with an impactor."""
    plan, test = judged.plan, judged.test
    tasks = [*_first_tasks(judged), *_test_tasks(test)]
    for job in plan.jobs:
        if job.impactors:
            tasks += [task for task in tasks_of_stage(plan, job) if task.section != LEFT_OUT]
    if not test.job.impactors:
        tasks += damage_tasks(plan.alone(test.job))
    return tasks


def _first_tasks(judged: Judged) -> list[Task]:
    """The curve of the strength, and the pictures of what ended the test."""
    test, pristine, ending = judged.test, judged.pristine, judged.ending
    tests = (test,) if pristine is None else (test, pristine)
    middle = _struck_place(judged)
    text = f"Stress over {test.moved}; the peak is marked."
    tasks = [Task(STRENGTH, "compression_stress", text, partial(draw_stress, tests))]
    if test.job.interface_fields.is_file() and ending.interfaces:
        text = "The plies next to the peak, with gaps between them drawn wider."
        draw = partial(draw_sublaminates, test, middle)
        tasks.append(Task(ENDED, "compression_sublaminates", text, draw))
    if ending.shown is not None:
        text = "Gap next to the peak of the interface that had opened, else of the one that grew."
        draw = partial(draw_gap, test, ending, middle)
        tasks.append(Task(ENDED, "compression_gap", text, draw))
    text = "What breaks; the dotted line is the peak."
    tasks.append(Task(ENDED, "compression_event", text, partial(draw_event, test)))
    return tasks


def _struck_place(judged: Judged) -> np.ndarray:
    """Where the last impact was, (2,); the middle of the plate without one."""
    hit = [job for job in judged.plan.jobs if struck_by(job)]
    header = read_header((hit[-1] if hit else judged.test.job).fields)
    return middle_of(header, layout_of(judged.test.job.fields).points[:, :2])


def _test_tasks(test: Compression) -> list[Task]:
    """Gauges, faces and delaminated area of the test."""
    section = "Tension" if test.pulled else "Compression"
    wanted = (
        (
            "gauges",
            "Strain gauges back to back, and percent bending from a fifth of the peak on.",
            partial(draw_gauges, test),
        ),
        ("faces", "Both faces in the middle of the plate.", partial(draw_faces, test)),
    )
    tasks = [Task(section, f"compression_{name}", text, draw) for name, text, draw in wanted]
    if test.job.has("delamination"):
        draw = partial(draw_delamination, test)
        text = f"Delaminated area over {test.moved}."
        tasks.append(Task(section, "compression_delamination", text, draw))
    return tasks
