"""The picture of the first table of the validation page: what is read from its rows."""

from __future__ import annotations

import pytest

from studies.glance import PAGE, Deviation, read_deviations

TABLE = """## At a glance

| test | quantity | deviation from the measurement | section |
| --- | --- | --- | --- |
| [hard](#hard) impact, 25 J | force, that area | +20 %, -5 % and +0.5 % | |
| | shape | like 100 % of leaves | |
| a strip | strength | +1 %, -13 % | [below](#strip) |
| beams | largest force | -4 to -15 % | |
| a crack | – (closed form) | -0.6 % | |
"""


def test_deviations_of_a_table() -> None:
    """Links are names, empty cells repeat, words and closed forms have no place in the picture."""
    assert read_deviations(TABLE) == [
        Deviation("hard impact, 25 J", "force", (pytest.approx(0.2),)),
        Deviation("hard impact, 25 J", "that area", (pytest.approx(-0.05), pytest.approx(0.005))),
        Deviation("a strip", "strength", (pytest.approx(0.01), pytest.approx(-0.13))),
        Deviation("beams", "largest force", (pytest.approx(-0.04), pytest.approx(-0.15))),
    ]


def test_every_number_of_the_page_is_drawn() -> None:
    """All shares between the heads of the table and its end, but for those of closed forms."""
    table = PAGE.read_text().split("## At a glance\n\n")[1].split("\n\n")[0]
    rows = table.splitlines()
    cells = [row.split("|")[3] for row in rows if row.startswith("|") and "closed" not in row]
    written = sum(cell.count(" %") + cell.count(" to -") + cell.count(" to +") for cell in cells)
    found = read_deviations(PAGE.read_text())
    assert sum(len(one.shares) for one in found) == written > 30
    assert all(one.kind for one in found)
