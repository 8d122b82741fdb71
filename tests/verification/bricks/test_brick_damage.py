"""Bricks of plies that are damaged: energy per area of crack, directions, the same as plates."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from brick_decks import Bricks, add_bricks, box
from comparison import Comparison
from damage import BAND, HTS40, MODES, POINT, ROOT_POINT, ROOT_QUAD, DamagedPly
from decks import Deck, Ply, Sphere
from meshes import regular
from runs import Results, Table, run

END, DAMPING = 5.0e-4, 5.0e5


def plies(*materials: DamagedPly) -> Callable[[Deck], None]:
    """Materials from 1."""

    def add(deck: Deck) -> None:
        for number, ply in enumerate(materials, 1):
            deck.add("MAT_PLY_CODAM2", *ply.cards(number))

    return add


def led(mode: str, rule: int, size: tuple[float, ...], points: int, folder: Path) -> Results:
    """Lead a brick to 1.05 times the strain at which nothing is left."""
    angle, _, strength, toughness, sense = MODES[mode]
    finish = 1.05 * 2.0 * toughness / (width(rule, mode, size, points) * strength)
    mesh = box(size, (1, 1, 1))
    deck = Deck(mode, END)
    deck.control(linear=True, damping=DAMPING)
    add_bricks(deck, mesh, plies(replace(HTS40, switches=(rule,))), points=points, angles=(angle,))
    curve = deck.curve([(0.0, 0.0), (END, 1.0)])
    deck.hold(mesh.where(z=0.0), "z")
    if mode == "shear":
        deck.hold(mesh.where(y=0.0), "xy")
        deck.hold(mesh.where(y=size[1]), "y")
        deck.move(mesh.where(y=size[1]), 1, curve, finish * size[1])
    else:
        deck.hold(mesh.where(x=0.0), "x")
        deck.hold(mesh.where(y=0.0), "y")
        deck.move(mesh.where(x=size[0]), 1, curve, sense * finish * size[0])
    deck.add("DATABASE_FIELD", "displacement damage_fibre damage_matrix")
    deck.intervals(glstat=END / 400.0, binary_d3plot=END)
    return run(deck, folder)


def width(rule: int, mode: str, size: tuple[float, ...], points: int) -> float:
    """Crack band of a brick along the axes: the crack is normal to x, for shear to y."""
    along = size[1] if mode == "shear" else size[0]
    root = np.sqrt(size[0] * size[1])
    share = 1.0 if points == 1 else 0.5
    return {BAND: along, POINT: share * along, ROOT_POINT: share * root, ROOT_QUAD: root}[rule]


@pytest.mark.parametrize(
    ("points", "rule"), [(1, BAND), *((8, rule) for rule in (BAND, POINT, ROOT_POINT, ROOT_QUAD))]
)
@pytest.mark.parametrize("mode", list(MODES))
def test_mode(mode: str, points: int, rule: int, compare: Comparison, tmp_path: Path) -> None:
    """The energy is the toughness over the width of the band; the field shows the damage.

    With the first rule that is the toughness times the area of the crack.
    """
    _, modulus, strength, toughness, _ = MODES[mode]
    scale = 5.0 if mode.startswith("fibre") else 0.5
    size = (0.3 * scale, 0.2 * scale, 0.125)
    results = led(mode, rule, size, points, tmp_path)
    energy = results.table("energy")
    fibre = mode.startswith("fibre")
    own = "fibre damage" if fibre else "matrix damage"
    band = width(rule, mode, size, points)
    # what the least stiffness, a millionth, stores at the end, and the inertia of the sides
    close = 1.3e-6 * 2.0 * toughness * modulus / (band * strength**2) + 2.0e-5
    expected = np.prod(size) * toughness / band
    compare.number("energy of damage", energy[own][-1], expected, unit="mJ", rel=close)
    if rule == BAND:
        crack = size[2] * (size[0] if mode == "shear" else size[1])
        assert energy[own][-1] == pytest.approx(toughness * crack, rel=close)
    assert energy["dissipated"] == pytest.approx(energy[own], abs=1.0e-12 * energy[own][-1])
    assert np.abs(energy["error"]).max() < 1.0e-9
    broken = results.field("damage_fibre" if fibre else "damage_matrix")
    whole = results.field("damage_matrix" if fibre else "damage_fibre")
    # DMAX of the keyword
    assert broken == pytest.approx(np.ones(8), abs=2.0e-6)
    assert whole == pytest.approx(np.zeros(8), abs=1.0e-12)


@pytest.mark.parametrize("points", [1, 8])
def test_damage_between_strains(points: int, compare: Comparison, tmp_path: Path) -> None:
    """A brick of *MAT_CODAM2 across its fibres spends half of modulus, onset and saturation."""
    young, onset, finish, size = 9.0e3, 0.008, 0.032, (0.3, 0.2, 0.125)

    def add(deck: Deck) -> None:
        elastic = (1, 1.6e-9, 130.0e3, young, 0, 0.02, 0, 0.4)
        axes = ((0, 0, 0, 1.0, 0.0, 0.0, 2.0), (0, 0, 0, 0.0, 1.0, 0.0, 0, 0), (90.0,))
        tension = (onset, 0.015, 0.06, 0, finish, 0.06, 0.08, 0)
        compression = (0.02, 0.011, 0.09, 0, 0.07, 0.09, 0.11, 0)
        cards = (elastic, (5.0e3, 0, 0, 1, 0, 0, 0), *axes, tension, compression)
        deck.add("MAT_CODAM2", *cards)

    mesh = box(size, (1, 1, 1))
    deck = Deck("between strains", END)
    deck.control(linear=True, damping=DAMPING)
    add_bricks(deck, mesh, add, points=points)
    curve = deck.curve([(0.0, 0.0), (END, 1.0)])
    for direction in "xyz":
        deck.hold(mesh.where(**{direction: 0.0}), direction)
    deck.move(mesh.where(x=size[0]), 1, curve, 1.05 * finish * size[0])
    deck.intervals(glstat=END / 400.0, binary_d3plot=END)
    energy = run(deck, tmp_path).table("energy")
    spent = 0.5 * young * onset * finish * np.prod(size)
    # what the least stiffness, a millionth, stores at the end, and the inertia of the sides
    close = 1.3e-6 * finish / onset + 2.0e-5
    dissipated = energy["matrix damage"][-1]
    compare.number("energy between given strains", dissipated, spent, unit="mJ", rel=close)
    assert np.all(energy["fibre damage"] == 0.0)
    assert np.abs(energy["error"]).max() < 1.0e-9


def bar(bricks: int, points: int, folder: Path) -> Table:
    """Pull a bar of plies across it, the brick in its middle weaker by a tenth."""
    length, side, thickness = 0.6, 0.6, 0.125
    strength, toughness = 0.9 * HTS40.matrix_strength[0], HTS40.matrix_toughness[0]
    mesh = box((length, side, thickness), (bricks, 1, 1))
    deck = Deck("a bar with a weak brick", END)
    deck.control(linear=True, damping=DAMPING)
    weak = replace(HTS40, matrix_strength=(strength, 236.0))
    parts = [2 if 2 * i + 1 == bricks else 1 for i in range(bricks)]
    add_bricks(deck, mesh, plies(HTS40, weak), points=points, angles=(90.0,), parts=parts)
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(mesh.where(y=0.0), "y")
    deck.hold(mesh.where(z=0.0), "z")
    curve = deck.curve([(0.0, 0.0), (END, 1.0)])
    deck.move(mesh.where(x=length), 1, curve, 5.0 * toughness / strength)
    deck.intervals(glstat=END / 400.0, binary_d3plot=END)
    return run(deck, folder).table("energy")


@pytest.mark.parametrize("points", [1, 8])
def test_bar(points: int, compare: Comparison, tmp_path: Path) -> None:
    """One crack opens, with the toughness of its area, however fine the bricks are."""
    area = 0.6 * 0.125
    for bricks in (3, 5, 9):
        energy = bar(bricks, points, tmp_path / f"{bricks}")
        spent = energy["matrix damage"][-1] / (HTS40.matrix_toughness[0] * area)
        # the brick cannot become narrower as its neighbours do not, as with plates of four nodes
        compare.number("energy of one crack over its toughness", spent, 1.0, rel=1.0e-4)
        assert np.abs(energy["error"]).max() < 1.0e-9


def strained(turn: float, points: int, folder: Path) -> Table:
    """Strain a distorted brick with fibres at 20 degrees, all of it turned about z."""
    angle = np.radians(turn)
    rotation = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    flat = box((0.3, 0.2, 0.125), (1, 1, 1))
    places = flat.points.copy()
    places[[2, 6], :2] += [0.03, 0.02]
    gradient = np.zeros((3, 3))
    gradient[:2, :2] = np.array([[0.02, 0.01], [0.005, 0.015]])
    moved = places @ gradient.T
    places[:, :2], moved[:, :2] = places[:, :2] @ rotation.T, moved[:, :2] @ rotation.T
    mesh = Bricks(places, flat.bricks, flat.layer)
    deck = Deck("a turned brick", 1.0e-5)
    deck.control(linear=True)
    add_bricks(deck, mesh, plies(HTS40), points=points, angles=(20.0 + turn,))
    curve = deck.curve([(0.0, 0.0), (1.0e-5, 1.0)])
    for node in range(8):
        for direction in range(3):
            deck.move([node], direction + 1, curve, moved[node, direction])
    deck.intervals(glstat=1.0e-6, binary_d3plot=1.0e-5)
    return run(deck, folder).table("energy")


@pytest.mark.parametrize("points", [1, 8])
def test_turned(points: int, tmp_path: Path) -> None:
    """A brick and its fibres turned together spend the same energies."""
    found = [strained(turn, points, tmp_path / f"{turn}") for turn in (0.0, 37.0)]
    for name in ("matrix damage", "internal"):
        assert found[0][name][-1] > 0.0
        assert found[1][name] == pytest.approx(found[0][name], rel=1.0e-9)


def struck(kind: str, folder: Path, *, linear: bool = True, threads: int = 1) -> Results:
    """A clamped laminate hit until it cracks: layers of four nodes, or bricks in their place."""
    side, thickness, n, end = 12.0, 0.25, 8, 3.0e-5
    ply = replace(HTS40, density=1.6e-9, largest=0.9)
    deck = Deck("a struck laminate", end)
    deck.control(linear=linear, share=0.5)
    deck.add("CONTROL_PARALLEL", (threads,))
    if kind == "layers":
        plane = regular(side, side, n, n, 4)
        deck.mesh(plane)
        deck.laminate([Ply(ply, thickness, angle) for angle in (0.0, 90.0)], order=1)
        edge, top = np.array(plane.boundary()), thickness
    else:
        mesh = box((side, side, 2.0 * thickness), (n, n, 2))
        points = 8 if kind == "full" else 1
        add_bricks(deck, mesh, plies(ply), points=points, angles=(0.0, 90.0))
        away = np.abs(mesh.points[:, :2] - 0.5 * side).max(axis=1)
        edge, top = np.flatnonzero(away > 0.5 * side - 1.0e-9), 2.0 * thickness
    deck.hold(edge, "xyz")
    centre = (0.5 * side, 0.5 * side, top + 3.0)
    deck.sphere(Sphere(3.0, 1.0e-6, centre, velocity=(0.0, 0.0, -2.0e4)))
    deck.intervals(impactor=end / 100, glstat=end / 100, binary_d3plot=end)
    return run(deck, folder)


@pytest.mark.parametrize("linear", [True, False])
def test_full_bricks_are_layers_of_four_nodes(
    linear: bool, compare: Comparison, tmp_path: Path
) -> None:
    """Shape functions, points, masses, steps, crack bands and contact are the same: so are answers.

    Only the order of sums differs: rounding, which contact and damage let grow.
    """
    found = [struck(kind, tmp_path / kind, linear=linear) for kind in ("layers", "full")]
    layers, bricks = (results.table("energy") for results in found)
    assert layers["matrix damage"][-1] > 0.02 * layers["total"][0]
    for name in ("time", "matrix damage", "fibre damage", "internal", "kinetic"):
        assert bricks[name] == pytest.approx(layers[name], rel=1.0e-7, abs=1.0e-9), name
    force, same = (results.table("impactor_1")["force"] for results in found)
    compare.values("force, bricks beside layers", same, force, unit="N", abs=1.0e-7 * force.max())


def test_balance_closes_and_bits_are_the_same(tmp_path: Path) -> None:
    """Bricks of one point: one thread and two give the same files, and no energy is lost."""
    folders = [tmp_path / "one", tmp_path / "two"]
    for threads, folder in enumerate(folders, 1):
        results = struck("one point", folder, linear=False, threads=threads)
    energy = results.table("energy")
    lost = energy["matrix damage"] + energy["fibre damage"]
    assert lost[-1] > 0.02 * energy["total"][0]
    assert energy["dissipated"] == pytest.approx(lost, abs=1.0e-9)
    assert np.abs(energy["error"]).max() < 1.0e-9
    for name in ("job.energy.csv", "job.impactor_1.csv"):
        assert (folders[0] / name).read_bytes() == (folders[1] / name).read_bytes()
