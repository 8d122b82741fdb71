"""Two failed layers that buckle apart, close again under load, and rub on each other.

Two equal layers, each of the thickness h, lie on each other without a joint, both ends clamped. A
shortening d of the length L buckles them apart, one upwards and one downwards:

    w^2 = 4 L (d - c) / pi^2,    c = pi^2 h^2 / 3 L,

w being the deflection in the middle without Poisson's ratio. Then the ends go back and a pressure p
presses the layers on each other: the faces overlap by p / 0.1 k, k being the stiffness of the
interface, of which failed faces keep a tenth.

A second stage frees one end. The layers are now a cantilever that moves to and fro; the loop of
Goodman and Klumpp (1956) takes 3 F_s (F - F_s) / k_2 in a cycle, with F_s = 4/3 b h mu p, as if
they had never been apart. The pressure does not turn with the layers: where they are inclined it
acts along the interface as well, by p L^2 / E h^2 = 0.4 % of the limit of friction, twice as much
beyond it.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, TOP, Bond, Deck, Ply, ramp
from elasticity import isotropic
from meshes import regular
from runs import Results, run, run_stage

FRICTION, PRESSURE = 0.3, 0.1
YOUNG, DENSITY = 70.0e3, 2.7e-9
LENGTH, WIDTH, HEIGHT = 100.0, 10.0, 2.0
BOND = Bond((1.0e5, 1.0e5), (50.0, 50.0), (0.5, 0.5), 1.0, False, FRICTION)
#: Share of its stiffness that a failed interface keeps against closing
CLOSED = 0.1
RIGIDITY = YOUNG * HEIGHT**3 / 12.0
#: Of a clamped layer, and of the cantilever whose layers slide
SWING = 22.37 / LENGTH**2 * np.sqrt(RIGIDITY / (DENSITY * HEIGHT))
SLOW = 3.516 / LENGTH**2 * np.sqrt(RIGIDITY / (DENSITY * HEIGHT))
PERIOD, CANTILEVER = 2.0 * np.pi / SWING, 2.0 * np.pi / SLOW
ONSET = np.pi**2 * HEIGHT**2 / (3.0 * LENGTH)
SHORTENING = 2.0 * ONSET
#: Deflection of each layer over its thickness by the pressure from inside alone
PUSHED = 1.0e-2
#: Times in periods: shortened, still, back again, pressed
SHORT, STILL, BACK, PRESSED = 6.0, 10.0, 16.0, 22.0
#: Force at the end of the cantilever
FORCE = 1.0


def legs(*points: tuple[float, float]) -> list[tuple[float, float]]:
    """A curve through points, times in periods, that rests at each of them."""
    curve = [(0.0, points[0][1])]
    for (start, low), (end, high) in pairwise(points):
        curve += [
            (PERIOD * (start + (end - start) * t), low + (high - low) * share)
            for t, share in ramp(1.0, 60)[1:]
        ]
    return curve


def closed(folder: Path) -> Results:
    """The layers are buckled, closed and pressed."""
    deck = Deck("layers that buckle and close", PRESSED * PERIOD)
    deck.control(damping=0.5 * SWING)
    mesh = regular(LENGTH, WIDTH, 10, 1, 9)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(DENSITY, YOUNG, 0.0), HEIGHT)] * 2, 1)
    deck.cohesive(BOND)
    deck.add("INITIAL_DELAMINATION", (1, 0, 0))
    near, far = mesh.where(x=0.0), mesh.where(x=LENGTH)
    deck.hold(near, "xyz")
    deck.hold(far, "yz")
    ways = legs((0.0, 0.0), (SHORT, 1.0), (STILL, 1.0), (BACK, 0.0), (PRESSED, 0.0))
    deck.move(far, 1, deck.curve(ways), -SHORTENING)
    push = 384.0 * RIGIDITY * PUSHED * HEIGHT / LENGTH**4
    loads = (0.0, 0.0), (SHORT, -push), (STILL, -push), (BACK, 0.0), (PRESSED, PRESSURE)
    curve = deck.curve(legs(*loads))
    for face in (TOP, BOTTOM):
        deck.add("LOAD_FACE_PRESSURE", (0, face, curve, 1.0))
    deck.profile(1, 0.5 * LENGTH, 0.5 * WIDTH, 0.02 * PERIOD, 2)
    deck.intervals(glstat=0.02 * PERIOD, spcforc=0.01 * CANTILEVER)
    deck.add("DATABASE_BINARY_D3DUMP", (999999999,))
    return run(deck, folder, "closed")


def bent(before: Results, reach: float) -> tuple[Results, float, float]:
    """A stage in which the far end is free but for its deflection; when it turns, and ends."""
    lift, end = 3.0 * CANTILEVER, 13.0 * CANTILEVER
    rise = [(lift * t, 0.5 * (1.0 - np.cos(np.pi * t))) for t in np.linspace(0.0, 1.0, 50)]
    cycle = [
        (lift + (end - lift) * t, np.cos(2.0 * np.pi * t)) for t in np.linspace(0.01, 1.0, 100)
    ]
    points = "".join(f"{float(t)!r},{float(w)!r}\n" for t, w in rise + cycle)
    # the sets of both ends are the first two of the deck before
    body = (
        f"*CONTROL_TERMINATION\n{float(end)!r},\n*DAMPING_GLOBAL\n0,{float(0.4 * SLOW)!r}\n"
        f"*DEFINE_CURVE\n90\n{points}*BOUNDARY_SPC_SET\n1,0,1,1,1\n"
        f"*BOUNDARY_PRESCRIBED_MOTION_SET\n2,3,2,90,{reach!r}\n"
    )
    return run_stage(before, body, "bent"), lift, end


def test_layers_close_and_hold_by_friction(compare: Comparison, tmp_path: Path) -> None:
    """Opening while buckled, overlap when pressed, and the loop of friction afterwards."""
    before = closed(tmp_path)
    profile = before.table("profile_1")
    height = profile["uz"].reshape(-1, 4)
    time, opening = profile["time"][::4] / PERIOD, height[:, 2] - height[:, 1]
    still = (time > STILL - 1.0) & (time < STILL)
    exact = 4.0 * np.sqrt(LENGTH * (SHORTENING - ONSET)) / np.pi
    compare.number("opening while buckled", opening[still].mean(), exact, unit="mm", rel=0.03)
    overlap = PRESSURE / (CLOSED * BOND.stiffness[0])
    for name, found in (("at the end", opening[-1]), ("at any time", opening.min())):
        words = f"overlap of the pressed faces {name}"
        compare.number(words, -found, overlap, unit="mm", rel=0.02)

    limit = 4.0 / 3.0 * WIDTH * HEIGHT * FRICTION * PRESSURE
    stuck = 2.0 * YOUNG * WIDTH * HEIGHT**3 / LENGTH**3
    sliding = stuck / 4.0
    reach = limit / stuck + (FORCE - limit) / sliding
    loss = 3.0 * limit * (FORCE - limit) / sliding
    after, lift, end = bent(before, reach)
    energy, supports = after.table("energy"), after.table("supports")
    start = energy["time"][0]
    lost = np.interp([start + lift, start + end], energy["time"], energy["friction"])
    compare.number("loop of friction after closing", lost[1] - lost[0], loss, unit="mJ", rel=0.03)
    name = next(name for name in supports.names if name.startswith("motion") and "fz" in name)
    turning = np.abs(supports["time"] - start - lift) < 0.1 * CANTILEVER
    force = np.abs(supports[name][turning].mean())
    compare.number("force at the turn", force, FORCE, unit="N", rel=0.03)
    for results in (before, after):
        assert np.abs(results.table("energy")["error"]).max() < 1.0e-9
    assert before.table("energy")["friction"][-1] == pytest.approx(0.0, abs=1.0e-3 * loss)
    compare.curves(
        "layers that buckle apart and close",
        ("time / period", "opening in the middle [mm]"),
        {"run": (time, opening)},
        {"buckled strips": (np.array([SHORT, STILL]), np.array([exact, exact]))},
    )
