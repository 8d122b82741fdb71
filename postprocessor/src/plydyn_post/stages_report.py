"""One page over a chain of stages: what each one came to, with its figures and pictures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from plydyn_post.dent import is_moving, read_permanent_dent, struck_by
from plydyn_post.errors import ResultsError
from plydyn_post.page import PageTable
from plydyn_post.plan import Plan, Task, file_name
from plydyn_post.report import Report, make_report, tasks_of
from plydyn_post.results import Results
from plydyn_post.style import figure, legend_above, look_of, name_job, save
from plydyn_post.units import in_brackets, readable

#: What the columns of prescribed motions begin with
MOTIONS = ("motion", "face motion")


def stages_report(
    plan: Plan, notes: Sequence[str] = (), tick: Callable[[str], None] = lambda _: None
) -> Report:
    """Write the page: a table of the stages, and the figures and pictures of each."""
    plan.folder.mkdir(parents=True, exist_ok=True)
    return make_report(plan, stages_tasks(plan), tick, (stage_table(plan.jobs),), notes)


def stages_tasks(plan: Plan) -> list[Task]:
    """All images of all stages."""
    return [task for job in plan.jobs for task in tasks_of_stage(plan, job)]


def tasks_of_stage(plan: Plan, job: Results) -> list[Task]:
    """All images of a stage; where several stages have an impactor, their names tell them apart."""
    tasks = tasks_of(plan.alone(job))
    if moves(job):
        words = f"Forces of what is moved in {job.job}."
        draw = partial(draw_motions, job)
        tasks.append(Task("Moved ends", f"motions_{file_name(job.job)}", words, draw))
    if sum(bool(one.impactors) for one in plan.jobs) < 2:
        return tasks
    return [task if job.job in task.name else _named(task, job) for task in tasks]


def _named(task: Task, job: Results) -> Task:
    """A task with the job in its name and caption."""
    name = f"{task.name}_{file_name(job.job)}"
    return replace(task, name=name, caption=f"{job.job}: {task.caption}")


def stage_table(jobs: Sequence[Results]) -> PageTable:
    """Time, energy taken, delaminated area and dent at the end of every stage."""
    rows = []
    time_unit = energy_unit = area_unit = dent_unit = ""
    impact: Results | None = None
    for job in jobs:
        impact = job if struck_by(job) else impact
        dent, unit = _dent(job, impact)
        dent_unit = unit or dent_unit
        energy = job.energy()
        time = readable(energy.unit("time"), float(energy["time"][-1]))
        spent = readable(energy.unit("internal"), 1.0e9)
        time_unit, energy_unit = time.unit, spent.unit
        dissipated = energy.get("dissipated")
        area = "–"
        if job.has("delamination"):
            table = job.delamination()
            area_unit = table.unit("projected area")
            area = f"{table['projected area'][-1]:.4g}"
        rows.append(
            (
                job.job,
                f"{energy['time'][0] * time.factor:.4g} to {energy['time'][-1] * time.factor:.4g}",
                "–" if dissipated is None else f"{dissipated[-1] * spent.factor:.4g}",
                area,
                dent,
                f"{100.0 * float(np.max(np.abs(energy['error']))):.2g}",
            )
        )
    headings = (
        "stage",
        in_brackets("time", time_unit),
        in_brackets("dissipated", energy_unit),
        in_brackets("delaminated, seen from above", area_unit),
        in_brackets("dent", dent_unit),
        "energy error [%]",
    )
    return PageTable("Stages", headings, tuple(rows), "At the end of each stage.")


def _dent(job: Results, impact: Results | None) -> tuple[str, str]:
    """Depth of the dent of the last impact for print, and its unit; only of a plate at rest."""
    body = None if impact is None else struck_by(impact)
    if impact is None or body is None or moves(job):  # which loads the plate
        return "–", ""
    if is_moving(job, impact):
        return "still moves", ""
    found = read_permanent_dent(job, body)
    return ("–", "") if found is None else (f"{found.struck:.3g}", found.length)


def moves(job: Results) -> list[str]:
    """Names of the columns of prescribed motions that a force acts on."""
    if not job.has("supports"):
        return []
    table = job.supports()
    return [name for name in table.names if name.startswith(MOTIONS) and np.any(table[name])]


def draw_motions(job: Results, path: Path) -> Path:
    """Draw the forces of prescribed motions over time."""
    names = moves(job)
    if not names:
        raise ResultsError(f"{job.job} has no prescribed motion with a force")
    table = job.supports()
    time = readable(table.unit("time"), float(table["time"][-1]))
    largest = max(float(np.max(np.abs(table[name]))) for name in names)
    force = readable(table.unit(names[0]), largest)
    with figure() as (made, axes):
        for place, name in enumerate(names):
            values = table[name] * force.factor
            axes.plot(table["time"] * time.factor, values, label=name, **look_of(place))
        axes.set_xlabel(in_brackets("Time", time.unit))
        axes.set_ylabel(in_brackets("Force", force.unit))
        legend_above(made, axes)
        name_job(made, job.job)
        return save(made, path)
