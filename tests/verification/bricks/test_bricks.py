"""Bricks: patches, bending, hourglassing, plastic flow, impact, and the same bits on two threads.

A cantilever of one brick through its thickness bends as beam theory says when its hourglass
control has the stiffness of bending (IHQ 6 with coefficient 1). A long cylinder of perfectly
plastic metal opens under (2/sqrt 3) yield ln(b/a) (Hill, 1950), which bricks that lock exceed.
"""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest

from brick_decks import Bricks, add_bricks, box, shaken
from comparison import Comparison
from decks import Deck, Sphere, ramp
from elasticity import STEEL, stiffness
from runs import Results, run

YOUNG, POISSON, DENSITY = STEEL.young[0], STEEL.poisson[0], STEEL.density
YIELD = 210.0


def steel(deck: Deck) -> None:
    """Material 1, elastic."""
    deck.add("MAT_ELASTIC", (1, DENSITY, YOUNG, POISSON))


def metal(deck: Deck) -> None:
    """Material 1, perfectly plastic."""
    deck.add("MAT_PLASTIC_KINEMATIC", (1, DENSITY, YOUNG, POISSON, YIELD))


@pytest.mark.parametrize("points", [1, 8])
@pytest.mark.parametrize("linear", [True, False])
def test_patch(points: int, linear: bool, compare: Comparison, tmp_path: Path) -> None:
    """Nodes inside a distorted patch follow those outside, with Hooke's stress everywhere."""
    mesh = shaken(box((2.0, 1.5, 1.0), (3, 3, 3)), 0.08)
    gradient = 1.0e-4 * np.array([[10.0, 5.0, 3.0], [-2.0, -7.0, 4.0], [6.0, 1.0, 9.0]])
    deck = Deck("patch", 2.0e-5)
    deck.control(linear=linear, damping=1.0e6)
    add_bricks(deck, mesh, steel, points=points)
    moved = mesh.points @ gradient.T
    curve = deck.curve(ramp(1.0e-5))
    for node in mesh.outside():
        for direction in range(3):
            deck.move([node], direction + 1, curve, moved[node, direction])
    deck.add("DATABASE_FIELD", "displacement stress")
    deck.intervals(binary_d3plot=2.0e-5, glstat=1.0e-6)
    results = run(deck, tmp_path)
    # what damping has left of the motion
    with h5py.File(tmp_path / "job.vtkhdf") as file:
        there = np.array(file["VTKHDF/Points"]) @ gradient.T
    assert results.field("displacement") == pytest.approx(there, abs=1e-4 * np.abs(moved).max())
    strain = gradient + gradient.T
    strain = [*(0.5 * np.diag(strain)), strain[0, 1], strain[0, 2], strain[1, 2]]
    hooke = stiffness(STEEL) @ np.array(strain)
    found = results.field("stress")[:, [0, 1, 2, 3, 5, 4]]
    # with large displacement the strain is not that of Hooke's: 1e-3 of it
    close = 2e-4 if linear else 3e-3
    close *= np.abs(hooke).max()
    compare.values("stress in a distorted patch", found, hooke, unit="MPa", abs=close)
    assert results.table("energy")["hourglass"][-1] < 1e-8 * results.table("energy")["internal"][-1]


@pytest.mark.parametrize(("points", "hourglass"), [(1, (6, 1.0)), (1, (3, 0.1)), (8, (6, 0.1))])
def test_rigid_motion(points: int, hourglass: tuple[int, float], tmp_path: Path) -> None:
    """A cube flies on and turns by a quarter about a slanted axis, strained by nothing.

    All axes of a cube are principal. Centrifugal forces stretch it by at most rho omega^2 R^2 / E,
    twice that as they set in at once.
    """
    mesh = box((1.0, 1.0, 1.0), (3, 3, 3))
    rate, drift = 2000.0, np.array([300.0, -200.0, 100.0])
    axis = np.array([2.0, -1.0, 2.0]) / 3.0
    arm = mesh.points - mesh.points.mean(axis=0)
    end = 0.5 * np.pi / rate
    deck = Deck("a cube that turns", end)
    deck.control()
    add_bricks(deck, mesh, steel, points=points, hourglass=hourglass)
    deck.velocities(drift + rate * np.cross(axis, arm))
    deck.histories(range(len(arm)), end)
    deck.intervals(glstat=end / 20, binary_d3plot=end)
    results = run(deck, tmp_path)
    radius = np.linalg.norm(arm, axis=1).max()
    stretch = 2.0 * DENSITY * rate**2 * radius**2 / YOUNG
    table, energy = results.table("nodes"), results.table("energy")
    angle = rate * table["time"][-1]
    turned = arm * np.cos(angle) + np.cross(axis, arm) * np.sin(angle)
    turned += np.outer(arm @ axis, axis) * (1.0 - np.cos(angle))
    moved = np.array([[table[f"n{i + 1} u{c}"][-1] for c in "xyz"] for i in range(len(arm))])
    # radial stretch, and the lag of a body whose inertia has grown by as much
    found = moved - (turned - arm) - drift * table["time"][-1]
    assert np.abs(found).max() < 4.0 * stretch * radius
    assert energy["hourglass"].max() < stretch * energy["kinetic"][0]
    assert np.abs(energy["error"]).max() < 1e-9
    for name in ("momentum x", "momentum y", "momentum z"):
        assert energy[name] == pytest.approx(energy[name][0], rel=1e-9)


