"""Elastic bricks that swing, step by step, against a dense solution of the same equations."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from brick_decks import Bricks, add_bricks, box
from brick_reference import STIFF, VISCOUS, BrickPatch
from comparison import Comparison
from decks import Deck
from elasticity import CARBON, GLASS, STEEL, Array, Material, stiffness
from runs import Table, run

CYCLES = 100
#: Ten digits in the files, and what some hundred steps make of the last of a step's
TOLERANCE = 1.0e-8


@dataclass(frozen=True)
class Case:
    """Bricks, how they start, and how many of their nodes are held."""

    mesh: Bricks
    material: Material
    angles: list[float]
    hourglass: tuple[int, float] | None
    velocity: Array
    held: int


def stable_step(patch: BrickPatch) -> float:
    """A share of the step of the fastest motion, less for what control drags."""
    root = np.sqrt(patch.mass)
    stiff, drag = (
        np.linalg.eigvalsh(matrix / np.outer(root, root))[-1]
        for matrix in (patch.stiffness, patch.drag)
    )
    return float(0.7 / (np.sqrt(stiff) + drag))


def swing(patch: BrickPatch, free: Array, velocity: Array, step: float) -> dict[str, Array]:
    """Central differences; drag takes the velocity of the last half step."""
    u, v, taken = np.zeros_like(velocity), velocity, 0.0
    a = np.where(free, -patch.drag @ v / patch.mass, 0.0)
    lines = []
    for cycle in range(CYCLES):
        v = v + (step if cycle else 0.5 * step) * a
        u = u + step * v
        taken += step * float(v @ patch.drag @ v)
        a = np.where(free, -(patch.stiffness @ u + patch.drag @ v) / patch.mass, 0.0)
        kinetic = 0.5 * float(patch.mass @ (v + 0.5 * step * a) ** 2)
        lines.append((u, kinetic, taken, 0.5 * float(u @ patch.stiffness @ u)))
    names = ("displacement", "kinetic", "taken", "stored")
    return dict(zip(names, map(np.array, zip(*lines, strict=True)), strict=True))


def solve(case: Case, step: float, folder: Path) -> tuple[Table, Array]:
    """Energies of a run, and the displacement of its nodes after each step."""
    m, mesh = case.material, case.mesh
    deck = Deck("bricks that swing", 1.0, CYCLES)
    deck.control(linear=True, share=0.95, largest=step)
    add_bricks(
        deck,
        mesh,
        lambda own: own.add("MAT_PLY_ELASTIC", (1, m.density, *m.young, *m.poisson), m.shear),
        points=1 if case.hourglass else 8,
        hourglass=case.hourglass,
        angles=case.angles,
    )
    if case.held > 0:
        deck.hold(range(case.held), "xyz")
    deck.velocities(case.velocity)
    deck.histories(range(len(mesh.points)), 0.0)
    deck.intervals(glstat=0.0)
    results = run(deck, folder)
    nodes = results.table("nodes")
    names = [f"n{i + 1} u{c}" for i in range(len(mesh.points)) for c in "xyz"]
    return results.table("energy"), np.stack([nodes[name][1:] for name in names], axis=1)


def by_chance(control: int | None, seed: int) -> Case:
    """Bricks with fibres in some direction: distorted, but boxes where the control is stiff."""
    random = np.random.default_rng(seed)
    size, counts = random.uniform(1.0, 3.0, 3), [int(n) for n in random.integers(1, 3, 3)]
    mesh, angles = box(size, counts), random.uniform(-90.0, 90.0, counts[2])
    if control == STIFF:
        angles = np.zeros(counts[2])
    else:
        shift = 0.12 * random.uniform(-1.0, 1.0, mesh.points.shape) * size / counts
        mesh = Bricks(mesh.points + shift, mesh.bricks, mesh.layer)
    hourglass = control and (control, float(random.uniform(0.05, 0.3)))
    velocity = 1.0e3 * random.normal(size=mesh.points.shape)
    velocity[:seed] = 0.0
    return Case(mesh, (CARBON, GLASS, STEEL)[seed], angles.tolist(), hourglass, velocity, seed)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("control", [None, VISCOUS, STIFF])
def test_bricks_swing_as_the_reference(
    control: int | None, seed: int, compare: Comparison, tmp_path: Path
) -> None:
    """Displacement of every node and the energies in every step."""
    case = by_chance(control, seed)
    moduli = [stiffness(case.material, case.angles[layer]) for layer in case.mesh.layer]
    patch = BrickPatch(case.mesh, np.array(moduli), case.material.density, case.hourglass)
    step = stable_step(patch)
    energy, found = solve(case, step, tmp_path)
    free = np.repeat(np.arange(len(case.mesh.points)) >= case.held, 3)
    expected = swing(patch, free, case.velocity.ravel(), step)
    assert energy["step"][1:] == pytest.approx(np.full(CYCLES, step), rel=1.0e-9)
    close = TOLERANCE * np.abs(found).max()
    compare.values("displacements, 100 steps", found, expected["displacement"], abs=close)
    close = TOLERANCE * energy["kinetic"][0]
    assert np.abs(energy["kinetic"][1:] - expected["kinetic"]).max() < close
    if control == VISCOUS:
        assert np.abs(energy["hourglass"][1:] - expected["taken"]).max() < close
    else:
        assert np.abs(energy["internal"][1:] - expected["stored"]).max() < close
