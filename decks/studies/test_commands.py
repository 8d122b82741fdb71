"""Tests of how the commands run jobs."""

from __future__ import annotations

import re
from pathlib import Path

import plydyn_post.cli
import plydyn_pre.cli
import pytest
import typer

import study
from studies.commands import run_all, run_most
from studies.jobs import ROOT, Job, StudyError, Tools, find_tools, kept_effort, made_by

#: A solver that fails on jobs named so, and says of the others what studies read
SOLVER = """#!/usr/bin/env bash
[[ $1 == --version ]] && { echo "plydyn 9 (abc)"; exit; }
job=$4 folder=$6
[[ $job == bad ]] && { echo "it is unstable"; exit 3; }
echo again >>"$folder/$job.turns"
printf '%s\\n' "plydyn 9 (abc)" "degrees of freedom  1" "normal end" "cycle 200, time 1.0 s" \
  "seconds 1.0 in the loop" >"$folder/$job.out"
"""


@pytest.fixture
def tools(tmp_path: Path) -> Tools:
    """The preprocessor, and that solver."""
    solver = tmp_path / "solver"
    solver.write_text(SOLVER)
    solver.chmod(0o755)
    return find_tools(solver)


def _job(name: str) -> Job:
    return Job(name, ROOT / "decks/damage_impact/coarse.toml")


def test_a_job_that_fails_does_not_keep_others_from_running(tools: Tools, tmp_path: Path):
    jobs = [_job("bad"), _job("good")]
    failed = run_most(tools, jobs, tmp_path / "out", 1, False)
    assert failed == ["bad: the solver left with 3: it is unstable"]
    assert [kept_effort(job, tmp_path / "out") is not None for job in jobs] == [False, True]
    assert made_by(jobs, tmp_path / "out") == "Made by plydyn 9 (abc).\n"
    with pytest.raises(StudyError, match="bad: the solver left with 3"):
        run_all(tools, jobs, tmp_path / "out", 1, False)


def test_what_has_run_is_not_run_again(tools: Tools, tmp_path: Path):
    for again in (False, False, True):
        run_all(tools, [_job("good")], tmp_path, 1, again)
    assert (tmp_path / "good.turns").read_text().splitlines() == ["again"] * 2


@pytest.mark.parametrize(
    ("program", "app"),
    [
        (r"decks/study\.py", study.app),
        ("plydyn-pre", plydyn_pre.cli.app),
        ("plydyn-post", plydyn_post.cli.app),
    ],
)
def test_pages_name_commands_that_there_are(program: str, app: typer.Typer) -> None:
    """In text and in examples, on all pages."""
    known = typer.main.get_command(app).commands
    pages = [ROOT / "README.md", *ROOT.glob("manual/*.md"), *ROOT.glob("decks/**/README.md")]
    pages += [ROOT / "preprocessor/README.md", ROOT / "postprocessor/README.md"]
    text = "\n".join(page.read_text() for page in pages)
    named = set(re.findall(rf"(?<![\w/]){program} ([a-z]\w*)", text))
    assert named
    assert named <= set(known)
