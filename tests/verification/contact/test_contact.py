"""Contact holds nothing that does not press, opens and closes, and never pulls."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, TOP, Deck, Ply, Sphere
from elasticity import CARBON, STEEL
from meshes import Mesh, regular
from runs import DIGITS, Results, run

SIDE, THICKNESS, RADIUS = 10.0, 1.0, 5.0
METHODS = pytest.mark.parametrize("method", [1, 2], ids=["nodes on sphere", "points of plate"])


def plate(time: float, quads: int = 6) -> tuple[Deck, Mesh]:
    """A square carbon plate whose edges are held, to be struck in its middle."""
    mesh = regular(SIDE, SIDE, quads, quads, 9)
    deck = Deck("contact", time)
    deck.control()
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.5 * THICKNESS, 0.0), Ply(CARBON, 0.5 * THICKNESS, 90.0)], 1)
    deck.hold(mesh.boundary(), "xyz")
    deck.intervals(impactor=0.0, glstat=0.01 * time)
    return deck, mesh


@METHODS
@pytest.mark.parametrize("face", [TOP, BOTTOM])
def test_sphere_at_rest_stays_at_rest(method: int, face: int, tmp_path: Path) -> None:
    """A sphere that touches without weight or velocity makes no force and no motion.

    Round-off of its place, 1e-15 mm, may count as a penetration once.
    """
    deck, _ = plate(1.0e-5)
    centre = (0.5 * SIDE, 0.5 * SIDE, face * (RADIUS + 0.5 * THICKNESS))
    deck.sphere(Sphere(RADIUS, 1.0e-6, centre, method=method, face=face))
    # a deck in which nothing can happen is refused: a ball that comes later
    later = (*centre[:2], 9.0 * centre[2])
    deck.sphere(Sphere(RADIUS, 1.0e-6, later, (0.0, 0.0, -face * 1.0), face=face), 2)
    results = run(deck, tmp_path)
    history = results.table("impactor_1")
    assert np.abs(history["displacement"]).max() < 1.0e-12
    assert np.abs(history["velocity"]).max() < 1.0e-6
    assert results.table("energy")["internal"].max() < 1.0e-15


@METHODS
def test_sphere_falls_freely(method: int, compare: Comparison, tmp_path: Path) -> None:
    """Central differences are exact for a constant acceleration."""
    deck, _ = plate(1.0e-5)
    gravity = -1.0e9
    centre = (0.5 * SIDE, 0.5 * SIDE, RADIUS + 0.5 * THICKNESS + 0.1)
    deck.sphere(Sphere(RADIUS, 1.0e-6, centre, gravity=gravity, method=method))
    history = run(deck, tmp_path).table("impactor_1")
    exact = 0.5 * gravity * history["time"] ** 2
    fallen = history["displacement"]
    compare.values("free fall", fallen, exact, unit="mm", rel=3.0 * DIGITS, abs=1e-15)
    assert np.abs(history["force"]).max() == 0.0


def spans(touching: np.ndarray) -> list[tuple[int, int]]:
    """First and past-the-last index of every stretch of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], touching.astype(int), [0]])))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))


@METHODS
def test_sphere_bounces(method: int, compare: Comparison, tmp_path: Path) -> None:
    """Under a strong gravity a guided sphere comes back: free flight between the contacts.

    The longest flight is a parabola, the force never pulls, and the balance of energy closes.
    """
    gravity = -2.0e8
    deck, _ = plate(4.0e-4)
    centre = (0.5 * SIDE, 0.5 * SIDE, RADIUS + 0.5 * THICKNESS + 0.05)
    sphere = Sphere(RADIUS, 2.0e-6, centre, guided=True, gravity=gravity, method=method)
    deck.sphere(sphere)
    results = run(deck, tmp_path)
    history = results.table("impactor_1")
    assert history["force"].min() >= 0.0
    contacts = spans(history["force"] > 0.0)
    assert len(contacts) >= 2
    flights = [(a[1], b[0]) for a, b in pairwise(contacts)]
    first, past = max(flights, key=lambda flight: flight[1] - flight[0])
    flying = slice(first + 2, past - 2)
    time, height = history["time"][flying], history["displacement"][flying]
    parabola = np.polynomial.Polynomial.fit(time, height, 2)
    assert np.abs(parabola(time) - height).max() < 1e-9
    found = 2.0 * parabola.convert().coef[2]
    compare.number("gravity between two contacts", found, gravity, unit="mm/s2", rel=1e-6)
    assert np.abs(results.table("energy")["error"]).max() < 0.01


