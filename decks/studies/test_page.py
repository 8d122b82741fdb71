"""One command makes the validation page."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from runner.cases import ROOT, Case, Run, StudyError
from runner.commands import Study
from runner.pages import Page
from studies.page import STUDIES, cases_of, report

SENTENCE = re.compile(r"study\.py (\w+) --into manual/validation\.md")


def test_each_study_of_the_page_is_one_of_the_command() -> None:
    text = (ROOT / "manual/validation.md").read_text(encoding="utf-8")
    named = set(SENTENCE.findall(text))
    # it makes the sections that name none
    others = {"validation"}
    assert named == {"page"} | {study.__name__ for study in STUDIES} - others


def test_a_case_runs_once_and_has_one_meaning() -> None:
    """The page has cases that several studies share."""
    studies = [declare() for declare in STUDIES]
    names = [case.name for case in cases_of(studies)]
    assert len(set(names)) == len(names) < sum(len(study.cases) for study in studies)
    case = Case("one", "damage_impact/coarse", "a case")
    other = [_study(case), _study(replace(case, label="another"))]
    with pytest.raises(StudyError, match="two studies have different cases with the name one"):
        cases_of(other)


def test_studies_say_what_has_run(capsys: pytest.CaptureFixture[str]) -> None:
    """One has no run, one has not all that it needs, one has nothing to say."""
    cases = [Case(name, "damage_impact/coarse", name) for name in "abcd"]
    runs = [Run(case, None, None) for case in cases[:2]]
    studies = [_study(*cases[:2]), _study(*cases[2:])]
    studies += [replace(_study(*cases), needs_all=True), Study(cases, _nothing)]
    pages = report(studies, runs, Path())
    assert [page.name for page in pages] == ["ab"]
    assert capsys.readouterr().out == "left out: nothing to say\n"


def _study(*cases: Case) -> Study:
    """A study whose page has the names of its runs."""
    return Study(cases, lambda runs, _: [Page("".join(run.case.name for run in runs))])


def _nothing(_runs: list[Run], _folder: Path) -> list[Page]:
    """A report that has nothing to say."""
    raise StudyError("nothing to say")
