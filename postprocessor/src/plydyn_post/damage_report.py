"""The part of a report about damage: images for the jobs that have such results."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from plydyn_post.cscan import draw_cscan
from plydyn_post.delamination import draw_delamination
from plydyn_post.dissipation import draw_areas, draw_dissipation, mechanisms
from plydyn_post.errors import ResultsError
from plydyn_post.grid import has_point_field
from plydyn_post.plan import Plan, Task, file_name
from plydyn_post.ply_fields import MECHANISMS
from plydyn_post.ply_maps import draw_ply_maps
from plydyn_post.results import Results, labelled
from plydyn_post.section import draw_section

SECTION, WIDE_SECTION = "Damage", "Damage of interfaces and plies"


def damage_tasks(plan: Plan) -> list[Task]:
    """Images of damage and delamination at the time of the plan, else at the end."""
    return [
        Task(section, f"{name}_{file_name(label)}", caption.format(label), draw)
        for label, job in labelled(plan.jobs)
        for section, name, caption, draw in [*_between(plan, job), *_within(plan, job)]
    ]


_Made = tuple[str, str, str, Callable[[Path], object]]


def _between(plan: Plan, job: Results) -> list[_Made]:
    """Images of the interfaces and of what was dissipated."""
    made: list[_Made] = []
    if job.interface_fields.is_file():
        words = "Delaminated interfaces of {} as a scan shows them, coloured by depth."
        made.append((SECTION, "cscan", words, partial(draw_cscan, job, time=plan.time)))
    if job.has("delamination"):
        words = "Delaminated areas of {} over time."
        made.append((SECTION, "areas", words, partial(draw_areas, job)))
    if _dissipates(job):
        words = "Energy dissipated in {} by mechanism."
        made.append((SECTION, "dissipation", words, partial(draw_dissipation, job)))
    if job.interface_fields.is_file():
        words = "The interfaces of {}, delaminated inside white lines."
        draw = partial(draw_delamination, job, time=plan.time)
        made.append((WIDE_SECTION, "delamination", words, draw))
    return made


def _within(plan: Plan, job: Results) -> list[_Made]:
    """Images of the plies."""
    made: list[_Made] = []
    known = [name for name in MECHANISMS if has_point_field(job.fields, name)]
    if known:
        words = "Largest damage through the thickness of each ply of {}."
        made.append((WIDE_SECTION, "damage", words, partial(draw_ply_maps, job, time=plan.time)))
    if "damage_matrix" in known:
        words = "Matrix damage and cracks in cuts through the point of impact of {}."
        made.append((WIDE_SECTION, "section", words, partial(draw_section, job, time=plan.time)))
    return made


def _dissipates(job: Results) -> bool:
    """Whether any mechanism of damage took energy."""
    try:
        return any(taken[-1] > 0.0 for taken in mechanisms(job.energy()).values())
    except ResultsError:
        return False
