"""Mass scaling: a heavier plate with the same stiffness, as heavy as the time step needs.

A layer of order 1 over a quad, without Poisson's ratio and thin against the quad, has the stable
step h / c. DT2MS makes that step s at least: the mass grows by (s c / h)^2 where this is above one.
The exact frequency of the laminate with such densities, the force of a heavier bar on a wall and
the state of rest, which has no inertia, are the references.
"""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck, Ply, ramp
from elasticity import Array, Material, isotropic
from exact_plate import CrossPly, frequency
from meshes import rectangle, regular
from runs import Results, run
from swings import add_first_mode, deflection, fitted

DENSITY, YOUNG = 2.7e-9, 70.0e3
SPEED = float(np.sqrt(YOUNG / DENSITY))
MATERIAL = isotropic(DENSITY, YOUNG, 0.0)
#: Two thick plies and a thin one
SIDE, PLIES = 80.0, (2.0, 2.0, 0.5)


def masses(results: Results) -> Array:
    """Mass, added mass, per cent, elements, those with more, largest ratio, of all parts."""
    table = results.listing().split("\nMass scaling\n")[1].split("\n\n")[2]
    row = next(line for line in table.splitlines() if line.split()[0] == "all")
    return np.array(row.split()[1:], float)


def step(results: Results) -> float:
    """Largest step that is taken."""
    found = re.search(r"^largest step taken +([\d.E+-]+)", results.listing(), re.MULTILINE)
    assert found is not None
    return float(found[1])


def layers_of(ratios: list[float]) -> tuple[tuple[Material, float, float], ...]:
    """The plies with densities that are so many times as large."""
    return tuple(
        (replace(MATERIAL, density=ratio * DENSITY), h, 0.0)
        for ratio, h in zip(ratios, PLIES, strict=True)
    )


def vibrating(wanted: float, time: float, folder: Path) -> Results:
    """The plate with mass scaling, in its first mode."""
    deck = Deck("heavier laminate", time)
    deck.control(linear=True, scaled=wanted)
    mesh = regular(0.5 * SIDE, 0.5 * SIDE, 4, 4, 9)
    add_first_mode(deck, mesh, [Ply(MATERIAL, h) for h in PLIES], 1, time / 1000.0)
    return run(deck, folder)


@pytest.mark.parametrize("times", [0.8, 3.0], ids=["thin ply", "all plies"])
def test_frequency_is_that_of_the_heavier_laminate(
    times: float, compare: Comparison, tmp_path: Path
) -> None:
    """The exact plate with the density of each ply raised as the listing says.

    The mass is above (s c / h)^2, s so many thick plies over c: the step of a thick ply also
    depends on the quad, and an eigenvalue is proved to a few thousandths.
    """
    wanted = times * max(PLIES) / SPEED
    guess = frequency(CrossPly(SIDE, SIDE, layers_of([1.0] * len(PLIES))), 1, 1, 3.0e5)
    results = vibrating(wanted, 8.0 * 2.0 * np.pi / guess * times, tmp_path)
    own, added, *_, thin = masses(results)
    raised = (own + added) / own * sum(PLIES) - thin * PLIES[-1]
    thick = raised / sum(PLIES[:-1])
    ideal = [max((wanted * SPEED / h) ** 2, 1.0) for h in PLIES]
    heavier = np.dot(ideal, PLIES) / sum(PLIES)
    bounds = (0.0, 0.03)
    compare.number("mass over own mass", (own + added) / own, heavier, bounds=bounds)
    compare.number("step taken", step(results), 0.9 * wanted, unit="s", rel=1.0e-5)
    plate = CrossPly(SIDE, SIDE, layers_of([thick] * len(PLIES[:-1]) + [thin]))
    exact = frequency(plate, 1, 1, 3.0e5)
    found = fitted(*deflection(results), exact)
    hertz = 2.0 * np.pi
    compare.number("first frequency", found / hertz, exact / hertz, unit="Hz", rel=1.0e-2)


LENGTH, WIDTH, THICKNESS = 50.0, 1.0, 4.0


@pytest.mark.parametrize("times", [2.0, 5.0])
def test_bar_on_a_wall(times: float, compare: Comparison, tmp_path: Path) -> None:
    """A bar whose mass has grown by r on a wall: rho c v A sqrt(r) until 2 L sqrt(r) / c.

    The step of quads of 0.5 mm is `times` as large; the mean over the middle of the time is known
    to 0.5 %, as without added mass.
    """
    quads, velocity = 100, 5.0e3
    wanted = times * LENGTH / quads / SPEED
    time = 2.0 * LENGTH * times / SPEED
    mesh = regular(LENGTH, WIDTH, quads, 1, 4)
    deck = Deck("bar", time)
    deck.control(linear=True, scaled=wanted)
    deck.mesh(mesh)
    deck.laminate([Ply(MATERIAL, THICKNESS)], 1)
    deck.hold(range(len(mesh.points)), "yz")
    deck.hold(mesh.where(x=0.0), "x")
    deck.velocity(range(len(mesh.points)), (-velocity, 0.0, 0.0))
    deck.intervals(spcforc=0.0)
    results = run(deck, tmp_path)
    own, added = masses(results)[:2]
    ratio = 1.0 + added / own
    supports = results.table("supports")
    back = 2.0 * LENGTH * np.sqrt(ratio) / SPEED
    steady = (supports["time"] > 0.2 * back) & (supports["time"] < 0.8 * back)
    force = DENSITY * SPEED * velocity * WIDTH * THICKNESS * np.sqrt(ratio)
    found = supports["fx"][steady].mean()
    compare.number("force of a heavier bar on a wall", found, force, unit="N", rel=5.0e-3)


def test_rest_has_no_mass(compare: Comparison, tmp_path: Path) -> None:
    """A bar of unlike quads that is stretched slowly: E A e, though most of its mass is added."""
    strain = 1.0e-3
    lines = np.concatenate([np.linspace(0.0, 10.0, 21), np.linspace(10.0, LENGTH, 9)[1:]])
    side = 10.0
    mesh = rectangle(lines, np.array([0.0, side]), 4)
    wanted = 3.0 / SPEED
    rate = 0.5 * np.pi * SPEED / LENGTH / 4.0
    time = 12.0 * 2.0 * np.pi / rate
    deck = Deck("stretched", time)
    deck.control(linear=True, damping=1.5 * rate, scaled=wanted)
    deck.mesh(mesh)
    deck.laminate([Ply(MATERIAL, side)], 1)
    deck.hold(range(len(mesh.points)), "yz")
    deck.hold(mesh.where(x=0.0), "x")
    curve = deck.curve([*[(0.3 * time * t, share) for t, share in ramp(1.0, 100)], (time, 1.0)])
    deck.move(mesh.where(x=LENGTH), 1, curve, strain * LENGTH)
    deck.intervals(spcforc=0.0, glstat=0.0)
    results = run(deck, tmp_path)
    own, added, _, elements, raised, _ = masses(results)
    assert added > own
    assert 0 < raised < elements
    supports = results.table("supports")
    name = next(name for name in supports.names if name.startswith("motion") and "fx" in name)
    exact = YOUNG * side**2 * strain
    compare.number(
        "force of a stretched bar at rest", abs(supports[name][-1]), exact, unit="N", rel=1.0e-4
    )
    energy = results.table("energy")
    compare.number(
        "energy of it", energy["internal"][-1], 0.5 * exact * strain * LENGTH, unit="mJ", rel=1.0e-4
    )
