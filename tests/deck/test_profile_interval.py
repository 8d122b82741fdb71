"""*DATABASE_PROFILE: its interval where DT is blank, and its size in what `check` adds up."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from broken import said
from decks import Deck, Ply, ramp
from elasticity import CARBON
from meshes import regular
from runs import Results

END, POINTS, PLIES, USUAL = 2.0e-5, 50, 2, 100
#: Columns of a profile, and bytes of a number with its comma
COLUMNS, BYTES, MEGA = 24, 17, 1.0e6


def written(folder: Path, name: str, interval: str | None) -> Path:
    """A deck with a profile at some interval, blank or not; or without one."""
    deck = Deck("a plate under tension", END)
    mesh = regular(4.0, 2.0, 2, 1, 4)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.2)] * PLIES, order=1)
    x = mesh.points[:, 0]
    deck.hold(np.flatnonzero(x < 1e-9), "xyz")
    deck.move(np.flatnonzero(x > 4.0 - 1e-9), 1, deck.curve(ramp(END)), 0.01)
    deck.intervals(glstat=END)
    if interval is not None:
        deck.add("DATABASE_PROFILE", f"1,1.0,1.0,{POINTS},{interval}")
    return deck.write(folder / f"{name}.k")


def size_of_tables(deck: Path) -> float:
    """Megabytes that `check` predicts for the tables of a job."""
    code, text = said("check", deck)
    assert code == 0, text
    return float(re.search(r"tables, about +(\S+) MB", text)[1])


def test_profile_without_interval_is_written_a_hundred_times(tmp_path: Path) -> None:
    """Blank is a hundred in the run, with the first state; `check` counts their lines."""
    deck = written(tmp_path, "blank", "")
    code, text = said("run", deck, "-o", tmp_path)
    assert code == 0, text
    table = Results(tmp_path, "blank").table("profile_1")
    times = np.unique(table["time"])
    steps = int(Results(tmp_path, "blank").table("energy")["cycle"][-1])
    assert steps > 2 * USUAL
    assert len(times) == USUAL + 1
    assert len(table["time"]) == len(times) * POINTS * PLIES
    assert np.diff(times) == pytest.approx(END / USUAL, abs=2 * END / steps)
    added = size_of_tables(deck) - size_of_tables(written(tmp_path, "none", None))
    assert added == pytest.approx(len(table["time"]) * COLUMNS * BYTES / MEGA, rel=1e-2)
    # within the width of the numbers: what is written is no longer than that
    assert (tmp_path / "blank.profile_1.csv").stat().st_size < 1.1 * added * MEGA


def test_zero_is_every_step(tmp_path: Path) -> None:
    """And `check` tells so before the run."""
    deck = written(tmp_path, "all", "0.0")
    steps = int(re.search(r"steps\D+(\d+)", said("check", deck)[1])[1])
    added = size_of_tables(deck) - size_of_tables(written(tmp_path, "none", None))
    lines = (steps + 1) * POINTS * PLIES
    assert added == pytest.approx(lines * COLUMNS * BYTES / MEGA, rel=2e-2)
