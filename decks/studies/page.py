"""The validation page by one build and one command: its studies into one folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from runner.cases import Case, Run, StudyError
from runner.commands import Study, command
from runner.jobs import console
from runner.pages import Page
from studies import blind, crack_lines, mechanisms, strength, unnotched, validation

#: Studies of the page; a case that stands in several of them runs once
STUDIES = (
    *(unnotched.unnotched, validation.validation, mechanisms.mechanisms),
    *(crack_lines.crack_lines, blind.blind, blind.bands, blind.second),
    *(strength.third, strength.levels, strength.ncamp, strength.plates, strength.depends),
)


@command()
def page() -> Study:
    """All studies of manual/validation.md by one build; goes on where it stopped; many hours."""
    studies = [declare() for declare in STUDIES]
    return Study(cases_of(studies), lambda runs, folder: report(studies, runs, folder))


def cases_of(studies: Sequence[Study]) -> list[Case]:
    """The cases of studies, each once."""
    named: dict[str, Case] = {}
    for case in (case for study in studies for case in study.cases):
        if named.setdefault(case.name, case) != case:
            raise StudyError(f"two studies have different cases with the name {case.name}")
    return list(named.values())


def report(studies: Sequence[Study], runs: Sequence[Run], folder: Path) -> list[Page]:
    """What each study says of those of its cases that have run."""
    ready = {run.case.name: run for run in runs}
    pages = []
    for study in studies:
        own = [ready[case.name] for case in study.cases if case.name in ready]
        if not own or (study.needs_all and len(own) < len(study.cases)):
            continue
        try:
            pages += study.report(own, folder)
        except StudyError as error:
            console.print(f"left out: {error}", markup=False, soft_wrap=True)
    return pages
