"""Cracks along lines: what ties hold, what tearing takes, and what a crack does to its neighbours.

A zone with crack lines lies in a part of its own, with the same plies and interfaces around it.
"""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, Bond, Deck, Ply, Sphere, ramp
from elasticity import CARBON, Array, Material
from meshes import Mesh, regular
from runs import Results, run

NEVER = (1.0e9, 1.0e9, 1.0e9)  # strengths that nothing reaches, MPa
# HTS40/977-2 of the paper's Tables 5 and 6, and the same with 1 and 2 exchanged
HTS40 = Material(1.6e-9, (153.0e3, 10.3e3, 10.3e3), (0.3, 0.3, 0.4), (6.0e3, 6.0e3, 3.7e3))
ACROSS = Material(
    1.6e-9,
    (10.3e3, 153.0e3, 10.3e3),
    (0.3 * 10.3 / 153.0, 0.4, 0.3),
    (6.0e3, 3.7e3, 6.0e3),
)


def parts_of(mesh: Mesh, inside: Array) -> list[int]:
    """Part 2 for the quads of a zone, part 1 around it."""
    return [2 if is_inside else 1 for is_inside in inside]


def middles(mesh: Mesh) -> Array:
    """Middles of all quads, (m, 2)."""
    return mesh.points[mesh.quads].mean(axis=1)


def crack_lines(
    deck: Deck, spacing: float, toughness: float, strengths: tuple[float, float, float]
) -> None:
    """Crack lines in part 2."""
    deck.add("CRACK_LINES", (2, spacing, toughness), strengths)


GRADIENT = np.array([[1.0e-3, 2.0e-4], [6.0e-4, -5.0e-4]])
PLACE = np.array([4.1, 4.8])  # inside a quad of the zone, before the plate is turned


def stretched(angle: float, sign: float, folder: Path) -> tuple[Array, Array, Results]:
    """Displacements inside of a stretched plate: the exact field, and those found; the results."""
    square = regular(9.0, 9.0, 9, 9, 4)
    turn = np.deg2rad(angle)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    mesh = Mesh(square.points @ rotation.T, square.quads)
    deck = Deck("patch with twins", 8.0e-5)
    deck.control(linear=True, damping=8.0e5)
    deck.mesh(mesh, parts_of(mesh, np.abs(middles(square) - 4.5).max(axis=1) < 3.6))
    plies = [Ply(CARBON, 0.5, angle + sign * own) for own in (0.0, 45.0, 90.0, -45.0)]
    for part in (1, 2):
        deck.laminate(plies, 1, part=part)
    deck.add("MAT_COHESIVE_ELASTIC", (100, 0.0, 0, 0, 5.0e4, 8.0e4))
    deck.add("INTERFACE_COHESIVE", (1, 0, 0, 100), (2, 0, 0, 100))
    crack_lines(deck, 1.0, 0.3, NEVER)
    curve = deck.curve(ramp(1.0e-5))
    rim = square.boundary()
    for node in rim:
        for k, value in enumerate(GRADIENT @ mesh.points[node]):
            deck.move([node], k + 1, curve, value)
    inside = [node for node in range(len(mesh.points)) if node not in rim]
    deck.histories(inside, 8.0e-5)
    deck.profile(1, *(rotation @ PLACE), 8.0e-5, points=2)
    results = run(deck, folder)
    nodes = results.table("nodes")
    found = [
        [[nodes[f"n{node + 1} {face} {axis}"][-1] for axis in ("ux", "uy")] for node in inside]
        for face in ("bottom", "top")
    ]
    exact = mesh.points[inside] @ GRADIENT.T
    return np.stack([exact, exact]), np.array(found), results


@pytest.mark.parametrize("angle", [0.0, 30.0])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_ties_hold_a_uniform_strain(
    angle: float, sign: float, compare: Comparison, tmp_path: Path
) -> None:
    """Tied twins give the exact field of a stretch, turned and mirrored: 1e-6 of relaxation.

    So does a profile in the zone, in every layer, on both of its faces.
    """
    exact, found, results = stretched(angle, sign, tmp_path)
    largest = np.abs(exact).max()
    compare.values("displacement with tied twins", found, exact, unit="mm", abs=1e-6 * largest)
    profile, turn = results.profile(1), np.deg2rad(angle)
    place = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]) @ PLACE
    names = ("ux", "uy", "exx", "eyy", "gxy")
    strain = [GRADIENT[0, 0], GRADIENT[1, 1], GRADIENT[0, 1] + GRADIENT[1, 0]]
    rows = np.tile([*(GRADIENT @ place), *strain], (8, 1))
    here = np.stack([profile[name] for name in names], axis=1)
    compare.values("profile with tied twins", here, rows, abs=1e-6 * largest)


