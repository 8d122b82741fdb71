"""The study of the loading rate, and chains of stages as cases of studies."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from plydyn_pre.study import Motion
from runner.cases import ROOT, Case, read_effort, read_runs
from runner.jobs import Queue, Tools, find_tools
from studies.rates import DELAY, REACH, rate_cases, rates_text

#: A solver that notes its jobs, and says of them what studies and chains read
SOLVER = """#!/usr/bin/env bash
[[ $1 == --version ]] && { echo "plydyn 9 (abc)"; exit; }
[[ $1 == run ]] && set -- "$1" none "${@:2}"
job=$5 folder=$7
echo "$job" >>"$folder/turns"
[[ $job == *settle && -e $folder/bad ]] && { echo "it is unstable"; exit 3; }
printf '%s\\n' "time [s],force [N]" "0,0" >"$folder/$job.impactor_1.csv"
echo state >"$folder/$job.dump01"
[[ $1 == run ]] && size="degrees of freedom  1"
printf '%s\\n' "plydyn 9 (abc)" "$size" "End" "---" "" "normal end" \
  "cycle 200, time 1.0 s" "seconds 1.0 in the loop" >"$folder/$job.out"
"""
JOBS = ["rate_1", "rate_1_settle", "rate_1_compression"]
COARSE = ("mesh.quad=20", "mesh.core=40")


@pytest.fixture
def tools(tmp_path: Path) -> Tools:
    """The preprocessor, and that solver."""
    solver = tmp_path / "bin/plydyn"
    solver.parent.mkdir()
    solver.write_text(SOLVER)
    solver.chmod(0o755)
    return find_tools(solver)


@pytest.fixture
def case() -> Case:
    """A chain on a mesh that is made at once."""
    return replace(rate_cases()[0], given=COARSE)


def test_each_rate_is_half_of_the_one_before() -> None:
    """Nothing else differs, and each test ends at the same end shortening."""
    loads = []
    for one in rate_cases():
        stage = one.model.stages[-1]
        (load,) = stage.loads
        assert isinstance(load, Motion)
        loads.append(load.value)
        moved = -load.value * (stage.end_time - DELAY)
        assert moved == pytest.approx(REACH, rel=1e-4)
        assert one.model.stages[0] == rate_cases()[0].model.stages[0]
        assert tuple(each.name for each in one.model.stages) == one.stages
    assert loads[1:] == [0.5 * load for load in loads[:-1]]
    rise = rate_cases()[0].model.curves["start"]
    assert np.trapezoid(rise.value, rise.time) == pytest.approx(rise.time[-1] - DELAY, rel=1e-3)


def test_a_chain_is_run_once_to_its_end(case: Case, tools: Tools, tmp_path: Path) -> None:
    folder = tmp_path / "out"
    for _ in range(2):
        assert Queue(tools, folder).run([case]) == []
        assert (folder / "turns").read_text().split() == JOBS
    (run,) = read_runs([case], folder)
    assert run.results.job == JOBS[-1]
    assert read_effort(case, folder).steps == 200
    assert Queue(tools, folder, again=True).run([case]) == []
    assert (folder / "turns").read_text().split() == JOBS * 2


def test_a_chain_goes_on_with_the_stage_that_failed(
    case: Case, tools: Tools, tmp_path: Path
) -> None:
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / "bad").touch()
    assert "the solver left with 3: it is unstable" in Queue(tools, folder).run([case])[0]
    assert read_runs([case], folder) == []
    (folder / "bad").unlink()
    assert Queue(tools, folder).run([case]) == []
    assert (folder / "turns").read_text().split() == [*JOBS[:2], *JOBS[1:]]


def test_a_solver_of_another_name_is_refused(case: Case, tools: Tools, tmp_path: Path) -> None:
    other = tools.solver.rename(tmp_path / "bin/other")
    assert Queue(find_tools(other), tmp_path).run([case]) == [
        "rate_1: the solver must have the name plydyn"
    ]


def test_rates_are_compared_with_twice_the_rate() -> None:
    def test(strength: float) -> SimpleNamespace:
        moved = np.array([0.0, 0.8])
        return SimpleNamespace(
            strength=strength, shortening=moved, peak=1, kinetic_share=lambda: 0.001
        )

    lines = rates_text([("fast", test(250.0)), ("slow", test(240.0))]).splitlines()
    assert lines[2:] == [
        "| fast | 250.0 | 0.8000 | 0.1 % |  |",
        "| slow | 240.0 | 0.8000 | 0.1 % | -4 % |",
    ]


def test_the_page_of_the_blind_strength_names_the_study() -> None:
    assert "decks/study.py rate" in (ROOT / "decks/validation/README.md").read_text()