@METHODS
def test_two_free_bodies_keep_their_momentum(
    method: int, compare: Comparison, tmp_path: Path
) -> None:
    """A ball on a free block: momentum to round-off, restitution between none and full."""
    mesh, thickness, mass, velocity = regular(8.0, 8.0, 6, 6, 9), 4.0, 2.0e-6, 2.0e3
    deck = Deck("two free bodies", 4.0e-5)
    deck.control()
    deck.mesh(mesh)
    deck.laminate([Ply(STEEL, thickness)], 2, 3)
    deck.intervals(impactor=0.0, glstat=4.0e-7)
    centre = (4.0, 4.0, 0.5 * thickness + RADIUS)
    sphere = Sphere(RADIUS, mass, centre, (0.0, 0.0, -velocity), method=method)
    deck.sphere(sphere)
    results = run(deck, tmp_path)
    history, energy = results.table("impactor_1"), results.table("energy")
    momentum = energy["momentum z"]
    compare.values("momentum of ball and block", momentum, -mass * velocity, rel=DIGITS)
    assert history["force"][-1] == 0.0
    block = STEEL.density * 8.0 * 8.0 * thickness
    after = history["velocity"][-1]
    away = (momentum[-1] - mass * after) / block
    restitution = (after - away) / velocity
    assert 0.0 < restitution < 1.0


def part_of_impact(folder: Path, method: int, planes: int) -> tuple[np.ndarray, np.ndarray]:
    """Force of a whole impact over time, from what planes of symmetry through its axis leave."""
    sizes = [0.5 * SIDE if axis < planes else SIDE for axis in range(2)]
    middle = [0.0 if axis < planes else 0.5 * SIDE for axis in range(2)]
    mesh = regular(*sizes, *(6 if axis < planes else 12 for axis in range(2)), 9)
    deck = Deck("part", 5.0e-5)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.5 * THICKNESS, 0.0), Ply(CARBON, 0.5 * THICKNESS, 90.0)], 1)
    cut = [set(mesh.where(**{name: 0.0})) for name in "xy"[:planes]]
    held = {*mesh.where(x=sizes[0]), *mesh.where(y=sizes[1])}
    held |= {node for name in "xy"[planes:] for node in mesh.where(**{name: 0.0})}
    deck.hold(sorted(held), "xyz")
    for name, nodes in zip("xy", cut, strict=False):
        deck.hold(sorted(nodes - held), name)
    share = 0.5**planes
    centre = (*middle, RADIUS + 0.5 * THICKNESS)
    velocity = (0.0, 0.0, -5.0e3)
    deck.sphere(Sphere(RADIUS, 1.0e-5 * share, centre, velocity, guided=True, method=method))
    deck.intervals(impactor=0.0, glstat=5.0e-5)
    history = run(deck, folder).table("impactor_1")
    return history["time"], history["force"] / share


@METHODS
@pytest.mark.parametrize("planes", [1, 2], ids=["half", "quarter"])
def test_planes_of_symmetry_leave_the_force_as_it_is(
    method: int, planes: int, compare: Comparison, tmp_path: Path
) -> None:
    """Half or a quarter of an impact, cut through the axis of the sphere, is the whole one."""
    folders = [tmp_path / "whole", tmp_path / "part"]
    for folder in folders:
        folder.mkdir()
    time, whole = part_of_impact(folders[0], method, 0)
    part_time, part = part_of_impact(folders[1], method, planes)
    assert part_time == pytest.approx(time, rel=1.0e-6)
    assert whole.max() > 0.0
    compare.values("force of a half or a quarter", part, whole, unit="N", abs=1.0e-6 * whole.max())
    if (method, planes) == (1, 2):
        compare.curves(
            "impact on a quarter of a plate",
            ("time [µs]", "force [N]"),
            {"quarter, four times": (1e6 * part_time, part)},
            {"whole": (1e6 * time, whole)},
        )