def struck(spacing: float, frame: bool, folder: Path) -> Results:
    """A ball on a plate whose cracks never start; one line in each ply, or as many as there are.

    Its boundary is held, or it lies on a rough frame that is half in the zone.
    """
    mesh = regular(12.0, 12.0, 12, 12, 4)
    deck = Deck("tied twins under a ball", 6.0e-5)
    deck.control(largest=2.0e-8)
    deck.mesh(mesh, parts_of(mesh, np.abs(middles(mesh) - 6.0).max(axis=1) < 4.6))
    for part in (1, 2):
        deck.laminate([Ply(CARBON, 0.5, angle) for angle in (0.0, 45.0, 90.0, -45.0)], 1, part=part)
    deck.add("MAT_COHESIVE_ELASTIC", (100, 0.0, 0, 0, 5.0e4, 8.0e4))
    deck.add("INTERFACE_COHESIVE", (1, 0, 0, 100), (2, 0, 0, 100))
    crack_lines(deck, spacing, 0.3, NEVER)
    if frame:
        deck.add("FIXTURE_PLANE", (1, BOTTOM, 0.0, 0.5, 0.3), (1, 6.0, 6.0, 5.0, 5.0, 0.0))
    else:
        deck.hold(mesh.boundary(), "z")
    deck.sphere(Sphere(8.0, 2.0e-5, (6.0, 6.0, 9.01), (0.0, 0.0, -5.0e3), part=0))
    deck.intervals(impactor=2.0e-7, glstat=1.0e-6, binary_d3plot=6.0e-5, fixture=2.0e-7)
    return run(deck, folder)


@pytest.mark.parametrize("frame", [False, True])
def test_tied_twins_change_nothing(frame: bool, compare: Comparison, tmp_path: Path) -> None:
    """An impact is that of a plate with hardly a twin: 1e-8 of the force, what round-off becomes.

    Ties share motion by mass, so that both copies are the one node that they come from, also where
    they lie on a frame and slide there.
    """
    few, many = (struck(spacing, frame, tmp_path / str(spacing)) for spacing in (1.0e3, 1.0))
    counts = [int(each.listing().split("nodes with a twin")[1].split()[0]) for each in (few, many)]
    assert counts[0] < 0.5 * counts[1]
    force, found = (each.table("impactor_1")["force"] for each in (few, many))
    assert force.max() > 500.0
    compare.values("force over tied twins", found, force, unit="N", abs=1e-8 * force.max())
    if frame:
        check_frame(few, many, compare)


def check_frame(few: Results, many: Results, compare: Comparison) -> None:
    """The forces of the frame are the same, along the plate as well."""
    for name in ("force x", "force y", "force z"):
        force, found = (each.table("fixture_1")[name] for each in (few, many))
        largest = np.abs(few.table("fixture_1")["force z"]).max()
        assert largest > 500.0
        compare.values(f"{name} of a frame", found, force, unit="N", abs=1e-8 * largest)


def torn(
    side: float, angle: float, folder: Path, reach: float = 8.0, *, punch: bool = False
) -> Results:
    """A single ply that a crack tears from edge to edge; the ends are plain.

    With less reach across, the zone leaves out strips along both edges. A rough punch may push the
    ply up where it tears.
    """
    length, width = 24.0, 8.0
    mesh = regular(length, width, round(length / side), round(width / side), 4)
    mesh = Mesh(mesh.points - np.array([length, width]) / 2.0, mesh.quads)
    time = 4.0e-4
    deck = Deck("torn ply", time)
    deck.control(damping=2.0e4)
    deck.mesh(mesh, parts_of(mesh, (np.abs(middles(mesh)) < [8.0, reach]).all(axis=1)))
    for part in (1, 2):
        deck.laminate([Ply(HTS40, 0.25, angle)], 1, part=part)
    crack_lines(deck, 1000.0, 0.3, (60.0, 90.0, 60.0))
    deck.hold(mesh.where(x=-length / 2.0), "xyz")
    deck.hold(mesh.where(x=length / 2.0), "yz")
    pull = deck.curve([(0.0, 0.0), (0.8 * time, 1.0), (time, 1.0)])
    deck.move(mesh.where(x=length / 2.0), 1, pull, 0.4)
    if punch:
        rise = deck.curve([(0.0, 0.0), (0.8 * time, 0.5), (time, 0.5)])
        place = (1, 0.0, 0.0, 9.0, width, 0.0)
        deck.add("FIXTURE_PUNCH", (1, BOTTOM, 0.0, 1.0, 0.3), place, (0, 0, rise))
        deck.intervals(fixture=time / 200.0)
    deck.intervals(glstat=time / 200.0, delam=time / 200.0, binary_d3plot=time)
    return run(deck, folder)


