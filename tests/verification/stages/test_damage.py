"""Damage that a first stage has made, in the next one: the same fields, and the secant stiffness.

A ply or an interface that softens along a line from the strain of onset a to the strain of failure
b has at the strain e, once reached, the stress X (b - e) / (b - a) and the damage
b (e - a) / (e (b - a)). It unloads to the origin and is loaded again along that secant, whatever
stage does it. What has been spent counts: to fail, the stage after takes the rest of the energy.
"""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest

from comparison import Comparison
from damage import HTS40, MODES
from decks import BOTTOM, TOP, Bond, Deck, Ply
from elasticity import Array, isotropic
from meshes import regular
from runs import Results, run, run_stage

THICKNESS, STATES = 0.125, 400
#: Sides of the ply, time of a stage, damping
SIDES = {"fibre": (3.0, 2.0), "matrix": (0.3, 0.2)}
END, DAMPING = 1.0e-3, 5.0e5
#: Strain reached between onset and failure, and strain of the second stage over it
REACHED, AGAIN = 0.3, 0.9
#: An interface between stiff plies: stiffness, strength, toughness, side, thickness of a ply
STIFFNESS, STRENGTH, TOUGHNESS = 1.0e5, 60.0, 0.28
SIDE, HEIGHT, DURATION = 1.0, 0.1, 2.0e-5
FAILURE = 2.0 * TOUGHNESS / STRENGTH
BOND = Bond((STIFFNESS, 0.4e5), (STRENGTH, 90.0), (TOUGHNESS, 0.79), -1.6)


def damage_at(reached: float, onset: float, failure: float) -> float:
    """Damage of a law that softens along a line."""
    return failure * (reached - onset) / (reached * (failure - onset))


def there_and_back(most: float, end: float, *, back: bool = True) -> list[tuple[float, float]]:
    """A smooth way to a strain, and back to none in equal time."""
    rise = [0.5 * (1.0 - np.cos(np.pi * t)) for t in np.linspace(0.0, 1.0, 51)]
    shape = rise + rise[-2::-1] if back else rise
    times = np.linspace(0.0, end, len(shape))
    return [(float(t), float(most * share)) for t, share in zip(times, shape, strict=True)]


def lines(points: list[tuple[float, float]]) -> str:
    """Cards of a curve."""
    return "".join(f"{time!r},{value!r}\n" for time, value in points)


def states(results: Results, name: str, grid: str = "vtkhdf") -> tuple[Array, Array]:
    """A point field of the first and of the last state."""
    with h5py.File(results.folder / f"{results.job}.{grid}") as file:
        counts = file["VTKHDF/NumberOfPoints"][()]
        values = file[f"VTKHDF/PointData/{name}"][()]
    return values[: counts[0]], values[-counts[-1] :]


def damaged_ply(mode: str, reached: float, folder: Path) -> Results:
    """One quad that is led to a strain and back."""
    angle, *_, sense = MODES[mode]
    size = SIDES[mode.split()[0]]
    mesh = regular(*size, 1, 1, 4)
    deck = Deck(mode, END)
    deck.control(linear=True, damping=DAMPING)
    deck.mesh(mesh)
    deck.laminate([Ply(HTS40, THICKNESS, angle)], order=1)
    deck.hold_face(range(4), BOTTOM, "z")
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(mesh.where(y=0.0), "y")
    curve = deck.curve(there_and_back(reached, END))
    deck.move(mesh.where(x=size[0]), 1, curve, sense * size[0])
    deck.profile(1, 0.5 * size[0], 0.5 * size[1], END / STATES, 2)
    deck.intervals(glstat=END / STATES)
    deck.add("DATABASE_BINARY_D3DUMP", (999999999,))
    return run(deck, folder, "first")


def loaded_again(before: Results, mode: str, most: float) -> Results:
    """A stage with supports of its own that leads the quad to a strain."""
    size = SIDES[mode.split()[0]]
    # the sets of the deck before: all nodes, x = 0, y = 0, x = side
    body = (
        f"*CONTROL_TERMINATION\n{END!r},\n*DEFINE_CURVE\n90\n"
        f"{lines(there_and_back(most, END, back=False))}"
        f"*BOUNDARY_FACE\n1,{BOTTOM},0.0,0,0,1\n*BOUNDARY_SPC_SET\n2,0,1,0,0\n3,0,0,1,0\n"
        f"*BOUNDARY_PRESCRIBED_MOTION_SET\n4,1,2,90,{MODES[mode][-1] * size[0]!r}\n"
    )
    return run_stage(before, body, "second")