def cantilever(tmp_path: Path, hourglass: tuple[int, float]) -> tuple[float, Results]:
    """Deflection over that of beam theory, bricks one thick and twice as long as thick."""
    length, width, height, force = 20.0, 1.0, 1.0, 1.0
    mesh = box((length, width, height), (10, 1, 1))
    omega = 3.516 * np.sqrt(hourglass[1] * YOUNG * height**2 / 12.0 / DENSITY) / length**2
    end = 20.0 / omega
    deck = Deck("cantilever", end)
    deck.control(linear=True, damping=1.6 * omega)
    add_bricks(deck, mesh, steel, hourglass=hourglass)
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(mesh.where(x=0.0, z=0.0), "z")
    deck.hold(mesh.where(x=0.0, y=0.0, z=0.0), "y")
    tip = mesh.where(x=length)
    curve = deck.curve(ramp(0.2 * end))
    deck.add("LOAD_NODE_SET", (deck.node_set(tip), 3, curve, force / len(tip)))
    deck.histories([tip[0]], end / 10)
    deck.intervals(glstat=end / 100, binary_d3plot=end)
    results = run(deck, tmp_path)
    inertia = width * height**3 / 12.0
    shear = YOUNG / (2.0 * (1.0 + POISSON))
    theory = force * length**3 / (3.0 * YOUNG * inertia) + force * length / (5.0 / 6.0 * shear)
    return results.table("nodes")[f"n{tip[0] + 1} uz"][-1] / theory, results


def test_bending_of_one_brick(compare: Comparison, tmp_path: Path) -> None:
    """With coefficient 1 the beam of theory; with 0.1 a beam that is 1/0.1 times as soft."""
    exact, results = cantilever(tmp_path / "exact", (6, 1.0))
    # rows of bricks with one angle each: (1 - 1/(4 n**2)) of the deflection for n bricks
    compare.number("deflection of one row of bricks over beam theory", exact, 1.0, rel=0.01)
    energy = results.table("energy")
    assert energy["hourglass"][-1] == pytest.approx(energy["internal"][-1], rel=0.05)
    soft, _ = cantilever(tmp_path / "soft", (6, 0.1))
    assert soft == pytest.approx(10.0, rel=0.05)


def test_viscous_hourglass_control(compare: Comparison, tmp_path: Path) -> None:
    """A velocity that one point does not feel dies out, and all of it is hourglass energy."""
    mesh = box((1.0, 1.0, 1.0), (1, 1, 1))
    deck = Deck("hourglass", 2.0e-6)
    deck.control(linear=True, share=0.05)
    add_bricks(deck, mesh, steel, hourglass=(3, 0.1))
    signs = np.prod(np.sign(mesh.points[:, :2] - 0.5), axis=1)
    deck.velocities(np.stack([0.0 * signs, 0.0 * signs, 1000.0 * signs], axis=1))
    deck.intervals(glstat=1.0e-8, binary_d3plot=2.0e-6)
    energy = run(deck, tmp_path).table("energy")
    start = 0.5 * DENSITY * 1000.0**2
    # Flanagan and Belytschko: force a q Gamma with a = Q rho c V**(2/3) / 4, q = 8 v
    wave = np.sqrt(stiffness(STEEL)[0, 0] / DENSITY)
    rate = 64.0 * 0.1 * wave / 4.0
    expected = start * np.exp(-2.0 * rate * energy["time"])
    # forces are those of the velocity half a step before, none in the first half step
    compare.values("decay of an hourglass", energy["kinetic"], expected, abs=0.03 * start)
    assert energy["kinetic"][-1] < 1e-3 * start
    assert energy["hourglass"][-1] == pytest.approx(start, rel=0.05)


