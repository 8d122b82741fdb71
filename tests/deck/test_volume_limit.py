"""VOLLIM of *CONTROL_LAYERWISE stops a run whose elements are pressed to nothing, with a state."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from broken import said
from decks import Deck, Ply
from elasticity import STEEL
from meshes import regular
from runs import Results, run, run_stage

DECK = Path(__file__).parent / "crushed" / "deck.k"
#: Of that deck: thickness of a layer, and the share of it that is lost per time, 1/s
THICKNESS = 0.25
RATE = 0.225 / 4.0e-4 / THICKNESS
#: Rows of the energies, with each of which volumes are looked at, s
ROW = 1.0e-6
STOPPED = 3

#: A clamped strip whose far end is moved beyond its clamp: length, displacement, rows of output
LONG, FAR, ROWS = 40.0, -45.0, 100
END = 1.0e-3
WARNED = 0.3


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
    assert least == pytest.approx(1.0 - RATE * time, abs=1e-3)
    results = Results(tmp_path, "job")
    assert limit - (ROW + results.table("energy")["step"][1]) * RATE < least < limit
    # the state at the stop is in the file of fields
    moved = abs(results.field("displacement")[:, 2]).max()
    assert moved == pytest.approx(THICKNESS * RATE * time, rel=1e-3)


def pressed_strip(folder: Path, kinematics: int) -> tuple[int, str, Results]:
    """A strip of metal that can only become shorter: held across and through its thickness."""
    deck = Deck("strip pressed through its clamp", END)
    deck.add("CONTROL_LAYERWISE", (kinematics, 0.05))
    mesh = regular(LONG, 10.0, 8, 2, 4)
    deck.mesh(mesh)
    deck.add("MAT_PLASTIC_KINEMATIC", (1, 7.8e-9, 2.1e5, 0.3, 200.0, 2000.0, 1.0))
    deck.add("PART_COMPOSITE", "strip", (1, 0), (1, 1.0, 0.0, 0))
    deck.add("SECTION_LAYERWISE", (1, 0, 1))
    x = mesh.points[:, 0]
    deck.hold(range(len(x)), "yz")
    deck.hold(np.flatnonzero(x < 1e-9), "x")
    curve = deck.curve([(0.0, 0.0), (END, 1.0)])
    deck.move(np.flatnonzero(x > LONG - 1e-9), 1, curve, FAR)
    deck.intervals(glstat=END / ROWS, binary_d3plot=END / 4)
    deck.write(folder / "strip.k")
    code, words = said("run", folder / "strip.k", "-o", folder)
    return code, words, Results(folder, "strip")


def check_volumes(words: str, results: Results) -> None:
    """Each row has the least ratio, at most the mean one, and the warning names the first one."""
    table = results.table("energy")
    time, least = table["time"], table["least volume"]
    # the plane strain of a strip held across: its volume is its length
    assert (least < 1.0 + FAR / LONG * time / END + 1e-9).all()
    found = re.findall(r"warning: quad \d+, ply 1 is pressed to (\S+) of its volume", words)
    assert len(found) == 1, words
    when = float(re.search(r"pressed.* at cycle \d+, time (\S+);", words)[1])
    first = int(np.argmax(least < WARNED))
    assert time[first - 1] < when < time[first] * (1.0 + 1e-5)
    assert float(found[0]) < WARNED


def test_strip_pressed_through_its_clamp_is_stopped(tmp_path: Path) -> None:
    """No strip is shorter than nothing: the run stops, with a state, before its far end is there.

    Warning and stop name quad, ply and time.
    """
    code, words, results = pressed_strip(tmp_path, kinematics=1)
    assert code == STOPPED, words
    check_volumes(words, results)
    found = re.search(
        r"quad \d+, ply 1 is pressed to (\S+) of its.*time (\S+), below the limit", words
    )
    assert found is not None, words
    least, time = float(found[1]), float(found[2])
    assert least < 0.0
    assert time <= -LONG / FAR * END
    # the state at the stop is in the file of fields
    moved = abs(results.field("displacement")[:, 0]).max()
    assert moved == pytest.approx(-FAR * time / END, rel=1e-3)


def test_linear_strain_only_warns(tmp_path: Path) -> None:
    """Linear strain knows no volumes: the run ends, with a warning and a column below zero."""
    code, words, results = pressed_strip(tmp_path, kinematics=0)
    assert code == 0, words
    check_volumes(words, results)
    assert results.table("energy")["least volume"][-1] <= 1.0 + FAR / LONG


@pytest.mark.parametrize("moved", [-4.9, -5.5])
def test_corner_that_is_turned_inside_out_is_reported(moved: float, tmp_path: Path) -> None:
    """One corner of a square of 10 mm moves along the diagonal by a in x and y.

    The edges beside it then span 10 (10 - 2 a) mm2, less than nothing beyond 5 mm.
    """
    deck = Deck("corner pushed into its quad", END)
    deck.add("CONTROL_LAYERWISE", (0, 0.05))
    mesh = regular(10.0, 10.0, 1, 1, 4)
    deck.mesh(mesh)
    deck.add("MAT_ELASTIC", (1, 7.8e-9, 2.1e5, 0.3))
    deck.add("PART_COMPOSITE", "square", (1, 0), (1, 1.0, 0.0, 0))
    deck.add("SECTION_LAYERWISE", (1, 0, 1))
    corner = np.flatnonzero(mesh.points.sum(axis=1) > 20.0 - 1e-9)
    others = np.setdiff1d(np.arange(len(mesh.points)), corner)
    deck.hold(others, "xyz")
    deck.hold(corner, "z")
    curve = deck.curve([(0.0, 0.0), (END, 1.0)])
    for direction in (1, 2):
        deck.move(corner, direction, curve, moved)
    deck.intervals(glstat=END / ROWS)
    deck.write(tmp_path / "square.k")
    code, words = said("run", tmp_path / "square.k", "-o", tmp_path)
    assert code == 0, words
    assert Results(tmp_path, "square").table("energy")["least volume"].min() > 0.0
    found = re.findall(
        r"a corner of quad 1, ply 1 is turned inside out at cycle \d+, time (\S+);", words
    )
    assert len(found) == (1 if moved < -5.0 else 0), words
    for time in found:
        crossing = 5.0 / -moved * END
        assert crossing < float(time) < crossing + 1.1 * END / ROWS


def test_first_row_of_a_stage_is_the_last_one_before_it(tmp_path: Path) -> None:
    """A block that a first stage presses to four fifths is so from the start of the next one."""
    deck = Deck("pressed block", END)
    deck.control(linear=True)
    mesh = regular(10.0, 10.0, 1, 1, 4)
    deck.mesh(mesh)
    deck.laminate([Ply(STEEL, 1.0)], 1)
    everywhere = range(len(mesh.points))
    deck.hold(everywhere, "yz")
    deck.hold(mesh.where(x=0.0), "x")
    deck.move(mesh.where(x=10.0), 1, deck.curve([(0.0, 0.0), (END, 1.0)]), -2.0)
    deck.intervals(glstat=END / 4, binary_d3dump=10**9)
    first = run(deck, tmp_path)
    second = run_stage(first, f"*CONTROL_TERMINATION\n{END},\n", "next")
    before, after = (each.table("energy")["least volume"] for each in (first, second))
    assert before[-1] == pytest.approx(0.8, rel=1e-9)
    assert after[0] == before[-1]