@pytest.mark.parametrize(("side", "angle"), [(2.0, 45.0), (1.0, 45.0), (1.0, -45.0), (1.0, 90.0)])
def test_tearing_takes_the_toughness(
    side: float, angle: float, compare: Comparison, tmp_path: Path
) -> None:
    """GC times the area from edge to edge along the fibres: 0.2 % of the last steps of softening.

    The crack follows the fibres: its length is that of the line, whatever the mesh.
    """
    results = torn(side, angle, tmp_path)
    length = 8.0 / abs(np.sin(np.deg2rad(angle)))
    cracks, energy = results.table("cracks"), results.table("energy")
    compare.number("length of the crack", cracks["length"][-1], length, unit="mm", rel=1e-9)
    compare.number("energy", cracks["energy"][-1], 0.3 * 0.25 * length, unit="mJ", rel=1e-6)
    assert cracks["energy"][-1] == pytest.approx(energy["matrix damage"][-1], rel=1e-9)
    assert np.abs(energy["error"]).max() < 1e-6
    # of what went in, 20 times the fracture
    assert np.abs(energy["stored error"]).max() < 1e-3
    check_line(results, angle, length)
    check_ends(results)


@pytest.mark.parametrize("angle", [45.0, 90.0])
def test_a_ply_tears_over_a_punch(angle: float, compare: Comparison, tmp_path: Path) -> None:
    """GC times the area there, too; both halves slide apart on it, and their friction is work."""
    results = torn(1.0, angle, tmp_path, punch=True)
    length = 8.0 / abs(np.sin(np.deg2rad(angle)))
    cracks, energy, punch = (results.table(name) for name in ("cracks", "energy", "fixture_1"))
    compare.number("length over a punch", cracks["length"][-1], length, unit="mm", rel=1e-9)
    taken = 0.3 * 0.25 * length
    compare.number("energy over a punch", cracks["energy"][-1], taken, unit="mJ", rel=1e-6)
    assert punch["force z"].min() < -1.0
    assert punch["friction"][-1] == pytest.approx(energy["contact friction"][-1], rel=1e-9)
    assert punch["friction"][-1] > taken
    assert np.abs(energy["error"]).max() < 1e-6
    assert np.abs(energy["stored error"]).max() < 1e-3


def test_twins_begin_with_the_velocity_of_their_nodes(tmp_path: Path) -> None:
    """A plate that flies keeps its momentum, and is not torn."""
    mesh = regular(6.0, 6.0, 6, 6, 4)
    deck = Deck("flying", 2.0e-6)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.5)], 1)
    deck.add("CRACK_LINES", (1, 1.0, 0.3), NEVER)
    deck.velocity(range(len(mesh.points)), (0.0, 0.0, 1000.0))
    energy = run(deck, tmp_path).table("energy")
    mass = CARBON.density * 6.0 * 6.0 * 0.5
    assert energy["momentum z"] == pytest.approx(1000.0 * mass, rel=1e-9)
    assert energy["kinetic"] == pytest.approx(0.5e6 * mass, rel=1e-9)


def struck_at_edge(x: float, folder: Path) -> Results:
    """A ball on the edge of a plate of one ply at 45 degrees whose cracks never start."""
    deck = Deck("tied twins at an edge", 2.0e-5)
    deck.control(largest=2.0e-8)
    deck.mesh(regular(12.0, 12.0, 12, 12, 4))
    deck.laminate([Ply(CARBON, 0.5, 45.0)], 1)
    deck.add("CRACK_LINES", (1, 1.0, 0.3), NEVER)
    deck.sphere(Sphere(8.0, 2.0e-5, (x, 6.0, 8.26), (0.0, 0.0, -5.0e3), part=0))
    deck.intervals(impactor=2.0e-7)
    return run(deck, folder)


