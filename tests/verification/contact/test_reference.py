"""Impacts by chance, step by step, against an independent dense solution of the same equations."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from contact_reference import Impact
from decks import BOTTOM, TOP, Deck, Ply, Sphere
from elasticity import CARBON, GLASS, STEEL
from layered_plate import LayeredPlate
from meshes import Mesh, distorted, regular
from runs import Results, run

CYCLES = 80
#: Ten digits in the files, and what some hundred steps make of the last of a step's
TOLERANCE = 1.0e-7


@dataclass(frozen=True)
class Case:
    """A small plate, what holds it, and what strikes it."""

    mesh: Mesh
    plies: list[Ply]
    order: int
    held: list[tuple[list[int], str]]
    spheres: list[Sphere]


def curved(random: np.random.Generator, nodes: int) -> Mesh:
    """Two or three quads along either side: straight, distorted, skew, or with curved sides."""
    counts = [int(count) for count in random.integers(2, 4, 2)]
    length, width = random.uniform(3.0, 8.0, 2)
    mesh = regular(length, width, *counts, nodes)
    kind = random.integers(4)
    if kind == 1:
        shift = (0.12 if nodes == 4 else 0.06) * min(length / counts[0], width / counts[1])
        return distorted(mesh, shift, int(random.integers(1000)))
    points = mesh.points.copy()
    if kind == 2:
        points[:, 0] += random.uniform(-0.5, 0.5) * points[:, 1]
    if kind == 3:
        x, y = mesh.points.T
        points[:, 0] += 0.1 * length * (y / width) ** 2
        points[:, 1] += 0.15 * width * random.uniform(-1.0, 1.0) * np.sin(np.pi * x / length)
    return Mesh(points, mesh.quads)


def place(random: np.random.Generator, mesh: Mesh, size: float) -> np.ndarray:
    """Over a quad, a node, the middle of a side, or inside or outside of the border, (2,)."""
    quad = mesh.quads[random.integers(len(mesh.quads))]
    border = mesh.points[random.choice(mesh.quads[0][:2])]
    places = [
        mesh.points[quad].mean(axis=0) + random.uniform(-0.5, 0.5, 2) * size,
        mesh.points[quad[0]],
        mesh.points[quad[:2]].mean(axis=0),
        border + random.uniform(-0.2, 0.2, 2) * size,
    ]
    return places[random.integers(len(places))]


def ball(random: np.random.Generator, mesh: Mesh, height: float, mass: float) -> Sphere:
    """A sphere just above a face or in touch with it, guided or free, falling or also sideways."""
    size = float(np.ptp(mesh.points[mesh.quads[0]], axis=0).min())
    method, face = int(random.integers(1, 3)), int(random.choice([TOP, BOTTOM]))
    radius = size * random.choice([random.uniform(0.6, 1.0), random.uniform(1.2, 4.0)])
    if method == 2:
        radius = max(radius, 1.3 * size)
    speed, guided = random.uniform(2.0e3, 3.0e4), bool(random.random() < 0.4)
    aside = random.uniform(-1.0, 1.0, 2) * speed * (0.0 if guided else random.integers(2))
    gap = random.choice([0.0, random.uniform(0.0, 1.0e-3)])
    centre = (*place(random, mesh, size), face * (0.5 * height + radius + gap))
    return Sphere(
        float(radius),
        float(mass * 10.0 ** random.uniform(-1.0, 1.0)),
        tuple(float(x) for x in centre),
        (float(aside[0]), float(aside[1]), -face * float(speed)),
        guided,
        -face * 1.0e8 * int(random.random() < 0.2),
        method,
        float(size * random.choice([0.0, random.uniform(0.15, 0.5)])),
        face,
    )


def by_chance(seed: int) -> Case:
    """Everything that the deck has a choice of."""
    random = np.random.default_rng(seed)
    mesh = curved(random, int(random.choice([4, 9])))
    materials = [CARBON, GLASS, STEEL]
    plies = [
        Ply(materials[random.integers(3)], random.uniform(0.2, 0.8), random.uniform(-90.0, 90.0))
        for _ in range(random.integers(1, 4))
    ]
    some = [int(node) for node in mesh.quads[-1][:2]]
    held = [[], [(some, "xyz")], [(some, "z")]][random.integers(3)]
    height = sum(ply.thickness for ply in plies)
    mass = height * 2.0e-9 * float(np.prod(np.ptp(mesh.points, axis=0)))
    spheres = [ball(random, mesh, height, mass) for _ in range(random.choice([1, 1, 2]))]
    # decks with two bodies in one place are refused
    if np.linalg.norm(np.subtract(spheres[0].centre, spheres[-1].centre)) < 2.0 * max(
        sphere.radius for sphere in spheres
    ):
        del spheres[1:]
    return Case(mesh, plies, int(random.integers(1, 3)), held, spheres)


def solve(case: Case, step: float, folder: Path) -> Results:
    """Run the solver, every step of it written."""
    deck = Deck("by chance", 1.0, CYCLES)
    deck.control(linear=True, largest=step)
    deck.mesh(case.mesh)
    deck.laminate(case.plies, case.order)
    for nodes, directions in case.held:
        deck.hold(nodes, directions)
    for number, sphere in enumerate(case.spheres, 1):
        deck.sphere(sphere, number)
    deck.intervals(impactor=0.0, glstat=0.0)
    deck.histories(range(len(case.mesh.points)), 0.0)
    return run(deck, folder)


def history(impact: Impact) -> dict[str, np.ndarray]:
    """What the reference has after each step: columns by table and name, (steps,)."""
    faces = {name: impact.plate.face(side)[1] for name, side in (("bottom", -1), ("top", 1))}
    lines = []
    for _ in range(CYCLES):
        impact.advance()
        line = {("energy", name): value for name, value in impact.energies().items()}
        for axis, name in enumerate("xyz"):
            line["energy", f"momentum {name}"] = impact.momentum()[axis]
        for number, own in enumerate(impact.impactors, 1):
            table = f"impactor_{number}"
            line[table, "force x"], line[table, "force y"], line[table, "force"] = own.force
            line[table, "displacement"] = own.displacement[2]
            line[table, "velocity"] = own.velocity[2]
        for face, unknowns in faces.items():
            for node, own in enumerate(unknowns, 1):
                for axis, name in enumerate("xyz"):
                    value = impact.displacement[own[axis]]
                    line["nodes", f"n{node} {face} u{name}"] = value
        lines.append(line)
    return {key: np.array([line[key] for line in lines]) for key in lines[0]}


def kind(table: str, name: str) -> str:
    """Columns that are measured by the largest value of them all."""
    if table == "nodes":
        return "displacement of nodes"
    if table == "energy":
        return "momentum" if name.startswith("momentum") else "energy"
    return table + name.split()[0]


@pytest.mark.parametrize("seed", range(12))
def test_impacts_by_chance_go_as_the_reference(
    seed: int, compare: Comparison, tmp_path: Path
) -> None:
    """Forces, motion, energies and momentum in every step, on meshes of a few quads."""
    case = by_chance(seed)
    plate = LayeredPlate(case.mesh, case.plies, case.order)
    for nodes, directions in case.held:
        plate.hold(nodes, directions)
    step = 0.5 * plate.stable_step()
    results = solve(case, step, tmp_path)
    expected = history(Impact(plate, case.spheres, step))
    tables = {name: results.table(name) for name, _ in expected}
    assert tables["energy"]["step"][1:] == pytest.approx(np.full(CYCLES, step), rel=1.0e-9)
    sizes: dict[str, float] = {}
    for (table, name), values in expected.items():
        found = kind(table, name)
        start = float(np.abs(tables[table][name][0]))
        if name == "displacement":
            # a sphere on a held point does not move: what it would have in a step
            start = step * float(np.abs(tables[table]["velocity"][0]))
        sizes[found] = max(sizes.get(found, 0.0), start, float(np.abs(values).max()))
    errors = {
        (table, name): np.abs(tables[table][name][1:] - values).max()
        / (sizes[kind(table, name)] or 1.0)
        for (table, name), values in expected.items()
    }
    worst = max(errors, key=lambda key: errors[key])
    compare.number("largest error of any history, of 80 steps", errors[worst], 0.0, abs=TOLERANCE)
