"""Tests of how studies are run, and that each of their cases is a recipe."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
import typer

import plydyn_post.cli
import plydyn_pre.cli
import study
from readings import damage
from runner.cases import (
    ROOT,
    Case,
    Effort,
    Run,
    StudyError,
    by_build,
    made_by,
    read_effort,
    read_runs,
    read_spent,
)
from runner.commands import Options, Study
from runner.jobs import Queue, Tools, find_tools
from runner.pages import Page, Section, insert, table
from studies import bimetal, bricks, choices, elastic_meshes, refinement, runs, schemes

#: A solver that fails on jobs named so, and says of the others what studies read; it goes on from
#: restart files
SOLVER = """#!/usr/bin/env bash
[[ $1 == --version ]] && { echo "plydyn 9 (abc)"; exit; }
if [[ $1 == restart ]]; then
  folder=$(dirname "$2") job=$(basename "$2" .dump01) word=on
else
  job=$4 folder=$6 word=again
fi
[[ $job == bad ]] && { echo "it is unstable"; exit 3; }
echo "$word" >>"$folder/$job.turns"
printf '%s\n' "time [s],force [N]" "0,0" >"$folder/$job.impactor_1.csv"
end="normal end"
[[ $job == stopped && $word == again ]] && end="stopped by SIGTERM" && touch "$folder/$job.dump01"
[[ $word == again ]] && : >"$folder/$job.out"
printf '%s\n' "plydyn 9 (abc)" "degrees of freedom  1" "End" "---" "" "$end" \\
  "cycle $((100 * $(wc -l <"$folder/$job.turns"))), time 1.0 s" \\
  "seconds 1.5 in the loop" >>"$folder/$job.out"
