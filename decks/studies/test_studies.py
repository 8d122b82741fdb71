"""Tests of what the studies compute and write."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from plydyn_post.results import Results, open_results

from studies.differences import force_difference, ply_means, section, velocity_difference
from studies.jobs import Effort, StudyError, read_effort
from studies.markdown import insert, table
from studies.stress import agreement

IMPACTOR = "time [s],force [N],displacement [mm],velocity [mm/s]\n"
PROFILE = "time [s],z [mm],ply [-],syz [MPa]\n"


def _impact(folder: Path, job: str, factor: float) -> Results:
    """A job whose force is a straight line up and whose velocity is another one."""
    rows = [f"{t:.6e},{factor * t:.9e},0,{-5.0 + factor * t:.9e}\n" for t in np.arange(201) * 1e-6]
    (folder / f"{job}.impactor_1.csv").write_text(IMPACTOR + "".join(rows))
    return open_results(folder / job)


def test_differences_are_shares_of_the_other(tmp_path):
    one, other = _impact(tmp_path, "one", 1.1), _impact(tmp_path, "other", 1.0)
    assert force_difference(one, other) == pytest.approx(0.1, rel=1e-6)
    assert force_difference(one, other, 50e-6) == pytest.approx(0.1, rel=1e-6)
    assert velocity_difference(one, other) == pytest.approx(0.1 * 200e-6 / 5.0, rel=1e-6)


def test_profiles_of_different_rows_are_compared_at_the_same_places(tmp_path):
    # two plies: linear in the first, constant in the second, with a jump of 2 between them
    coarse = [(0, 1, 0), (1, 1, 4), (1, 2, 6), (2, 2, 6)]
    fine = [(0, 1, 0), (0.5, 1, 2), (1, 1, 4), (1, 2, 6), (1.5, 2, 6), (2, 2, 6)]
    found = []
    for name, rows in (("coarse", coarse), ("fine", fine)):
        text = "".join(f"0,{z},{ply},{value}\n" for z, ply, value in rows)
        (tmp_path / f"{name}.profile_2.csv").write_text(PROFILE + text)
        found.append(section(open_results(tmp_path / name), 2, "syz"))
    assert found[0].values == pytest.approx(found[1].values)
    assert ply_means(found[0].values[0]) == pytest.approx([2.0, 6.0])
    same = agreement(found[0], found[1], 0.0)
    assert (same.largest, same.size, same.whole, same.means) == (0.0, 0.0, 0.0, 0.0)
    assert same.jump == pytest.approx(2.0 / 6.0)
    assert same.end == pytest.approx(1.0)


def test_a_table_stands_between_its_marks_and_nowhere_else(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("before\n<!-- times -->\nold\n<!-- end of times -->\nafter\n")
    insert(page, "times", table(["a", "b"], [["1", "2"]]))
    text = page.read_text()
    assert "old" not in text
    assert "| 1 | 2 |" in text
    assert text.startswith("before\n") and text.endswith("\nafter\n")
    with pytest.raises(StudyError, match="no lines"):
        insert(page, "forces", "")


def test_effort_is_read_off_a_listing(tmp_path):
    listing = tmp_path / "job.out"
    listing.write_text(
        "degrees of freedom            1000\nnormal end\ncycle 200, time  1.0E-04 s\n"
        "elapsed 0:00:01\nseconds 1.000 in the loop\n"
    )
    effort = read_effort(listing, 1.5, 1.2)
    assert effort == Effort(1.5, 1.2, 1.0, 200, 1000)
    assert effort.grain == pytest.approx(5000.0)
    listing.write_text("cut")
    with pytest.raises(StudyError, match="no line like"):
        read_effort(listing, 1.0, 1.0)
