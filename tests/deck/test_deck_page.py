"""The page about writing decks: its deck runs, and its table has every keyword."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from runs import ROOT, run_deck

PAGE = (ROOT / "manual/decks.md").read_text()
MASS, VELOCITY = 2.0e-6, 2.0e3


def test_its_deck_runs(tmp_path: Path) -> None:
    """The ball of the deck bounces: what it loses went into the plate, and the books close."""
    path = tmp_path / "plate.k"
    path.write_text(PAGE.split("```\n")[1])
    results = run_deck(path, tmp_path, "plate")
    ball, energy = results.table("impactor_1"), results.table("energy")
    assert energy["impactor"][0] == pytest.approx(0.5 * MASS * VELOCITY**2)
    assert energy["total"][-1] == pytest.approx(energy["total"][0])
    assert 0.0 < ball["velocity"][-1] < VELOCITY
    assert ball["force"][-1] == 0.0


def test_its_table_has_every_keyword() -> None:
    """Each page of a keyword has one place in the table, and no other name has one."""
    table = PAGE.split("## Keywords by purpose")[1]
    names = re.findall(r"\[(\w+)\]\(keywords\.md#(\w+)\)", table)
    pages = re.findall(r"^## \*(\w+)$", (ROOT / "manual/keywords.md").read_text(), re.MULTILINE)
    assert sorted(name for name, _ in names) == sorted(pages)
    assert all(name.lower() == place for name, place in names)
