"""Everything about some jobs at once: figures, pictures, numbers and a page."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

import numpy as np

from plydyn_post.case import Case, read_case
from plydyn_post.damage_report import damage_tasks
from plydyn_post.dent import draw_dent
from plydyn_post.errors import ResultsError
from plydyn_post.figures import curves_of, draw_energy, draw_history
from plydyn_post.fixtures import FixtureSheet, draw_fixtures, fixture_sheet, write_sheet
from plydyn_post.grid import has_point_field
from plydyn_post.header import read_header
from plydyn_post.numbers import Comparison, compare, write_numbers
from plydyn_post.page import Image, PageTable, Sheet, write_page
from plydyn_post.picture import draw_picture
from plydyn_post.plan import Plan, Task, file_name
from plydyn_post.profile import IN_PLANE, INTERLAMINAR, draw_profiles, read_profiles
from plydyn_post.results import Results, labelled
from plydyn_post.scene import Wish

#: Share of the energy of a run that contact may give by round-off before a note
GIVEN = 0.01


@dataclass(frozen=True)
class Report:
    """What was made."""

    page: Path
    files: tuple[Path, ...]
    comparison: Comparison | None
    notes: tuple[str, ...] = field(default_factory=tuple)


def tasks_of(plan: Plan) -> list[Task]:
    """All images that the jobs have results for."""
    return [
        *_history_tasks(plan),
        *_dent_tasks(plan),
        *_fixture_tasks(plan),
        *_energy_tasks(plan),
        *damage_tasks(plan),
        *_profile_tasks(plan),
        *_picture_tasks(plan),
    ]


def make_report(
    plan: Plan,
    tasks: Sequence[Task],
    tick: Callable[[str], None] = lambda _: None,
    tables: tuple[PageTable, ...] = (),
    told: Sequence[str] = (),
    first: tuple[PageTable, ...] = (),
) -> Report:
    """Make the images and the page, with tables and notes that are known already.

    The page begins with the tables that are first, and with their images.

    What cannot be made is told in its notes.
    """
    images, notes = [], list(told)
    for task in tasks:
        tick(task.name)
        try:
            path = plan.folder / f"{task.name}.png"
            task.draw(path)
            images.append(Image(task.section, path, task.caption))
        except ResultsError as error:
            notes.append(str(error))
    notes += [note for job in plan.jobs for note in job.notes()]
    notes += [note for job in plan.jobs for note in _contact_notes(job)]
    comparison, files = None, [image.path for image in images]
    try:
        comparison = compare(list(plan.jobs))
        files.append(write_numbers(comparison, plan.folder / "numbers.csv"))
        notes += comparison.notes
    except ResultsError as error:
        notes.append(str(error))
    fixtures = []
    try:
        for held, path in _fixture_sheets(plan):
            fixtures.append(held)
            files.append(path)
    except ResultsError as error:
        notes.append(str(error))
    notes = list(dict.fromkeys(notes))
    headers = tuple(read_header(job.fields) for job in plan.jobs)
    names = tuple(name for name, _ in labelled(plan.jobs))
    images_and_notes = (tuple(images), tuple(notes))
    cases = cases_of(plan)
    sheet = Sheet(
        names, headers, comparison, *images_and_notes, tuple(fixtures), tables, cases, first
    )
    page = write_page(sheet, plan.folder / "report.html")
    return Report(page, tuple(files), comparison, tuple(notes))


def cases_of(plan: Plan) -> tuple[Case, ...]:
    """What the jobs compute, and their lights."""
    peaks = [None] * (len(plan.jobs) - 1) + [plan.peak]
    named = zip(labelled(plan.jobs), peaks, strict=True)
    return tuple(read_case(job, name, peak) for (name, job), peak in named)


def _contact_notes(job: Results) -> Iterator[str]:
    """Contact takes energy: say where it has given some, which the balance does not show."""
    if not job.has("energy"):
        return
    table = job.energy()
    given, whole = -table["contact"].min(), np.abs(table["total"]).max()
    if given > GIVEN * whole:
        share = f"{given / whole:.0%} of all"
        yield f"{job.job}: contact has given energy, {share}, where it should take"


def _history_tasks(plan: Plan) -> list[Task]:
    """Curves of the impactor, for every impactor number that the first job has."""
    wanted = (
        ("force", "time", "force", "Contact force over time; faint where a running mean is drawn."),
        ("force_displacement", "displacement", "force", "Contact force over displacement."),
        ("velocity", "time", "velocity", "Velocity of the impactor over time."),
    )
    tasks = []
    numbers = plan.jobs[0].impactors
    for number in numbers:
        of_number = "" if len(numbers) == 1 else f"_{number}"
        for name, across, upwards, caption in wanted:
            draw = partial(_draw_history, plan, number, across, upwards)
            tasks.append(Task("Impact", name + of_number, caption, draw))
    return tasks


def _dent_tasks(plan: Plan) -> list[Task]:
    """Depth of the dent, for jobs with an impactor and displacements."""
    return [
        Task(
            "Impact",
            f"dent_{file_name(name)}",
            f"Depth of both faces of {name} below the plate around, and the indentation.",
            partial(draw_dent, job),
        )
        for name, job in labelled(plan.jobs)
        if job.impactors and has_point_field(job.fields, "displacement")
    ]


def _draw_history(plan: Plan, number: int, across: str, upwards: str, path: Path) -> None:
    curves = [
        curve
        for curve in curves_of(plan.jobs, plan.measured, number)
        if not curve.measured or {across, upwards} <= set(curve.table.names)
    ]
    draw_history(curves, across, upwards, path, plan.window)


def _fixture_tasks(plan: Plan) -> list[Task]:
    """Force, contact, slip and uplift of what holds the plate."""
    return [
        Task(
            "Fixtures",
            f"fixtures_{file_name(name)}",
            f"Force (20 µs mean), area in contact, slip and uplift of the fixtures of {name}.",
            partial(draw_fixtures, job),
        )
        for name, job in labelled(plan.jobs)
        if job.fixtures
    ]


def _fixture_sheets(plan: Plan) -> Iterator[tuple[FixtureSheet, Path]]:
    """Tables of fixtures, and where they are written."""
    for name, job in labelled(plan.jobs):
        if job.fixtures:
            sheet = replace(fixture_sheet(job), job=name)
            yield sheet, write_sheet(sheet, plan.folder / f"fixtures_{file_name(name)}.csv")


def _energy_tasks(plan: Plan) -> list[Task]:
    return [
        Task(
            "Energy",
            f"energy_{file_name(name)}",
            f"Energies of {name}, and the error of their balance as a share of the energy put in.",
            partial(draw_energy, job),
        )
        for name, job in labelled(plan.jobs)
    ]


def _profile_tasks(plan: Plan) -> list[Task]:
    groups = (("in_plane", "In-plane", IN_PLANE), ("interlaminar", "Interlaminar", INTERLAMINAR))
    return [
        Task(
            "Through the thickness",
            f"profile_{number}_{name}",
            f"{words} stress through the thickness at point {number}.",
            partial(_draw_profile, plan, number, components),
        )
        for number in plan.jobs[0].profiles
        for name, words, components in groups
    ]


def _draw_profile(plan: Plan, number: int, components: tuple[str, ...], path: Path) -> None:
    jobs = [job for job in plan.jobs if number in job.profiles]
    draw_profiles(read_profiles(jobs, number, plan.time), components, path)


def _picture_tasks(plan: Plan) -> list[Task]:
    looks = (
        ("displacement", "Deflection of {}.", Wish("uz", plan.time)),
        (
            "stress",
            "Stress near the impactor in {}, with a quarter cut away.",
            Wish("sxx", plan.time, cut=True, zoom=2.5),
        ),
    )
    return [
        Task(
            "The plate",
            f"{kind}_{file_name(name)}",
            caption.format(name),
            partial(draw_picture, job, wish=wish, plain=plan.plain),
        )
        for name, job in labelled(plan.jobs)
        for kind, caption, wish in looks
        if kind != "stress" or has_point_field(job.fields, "stress")
    ]