def test_a_ball_pushes_both_copies_at_an_edge(compare: Comparison, tmp_path: Path) -> None:
    """Opposite edges are one, turned by half a turn: 1e-6 of the force, what round-off becomes.

    At one of them nodes have the small half of the quad that a line parts, at the other twins.
    """
    left, right = (
        struck_at_edge(x, tmp_path / str(x)).table("impactor_1")["force"] for x in (0.0, 12.0)
    )
    assert right.max() > 5.0
    compare.values("force at an edge", left, right, unit="N", abs=1e-6 * right.max())


@pytest.mark.parametrize("frame", [False, True])
def test_a_corner_stays_whole(frame: bool, tmp_path: Path) -> None:
    """A ball or a rough frame at a corner that a line along the diagonal would cut in two.

    The face of the plate has one copy alone there: tied ones would part, and make energy.
    """
    mesh = regular(12.0, 12.0, 12, 12, 4)
    deck = Deck("a corner on a line", 2.0e-5)
    deck.control(largest=2.0e-8)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.5, 45.0)], 1)
    deck.add("CRACK_LINES", (1, 1.0e3, 0.3), NEVER)
    if frame:
        deck.add("FIXTURE_PLANE", (1, BOTTOM, 0.0, 0.5, 0.3), (1, 6.0, 6.0, 9.0, 9.0, 0.0))
        deck.velocity(range(len(mesh.points)), (300.0, 0.0, -1.0e3))
    else:
        deck.sphere(Sphere(8.0, 2.0e-5, (0.0, 0.0, 8.26), (0.0, 0.0, -5.0e3), part=0))
    deck.intervals(glstat=2.0e-7, impactor=2.0e-7, fixture=2.0e-7)
    results = run(deck, tmp_path)
    # all 13 nodes of the diagonal but its ends
    assert int(results.listing().split("nodes with a twin")[1].split()[0]) == 11
    met = results.table("fixture_1" if frame else "impactor_1")
    assert met["contacts"].max() > 0
    assert np.abs(results.table("energy")["stored error"]).max() < 1e-5


@pytest.mark.parametrize("angle", [45.0, 90.0])
def test_lines_end_inside_of_a_plate(angle: float, tmp_path: Path) -> None:
    """A crack that has come to the edge of the part is noted as one at the edge of the plate is."""
    results = torn(1.0, angle, tmp_path, reach=2.0)
    assert 0.0 < results.table("cracks")["length"][-1] < 8.0
    check_ends(results)


def check_ends(results: Results) -> None:
    """The listing counts both ends of the line, and says what they mean."""
    table, note = results.listing().split("ends of lines")[1].split("note: cracks", 1)
    assert table.split()[-1] == "2"
    where = "in ply 1: at the edge of the part, unless the plate ends there"
    assert note.split(".")[0].endswith(where)


def line_ends(results: Results, ply: int, angle: float) -> Array:
    """Ends of all pieces of the lines of a ply, (pieces, 2, 3)."""
    with h5py.File(results.folder / f"{results.job}.cracks.vtkhdf") as file:
        grid = file["VTKHDF"]
        assert set(grid["Types"][:]) == {3}
        own = grid["CellData/ply"][:] == ply
        assert set(grid["CellData/angle"][:][own]) == {angle}
        return np.array(grid["Points"][:][grid["Connectivity"][:].reshape(-1, 2)[own]])


def check_line(results: Results, angle: float, length: float) -> None:
    """The field of cracks is one line through the middle along the fibres, open all the way."""
    way = np.array([np.cos(np.deg2rad(angle)), np.sin(np.deg2rad(angle)), 0.0])
    ends = line_ends(results, 1, angle)
    assert np.allclose(np.cross(ends, way)[..., 2], 0.0, atol=1e-6)
    assert np.allclose(ends[..., 2], 0.0)
    assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum() == pytest.approx(length)
    values = {name: results.field(name, "cracks.vtkhdf") for name in ("damage", "start", "mode")}
    assert np.all(values["damage"] == 1.0)
    assert np.all(values["start"] > 0.0)
    # both halves are apart: across the crack, which is a unit vector times the least gap
    gap = results.field("opening", "cracks.vtkhdf") @ np.array([-way[1], way[0], 0.0])
    assert np.all(gap > 0.0) or np.all(gap < 0.0)
    assert np.all((values["mode"] >= 0.0) & (values["mode"] <= 1.0))


BOND = Bond((1.0e5, 1.0e5), (62.3, 92.3), (0.28, 0.79), -1.634)
THICKNESS, CUT, LENGTH, TIME = 2.0, 0.5, 80.0, 1.5e-3