[[ $end == normal* ]] || { echo "asked to stop"; exit 4; }
"""


@pytest.fixture
def tools(tmp_path: Path) -> Tools:
    """The preprocessor, and that solver."""
    solver = tmp_path / "bin/plydyn"
    solver.parent.mkdir()
    solver.write_text(SOLVER)
    solver.chmod(0o755)
    return find_tools(solver)


def _case(name: str) -> Case:
    return Case(name, "damage_impact/coarse")


def _report(found: list[Run], _folder: Path) -> list[Page]:
    names = ", ".join(run.case.name for run in found)
    return [Page("page", [Section("Names", names, "names")])]


def test_a_job_that_fails_does_not_keep_others_from_running(tools: Tools, tmp_path: Path) -> None:
    cases, folder = [_case("bad"), _case("good")], tmp_path / "out"
    failed = Queue(tools, folder).run(cases)
    assert failed == ["bad: the solver left with 3: it is unstable"]
    assert [run.case.name for run in read_runs(cases, folder)] == ["good"]
    assert made_by(read_runs(cases, folder)) == "Made by plydyn 9 (abc).\n"


def test_runs_of_several_builds_are_told_build_by_build(tools: Tools, tmp_path: Path) -> None:
    cases = [_case(name) for name in ("one", "two", "three")]
    Queue(tools, tmp_path).run(cases)
    listing = tmp_path / "two.out"
    listing.write_text(listing.read_text().replace("(abc)", "(def)"))
    text = by_build(read_runs(cases, tmp_path), lambda own: ", ".join(run.case.name for run in own))
    assert text == "one, three\nMade by plydyn 9 (abc).\n\ntwo\nMade by plydyn 9 (def).\n"


def test_a_run_that_was_stopped_counts_only_where_it_may(tools: Tools, tmp_path: Path) -> None:
    cases = [_case("stopped")]
    failed = Queue(tools, tmp_path).run(cases)
    assert failed == ["stopped: the solver left with 4: asked to stop"]
    assert read_runs(cases, tmp_path) == []
    assert Queue(tools, tmp_path, again=True, may_stop=True).run(cases) == []
    assert len(read_runs(cases, tmp_path)) == 1


def test_a_run_that_was_stopped_goes_on(tools: Tools, tmp_path: Path) -> None:
    """Its times are those of both parts; another deck or build begins anew."""
    case, turns = _case("stopped"), tmp_path / "stopped.turns"
    Queue(tools, tmp_path).run([case])
    first = read_spent(case, tmp_path)
    assert first.wall > 0.0
    assert Queue(tools, tmp_path).run([case]) == []
    assert turns.read_text().split() == ["again", "on"]
    effort = read_effort(case, tmp_path)
    assert (effort.loop, effort.steps) == (3.0, 200)
    assert effort.wall > first.wall
    assert effort.processor > first.processor
    listing = tmp_path / "stopped.out"
    listing.write_text(listing.read_text().replace("(abc)", "(def)", 1))
    Queue(tools, tmp_path).run([case])
    assert turns.read_text().split() == ["again", "on", "again"]
    Queue(tools, tmp_path).run([replace(case, given=("control.end_time=1e-3",))])
    assert turns.read_text().split() == ["again", "on", "again", "again"]


def test_a_report_is_on_what_has_run_unless_it_needs_all(
    tools: Tools, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cases, page = [_case("bad"), _case("good")], tmp_path / "other.md"
    page.write_text("<!-- names -->\n<!-- end of names -->\n")
    options = Options(tmp_path, into=page, plydyn=tools.solver)
    with pytest.raises(StudyError, match="bad: the solver left with 3"):
        Study(cases, _report).carry_out(options)
    assert "## Names\n\ngood\n" in capsys.readouterr().out
    assert page.read_text() == "<!-- names -->\n\ngood\n\n<!-- end of names -->\n"
    with pytest.raises(StudyError, match="1 of 2 cases have run"):
        Study(cases, _report, needs_all=True).carry_out(options)
    assert "## Names" not in capsys.readouterr().out
    Study(cases, _report).carry_out(replace(options, kept=True))
    assert (tmp_path / "good.turns").read_text().splitlines() == ["again"]


def test_what_has_run_is_not_run_again(tools: Tools, tmp_path: Path) -> None:
    for again in (False, False, True):
        assert Queue(tools, tmp_path, again=again).run([_case("good")]) == []
    assert (tmp_path / "good.turns").read_text().splitlines() == ["again"] * 2
    other = replace(_case("good"), given=("control.end_time=1e-3",))
    assert Queue(tools, tmp_path).run([other]) == []
    assert len((tmp_path / "good.turns").read_text().splitlines()) == 3


def test_what_varies_stands_whatever_set_replaces() -> None:
    case = Case("one", "damage_impact/coarse", varied=("mesh.n=4",), common=("mesh.core=20",))
    replaced = replace(case, given=("mesh.n=6", "mesh.core=22")).model.mesh
    assert (replaced.n, replaced.core) == (4, 22.0)


ALL = {
    "table2": bricks.TABLE_2,
    "table4": bricks.TABLE_4,
    "converge": elastic_meshes.mesh_cases((1, 2, 3)),
    "bimetal_ladder": (*bimetal.MESHES, *bimetal.CHOICES),
    "table7": damage.MODELS,
    "runs": (*runs.RUNS, runs.ELASTIC),
    "schemes": schemes.elastic_cases(("le1", "le2")),
    "implicit": schemes.implicit_cases("q192_le1", "implicit_thickness:50"),
    "choices": [choices.case_of(one, choices.MODEL) for one in choices.CHOICES],
    "refine": [one for name, n in refinement.PAGE.items() for one in refinement.refined(name, n)],
    "variants": refinement.VARIANTS,
}


@pytest.mark.parametrize("name", ALL)
def test_every_case_is_a_recipe_with_a_name_of_its_own(name: str) -> None:
    """As it is declared, and with a value that a user replaces."""
    for case in ALL[name]:
        assert replace(case, given=("control.end_time=1e-4",)).model.control.end_time == 1e-4
    assert len({case.name for case in ALL[name]}) == len(ALL[name])


def test_a_table_stands_between_its_marks_and_nowhere_else(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("before\n<!-- times -->\nold\n<!-- end of times -->\nafter\n")
    insert(page, "times", table(["a", "b"], [["1", "2"]]))
    text = page.read_text()
    assert "old" not in text
    assert "| 1 | 2 |" in text
    assert text.startswith("before\n") and text.endswith("\nafter\n")
    with pytest.raises(StudyError, match="no lines"):
        insert(page, "forces", "")


def test_effort_is_read_off_a_listing(tmp_path: Path) -> None:
    case, listing = _case("job"), tmp_path / "job.out"
    listing.write_text(
        "degrees of freedom            1000\nnormal end\ncycle 200, time  1.0E-04 s\n"
        "elapsed 0:00:01\nseconds 1.000 in the loop\n"
    )
    assert read_effort(case, tmp_path) is None
    (tmp_path / "job.effort").write_text('{"wall": 1.5, "processor": 1.2}')
    effort = read_effort(case, tmp_path)
    assert effort == Effort(1.5, 1.2, 1.0, 200, 1000)
    assert effort.ns_per_dof_step == pytest.approx(5000.0)
    listing.write_text("cut")
    with pytest.raises(StudyError, match="no line like"):
        read_effort(case, tmp_path)


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