@pytest.mark.parametrize("points", [1, 8])
def test_thick_cylinder(points: int, compare: Comparison, tmp_path: Path) -> None:
    """The pressure that opens a cylinder of perfectly plastic metal: no locking."""
    inner, outer, opening, end = 10.0, 20.0, 0.3, 4.0e-4
    mesh = box((1.0, 1.0, 1.0), (16, 16, 1))
    radius = inner * (outer / inner) ** mesh.points[:, 0]
    angle = 0.5 * np.pi * mesh.points[:, 1]
    flat = np.stack([radius * np.cos(angle), radius * np.sin(angle), mesh.points[:, 2]], axis=1)
    ring = Bricks(flat, mesh.bricks, mesh.layer)
    deck = Deck("thick cylinder", end)
    deck.control(linear=True, damping=3.0e4)
    add_bricks(deck, ring, metal, points=points)
    deck.hold(range(len(flat)), "z")
    times = np.linspace(0.0, 1.0, 41)
    way = np.where(times < 0.25, 2.0 * times**2, times - 0.125) / 0.875
    curve = deck.curve(zip((end * times).tolist(), way.tolist(), strict=True))
    for direction in range(2):
        deck.hold(np.flatnonzero(flat[:, direction] < 1e-9), "xy"[direction])
        for node in np.flatnonzero(radius < inner * (1.0 + 1e-9)):
            if flat[node, direction] > 1e-9:
                deck.move([node], direction + 1, curve, opening * flat[node, direction] / inner)
    deck.intervals(glstat=end / 200, binary_d3plot=end)
    energy = run(deck, tmp_path).table("energy")
    used = energy["time"] > 0.6 * end
    opened = opening * np.interp(energy["time"][used], end * times, way)
    pressure = np.polyfit(opened, energy["external"][used], 1)[0] / (0.5 * np.pi * inner)
    hill = 2.0 / np.sqrt(3.0) * YIELD * np.log(outer / inner)
    # inertia, the elastic part, and the chords of the mesh
    compare.number("pressure of a thick cylinder", pressure, hill, unit="MPa", rel=0.02)
    assert energy["metal plasticity"][-1] == pytest.approx(energy["dissipated"][-1])


def struck(tmp_path: Path, threads: int) -> Results:
    """A clamped plate of steel under a sphere."""
    side, thickness, n, layers = 20.0, 1.0, 10, 2
    end = 4.0e-5
    deck = Deck("struck plate", end)
    deck.control(linear=False)
    deck.add("CONTROL_PARALLEL", (threads,))
    mesh = box((side, side, thickness), (n, n, layers))
    add_bricks(deck, mesh, steel, hourglass=(6, 1.0))
    away = np.abs(mesh.points[:, :2] - 0.5 * side).max(axis=1)
    deck.hold(np.flatnonzero(away > 0.5 * side - 1e-9), "xyz")
    centre = (0.5 * side, 0.5 * side, thickness + 4.0)
    deck.sphere(Sphere(4.0, 1.0e-6, centre, velocity=(0.0, 0.0, -5000.0), method=1))
    deck.intervals(impactor=end / 200, glstat=end / 200, binary_d3plot=end)
    return run(deck, tmp_path)


def test_impact(compare: Comparison, tmp_path: Path) -> None:
    """The sphere loses the momentum of its force, and no energy is lost.

    That bricks answer as layers do is in `test_brick_damage`.
    """
    results = struck(tmp_path / "bricks", 1)
    ball, energy = results.table("impactor_1"), results.table("energy")
    momentum = 1.0e-6 * (ball["velocity"] + 5000.0)
    pushed = np.trapezoid(ball["force"], ball["time"])
    # a line is written every few steps: the trapezia between them
    compare.number("momentum of the sphere", momentum[-1], pushed, unit="N s", rel=0.02)
    assert np.abs(energy["error"]).max() < 1e-9


def test_same_bits(tmp_path: Path) -> None:
    """One thread and two give the same files."""
    folders = [tmp_path / "one", tmp_path / "two"]
    for threads, folder in enumerate(folders, 1):
        struck(folder, threads)
    for name in ("job.energy.csv", "job.impactor_1.csv"):
        assert (folders[0] / name).read_bytes() == (folders[1] / name).read_bytes()
