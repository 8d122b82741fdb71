"""Tests of what is read off a run of the damage impact."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from plydyn_post.results import open_results
from readings.damage import areas_text, impacts_text, read_impact
from runner.cases import Case, Effort, Run


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """A run whose force rises to 4 kN and falls back over 2 ms; delamination begins at 2 kN."""
    time = np.linspace(0.0, 3e-3, 3001)
    force = 4000.0 * np.maximum(0.0, 1.0 - np.abs(time - 1e-3) / 1e-3)
    pairs = zip(time, force, strict=True)
    rows = [f"{t:.6e},{f:.9e},{-1e3 * t:.6e},-1,{1e6 * t:.6e}\n" for t, f in pairs]
    head = "time [s],force [N],displacement [mm],velocity [mm/s],absorbed [mJ]\n"
    (tmp_path / "job.impactor_1.csv").write_text(head + "".join(rows))
    head = "time [s],error [-],delamination [mJ],matrix damage [mJ]\n"
    (tmp_path / "job.energy.csv").write_text(head + "0,0,0,0\n3e-3,1e-9,900,100\n")
    head = "time [s],interface 1 area [mm2],interface 2 area [mm2],sum [mm2],projected area [mm2]\n"
    (tmp_path / "job.delamination.csv").write_text(
        head + "0,0,0,0,0\n5e-4,1,0,1,1\n1e-3,60,40,100,70\n"
    )
    case = Case("job", "damage_impact/coarse", "one")
    return Run(case, Effort(1.0, 1.0, 1.0, 3000, 1), open_results(tmp_path / "job"))


def test_an_impact_is_read_off_the_histories_of_a_run(run: Run) -> None:
    impact = read_impact(run)
    # the mean of a peak over 20 microseconds lies a quarter of their slope below it
    assert impact.peak == pytest.approx(4000.0 - 4e6 * 5e-6, rel=1e-6)
    assert impact.peak_time == pytest.approx(1e-3)
    assert impact.threshold == pytest.approx(2000.0, rel=1e-3)
    assert impact.duration == pytest.approx(2e-3, rel=1e-2)
    assert (impact.projected, impact.total) == (70.0, 100.0)
    assert impact.dissipated == {"delamination": 900.0, "matrix damage": 100.0}
    assert impact.absorbed == pytest.approx(2000.0, rel=1e-2)
    (row,) = impacts_text([impact]).splitlines()[2:]
    assert row.startswith("| one | 3980 | 1.00 | 2000 |")
    head, _, row = areas_text([impact]).splitlines()
    assert head == "| model | interface 1 [mm2] | interface 2 [mm2] |"
    assert row == "| one | 60 | 40 |"


def test_one_of_four_parts_counts_four_times(run: Run) -> None:
    impact = read_impact(run)
    for path in run.results.folder.glob("job.*.csv"):
        head, *rows = path.read_text().splitlines()
        lines = [f"{head},share of the whole plate [-]", *(f"{row},0.25" for row in rows)]
        path.write_text("\n".join(lines) + "\n")
    whole = read_impact(run)
    assert (whole.peak, whole.threshold) == pytest.approx((4.0 * impact.peak, 8000.0), rel=1e-3)
    assert (whole.projected, whole.total) == (280.0, 400.0)
    assert whole.dissipated == {"delamination": 3600.0, "matrix damage": 400.0}
    assert whole.absorbed == pytest.approx(4.0 * impact.absorbed)
    assert (whole.duration, whole.displacement) == (impact.duration, impact.displacement)
    assert areas_text([whole]).endswith("| one | 240 | 160 |\n")
