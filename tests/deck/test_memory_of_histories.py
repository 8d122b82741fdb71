"""Histories of damage take memory where there is damage, and the listing says how much."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from broken import cracked_ply, weak_laminate, weak_ply, yielding
from decks import Deck
from meshes import regular
from ranks import peaks
from runs import SOLVER

QUADS, SIZE = 60, 1.0
POINTS, LANES, BYTES, MEGA = 18, 8, 8, 1.0e6


def closing(deck: Deck) -> None:
    """Plies whose cracks close."""
    weak_ply(deck, closing=True)


# variables of a point, and those of an intact one: src/law/*/history.f90
LAWS: dict[str, tuple[Callable[[Deck], None], int, int]] = {
    "CODAM2": (closing, 24, 5),
    "planes of fracture": (cracked_ply, 37, 3),
    "metal": (yielding, 8, 8),
}


def plate(law: Callable[[Deck], None]) -> Deck:
    """A plate that flies on, so that nothing is damaged."""
    mesh = regular(QUADS * SIZE, QUADS * SIZE, QUADS, QUADS, 9)
    deck = Deck("memory", 1.0, 2)
    deck.control()
    deck.mesh(mesh)
    law(deck)
    weak_laminate(deck)
    deck.add("INITIAL_VELOCITY", (0,), (0.0, 0.0, 1.0))
    deck.add("DATABASE_FIELD", "displacement")
    deck.intervals(glstat=1.0, binary_d3plot=1.0)
    return deck


@pytest.mark.parametrize(("law", "variables", "intact"), LAWS.values(), ids=LAWS)
def test_listing_counts_both(
    law: Callable[[Deck], None], variables: int, intact: int, tmp_path: Path
) -> None:
    """Bytes of all variables of all points in all lanes, and of those of intact points."""
    told = subprocess.run(
        [SOLVER, "check", plate(law).write(tmp_path / "deck.k")],
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    one = QUADS**2 * POINTS * LANES * BYTES / MEGA
    for line, number in (("memory of histories", variables), ("while all is intact", intact)):
        found = re.search(line + r"\s+(\S+) MB", told)
        assert found
        assert float(found[1]) == pytest.approx(one * number, abs=0.051)


def test_intact_plate_takes_no_memory_for_damage(tmp_path: Path) -> None:
    """The whole process has less than all histories would take, also after its fields."""
    law, variables, _ = LAWS["planes of fracture"]
    deck = plate(law).write(tmp_path / "deck.k")
    most = MEGA * peaks(1, "run", deck, "-o", tmp_path)[0]
    assert most < QUADS**2 * POINTS * LANES * BYTES * variables
