"""Loads, motions, weight and hinges of decks of others arrive, by closed forms of the motion."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from foreign_decks import QUADS, SIDE, Foreign, ball, composite, ply_law, rim
from foreign_forms import LIKE, refused, same, with_more
from programs import plydyn_pre, run_deck

END = 2.0e-5
GRAVITY = 1.0e6  # mm/s2
#: Mass of the plate in t: density, area and thickness
PLATE = 1.6e-9 * SIDE**2 * 0.5
SHELL = (SIDE / QUADS) ** 2


def run(folder: Path, solver: str, deck: Foreign, end: float = END) -> None:
    """Translate and run a deck, `user.k`."""
    deck.put("CONTROL_TERMINATION", (end,))
    for name in ("RCFORC", "GLSTAT", "NODOUT"):
        deck.put(f"DATABASE_{name}", (1.0e-6,))
    (folder / "user.k").write_text(deck.text())
    result = plydyn_pre(folder, "translate", "user.k", "--like", LIKE)
    assert result.returncode == 0, result.stdout + result.stderr
    run_deck(solver, folder, "user_plydyn.k")


def rows(folder: Path, name: str) -> tuple[list[str], np.ndarray]:
    """Names of the columns of a history, without units, and its rows."""
    path = folder / f"user_plydyn.{name}.csv"
    head = path.read_text().splitlines()[0].split(",")
    return [each.rpartition(" [")[0] for each in head], np.loadtxt(path, delimiter=",", skiprows=1)


def plate(*curves: tuple[int, float, float, float]) -> tuple[Foreign, list[int]]:
    """A plate of shells, with curves by number, first and last value, and last time."""
    deck = Foreign()
    ids = deck.layer()
    deck.quads(1, ids)
    composite(deck)
    ply_law(deck)
    for number, first, last, end in curves:
        deck.put("DEFINE_CURVE", (number,), f"{0.0:>20}{first:>20}", f"{end:>20}{last:>20}")
    return deck, ids


def test_a_free_plate_has_the_momentum_that_all_loads_give_it(solver: str, tmp_path: Path) -> None:
    """Impulses of a ramp and of steady loads, of which central differences lose nothing."""
    deck, ids = plate((7, 1.0, 1.0, 1.0), (8, 0.0, 1.0, END))
    deck.put("LOAD_BODY_Z", (7, GRAVITY))
    deck.put("LOAD_NODE_POINT", (ids[40], 1, 8, 2.0))
    deck.set_of("SET_NODE_LIST", 5, ids[20:23])
    deck.put("LOAD_NODE_SET", (5, 2, 7, -1.5))
    deck.put("SET_SHELL_LIST", (6,), (28, 29, 36, 37))
    deck.put("LOAD_SHELL_SET", (6, 7, 0.1))
    # clockwise from above: its pressure is upwards
    deck.put("LOAD_SEGMENT_ID", (1, "edge"), (7, 0.2, None, ids[0], ids[9], ids[10], ids[1]))
    run(tmp_path, solver, deck)
    names, history = rows(tmp_path, "energy")
    time = history[:, names.index("time")]
    down = PLATE * GRAVITY + 4 * SHELL * 0.1 - SHELL * 0.2
    for axis, impulse in (
        ("x", 2.0 * time**2 / (2.0 * END)),
        ("y", -4.5 * time),
        ("z", -down * time),
    ):
        momentum = history[:, names.index(f"momentum {axis}")]
        assert momentum == pytest.approx(impulse, abs=1e-6 * np.abs(impulse).max()), axis


def test_motions_are_those_of_their_curves_and_a_ball_falls(solver: str, tmp_path: Path) -> None:
    """Displacement and velocity over time, and the way of a ball under its weight."""
    deck, ids = plate((7, 1.0, 1.0, 1.0), (8, 0.0, 1.0, END))
    deck.set_of("SET_NODE_LIST", 1, rim(ids))
    deck.put("BOUNDARY_SPC_SET", (1, 0, 0, 1, 1))
    deck.put("BOUNDARY_PRESCRIBED_MOTION_SET", (1, 1, 2, 8, 0.03))
    deck.put("BOUNDARY_PRESCRIBED_MOTION_NODE", (ids[40], 3, 0, 7, -500.0))
    deck.put("DATABASE_HISTORY_NODE", (ids[0], ids[40]))
    deck.put("LOAD_BODY_Z", (7, GRAVITY))
    ball(deck)
    run(tmp_path, solver, deck)
    names, history = rows(tmp_path, "nodes")
    time = history[:, names.index("time")]
    for node, axis, place in ((ids[0], "x", 0.03 * time / END), (ids[40], "z", -500.0 * time)):
        for face in ("bottom", "top"):
            moved = history[:, names.index(f"n{node} {face} u{axis}")]
            assert moved == pytest.approx(place, abs=1e-6 * np.abs(place).max())
    names, fall = rows(tmp_path, "impactor_1")
    time, way = (fall[:, names.index(name)] for name in ("time", "displacement"))
    assert way == pytest.approx(-GRAVITY * time**2 / 2.0, abs=1e-6 * np.abs(way).max())
    assert np.all(fall[:, names.index("force")] == 0.0)


def test_damping_of_one_direction_is_refused(tmp_path: Path) -> None:
    """Zero in all three directions, as on a short card, is one in all."""
    alone, both = (with_more(f"*DAMPING_GLOBAL\n0,10.{more}\n") for more in ("", ",1.,1.,1."))
    same(tmp_path, both, alone)
    one = with_more("*DAMPING_GLOBAL\n0,10.,0.,0.,1.\n")
    refused(tmp_path, one, "STX: damping of one direction is not translated")


def deflection(time: np.ndarray) -> np.ndarray:
    """That of the middle of [0/90]s, hinged at all edges, whose weight begins to act.

    Navier's series of the modes of a thin orthotropic plate: each swings about its static part.
    """
    thickness, axial, cross, minor, shear = 0.125, 153000.0, 10300.0, 0.0202, 6000.0
    share = 1.0 - minor**2 * axial / cross
    stiff = np.array([axial, cross]) / share
    inner, outer = (2.0 * h**3 / 3.0 * thickness**3 for h in (1.0, 2.0))
    d1, d2 = (stiff @ np.array(each) for each in ((outer - inner, inner), (inner, outer - inner)))
    mixed = (minor * axial / share + 2.0 * shear) * outer
    total = np.zeros_like(time)
    for m in range(1, 40, 2):
        for n in range(1, 40, 2):
            a, b = (np.pi * k / SIDE for k in (m, n))
            square = (d1 * a**4 + 2.0 * mixed * a**2 * b**2 + d2 * b**4) * SIDE**2 / PLATE
            middle = np.sin(m * np.pi / 2.0) * np.sin(n * np.pi / 2.0)
            total += (
                16.0 * middle / (np.pi**2 * m * n * square) * (1.0 - np.cos(square**0.5 * time))
            )
    return -GRAVITY * total


def test_a_plate_whose_edges_may_turn_is_hinged(solver: str, tmp_path: Path) -> None:
    """2 %: shear takes a part of one, and the hinge is at the height of the shells."""
    deck, ids = plate((7, 1.0, 1.0, 1.0))
    deck.set_of("SET_NODE_LIST", 1, rim(ids))
    deck.put("BOUNDARY_SPC_SET", (1, 0, 1, 1, 1))
    deck.put("LOAD_BODY_Z", (7, GRAVITY))
    deck.put("DATABASE_HISTORY_NODE", (ids[40],))
    run(tmp_path, solver, deck, 2.0e-4)
    names, history = rows(tmp_path, "nodes")
    expected = deflection(history[:, 0])
    found = history[:, names.index(f"n{ids[40]} top uz")]
    assert found == pytest.approx(expected, abs=0.02 * np.abs(expected).max())
