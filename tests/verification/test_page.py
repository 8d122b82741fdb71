"""The page of the verification tells of every problem."""

from __future__ import annotations

from pathlib import Path

HERE = Path(__file__).parent


def test_every_problem_has_a_row() -> None:
    """Each folder with tests begins a row of the table, and each such row is a folder."""
    rows = [line for line in (HERE / "README.md").read_text().splitlines() if line[:3] == "| `"]
    told = {row.split("`")[1] for row in rows}
    assert told == {path.parent.name for path in HERE.glob("*/test_*.py")}
