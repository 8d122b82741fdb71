"""What is said of the step: how much room it leaves for waves, and what bounds it."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from broken import said
from decks import Deck, Ply
from elasticity import CARBON
from meshes import regular

EXPLICIT, INTERFACES, THICKNESS = 0, 1, 2
INPUT = 2
THIN, THICK = 0.25, 25.0


@pytest.mark.parametrize(
    ("share", "linear", "scheme", "springs", "ply", "is_told"),
    [
        (0.9, False, EXPLICIT, 0.0, THIN, True),
        (0.8, False, EXPLICIT, 0.0, THIN, False),
        (0.9, True, EXPLICIT, 0.0, THIN, False),
        # stiff springs leave the plies a step far below their own
        (0.9, False, EXPLICIT, 1.0e7, THIN, False),
        (0.9, False, INTERFACES, 1.0e7, THIN, True),
        (0.9, False, THICKNESS, 1.0e7, THIN, False),
        # quads that are smaller than the plies are thick
        (0.9, False, EXPLICIT, 0.0, THICK, False),
    ],
    ids=["tied", "0.8", "linear", "springs", "IMPL 1", "IMPL 2", "thick"],
)
def test_room_for_waves(
    share: float,
    linear: bool,
    scheme: int,
    springs: float,
    ply: float,
    is_told: bool,
    tmp_path: Path,
) -> None:
    """Only where the thickness of plies sets the step."""
    deck = Deck("note", 1.0e-6)
    deck.control(linear=linear, share=share, scheme=scheme)
    deck.mesh(regular(8.0, 8.0, 4, 4, 9))
    deck.laminate([Ply(CARBON, ply, angle) for angle in (0.0, 90.0)])
    if springs > 0.0:
        deck.interfaces(springs, springs)
    code, text = said("check", deck.write(tmp_path / "job.k"))
    assert code == 0, text
    notes = [line for line in text.splitlines() if "of the stable step of plies" in line]
    assert len(notes) == int(is_told)
    assert not is_told or notes[0].startswith("note: large displacement, 0.900 of")


@pytest.mark.parametrize(
    ("card", "linear", "expected"),
    [
        (None, False, "0.8 (large displacement)"),
        (None, True, "0.9 (linear strain)"),
        (0.0, False, "0.8 (large displacement)"),
        (0.0, True, "0.9 (linear strain)"),
        (0.9, False, "0.9"),
        (0.8, True, "0.8"),
    ],
)
def test_the_share_of_the_stable_step_follows_the_strain_measure(
    card: float | None, linear: bool, expected: str, tmp_path: Path
) -> None:
    """Unless the deck has one; the listing prints which, and the step is that share."""
    deck = Deck("share", 1.0e-6)
    deck.add("CONTROL_LAYERWISE", (0 if linear else 1, 0.05))
    if card is not None:
        deck.add("CONTROL_TIMESTEP", (0.0, card))
    deck.mesh(regular(8.0, 8.0, 1, 1, 9))
    deck.laminate([Ply(CARBON, THIN, 0.0)])
    code, text = said("check", deck.write(tmp_path / "job.k"))
    assert code == 0, text
    found = {line[:30].strip(): line[30:].split(", TSSFAC ") for line in text.splitlines()}
    step, share = found["largest step taken"]
    assert share == expected
    stable = float(found["stable step"][0].split()[0])
    assert float(step.split()[0]) == pytest.approx(float(expected.split()[0]) * stable, rel=1e-5)


@pytest.mark.parametrize(
    ("largest", "curve", "springs", "cause"),
    [
        (0.0, 0.0, 0.0, "quad 1 ply 1"),
        (1.0e-9, 0.0, 0.0, "DTMAX"),
        (1.0, 0.0, 0.0, "quad 1 ply 1"),
        (0.0, 1.0e-9, 0.0, "LCTM"),
        (2.0e-9, 1.0e-9, 0.0, "LCTM"),
        (1.0e-9, 2.0e-9, 0.0, "DTMAX"),
        (0.0, 0.0, 1.0e9, "interfaces"),
    ],
    ids=["quad", "DTMAX", "far", "LCTM", "LCTM below", "DTMAX below", "interfaces"],
)
def test_line_of_life_names_what_bounds_the_step(
    largest: float, curve: float, springs: float, cause: str, tmp_path: Path
) -> None:
    """A quad and a ply, the springs, or the bound of the deck that is least."""
    deck = Deck("cause", 1.0e-7)
    deck.add("CONTROL_LAYERWISE", (0, 0.05, EXPLICIT, largest))
    number = deck.curve([(0.0, curve), (1.0, curve)]) if curve > 0.0 else 0
    deck.add("CONTROL_TIMESTEP", (0.0, 0.9, 0, 0.0, 0.0, number))
    deck.mesh(regular(8.0, 8.0, 1, 1, 9))
    deck.laminate([Ply(CARBON, THIN, angle) for angle in (0.0, 0.0)])
    if springs > 0.0:
        deck.interfaces(springs, springs)
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == 0, text
    heads, *lines = text[text.index("    cycle") :].splitlines()
    first = heads.index("controlled by")
    assert lines[0][first : heads.index("  error")].strip() == cause, text


@pytest.mark.parametrize("kind", ["a ply", "cracks", "springs"])
def test_step_follows_the_unit_of_time(kind: str, tmp_path: Path) -> None:
    """In nanoseconds the step is 1e9 times the number, and the density the square of that."""
    steps = []
    for unit in (1.0, 1.0e9):
        deck = Deck("unit", 1.0e-6 * unit)
        deck.mesh(regular(3.0, 3.0, 3, 3, 4))
        ply = Ply(replace(CARBON, density=CARBON.density * unit**2), THIN, 0.0)
        deck.laminate([ply] * (2 if kind == "springs" else 1), 1)
        if kind == "springs":
            deck.interfaces(1.0e9, 1.0e9)
        if kind == "cracks":
            deck.add("CRACK_LINES", (1, 1.0, 0.3), (60.0, 110.0, 75.0))
        code, text = said("check", deck.write(tmp_path / "job.k"))
        assert code == 0, text
        found = re.search(r"^stable step +(\S+)", text, re.MULTILINE)
        assert found is not None, text
        steps.append(float(found[1]))
    assert steps[1] == pytest.approx(1.0e9 * steps[0], rel=2e-5)


def test_no_stable_step(tmp_path: Path) -> None:
    """A step that does not move the time is an error with its element, whatever DTMAX says."""
    deck = Deck("none", 1.0e12)
    deck.control(largest=1.0)
    deck.mesh(regular(8.0, 8.0, 1, 1, 9))
    deck.laminate([Ply(CARBON, THIN, 0.0)])
    code, text = said("check", deck.write(tmp_path / "job.k"))
    assert code == INPUT, text
    assert "no stable step can be found that gets to the end: element 1 asks for " in text
    assert "and ENDTIM is 1e12\n" in text