@pytest.mark.parametrize("mode", [mode for mode in MODES if mode != "shear"])
def test_ply_damage_is_kept(mode: str, compare: Comparison, tmp_path: Path) -> None:
    """The same field at the end of a stage, at the start and at the end of the next one."""
    _, modulus, strength, toughness, sense = MODES[mode]
    onset, failure = strength / modulus, 2.0 * toughness / (SIDES[mode.split()[0]][0] * strength)
    reached = onset + REACHED * (failure - onset)
    before = damaged_ply(mode, reached, tmp_path)
    after = loaded_again(before, mode, AGAIN * reached)
    field = f"damage_{mode.split()[0]}"
    (_, end), (start, last) = states(before, field), states(after, field)
    assert np.array_equal(end, start)
    assert np.array_equal(start, last)
    expected = damage_at(reached, onset, failure)
    compare.number(f"damage kept, {mode}", float(last.mean()), expected, rel=1.0e-3)
    profile = after.table("profile_1")
    stress = sense * profile["s11" if MODES[mode][0] == 0.0 else "s22"]
    strain = sense * profile["exx"]
    half = strain > 0.5 * AGAIN * reached
    secant = float(np.polyfit(strain[half], stress[half], 1)[0])
    exact = (1.0 - expected) * modulus
    compare.number(f"stiffness of the damaged ply, {mode}", secant, exact, unit="MPa", rel=2.0e-3)
    spent = [results.table("energy")["dissipated"] for results in (before, after)]
    assert spent[1] == pytest.approx(np.full(len(spent[1]), spent[0][-1]), rel=1.0e-9)
    assert np.abs(after.table("energy")["error"]).max() < 1.0e-9
    table = before.table("profile_1")
    name = "s11" if MODES[mode][0] == 0.0 else "s22"
    compare.curves(
        mode,
        ("strain [-]", "stress [MPa]"),
        {
            "first stage": (sense * table["exx"], sense * table[name]),
            "second stage": (strain, stress),
        },
        {"law": (np.array([0.0, onset, failure]), np.array([0.0, strength, 0.0]))},
    )


def smooth(ways: tuple[float, ...]) -> list[tuple[float, float]]:
    """Velocity over time along some ways of equal time, zero between them."""
    shape = np.sin(np.pi * np.arange(32) / 32)
    times = np.linspace(0.0, DURATION, 32 * len(ways) + 1)
    speeds = [way * shape / (shape.sum() * times[1]) for way in ways]
    values = np.concatenate([*speeds, [0.0]])
    return [(float(t), float(v)) for t, v in zip(times, values, strict=True)]


def opened(reached: float, folder: Path) -> Results:
    """Two stiff plies on a quad that are moved apart and back."""
    mesh = regular(SIDE, SIDE, 1, 1, 9)
    deck = Deck("interface", DURATION)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(1.0e-9, 1.0e7, 0.0), HEIGHT)] * 2, 1)
    deck.cohesive(BOND)
    deck.hold_face(range(9), BOTTOM, "xyz")
    curve = deck.curve(smooth((reached, -reached)))
    deck.add("BOUNDARY_FACE_MOTION", (deck.node_set(range(9)), TOP, 3, 0, curve, 1.0))
    deck.profile(1, 0.5 * SIDE, 0.5 * SIDE, DURATION / STATES, 2)
    deck.intervals(glstat=DURATION / STATES)
    deck.add("DATABASE_BINARY_D3DUMP", (999999999,))
    return run(deck, folder, "first")


def opened_again(before: Results, ways: tuple[float, ...], job: str) -> Results:
    """A stage that moves the upper face along some ways."""
    number = 90 + len(job)
    body = (
        f"*CONTROL_TERMINATION\n{DURATION!r},\n*DEFINE_CURVE\n{number}\n{lines(smooth(ways))}"
        f"*BOUNDARY_FACE\n1,{BOTTOM},0.0,1,1,1\n*BOUNDARY_FACE_MOTION\n2,{TOP},3,0,{number},1.0\n"
    )
    return run_stage(before, body, job)


def test_interface_damage_is_kept(compare: Comparison, tmp_path: Path) -> None:
    """Three stages: damaged, loaded along the secant, and led to failure."""
    onset, reached = STRENGTH / STIFFNESS, 0.4 * FAILURE
    first = opened(reached, tmp_path)
    second = opened_again(first, (AGAIN * reached, -AGAIN * reached), "second")
    third = opened_again(second, (2.0 * FAILURE,), "third")
    grid = "interfaces.vtkhdf"
    for name in ("damage", "dissipated", "energy_share"):
        (_, end), (start, last) = states(first, name, grid), states(second, name, grid)
        assert np.array_equal(end, start)
        assert np.array_equal(start, last)
        assert np.array_equal(last, states(third, name, grid)[0])
    expected = damage_at(reached, onset, FAILURE)
    damage = states(second, "damage", grid)[1]
    # the plies take 2e-3 of the motion
    compare.number("damage of the interface kept", float(damage.mean()), expected, rel=1.0e-3)
    profile = second.table("profile_1")
    traction, height = profile["szz"][1::4], profile["uz"].reshape(-1, 4)
    opening = height[:, 2] - height[:, 1]
    slope = float(np.polyfit(opening, traction, 1)[0])
    exact = (1.0 - expected) * STIFFNESS
    compare.number("stiffness of the damaged interface", slope, exact, unit="N/mm3", rel=5.0e-3)
    energies = [results.table("energy")["delamination"] for results in (first, second, third)]
    assert np.ptp(energies[1]) == 0.0
    assert np.all(np.diff(energies[2]) >= 0.0)
    compare.number("energy of all stages", energies[2][-1], TOUGHNESS, unit="mJ", rel=1.0e-9)
