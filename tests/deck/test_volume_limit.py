"""VOLLIM of *CONTROL_LAYERWISE stops a run whose elements are pressed to nothing, with a state."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from broken import said
from runs import Results

DECK = Path(__file__).parent / "crushed" / "deck.k"
#: Of that deck: thickness of a layer, and the share of it that is lost per time, 1/s
THICKNESS = 0.25
RATE = 0.225 / 4.0e-4 / THICKNESS
#: Steps from one look at the volumes to the next
STEPS = 200
STOPPED = 3


@pytest.mark.parametrize("limit", [0.6, 0.35])
def test_run_stops_below_the_bound(limit: float, tmp_path: Path) -> None:
    """The volume falls at a known rate: the run stops at the first look below the bound."""
    text = DECK.read_text().replace("$#   KINEM\n         1\n", f"1,,,,{limit}\n")
    assert f",{limit}\n" in text
    (tmp_path / "job.k").write_text(text)
    code, words = said("run", tmp_path / "job.k", "-o", tmp_path)
    assert code == STOPPED, words
    found = re.search(r"pressed to (\S+) of its volume at cycle \d+, time (\S+),.*VOLLIM", words)
    assert found is not None, words
    least, time = float(found[1]), float(found[2])
    # three digits are printed
    assert least == pytest.approx(1.0 - RATE * time, abs=1e-3)
    results = Results(tmp_path, "job")
    assert limit - STEPS * results.table("energy")["step"][1] * RATE < least < limit
    # the state at the stop is in the file of fields
    moved = abs(results.field("displacement")[:, 2]).max()
    assert moved == pytest.approx(THICKNESS * RATE * time, rel=1e-3)