def past_the_border(folder: Path, method: int, beyond: tuple[float, float]) -> Results:
    """A free sphere that comes down past the corner (SIDE, SIDE) of a plate, or past a side."""
    mesh = regular(SIDE, SIDE, 6, 6, 9)
    deck = Deck("border", 6.0e-5)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, THICKNESS)], 1)
    deck.hold(mesh.where(x=0.0), "xyz")
    low = np.hypot(*np.maximum(beyond, 0.0))
    height = 0.5 * THICKNESS + np.sqrt(RADIUS**2 - low**2) + 1.0e-3
    centre = (SIDE + beyond[0], SIDE + beyond[1], height)
    deck.sphere(Sphere(RADIUS, 1.0e-6, centre, (0.0, 0.0, -5.0e3), method=method))
    deck.intervals(impactor=0.0, glstat=6.0e-7)
    return run(deck, folder)


def test_corner_holds_a_sphere_that_hangs_over_it(tmp_path: Path) -> None:
    """Past a corner nothing but the corner touches, a point of the plate: both methods agree."""
    nodes, points = (
        past_the_border(tmp_path / f"{method}", method, (1.5, 1.0)).table("impactor_1")
        for method in (1, 2)
    )
    assert points["force"].max() > 0.0
    for name in ("force", "force x", "force y", "velocity"):
        size = np.abs(points[name]).max()
        assert np.abs(nodes[name] - points[name]).max() < 1.0e-6 * size


@METHODS
def test_edge_holds_a_sphere_that_hangs_over_it(
    method: int, compare: Comparison, tmp_path: Path
) -> None:
    """Past a side between two points one long push, outwards and up along the radius.

    The edge is touched between points of the plate and passes between contact nodes; both methods
    hold it. What turns the push from the radius at first touch is the bend of the plate.
    """
    results = past_the_border(tmp_path, method, (1.5, -0.46 * SIDE))
    history = results.table("impactor_1")
    assert len(spans(history["force"] > 0.0)) == 1
    impulse = [np.sum(history[name]) for name in ("force x", "force")]
    lean = 1.5 / np.sqrt(RADIUS**2 - 1.5**2)
    compare.number("slope of the push of an edge", impulse[0] / impulse[1], lean, rel=0.05)
    assert np.abs(results.table("energy")["error"]).max() < 1.0e-3


def test_sphere_slides_off_without_a_jolt(tmp_path: Path) -> None:
    """A ball that strikes the free end of a cantilever slides down past it, on and off.

    Contact takes less than 1 % of its energy and gives none, and both methods push alike: they
    differ by the height of the sphere between two contact nodes.
    """
    mesh, energy = regular(16.0, 4.0, 8, 2, 9), 0.5 * 2.0e-6 * 2.0e4**2
    pushes = []
    for method in (1, 2):
        deck = Deck("free end", 7.5e-4)
        deck.control(share=0.8)
        deck.mesh(mesh)
        deck.laminate([Ply(CARBON, THICKNESS)], 1)
        deck.hold(mesh.where(x=0.0), "xyz")
        height = 0.5 * THICKNESS + np.sqrt(3.0**2 - 0.4**2) + 1.0e-3
        deck.sphere(Sphere(3.0, 2.0e-6, (16.4, 2.3, height), (0.0, 0.0, -2.0e4), method=method))
        deck.intervals(impactor=0.0, glstat=0.0)
        results = run(deck, tmp_path / f"{method}")
        taken = results.table("energy")["contact"]
        assert np.abs(taken).max() < 0.01 * energy
        assert np.abs(np.diff(taken)).max() < 0.001 * energy
        history = results.table("impactor_1")
        pushes.append(
            [np.trapezoid(history[name], history["time"]) for name in ("force x", "force")]
        )
    assert pushes[0] == pytest.approx(pushes[1], rel=0.05)
