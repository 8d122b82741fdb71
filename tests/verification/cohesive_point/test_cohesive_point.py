"""Two stiff plies on one quad, moved apart: work per area, tractions, what damage leaves."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, TOP, Bond, Deck, Ply
from elasticity import Array, isotropic
from meshes import regular
from runs import Results, run

SIDE, HEIGHT = 1.0, 0.1
AREA = SIDE**2
# Plies a thousand times as stiff as the bond, without Poisson's ratio: the faces move as prescribed
YOUNG = 1.0e7
STIFF = isotropic(1.0e-9, YOUNG, 0.0)
DURATION, STATES = 2.0e-5, 200
# Openings at onset and failure
ONSET, END = 60.0 / 1.0e5, 2.0 * 0.28 / 60.0
# Share of the motion that the plies take: both plies' compliance over that of the bond; in shear
# twice as much, of a bond that is less than half as stiff
SOFT = 2.0 * HEIGHT / YOUNG * 1.0e5

KENANE = Bond((1.0e5, 0.4e5), (60.0, 90.0), (0.28, 0.79), -1.6)
POWERS = replace(KENANE, exponent=1.5)
# Stress of a ply that goes on ringing when the bond lets go, and of its compliance
RINGING = 2.0 * SOFT * 60.0
# A motion that no mix of modes survives
LONG = 0.04
TURN = np.radians(30.0)


@dataclass(frozen=True)
class Motion:
    """How the upper ply moves: legs between (opening, sliding along 30 degrees from x)."""

    legs: tuple[tuple[float, float], ...]
    nodes: int = 9
    nodal: bool = False
    linear: bool = True
    start: float = 0.0  # damage at time zero


def moved(bond: Bond, motion: Motion, folder: Path) -> Results:
    """Run the motion, leg after leg in equal times."""
    mesh = regular(SIDE, SIDE, 1, 1, motion.nodes)
    deck = Deck("point", DURATION)
    deck.control(linear=motion.linear)
    deck.mesh(mesh)
    deck.laminate([Ply(STIFF, HEIGHT)] * 2, 1)
    deck.cohesive(bond, nodal=motion.nodal)
    if motion.start == 1.0:
        deck.add("INITIAL_DELAMINATION", (1, 0, 0))
    elif motion.start > 0.0:
        deck.add("INITIAL_DAMAGE", (1, 0, 0, 0, motion.start))
    everywhere = range(len(mesh.points))
    deck.hold_face(everywhere, BOTTOM, "xyz")
    opening, sliding = np.array([(0.0, 0.0), *motion.legs]).T
    for axis, way in enumerate((sliding * np.cos(TURN), sliding * np.sin(TURN), opening)):
        card = (deck.node_set(everywhere), TOP, axis + 1, 0, deck.curve(smooth(way)), 1.0)
        deck.add("BOUNDARY_FACE_MOTION", card)
    deck.profile(1, 0.5 * SIDE, 0.5 * SIDE, DURATION / STATES, 2)
    deck.intervals(glstat=DURATION / STATES, binary_d3plot=DURATION)
    return run(deck, folder)


def smooth(way: Array) -> list[tuple[float, float]]:
    """Velocity over time, zero between legs: without kinks of the motion the plies do not ring."""
    pieces = 32
    times = np.linspace(0.0, DURATION, pieces * (len(way) - 1) + 1)
    shape = np.sin(np.pi * np.arange(pieces) / pieces)
    speeds = [(b - a) * shape / (shape.sum() * times[1]) for a, b in pairwise(way)]
    return list(zip(times, np.concatenate([*speeds, [0.0]]), strict=True))


def traction(results: Results) -> tuple[Array, Array]:
    """Traction and jump over time at the place of the profile, (states, 3) along x, y, z."""
    profile = results.table("profile_1")
    stress = np.column_stack([profile[name] for name in ("sxz", "syz", "szz")])
    motion = np.column_stack([profile[name] for name in ("ux", "uy", "uz")])
    points = 4  # both faces of both plies
    return stress[1::points], motion[2::points] - motion[1::points]


def final(bond: Bond, mix: float) -> float:
    """Energy of the mix of modes."""
    return AREA * bond.toughness_of(mix)


@pytest.mark.parametrize("bond", [KENANE, POWERS], ids=["Benzeggagh-Kenane", "power law"])
@pytest.mark.parametrize("slope", [0.0, 0.6, 1.6, 3.0, np.inf])
def test_straight_path_takes_the_toughness(
    bond: Bond, slope: float, compare: Comparison, tmp_path: Path
) -> None:
    """G_c of the mix of modes, whatever the stiffnesses; the mix of a straight path is constant."""
    opening, sliding = (LONG, slope * LONG) if np.isfinite(slope) else (0.0, LONG)
    results = moved(bond, Motion(((opening, sliding),)), tmp_path)
    twice = np.array(bond.stiffness) * np.array([opening, sliding]) ** 2
    energy = results.table("energy")
    # the compliance of the plies bends the path by SOFT at most
    expected = final(bond, twice[1] / twice.sum())
    pure = opening == 0.0 or sliding == 0.0
    found = energy["delamination"][-1]
    compare.number(
        "fracture energy of a straight path",
        found,
        expected,
        unit="mJ",
        rel=1e-9 if pure else SOFT,
    )
    assert np.all(np.diff(energy["delamination"]) >= 0.0)
    assert np.all(energy["friction"] == 0.0)
    assert np.abs(energy["error"]).max() < 1e-9


def test_pressure_raises_shear_strength_and_toughness(tmp_path: Path) -> None:
    """S + eta p, and G_IIc with its square (Li and Hallett: eta 0.74)."""
    bond = replace(KENANE, whole_penalty=True, pressure_gain=0.74)
    legs = ((-0.5 * ONSET, 0.0), (-0.5 * ONSET, 2.0 * LONG))
    results = moved(bond, Motion(legs), tmp_path)
    stress, jump = traction(results)
    pressure = -bond.stiffness[0] * jump[-1, 2]
    raised = bond.strength[1] + bond.pressure_gain * pressure
    assert np.hypot(*stress[:, :2].T).max() == pytest.approx(raised, rel=0.03)
    lost = results.table("energy")["delamination"][-1]
    wanted = AREA * bond.toughness[1] * (raised / bond.strength[1]) ** 2
    assert lost == pytest.approx(wanted, rel=2.0 * SOFT)


@pytest.mark.parametrize("bond", [KENANE, replace(KENANE, whole_penalty=True)])
@pytest.mark.parametrize(
    ("nodes", "nodal", "linear"),
    [(9, False, True), (9, True, True), (4, False, True), (4, True, False), (9, False, False)],
)
def test_opening_unloads_to_the_origin_and_closes(
    bond: Bond, nodes: int, nodal: bool, linear: bool, compare: Comparison, tmp_path: Path
) -> None:
    """Open to 40 % of failure, close beyond the origin, open until nothing is left."""
    half, pressed = 0.4 * END, -0.5 * ONSET
    legs = ((half, 0.0), (pressed, 0.0), (LONG, 0.0))
    results = moved(bond, Motion(legs, nodes, nodal, linear), tmp_path)
    stress, jump = traction(results)
    opening, pull = jump[:, 2], stress[:, 2]
    damage = END * (half - ONSET) / (half * (END - ONSET))
    stiffness = bond.stiffness[0]
    # on the way back from the largest opening, which lags behind the motion by the share SOFT
    turn, closed = opening[: len(opening) // 2].argmax(), opening.argmin()
    leg = slice(turn + 1, closed + 1)
    held = np.where((opening > 0.0) | (not bond.whole_penalty), 1.0 - damage, 1.0)
    bilinear = held * stiffness * opening
    compare.values("traction on unloading", pull[leg], bilinear[leg], unit="MPa", abs=RINGING)
    if (nodes, nodal, linear) == (9, False, True):
        name = "closed: whole penalty" if bond.whole_penalty else "closed: 1 - damage"
        law = np.array([0.0, ONSET, END, 1.2 * END])
        compare.curves(
            f"opening, closing, failing ({name})",
            ("opening [mm]", "traction [MPa]"),
            {"run": (opening[opening < 1.2 * END], pull[opening < 1.2 * END])},
            {"bilinear law": (law, np.array([0.0, bond.strength[0], 0.0, 0.0]))},
        )
    assert np.abs(pull[opening > 1.01 * END]).max() < RINGING
    # states are that far apart
    assert pull.max() == pytest.approx(bond.strength[0], rel=0.03)
    lost = results.table("energy")["delamination"]
    assert np.all(np.diff(lost) >= 0.0)
    share = (half - ONSET) / (END - ONSET)
    assert lost[closed] == pytest.approx(share * bond.toughness[0] * AREA, rel=2.0 * SOFT)
    assert lost[-1] == pytest.approx(bond.toughness[0] * AREA, rel=1e-9)


def test_histories_and_listing_tell_the_delamination(tmp_path: Path) -> None:
    """Area of the quad, and openings of onset and failure, T/K and 2 G/T, in the listing."""
    results = moved(KENANE, Motion(((LONG, 0.0),)), tmp_path)
    history = results.table("delamination")
    assert history.names == [
        "time",
        "interface 1 area",
        "sum",
        "projected area",
        "interface 1 energy",
        "interface 1 failed area",
        "failed sum",
        "projected failed area",
    ]
    for name in (one for one in history.names if one.endswith(("area", "sum"))):
        assert history[name][0] == 0.0
        assert history[name][-1] == pytest.approx(AREA, rel=1e-9)
    assert history["interface 1 energy"][-1] == pytest.approx(0.28 * AREA, rel=1e-9)


@pytest.mark.parametrize("slope", [0.0, 1.6, np.inf])
def test_half_of_the_toughness_is_what_delaminated_means(slope: float, tmp_path: Path) -> None:
    """The share of a straight path: traction falls along a line from the onset to failure.

    So the work spent is the share of the way between both, in any mix of modes.
    """
    opening, sliding = (LONG, slope * LONG) if np.isfinite(slope) else (0.0, LONG)
    way = np.array([opening, sliding])
    twice = np.array(KENANE.stiffness) * way**2
    load = np.hypot(*(np.array(KENANE.stiffness) * way / KENANE.strength))
    onset, end = 1.0 / load, 2.0 * KENANE.toughness_of(twice[1] / twice.sum()) * load / twice.sum()
    for share in (0.3, 0.49, 0.51, 0.8):
        reach = onset + share * (end - onset)
        results = moved(KENANE, Motion(((reach * opening, reach * sliding),)), tmp_path)
        assert results.interface_field("energy_share") == pytest.approx(share, abs=2.0 * SOFT)
        history = results.table("delamination")
        for name in ("interface 1 area", "sum", "projected area"):
            assert history[name][-1] == pytest.approx(AREA if share > 0.5 else 0.0)
        assert history["failed sum"][-1] == 0.0


@pytest.mark.parametrize("start", [0.3, 0.9])
def test_initial_damage_leaves_the_rest_of_stiffness_and_toughness(
    start: float, compare: Comparison, tmp_path: Path
) -> None:
    """The path goes on as if an opening with this damage had been there before."""
    stress, jump = traction(moved(KENANE, Motion(((0.3 * ONSET, 0.0),), start=start), tmp_path))
    held = (1.0 - start) * KENANE.stiffness[0] * jump[:, 2]
    assert stress[:, 2] == pytest.approx(held, abs=RINGING)
    results = moved(KENANE, Motion(((LONG, 0.0),), start=start), tmp_path)
    largest = ONSET * END / (END - start * (END - ONSET))
    left = 1.0 - (largest - ONSET) / (END - ONSET)
    lost = results.table("energy")["delamination"]
    toughness = left * KENANE.toughness[0] * AREA
    compare.number("energy left by initial damage", lost[-1], toughness, unit="mJ", rel=1e-9)


def test_open_interface_pulls_nothing_and_takes_no_energy(tmp_path: Path) -> None:
    """All is failed from the start, and is told as failed."""
    results = moved(KENANE, Motion(((LONG, 0.0),), start=1.0), tmp_path)
    stress, _ = traction(results)
    assert np.abs(stress[:, 2]).max() < RINGING
    assert results.table("energy")["delamination"][-1] == 0.0
    assert np.all(results.table("delamination")["sum"] == pytest.approx(AREA))


@pytest.mark.parametrize("whole", [True, False])
def test_friction_takes_pressure_times_slip(
    whole: bool, compare: Comparison, tmp_path: Path
) -> None:
    """Failed faces are pressed, slid there and back: Coulomb's traction over the way that slips."""
    bond = replace(KENANE, friction=0.4, whole_penalty=whole)
    kept = 1.0 if whole else 0.1
    pressed, slid = -1.0e-3, 0.02
    legs = ((pressed, 0.0), (pressed, slid), (pressed, -slid))
    results = moved(bond, Motion(legs, start=1.0), tmp_path)
    pressure = kept * bond.stiffness[0] * -pressed
    # sliding first stretches the faces: pressure times friction over the stiffness of sliding
    stretch = bond.friction * pressure / (kept * bond.stiffness[1])
    way = (slid - stretch) + (2.0 * slid - 2.0 * stretch)
    lost = results.table("energy")["friction"]
    rubbed = bond.friction * pressure * way * AREA
    compare.number("energy of friction", lost[-1], rubbed, unit="mJ", rel=2.0 * SOFT)
    assert np.all(np.diff(lost) >= 0.0)
    stress, _ = traction(results)
    rubbing = np.hypot(stress[:, 0], stress[:, 1])
    # in the middle of plies with free edges
    assert rubbing.max() == pytest.approx(bond.friction * pressure, rel=0.02)
    # along the way of the slip, against it
    assert stress[-1, 1] / stress[-1, 0] == pytest.approx(np.tan(TURN), rel=0.01)
    assert stress[-1, 0] < 0.0