def critical_stress() -> float:
    """Stress over the whole thickness at which the delaminations grow, MPa."""
    left = THICKNESS - CUT
    modulus = HTS40.young[0]
    return float(np.sqrt(4.0 * modulus * BOND.toughness[1] * left / (THICKNESS * CUT)))


def pulled(turned: bool, folder: Path) -> tuple[Results, Array]:
    """A strip whose middle ply cracks across it, and its elongation over the time.

    All plies have one modulus along the strip. The middle one cracks along what its angle calls
    fibres, across the strip.
    """
    mesh = regular(LENGTH, 2.0, round(LENGTH), 2, 4)
    mesh = Mesh(mesh.points - np.array([LENGTH / 2.0, 0.0]), mesh.quads)
    zone = parts_of(mesh, np.abs(middles(mesh)[:, 0]) < 2.0)
    axis, along = (1, 90.0) if turned else (0, 0.0)
    if turned:
        mesh = Mesh(mesh.points[:, ::-1] * np.array([-1.0, 1.0]), mesh.quads)
    deck = Deck("transverse crack tension", TIME)
    deck.control(linear=True, damping=5.0e3)
    deck.mesh(mesh, zone)
    whole = Ply(HTS40, 0.5 * (THICKNESS - CUT), along)
    for part in (1, 2):
        deck.laminate([whole, Ply(ACROSS, CUT, 90.0 - along), whole], 1, part=part)
    deck.cohesive(BOND, nodal=True, parts=(1, 2))
    crack_lines(deck, 1000.0, 0.01, (50.0, 1.0e4, 1.0e4))
    ends = [np.flatnonzero(np.abs(mesh.points[:, axis] - end) < 1e-9) for end in (-40.0, 40.0)]
    deck.hold(ends[0], "xy"[axis])
    deck.hold(ends[0][:1], "xyz".replace("xy"[axis], ""))
    times = 0.1 * TIME * np.arange(17) / 16.0
    rising = deck.curve(zip(times, 0.5 - 0.5 * np.cos(np.pi * np.arange(17) / 16.0), strict=True))
    slack = critical_stress() / HTS40.young[0] * THICKNESS / (THICKNESS - CUT)
    speed = LENGTH * slack / (0.9 * TIME)
    deck.add("BOUNDARY_PRESCRIBED_MOTION_SET", (deck.node_set(ends[1]), axis + 1, 0, rising, speed))
    deck.intervals(glstat=TIME / 400.0, delam=TIME / 400.0, binary_d3plot=TIME)
    results = run(deck, folder)
    time = results.table("energy")["time"]
    start = 0.1 * TIME
    early = 0.5 * (time - start / np.pi * np.sin(np.pi * time / start))
    return results, speed * np.where(time < start, early, time - 0.5 * start)


@pytest.mark.parametrize("turned", [False, True])
def test_a_crack_starts_delaminations(turned: bool, compare: Comparison, tmp_path: Path) -> None:
    """Four delaminations peel off the cracked ply at sqrt(4 E GIIc (t - tc) / (t tc)).

    The stress is the work that arrives inside over the way: inertia and damping keep 2 % each of
    what the end gives. 3 %: one quad to 1 mm of a zone of 5 mm, whose points fail one after the
    other.
    """
    results, way = pulled(turned, tmp_path)
    energy, area = results.table("energy"), results.table("delamination")
    reach = np.arange(len(way))
    first, last = np.maximum(reach - 5, 0), np.minimum(reach + 5, len(way) - 1)
    work = energy["internal"]
    stress = (work[last] - work[first]) / (way[last] - way[first]) / (2.0 * THICKNESS)
    crack = np.interp(energy["time"], area["time"], area["failed sum"]) / 8.0
    growing = (crack > 8.0) & (crack < 30.0)
    assert growing.sum() > 20
    compare.number(
        "stress of growth", stress[growing].mean(), critical_stress(), unit="MPa", rel=0.03
    )
    assert results.table("cracks")["ply 2 length"][-1] == pytest.approx(2.0)
    ends = line_ends(results, 2, 0.0 if turned else 90.0)
    across = np.abs(ends[:, 1] - ends[:, 0])[:, 0 if turned else 1]
    assert np.allclose(ends[..., 1 if turned else 0], 0.0)
    assert across.sum() == pytest.approx(2.0)
    assert np.abs(energy["error"]).max() < 1e-6
