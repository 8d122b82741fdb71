"""The page of the verification tells of every problem."""

from __future__ import annotations

from pathlib import Path

HERE = Path(__file__).parent
PAGE = HERE.parents[1] / "manual/verification.md"


def test_every_problem_has_a_row() -> None:
    """Each folder with tests begins a row of the table, and each such row is a folder."""
    rows = [line for line in (HERE / "README.md").read_text().splitlines() if line[:3] == "| `"]
    told = {row.split("`")[1] for row in rows}
    assert told == {path.parent.name for path in HERE.glob("*/test_*.py")}


def test_every_problem_has_its_numbers_in_the_manual() -> None:
    """Each folder has a section with a table that the report has written: run report.py FOLDER."""
    page = PAGE.read_text()
    for folder in sorted({path.parent.name for path in HERE.glob("*/test_*.py")}):
        _, _, rest = page.partition(f"<!-- {folder} -->")
        section, ended, _ = rest.partition(f"<!-- end of {folder} -->")
        assert ended, f"manual/verification.md has no marks <!-- {folder} -->, <!-- end of ... -->"
        assert "error [%]" in section, f"run tests/verification/report.py {folder}"
