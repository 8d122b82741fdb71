"""Impactors of every shape: momentum, closed forms, seams between parts, both faces."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, TOP, Deck, Ply, Sphere
from elasticity import CARBON, STEEL, Array, isotropic
from fixture_decks import all_bodies
from meshes import Mesh, rectangle, regular
from runs import DIGITS, Results, run

METHODS = pytest.mark.parametrize("method", [1, 2], ids=["nodes on body", "points of plate"])
YOUNG, POISSON = STEEL.young[0], STEEL.poisson[0]
PLANE_STRAIN = YOUNG / (1.0 - POISSON**2)
SPEED = 2.0e3
CONE, TIP = 60.0, 1.0
#: Radius, second card and height of the centre above the lowest point
BODIES = {
    "TUP": (4.0, (0.0,), 4.0),
    "flat CYLINDER": (2.0, (6.0, 0.5), 3.0),
    "lying CYLINDER": (2.0, (12.0, 0.5, 1.0, 0.3, 0.0), 2.0),
    "CONE": (3.0, (CONE, TIP), TIP + (3.0 - TIP) / float(np.tan(np.radians(CONE)))),
}


@METHODS
@pytest.mark.parametrize("name", BODIES)
def test_free_bodies_keep_their_momentum(name: str, method: int, tmp_path: Path) -> None:
    """A body on a free block: momentum to round-off, energy in balance, both come apart.

    From below all is the mirror image, see `test_impact_from_below_is_the_mirror_image`.
    """
    side, thickness, mass = 8.0, 4.0, 2.0e-6
    mesh = regular(side, side, 10, 10, 9)
    deck = Deck("two free bodies", 4.0e-5)
    deck.control()
    deck.mesh(mesh)
    deck.laminate([Ply(STEEL, thickness)], 2, 3)
    deck.intervals(impactor=0.0, glstat=4.0e-7)
    radius, form, high = BODIES[name]
    centre = (0.5 * side, 0.5 * side, 0.5 * thickness + high)
    velocity = (0.0, 0.0, -SPEED)
    shape = name.split()[-1]
    body = Sphere(radius, mass, centre, velocity, method=method, shape=shape, form=form)
    deck.sphere(body)
    results = run(deck, tmp_path)
    history, energy = results.table("impactor_1"), results.table("energy")
    assert energy["momentum z"] == pytest.approx(
        np.full(len(energy["time"]), -mass * SPEED), rel=10.0 * DIGITS
    )
    assert np.abs(energy["error"]).max() < 1.0e-10
    assert history["force"].max() > 0.0
    assert history["force"][-1] == 0.0
    block = STEEL.density * side**2 * thickness
    after = history["velocity"][-1]
    away = (energy["momentum z"][-1] - mass * after) / block
    assert 0.0 < (after - away) / SPEED < 1.0


@METHODS
def test_flat_face_on_a_bar(method: int, compare: Comparison, tmp_path: Path) -> None:
    """A mass on the end of a bar: the force is rho c A V exp(-rho c A t / M) (Saint Venant).

    Without a Poisson's ratio the bar moves along its axis only, and its wave comes back after
    2 L / c. The force rings about the closed form by what the mesh cannot follow of the jump at
    the start; its impulse does not: within what half a step and one layer take up.
    """
    bar = isotropic(7.85e-9, 2.1e5, 0.0)
    side, length, mass = 2.0, 40.0, 2.0e-6
    sound = float(np.sqrt(bar.young[0] / bar.density))
    area = side**2
    end = 1.9 * length / sound
    mesh = regular(side, side, 2, 2, 9)
    deck = Deck("bar", end)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(bar, length)], 2, 80)
    deck.hold_face(range(len(mesh.points)), BOTTOM, "z")
    deck.intervals(impactor=0.0, glstat=end)
    centre = (0.5 * side, 0.5 * side, 0.5 * length + 3.0)
    body = Sphere(4.0, mass, centre, (0.0, 0.0, -SPEED), guided=True, method=method)
    deck.sphere(replace(body, shape="CYLINDER", form=(6.0, 0.0)))
    history = run(deck, tmp_path).table("impactor_1")
    impedance = bar.density * sound * area
    velocity = -SPEED * np.exp(-impedance * history["time"] / mass)
    layer = bar.density * area * length / 80.0
    assert np.abs(history["velocity"] - velocity).max() < layer / mass * SPEED
    late = history["time"] > 0.25 * end
    force = -impedance * velocity
    smooth = np.ones(201) / 201.0
    mean = np.convolve(history["force"], smooth, "same")[late][:-200]
    compare.values("force of a flat face on a bar", mean, force[late][:-200], unit="N", rel=0.02)


def lines(contact: float, depth: float) -> Array:
    """Four quads under the contact, five nodes to its radius, then ever larger ones."""
    widths = np.append(np.full(4, 0.4), 0.4 * 2.0 ** np.arange(1, 6)) * contact
    widths[4:] *= (depth - widths[:4].sum()) / widths[4:].sum()
    return np.append(0.0, np.cumsum(widths))


def test_cone_on_a_block(tmp_path: Path) -> None:
    """Sneddon (1965): F = 2 E tan(alpha) / (pi (1 - nu^2)) w^2, contact radius 2 w tan(alpha) / pi.

    A quarter of a block twenty contact radii deep and wide, struck slowly: the cone goes in by
    (3 M V^2 / 2 k)^(1/3) where the force is k w^2. The held bottom stops what a half-space would
    sink there, and makes the block harder, by less than for a sphere of the same contact radius,
    as the force is the smaller one.
    """
    angle, contact, depth, speed = 85.0, 1.0, 20.0, 1.0e3
    slope = float(np.tan(np.radians(angle)))
    stiffness = 2.0 / np.pi * PLANE_STRAIN * slope
    sinking = 0.5 * np.pi * contact / slope
    mass = 2.0 / 3.0 * stiffness * sinking**3 / speed**2
    mesh = rectangle(lines(contact, depth), lines(contact, depth), 9)
    deck = Deck("Sneddon", 3.0 * sinking / speed)
    deck.control(linear=True)
    deck.mesh(mesh)
    heights = np.diff(lines(contact, depth))[::-1]
    deck.laminate([Ply(STEEL, float(height)) for height in heights], 2)
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(mesh.where(y=0.0), "y")
    deck.hold_face(range(len(mesh.points)), BOTTOM, "z")
    deck.intervals(impactor=0.0, glstat=3.0 * sinking / speed)
    radius = 5.0
    centre = (0.0, 0.0, 0.5 * depth + radius / slope)
    body = Sphere(radius, 0.25 * mass, centre, (0.0, 0.0, -speed), guided=True)
    deck.sphere(replace(body, shape="CONE", form=(angle, 0.0)))
    history = run(deck, tmp_path).table("impactor_1")
    force, went_in = 4.0 * history["force"], -history["displacement"]
    harder = 2.0 / (3.0 * np.pi) * (3.0 - 2.0 * POISSON) / (1.0 - POISSON) * contact / depth
    # a facet cannot follow the singular tip: contact starts late, by what one point spacing sinks
    coarse = 0.1 / contact
    assert force.max() / (stiffness * sinking**2) == pytest.approx(1.0, abs=harder + coarse)
    assert went_in.max() / sinking == pytest.approx(1.0, abs=harder + coarse)
    assert history["velocity"].max() == pytest.approx(speed, rel=0.01)


@METHODS
def test_lying_cylinder_on_a_block(method: int, tmp_path: Path) -> None:
    """Hertz in the plane: the contact is 2 a wide where F per length = pi E a^2 / (4 (1 - nu^2) R).

    Its width is known to a point on either side.
    """
    contact, depth, width, radius, speed = 1.0, 20.0, 0.8, 20.0, 1.0e3
    line_force = np.pi * PLANE_STRAIN * contact**2 / (4.0 * radius)
    mesh = rectangle(lines(contact, depth), np.array([0.0, 0.4, 0.8]), 9)
    deck = Deck("lying cylinder", 1.0e-4)
    deck.control(linear=True)
    deck.mesh(mesh)
    heights = np.diff(lines(contact, depth))[::-1]
    deck.laminate([Ply(STEEL, float(height)) for height in heights], 2)
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(range(len(mesh.points)), "y")
    deck.hold_face(range(len(mesh.points)), BOTTOM, "z")
    deck.intervals(impactor=0.0, glstat=1.0e-4)
    centre = (0.0, 0.5 * width, 0.5 * depth + radius)
    # about the mass that comes to rest at this force under a logarithmic law of sinking
    mass = 0.5 * line_force * width * 0.1 / speed**2
    body = Sphere(radius, mass, centre, (0.0, 0.0, -speed), guided=True, method=method)
    deck.sphere(replace(body, shape="CYLINDER", form=(10.0, 1.0, 0.0, 1.0, 0.0)))
    results = run(deck, tmp_path)
    force = 2.0 * results.table("impactor_1")["force"] / width
    area = results.table("contact")["impactor 1 area"]
    pressed = force > 0.25 * line_force
    assert pressed.any()
    half_width = np.sqrt(4.0 * radius * force[pressed] / (np.pi * PLANE_STRAIN))
    within = np.flatnonzero(half_width < 1.5 * contact)
    measured = area[pressed][within] / width
    assert np.abs(measured - half_width[within]).max() < 0.2 + 0.1
    assert np.mean(measured / half_width[within]) == pytest.approx(1.0, abs=0.15)


def two_parts(apart: bool, method: int, folder: Path, part: int = 0) -> Results:
    """A sphere on the middle line of a plate, of one part or of one on each side."""
    side = 10.0
    mesh = regular(side, side, 6, 6, 9)
    deck = Deck("seam", 3.0e-5)
    deck.control()
    left = mesh.points[mesh.quads].mean(axis=1)[:, 0] < 0.5 * side
    deck.mesh(mesh, [1 if is_left or not apart else 2 for is_left in left])
    for number in (1, 2) if apart else (1,):
        deck.laminate([Ply(CARBON, 0.5, 0.0), Ply(CARBON, 0.5, 90.0)], 1, part=number)
    deck.hold(mesh.boundary(), "xyz")
    deck.intervals(impactor=0.0, glstat=3.0e-7)
    centre = (0.5 * side + 0.1, 0.5 * side, 5.5)
    deck.sphere(Sphere(5.0, 1.0e-5, centre, (0.0, 0.0, -5.0e3), method=method, part=part))
    return run(deck, folder)


@METHODS
def test_plate_of_two_parts_is_that_of_one(method: int, tmp_path: Path) -> None:
    """Over shared nodes the line between parts is none: the same force, to round-off."""
    one, two = (
        two_parts(apart, method, tmp_path / str(apart)).table("impactor_1")
        for apart in (False, True)
    )
    for name in ("force", "displacement", "force x"):
        size = np.abs(one[name]).max()
        assert np.abs(one[name] - two[name]).max() < 1.0e-8 * size


def test_left_out_part_is_told(tmp_path: Path) -> None:
    """A contact with one of two parts under the sphere: softer, and the listing says why."""
    all_parts = two_parts(True, 2, tmp_path / "all").table("impactor_1")
    results = two_parts(True, 2, tmp_path / "one", part=1)
    assert results.table("impactor_1")["force"].max() < all_parts["force"].max()
    assert "lies over part 2, too" in (tmp_path / "one" / "job.out").read_text()


def seam(method: int, folder: Path) -> Results:
    """A sphere over the gap of two plates that share no node, larger quads on one side."""
    left, right = regular(5.0, 10.0, 5, 10, 9), regular(5.0, 10.0, 2, 4, 9)
    points = np.vstack([left.points, right.points + np.array([5.0, 0.0])])
    mesh = Mesh(points, np.vstack([left.quads, right.quads + len(left.points)]))
    deck = Deck("gap", 1.2e-4)
    deck.control()
    deck.mesh(mesh, [1] * len(left.quads) + [2] * len(right.quads))
    for number in (1, 2):
        deck.laminate([Ply(CARBON, 0.5, 0.0), Ply(CARBON, 0.5, 90.0)], 1, part=number)
    deck.hold(mesh.where(x=0.0), "xyz")
    deck.hold(mesh.where(x=10.0), "xyz")
    deck.intervals(impactor=0.0, glstat=1.2e-6)
    centre = (5.1, 5.0, 5.5)
    deck.sphere(Sphere(5.0, 2.0e-6, centre, (0.0, 0.0, -5.0e3), method=method, part=0))
    return run(deck, folder)


@METHODS
def test_sphere_between_two_plates_does_not_fall_through(method: int, tmp_path: Path) -> None:
    """Both plates hold the sphere: it sinks until they throw it back, and energy is in balance."""
    results = seam(method, tmp_path)
    history = results.table("impactor_1")
    assert history["penetration"].max() < 1.0e-3
    assert history["velocity"][-1] > 0.0
    assert np.abs(results.table("energy")["error"]).max() < 1.0e-10


def test_both_methods_agree_over_a_gap(tmp_path: Path) -> None:
    """Nodes and points see both plates: the impulses are alike within what points miss."""
    impulses = [
        2.0e-6 * (5.0e3 + seam(method, tmp_path / str(method)).table("impactor_1")["velocity"][-1])
        for method in (1, 2)
    ]
    assert impulses[0] == pytest.approx(impulses[1], rel=0.1)


@METHODS
def test_impact_from_below_is_the_mirror_image(method: int, tmp_path: Path) -> None:
    """A symmetric plate, struck from above and from below."""
    histories = []
    for face in (TOP, BOTTOM):
        mesh = regular(10.0, 10.0, 6, 6, 9)
        deck = Deck("mirror", 3.0e-5)
        deck.control()
        deck.mesh(mesh)
        deck.laminate([Ply(CARBON, 0.3, angle) for angle in (0.0, 90.0, 0.0)], 1)
        deck.hold(mesh.boundary(), "xyz")
        deck.intervals(impactor=0.0, glstat=3.0e-5)
        deep = 0.5 + 2.5 / float(np.tan(np.radians(60.0)))
        centre = (5.2, 4.9, face * (0.45 + deep))
        body = Sphere(3.0, 1.0e-5, centre, (10.0, 0.0, -face * 5.0e3), method=method, face=face)
        deck.sphere(replace(body, shape="CONE", form=(60.0, 0.5)))
        histories.append(run(deck, tmp_path / str(face)).table("impactor_1"))
    above, below = histories
    size = np.abs(above["force"]).max()
    assert size > 0.0
    assert np.abs(above["force"] + below["force"]).max() < 1.0e-7 * size
    assert np.abs(above["force x"] - below["force x"]).max() < 1.0e-7 * size
    assert np.abs(above["displacement"] + below["displacement"]).max() < 1.0e-8


@METHODS
def test_two_impactors_at_places_of_symmetry(method: int, tmp_path: Path) -> None:
    """Two spheres on a plate that is symmetric about its middle line are pushed alike."""
    mesh = regular(20.0, 10.0, 12, 6, 9)
    deck = Deck("two", 3.0e-5)
    deck.control()
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.5, 0.0), Ply(CARBON, 0.5, 90.0)], 1)
    deck.hold(mesh.boundary(), "xyz")
    deck.intervals(impactor=0.0, glstat=3.0e-7)
    for number, x in ((1, 5.3), (2, 14.7)):
        sphere = Sphere(4.0, 1.0e-5, (x, 5.0, 4.5), (0.0, 0.0, -5.0e3), method=method)
        deck.sphere(sphere, number)
    results = run(deck, tmp_path)
    one, other = (results.table(f"impactor_{number}") for number in (1, 2))
    size = one["force"].max()
    assert size > 0.0
    assert np.abs(one["force"] - other["force"]).max() < 1.0e-7 * size
    assert np.abs(one["force x"] + other["force x"]).max() < 1.0e-7 * size
    assert np.abs(results.table("energy")["error"]).max() < 1.0e-10


@pytest.mark.parametrize("scheme", [0, 1, 2])
@pytest.mark.parametrize("linear", [True, False])
def test_all_bodies_at_once_on_a_window(scheme: int, linear: bool, tmp_path: Path) -> None:
    """Four impactors on both faces of a plate of two parts on a frame: all touch, energy holds."""
    results = run(all_bodies(scheme, linear=linear, apart=True, end=3.0e-5), tmp_path)
    for number in range(1, 5):
        assert np.abs(results.table(f"impactor_{number}")["force"]).max() > 0.0
    energy = results.table("energy")
    assert np.abs(energy["error"]).max() < 1.0e-10
