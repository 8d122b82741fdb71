"""Layers that slide on each other: failed interfaces with friction against closed forms."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, TOP, Bond, Deck, Ply, ramp
from elasticity import isotropic
from meshes import regular
from runs import run

FRICTION = 0.3


def pressed(
    deck: Deck, pressure: float, until: float, faces: tuple[int, ...] = (TOP, BOTTOM)
) -> None:
    """Fail all interfaces, and press the faces with a pressure that grows slowly."""
    deck.cohesive(Bond((1.0e5, 1.0e5), (50.0, 50.0), (0.5, 0.5), 1.0, True, FRICTION))
    deck.add("INITIAL_DELAMINATION", (1, 0, 0))
    curve = deck.curve(ramp(until))
    for face in faces:
        deck.add("LOAD_FACE_PRESSURE", (0, face, curve, pressure))


def test_two_layers_bend_with_friction_between_them(compare: Comparison, tmp_path: Path) -> None:
    """F8: the loop of Goodman and Klumpp (1956), 3 F_s (F - F_s) / k_2 in every cycle.

    Two layers stick up to the force F_s = 4/3 b h mu p at the end of the cantilever, as one beam of
    stiffness k_1 = 2 E b h^3 / L^3. Then they slide on each other all along, with k_2 = k_1 / 4.
    """
    young, length, width, height, pressure, force = 70.0e3, 100.0, 10.0, 2.0, 2.0, 20.0
    limit = 4.0 / 3.0 * width * height * FRICTION * pressure
    stuck = 2.0 * young * width * height**3 / length**3
    sliding = stuck / 4.0
    reach = limit / stuck + (force - limit) / sliding
    loss = 3.0 * limit * (force - limit) / sliding
    assert (limit, reach, loss) == pytest.approx((16.0, 2.857, 68.57), rel=1.0e-3)

    density = 2.7e-9
    slowest = 3.516 / length**2 * np.sqrt(young * height**2 / (12.0 * density))
    period = 2.0 * np.pi / slowest
    press, lift, cycle = period, 4.0 * period, 16.0 * period
    deck = Deck("two layers with friction", press + lift + cycle)
    deck.control(linear=True, damping=0.4 * slowest, scheme=2)
    mesh = regular(length, width, 10, 1, 9)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(density, young, 0.0), height)] * 2, 1)
    pressed(deck, pressure, press)
    deck.hold(mesh.where(x=0.0), "xyz")
    rise = [(press + lift * t, 0.5 * (1.0 - np.cos(np.pi * t))) for t in np.linspace(0.0, 1.0, 50)]
    around = [
        (press + lift + cycle * t, np.cos(2.0 * np.pi * t)) for t in np.linspace(0.01, 1.0, 100)
    ]
    path = deck.curve([(0.0, 0.0), *((float(t), float(w)) for t, w in rise + around)])
    deck.move(mesh.where(x=length), 3, path, reach)
    deck.intervals(glstat=0.01 * period, spcforc=0.01 * period)
    results = run(deck, tmp_path)
    energy, supports = results.table("energy"), results.table("supports")
    lost = np.interp([press + lift, press + lift + cycle], energy["time"], energy["friction"])
    compare.number("loop of two layers", lost[1] - lost[0], loss, unit="mJ", rel=0.03)
    name = next(name for name in supports.names if name.startswith("motion") and "fz" in name)
    turning = np.abs(supports["time"] - press - lift) < 0.1 * period
    assert np.abs(supports[name][turning].mean()) == pytest.approx(force, rel=0.03)


@pytest.mark.parametrize("degrees", [0.0, 2.0])
def test_layer_slides_between_two_others(
    degrees: float, compare: Comparison, tmp_path: Path
) -> None:
    """F9: the middle one of three is held by 2 mu p A, however the mesh lies; half by symmetry.

    Without damping the layers swing under the friction, leave each other and rub less.
    """
    side, pressure, end = 10.0, 10.0, 1.0e-3
    limit, press, speed = FRICTION * pressure * side**2, 0.4 * end, 5000.0
    deck = Deck("a layer between two others", end)
    deck.control(linear=True, damping=1.0e6)
    mesh = regular(side, side, 3, 3, 9)
    turn = np.radians(degrees)
    mesh.points[:] = mesh.points @ [[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(2.7e-9, 70.0e3, 0.3), 1.0)] * 2, 1)
    pressed(deck, pressure, press, faces=(TOP,))
    nodes = range(len(mesh.points))
    deck.hold_face(nodes, BOTTOM, "yz")
    deck.hold_face(nodes, TOP, "xy")
    times = np.linspace(0.0, end - press, 60)
    path = [(press + float(t), 0.5 * speed * float(t) ** 2 / (end - press)) for t in times]
    deck.move_face(nodes, BOTTOM, 1, deck.curve([(0.0, 0.0), *path]), 1.0)
    deck.intervals(glstat=0.01 * end, spcforc=0.0)
    results = run(deck, tmp_path)
    energy, supports = results.table("energy"), results.table("supports")
    late = energy["time"] > 0.9 * end
    way = np.interp(energy["time"][late], *np.transpose(path))
    work = np.ptp(energy["friction"][late]) / np.ptp(way)
    assert 2.0 * work == pytest.approx(2.0 * limit, rel=0.01)
    name = next(name for name in supports.names if name.startswith("face 2") and "fx" in name)
    force = supports[name][supports["time"] > 0.9 * end]
    mean = np.abs(force.mean())
    compare.number("force of a layer between others", mean, limit, unit="N", rel=0.01)
