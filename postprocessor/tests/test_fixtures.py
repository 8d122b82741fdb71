"""Fixtures in figures, numbers and the page of a report."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
import synthetic

from plydyn_post.errors import ResultsError
from plydyn_post.fixtures import draw_fixtures, fixture_sheet, read_fixtures
from plydyn_post.plan import Plan
from plydyn_post.report import make_report, tasks_of
from plydyn_post.results import open_results

NAMES = [
    "time [s]", "force x [N]", "force y [N]", "force z [N]", "impulse x [N s]", "impulse y [N s]",
    "impulse z [N s]", "area [mm2]", "contacts [-]", "slip [mm]", "uplift [mm]", "friction [mJ]",
]  # fmt: skip
LISTING = """\
fixture 1                     plane below the bottom face, over  6.0E+03 mm2 of it
fixture 12                    clamp above the top face, over  1.1E+02 mm2 of it
"""


def write_fixture(job: Path, number: int, force: float) -> None:
    """A fixture under a constant force from the first instant after zero."""
    time = np.linspace(0.0, synthetic.END, 301)
    push = np.where(time > 0.0, force, 0.0)
    nothing, share = np.zeros_like(time), time / synthetic.END
    area = np.where(time > 0.0, 200.0 - 150.0 * share, 0.0)
    columns = [
        time, nothing, nothing, push, nothing, nothing, force * time, area, np.ones_like(time),
        0.02 * share, 0.3 * share, 5.0 * share,
    ]  # fmt: skip
    path = job.with_name(f"{job.name}.fixture_{number}.csv")
    synthetic.write_csv(path, NAMES, np.column_stack(columns))


@pytest.fixture
def held(own_job: Path) -> Path:
    """A job with a plane below and a clamp above."""
    write_fixture(own_job, 1, -800.0)
    write_fixture(own_job, 12, 300.0)
    own_job.with_name(f"{own_job.name}.out").write_text(LISTING)
    return own_job


def test_fixtures_have_the_names_of_the_listing(held: Path) -> None:
    names = [one.name for one in read_fixtures(open_results(held))]
    assert names == ["1 plane below", "12 clamp above"]
    held.with_name(f"{held.name}.out").unlink()
    assert [one.name for one in read_fixtures(open_results(held))] == ["1", "12"]


def test_the_sheet_has_forces_that_press_and_momentum(held: Path) -> None:
    sheet = fixture_sheet(open_results(held))
    plane, clamp = sheet.rows
    assert sheet.headings[:2] == ("fixture", "largest force [N]")
    assert plane[:2] == ("1 plane below", "800")
    assert clamp[:2] == ("12 clamp above", "300")
    table = dict(zip(sheet.headings, plane, strict=True))
    assert float(table["impulse [N s]"]) == pytest.approx(-800.0 * synthetic.END)
    assert (table["largest area [mm2]"], table["smallest area [mm2]"]) == ("199.5", "50")
    assert table["friction work [mJ]"] == "5"
    # the synthetic energies have no momentum: all of the impulse is left
    assert "fixtures got -1.5 N" in sheet.words
    assert "1.0e+00 of the largest is left" in sheet.words


def test_fixtures_are_drawn_and_on_the_page(held: Path, tmp_path: Path) -> None:
    job = open_results(held)
    picture = tmp_path / "fixtures.png"
    draw_fixtures(job, picture)
    assert picture.read_bytes().startswith(b"\x89PNG")
    plan = Plan((job,), tmp_path)
    tasks = [task for task in tasks_of(plan) if task.section == "Fixtures"]
    assert len(tasks) == 1
    report = make_report(plan, tasks)
    page = report.page.read_text(encoding="utf-8")
    assert "12 clamp above" in page
    assert "momentum along z" in page
    (path,) = tmp_path.glob("fixtures_*.csv")
    rows = list(csv.reader(path.open(encoding="utf-8")))
    assert [row[0] for row in rows] == ["fixture", "1 plane below", "12 clamp above"]


def test_a_job_without_fixtures_says_so(job: Path, tmp_path: Path) -> None:
    results = open_results(job)
    assert not [task for task in tasks_of(Plan((results,), tmp_path)) if task.section == "Fixtures"]
    for ask in (fixture_sheet, lambda one: draw_fixtures(one, tmp_path / "none.png")):
        with pytest.raises(ResultsError, match="has no fixtures"):
            ask(results)


def test_contact_that_gives_energy_is_noted(held: Path, tmp_path: Path) -> None:
    plan = Plan((open_results(held),), tmp_path)
    assert not [note for note in make_report(plan, []).notes if "contact has given" in note]
    path = held.with_name(f"{held.name}.energy.csv")
    head, *rows = path.read_text().splitlines()
    place = head.split(",").index("contact [mJ]")
    cells = [row.split(",") for row in rows]
    cells[-1][place] = "-900.0"
    path.write_text("\n".join([head, *(",".join(row) for row in cells)]) + "\n")
    told = [note for note in make_report(plan, []).notes if "contact has given" in note]
    assert told == [f"{held.name}: contact has given energy, 20% of all, where it should take"]


def test_histories_of_fixtures_are_results_that_nothing_replaces(held: Path) -> None:
    results = open_results(held.with_name(f"{held.name}.fixture_12.csv"))
    assert results.job == held.name
    with pytest.raises(ResultsError, match="is a result"):
        results.spare(held.with_name(f"{held.name}.fixture_12.csv"))
