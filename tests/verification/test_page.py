"""The page of the verification tells of every problem."""

from __future__ import annotations

from pathlib import Path

import pytest

from worst_rows import TEST, overview, rows_of, share_used, worst

HERE = Path(__file__).parent
PAGE = HERE.parents[1] / "manual/verification.md"
TABLES = PAGE.with_name("verification_tables.md")


def test_every_problem_has_a_row() -> None:
    """Each folder with tests begins a row of the table, and each such row is a folder."""
    rows = [line for line in (HERE / "README.md").read_text().splitlines() if line[:3] == "| `"]
    told = {row.split("`")[1] for row in rows}
    assert told == {path.parent.name for path in HERE.glob("*/test_*.py")}


@pytest.mark.parametrize("page", [PAGE, TABLES], ids=lambda page: page.name)
def test_every_problem_has_its_numbers_in_the_manual(page: Path) -> None:
    """Each folder has a section with a table that the report has written: run report.py FOLDER."""
    for folder in sorted({path.parent.name for path in HERE.glob("*/test_*.py")}):
        section = section_of(page, folder)
        assert "error [%]" in section, f"run tests/verification/report.py {folder}"


def section_of(page: Path, folder: str) -> str:
    """What stands between the marks of a folder."""
    _, _, rest = page.read_text().partition(f"<!-- {folder} -->")
    section, ended, _ = rest.partition(f"<!-- end of {folder} -->")
    assert ended, f"{page.name} has no marks <!-- {folder} -->, <!-- end of ... -->"
    return section


def test_page_has_the_worst_row_of_each_test() -> None:
    """Those of the page of all rows, as the report chooses them; so does the table at the top."""
    folders = sorted({path.parent.name for path in HERE.glob("*/test_*.py")})
    for folder in folders:
        every = rows_of(section_of(TABLES, folder))
        shown = rows_of(section_of(PAGE, folder))
        assert {row[TEST] for row in shown} == {row[TEST] for row in every}
        assert shown == worst(every), f"run tests/verification/report.py {folder}"
    told = rows_of(section_of(PAGE, "overview"))
    assert told == [list(row) for row in overview(PAGE.read_text())]
    assert len(told) == len(folders)


def test_rows_use_a_share_of_their_tolerance() -> None:
    """On the side of the error, in per cent as printed."""
    row = ["bar", "force", "1", "1"]
    assert share_used([*row, "-0.5", "±2.00"]) == 0.25
    assert share_used([*row, "-29.4", "-100.00 to 0"]) == 0.294
    assert share_used([*row, "1e-8", "-1.00 to 1e-07"]) == pytest.approx(0.1)
    assert share_used([*row, "0", "±0"]) == 0.0
    rows = [[*row, "-0.5", "±2.00"], [*row, "0.3", "±1.00"], ["rod", *row[1:], "0", "±1.00"]]
    assert worst(rows) == [rows[1], rows[2]]
