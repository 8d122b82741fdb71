"""One table and one figure of the cases of a parameter study."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest
import synthetic
from typer.testing import CliRunner

from plydyn_post.cli import app
from plydyn_post.errors import ResultsError
from plydyn_post.series import draw_series, read_series

ENERGIES, LAYUPS = ("1 J", "4 J"), ("[0]", "[90]")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Four cases, the peak force 1 to 4 times that of the synthetic job; the last has not ended."""
    rows = [["case", "jobs", "laminate.layup", "impactor.energy"]]
    for number in range(4):
        name = str(number + 1)
        job = synthetic.write_job(tmp_path / name, factor=number + 1.0)
        end = "normal end" if number < 3 else "error end"
        Path(f"{job}.out").write_text(f"listing\n{end}\n")
        rows.append([name, "plate", LAYUPS[number // 2], ENERGIES[number % 2]])
    with (tmp_path / "cases.csv").open("w", newline="") as file:
        csv.writer(file).writerows(rows)
    return tmp_path


def test_numbers_stand_beside_the_values(folder: Path) -> None:
    table = read_series(folder)
    unit, peaks = table.numbers["peak force"]
    assert unit == "kN"
    wanted = [factor * synthetic.PEAK / 1000.0 for factor in (1.0, 2.0, 3.0)]
    assert peaks[:3] == pytest.approx(wanted, rel=1e-4)
    assert peaks[3] is None
    assert table.notes == ("1 of 4 cases have not come to a normal end: 4",)


def test_a_contact_that_has_not_ended_has_no_duration(folder: Path) -> None:
    """What there is so far is no value to stand beside those of other cases."""
    table = folder / "2" / "plate.impactor_1.csv"
    table.write_text("\n".join(table.read_text().splitlines()[:300]) + "\n")
    found = read_series(folder).numbers
    for name in ("contact duration", "impulse"):
        first, second, *_ = found[name][1]
        assert first is not None and second is None


def test_a_number_that_no_case_has_is_told_and_not_drawn(folder: Path) -> None:
    for table in folder.glob("*/plate.impactor_1.csv"):
        table.write_text("\n".join(table.read_text().splitlines()[:300]) + "\n")
    told = CliRunner().invoke(app, ["study", str(folder), "--show", "contact duration"])
    assert told.exit_code == 2
    assert "no case has a value of 'contact duration' to draw" in told.stderr
    assert (folder / "table.csv").is_file()
    assert not (folder / "contact_duration.png").exists()


def test_a_curve_for_each_layup_over_the_energies(folder: Path) -> None:
    made = draw_series(read_series(folder), "peak force")
    axes = made.axes[0]
    assert axes.get_xlabel() == "impactor.energy [J]"
    assert axes.get_ylabel() == "Peak force [kN]"
    first, second = axes.get_lines()
    assert (first.get_label(), second.get_label()) == LAYUPS
    assert first.get_xdata().tolist() == [1.0, 4.0]
    assert first.get_ydata() == pytest.approx([1.5, 3.0], rel=1e-4)
    assert second.get_xdata().tolist() == [1.0]


def test_values_that_are_no_numbers_stand_side_by_side(folder: Path) -> None:
    path = folder / "cases.csv"
    path.write_text(path.read_text().replace("1 J", "soft").replace("4 J", "hard"))
    axes = draw_series(read_series(folder), "peak force").axes[0]
    assert axes.get_xlabel() == "laminate.layup"
    ticks = [text.get_text() for text in axes.get_xticklabels()]
    assert ticks == list(LAYUPS)
    assert axes.get_lines()[0].get_xdata().tolist() == [0.0, 1.0]


def test_the_command_writes_both(folder: Path) -> None:
    done = CliRunner().invoke(app, ["study", str(folder), "--show", "absorbed energy"])
    assert done.exit_code == 0, done.output
    assert "1 of 4 cases" in done.output
    with (folder / "table.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["laminate.layup"] for row in rows] == ["[0]", "[0]", "[90]", "[90]"]
    assert rows[3]["peak force [kN]"] == ""
    assert (folder / "absorbed_energy.png").read_bytes().startswith(b"\x89PNG")


def test_what_is_no_study_is_told(folder: Path) -> None:
    with pytest.raises(ResultsError, match="'heat' is no number; right would be peak force"):
        draw_series(read_series(folder), "heat")
    for name in "123":
        (folder / name / "plate.out").unlink()
    with pytest.raises(ResultsError, match="no case has come to a normal end yet"):
        read_series(folder)
    (folder / "cases.csv").write_text("case,values\n1,2\n")
    with pytest.raises(ResultsError, match="is no list of cases"):
        read_series(folder)
    (folder / "cases.csv").unlink()
    with pytest.raises(ResultsError, match="plydyn-pre study writes it"):
        read_series(folder)
