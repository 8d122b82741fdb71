"""Damaged results are drawn, or refused in one sentence that names the file."""

from collections.abc import Iterator
from pathlib import Path

import fuzz_results
import h5py
import numpy as np
import pytest

from plydyn_post import style

# Mutants in the tests; python tests/fuzz_results.py tries as many as asked for
COUNT, SEEDS = 30, range(8)


@pytest.fixture
def small_pictures() -> Iterator[None]:
    """Draw with few dots, and with the usual ones afterwards."""
    before = dict(style.LOOK)
    fuzz_results.small_pictures()
    yield
    style.LOOK.update(before)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.usefixtures("small_pictures")
def test_damaged_results_are_drawn_or_refused(tmp_path: Path, seed: int) -> None:
    found = fuzz_results.try_mutants(tmp_path, seed, COUNT)
    assert not found, "\n".join(f"{mutant}\n    {wrong}" for mutant, wrong in found)


@pytest.fixture
def damaged(tmp_path: Path) -> Path:
    """The name of a small job that a test may damage."""
    fuzz_results.write_small_job(tmp_path)
    return tmp_path / fuzz_results.JOB


def refusal(*words: object) -> str:
    """What a command says that must refuse its results."""
    code, _, errors, raised = fuzz_results.run([str(word) for word in words])
    assert not fuzz_results.fault(code, errors, raised)
    assert code == 2
    return errors


@pytest.mark.parametrize(
    ("line", "text", "told"),
    [
        (4, "nan,0,0,0,0,0,0,0,0", "line 4: time is nan"),
        (4, "1e-5,0,0,inf,0,0,0,0,0", "line 4: velocity is inf"),
        (9, "0,0,0,0,0,0,0,0,0", "line 9: time falls from 3e-05 to 0"),
        (1, "time [s],force [N],force [N],d,e,f,g,h,i", "column 'force' stands twice"),
        (1, "time [s],force [N],,d,e,f,g,h,i", "a column has no name"),
        (1, "time [s],force [N],\x07,d,e,f,g,h,i", "the header is no text"),
        (1, "time [s],load [N],displacement [mm],velocity,e,f,g,h,i", "no column 'force'"),
    ],
)
def test_rows_and_headers_that_cannot_be_are_named(
    damaged: Path, line: int, text: str, told: str
) -> None:
    path = damaged.with_name("plate.impactor_1.csv")
    lines = path.read_text().splitlines()
    lines[line - 1] = text
    path.write_text("\n".join(lines) + "\n")
    errors = refusal("numbers", damaged)
    assert "plate.impactor_1.csv" in errors
    assert told in errors


def put(path: Path, name: str, values: object) -> None:
    """Write a dataset anew."""
    with h5py.File(path, "r+") as file:
        del file[name]
        file[name] = values


@pytest.mark.parametrize(
    ("name", "change", "told"),
    [
        ("Steps/Values", lambda old: old[::-1], "time falls from 0.002 to 0.001 at state 2"),
        ("Points", lambda old: old * [1, np.nan, 1], "Points, row 1: not a finite number"),
        ("Points", lambda old: old * [1, 0, 1], "Points span no area"),
        ("Points", lambda old: old[:, :2], "not three numbers a point"),
        ("Points", lambda old: old[:-1], "NumberOfPoints is"),
        ("Connectivity", lambda old: old + 1, "names points that are not there"),
        ("Connectivity", lambda old: old // 2, "has a point twice"),
        ("Offsets", lambda old: old[::-1], "do not fit the types of the cells"),
        ("Types", lambda old: old + 1, "cells of types [30]"),
        ("PointData/displacement", lambda old: old[:-1], "has"),
        ("PointData/displacement", lambda old: old[:, :2], "numbers at a point, not 3"),
        ("PointData/stress", lambda old: old.astype("S4"), "PointData/stress is damaged"),
        ("CellData/ply", lambda old: old[:1], "CellData/ply has 1 rows"),
    ],
)
def test_fields_that_cannot_be_are_named(
    damaged: Path, name: str, change: object, told: str
) -> None:
    path = damaged.with_name("plate.vtkhdf")
    with h5py.File(path, "r") as file:
        values = file[f"VTKHDF/{name}"][...]
    put(path, f"VTKHDF/{name}", change(values))
    errors = refusal("picture", damaged, "--plain", "--show", "sxx")
    assert "plate.vtkhdf" in errors
    assert told in errors


@pytest.mark.parametrize("name", ["Steps", "Points", "Types", "PointData/displacement"])
def test_parts_that_are_missing_are_named(damaged: Path, name: str) -> None:
    path = damaged.with_name("plate.vtkhdf")
    with h5py.File(path, "r+") as file:
        del file[f"VTKHDF/{name}"]
    errors = refusal("picture", damaged, "--plain")
    assert "plate.vtkhdf" in errors
    assert name.rpartition("/")[2] in errors or "holds no state" in errors


def test_energies_of_which_only_the_work_is_seen_are_stacked(damaged: Path) -> None:
    path = damaged.with_name("plate.energy.csv")
    rows = [line.split(",") for line in path.read_text().splitlines()]
    column = rows[0].index("external [mJ]")
    for row in rows[1:]:
        row[column] = "1e40"
    path.write_text("".join(",".join(row) + "\n" for row in rows))
    code, _, errors, raised = fuzz_results.run(["energy", str(damaged), "--stacked"])
    assert (code, errors, raised) == (0, "", None)
