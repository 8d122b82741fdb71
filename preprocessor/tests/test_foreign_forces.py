"""Decks of others have the forces that those who handed them over give; loads arrive."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from foreign_decks import Foreign, ball, control, ply_law, rim, standard
from foreign_forms import LIKE, tiebreak, tied
from programs import plydyn_pre, run_deck

#: Moduli and minor ratios of the law of the decks, as on its card
OWN = "  153000.0   10300.0   10300.0    0.0202    0.0202       0.4"


def thick(*moduli: float) -> str:
    """A plate of plies of 0.25 mm with other moduli and minor ratios."""
    deck = Foreign()
    plate = deck.layer()
    deck.quads(1, plate)
    rows = [(1, 0.25, 0.0, 0, 1, 0.25, 90.0), (1, 0.25, 90.0, 0, 1, 0.25, 0.0)]
    deck.put("PART_COMPOSITE", "plate", (1, 16, 0.833), *rows)
    ply_law(deck)
    ball(deck, 0.5)
    deck.set_of("SET_NODE_LIST", 1, rim(plate))
    deck.put("BOUNDARY_SPC_SET", (1, 0, 1, 1, 1, 1, 1, 1))
    deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0, 0, -2000.0))
    control(deck)
    text = deck.text()
    assert OWN in text
    return text.replace(OWN, "".join(f"{value:>10}" for value in moduli))


#: Decks, and their largest force over 0.5 ms in N
GIVEN: dict[str, tuple[Callable[[], str], float]] = {
    "composite shells": (standard()[0].text, 165.2),
    "tied by segments": (lambda: tied("segments"), 165.2),
    "tiebreak by segments": (lambda: tiebreak("segments"), 165.4),
    "glass": (lambda: thick(45000.0, 12000.0, 12000.0, 0.08, 0.08, 0.3), 232.7),
    "PRBA alone": (lambda: thick(80000.0, 11000.0, 11000.0, 0.04125, 0.0, 0.0), 357.6),
}


@pytest.mark.parametrize("name", GIVEN)
def test_a_deck_has_the_force_that_is_given_with_it(name: str, solver: str, tmp_path: Path) -> None:
    """To the digit that is given; what breaks in these impacts breaks slowly."""
    make, force = GIVEN[name]
    text = make().replace("*END", "*DATABASE_GLSTAT\n    1.0E-6\n*END")
    (tmp_path / "user.k").write_text(text)
    result = plydyn_pre(tmp_path, "translate", "user.k", "--like", LIKE)
    assert result.returncode == 0, result.stdout + result.stderr
    run_deck(solver, tmp_path, "user_plydyn.k")
    rows = np.loadtxt(tmp_path / "user_plydyn.impactor_1.csv", delimiter=",", skiprows=1)
    assert rows[:, 1].max() == pytest.approx(force, abs=0.05)
