"""Rows of the log of speeds, without measuring."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from speed_log import HEADS, append, row_of


def test_a_row_has_both_states(tmp_path: Path) -> None:
    """Milliseconds of the commit, and how many of them the reference takes in its time."""
    row = row_of("HEAD", [(0.012, 0.024), (0.5, 0.25)])
    assert row[4:] == ["12.0", "2.00", "500.0", "0.50"]
    assert len(row) == len(HEADS)
    log = tmp_path / "speed.csv"
    assert append(row, log) == [row]
    assert append(row, log) == [row, row]
    assert log.read_text().splitlines()[0].startswith("commit,of,")
