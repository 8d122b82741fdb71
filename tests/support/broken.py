"""Runs that are broken off and go on, and what must be the same as in one piece."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Sequence
from pathlib import Path

import h5py
import numpy as np

from brick_decks import add_bricks, box
from decks import BOTTOM, Bond, Deck, Ply, Sphere, ramp
from elasticity import CARBON
from meshes import regular
from runs import SOLVER

SIDE, PLY, RADIUS = 20.0, 0.5, 6.0
END, CYCLES = 1.5e-5, 40
TINY = 1.0e-9
ANGLES = (0.0, 90.0, 0.0)


def said(*words: object) -> tuple[int, str]:
    """Exit code of the program, and all that it printed."""
    # threads that wait for a core are not to keep it busy
    calm = {**os.environ, "OMP_WAIT_POLICY": "passive"}
    done = subprocess.run([SOLVER, *words], capture_output=True, text=True, check=False, env=calm)
    return done.returncode, done.stdout + done.stderr


def check_changed(
    deck: Deck, folder: Path, *changes: tuple[str, str], more: str = ""
) -> tuple[int, str]:
    """Exit code and words of a check of a deck with some changes, and with more cards."""
    text = deck.text()
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    path = folder / "job.k"
    path.write_text(text.replace("*END", f"{more}*END"))
    return said("check", path)


def outputs(deck: Deck, nodes: Sequence[int]) -> None:
    """Ask for every kind of results, at intervals that the steps do not meet."""
    deck.histories(nodes, 1.1e-6)
    deck.profile(1, 9.0, 9.0, 4.3e-6)
    deck.intervals(impactor=0.0, glstat=0.7e-6, spcforc=0.9e-6, binary_d3plot=3.7e-6)


def impact(
    method: int = 1,
    joint: str = "tied",
    end: float = END,
    *,
    implicit: int = 0,
    linear: bool = False,
    order: int = 1,
    failing: bool = False,
    closing: bool = False,
    fracture: bool = False,
    radii: tuple[float, float] = (0.0, 0.0),
) -> Deck:
    """A ball on a cross-ply plate; it touches at once. What can fail does so soon.

    Radii let averages over neighbours drive the damage; cracks may close, or be on planes of
    fracture.
    """
    mesh = regular(SIDE, SIDE, 6, 6, 9)
    deck = Deck("impact to be broken off", end)
    deck.add("CONTROL_LAYERWISE", (int(not linear), 0.05, implicit))
    deck.add("DAMPING_GLOBAL", (0, 100.0))
    deck.mesh(mesh)
    if fracture:
        cracked_ply(deck)
        weak_laminate(deck)
    elif failing:
        weak_plies(deck, radii, closing=closing)
    else:
        deck.laminate([Ply(CARBON, PLY, angle) for angle in ANGLES], order)
    if joint == "springs":
        deck.interfaces(1.0e5, 5.0e4)
    if joint == "cohesive":
        deck.cohesive(Bond((1.0e5, 5.0e4), (10.0, 15.0), (0.05, 0.1), 1.0, friction=0.3))
    deck.hold(mesh.boundary(), "z")
    centre = (0.5 * SIDE, 0.5 * SIDE, RADIUS + 1.5 * PLY + 0.01)
    deck.sphere(Sphere(RADIUS, 5.0e-6, centre, (1.0e2, 0.0, -8.0e3), method=method))
    outputs(deck, [mesh.at(0.5 * SIDE, 0.5 * SIDE)])
    return deck


def averaged() -> Deck:
    """The ball on plies whose damage is driven by averages over neighbours."""
    return impact(1, "springs", failing=True, radii=(4.0, 3.0))


def averaged_parts() -> Deck:
    """The same on two parts side by side, each of whose laws averages other strains."""
    mesh = regular(SIDE, SIDE, 6, 6, 9)
    deck = Deck("two parts to be broken off", END)
    deck.control()
    deck.mesh(mesh, (1, 1, 1, 2, 2, 2))
    weak_ply(deck, (4.0, 3.0))
    onset, finish = (0.004, 0.003, 0.002, 0.0), (0.02, 0.015, 0.01, 0.0)
    deck.add(
        "MAT_CODAM2",
        (2, CARBON.density, CARBON.young[0], CARBON.young[1], 0.0, 0.02, 0.0, 0.4),
        (CARBON.shear[0], 0.0, 0.0, 1, 2.5),
        (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2),
        (0.0, 0.0, 0.0, 0.0, 1.0, 0.0),
        (0.0,),
        (*onset, *finish[:3]),
        (*onset, *finish[:3]),
    )
    for part in (1, 2):
        plies = [(part, PLY, angle, 0, k + 1) for k, angle in enumerate(ANGLES)]
        deck.add("PART_COMPOSITE_LONG", "laminate", (part, 0), *plies)
        deck.add("SECTION_LAYERWISE", (part, 0, 1))
        deck.add("INTERFACE_COHESIVE", (part, 0, 0, 99))
    deck.add("MAT_COHESIVE_ELASTIC", (99, 0.0, 0, 0, 5.0e4, 1.0e5))
    deck.hold(mesh.boundary(), "z")
    centre = (0.5 * SIDE, 0.5 * SIDE, RADIUS + 1.5 * PLY + 0.01)
    deck.sphere(Sphere(RADIUS, 5.0e-6, centre, (1.0e2, 0.0, -8.0e3)))
    outputs(deck, [mesh.at(0.5 * SIDE, 0.5 * SIDE)])
    return deck


def weak_ply(deck: Deck, radii: tuple[float, float] = (0.0, 0.0), *, closing: bool = False) -> None:
    """Material 1, the same ply with damage of fibres and matrix.

    Where cracks close, shear follows a curve and crushed fibres keep a share of their strength.
    """
    head = (1, CARBON.density, *CARBON.young, *CARBON.poisson)
    strength = (600.0, 500.0, 20.0, 80.0, 30.0)
    toughness = (80.0, 80.0, 1.0, 2.0, 0.0, 0.999999)
    shear = (1, 0, 0.05) if closing else (0,)
    choices = (0, 0, 0.0, 0, 0, 1, 0.2, 0) if closing else (0, 0, 0.0, 0, 0, 0, 0.0, 0)
    average = (0.0, *radii)
    deck.add("MAT_PLY_CODAM2", head, CARBON.shear, strength, toughness, shear, choices, average)


def weak_plies(
    deck: Deck, radii: tuple[float, float] = (0.0, 0.0), *, closing: bool = False
) -> None:
    """The same plies, with damage of fibres and matrix."""
    weak_ply(deck, radii, closing=closing)
    weak_laminate(deck)


def cracked_ply(deck: Deck) -> None:
    """Material 1, the same ply with planes of fracture, permanent strain and debris."""
    head = (1, CARBON.density, *CARBON.young, *CARBON.poisson)
    strength, toughness = (600.0, 500.0, 20.0, 80.0, 30.0), (80.0, 80.0, 1.0, 2.0)
    shear, contact = (4, 0, 0, 20.0, 0.05), (0.3, 0.2, 0, 150.0, 0.01, 0.2)
    deck.add("MAT_PLY_FRACTURE_3D", head, CARBON.shear, strength, toughness, shear, contact)


def weak_laminate(deck: Deck) -> None:
    """A part with plies of material 1."""
    plies = [(1, PLY, angle, 0, k + 1) for k, angle in enumerate(ANGLES)]
    deck.add("PART_COMPOSITE_LONG", "laminate", (1, 0), *plies)
    deck.add("SECTION_LAYERWISE", (1, 0, 1))


def yielding(deck: Deck) -> None:
    """A metal that hardens in both ways, and with the rate."""
    deck.add("MAT_PLASTIC_KINEMATIC", (1, 7.8e-9, 2.1e5, 0.3, 200.0, 2000.0, 0.5), (40.0, 5.0))


def yielding_by_points(deck: Deck) -> None:
    """A metal whose yield stress is given by points, and rises with the rate."""
    head, rate = (1, 7.8e-9, 2.1e5, 0.3, 200.0), (40.0, 5.0, 0, 0, 1)
    points = (0.0, 0.01, 0.1), (200.0, 230.0, 300.0)
    deck.add("MAT_PIECEWISE_LINEAR_PLASTICITY", head, rate, *points)


def yielding_by_power(deck: Deck) -> None:
    """A metal after Johnson and Cook."""
    head, power = (1, 7.8e-9, 2.1e5, 0.3, 1), (200.0, 500.0, 0.3, 0.02, 0.0, 0.0, 0.0, 1.0)
    deck.add("MAT_SIMPLIFIED_JOHNSON_COOK", head, power)


def metal(law: Callable[[Deck], None] = yielding) -> Deck:
    """A plate of metal that is struck so hard that it yields, and whose edge is pulled."""
    mesh = regular(SIDE, SIDE, 4, 4, 4)
    deck = Deck("metal to be broken off", END)
    deck.control()
    deck.mesh(mesh)
    law(deck)
    deck.add("PART_COMPOSITE_LONG", "metal", (1, 0), (1, 1.0, 0.0, 0, 1))
    deck.add("SECTION_LAYERWISE", (1, 0, 2))
    deck.hold(mesh.where(x=0.0), "xyz")
    deck.move(mesh.where(x=SIDE), 1, deck.curve(ramp(END)), 0.1)
    deck.add("LOAD_FACE_PRESSURE", (0, 1, deck.curve(ramp(0.5 * END)), 5.0))
    deck.sphere(Sphere(RADIUS, 5.0e-6, (10.0, 10.0, RADIUS + 0.51), (0.0, 0.0, -2.0e4)))
    outputs(deck, [mesh.at(10.0, 10.0)])
    return deck


def bricks(points: int, *, failing: bool = False) -> Deck:
    """A ball on bricks of a metal that yields, of 8 points, or of one with viscous control.

    Or on bricks of plies that crack, with fibres in two directions.
    """
    mesh = box((SIDE, SIDE, 2.0), (8, 8, 2))
    deck = Deck("bricks to be broken off", END)
    deck.control()
    control = (3, 0.1) if points == 1 else None
    if failing:
        add_bricks(deck, mesh, weak_ply, points=points, hourglass=control, angles=(0.0, 90.0))
    else:
        add_bricks(deck, mesh, yielding, points=points, hourglass=control)
    deck.hold(np.flatnonzero(np.abs(mesh.points[:, 0]) < TINY), "xyz")
    deck.sphere(Sphere(RADIUS, 5.0e-6, (10.0, 10.0, RADIUS + 2.01), (0.0, 0.0, -2.0e4)))
    deck.intervals(impactor=0.0, glstat=0.7e-6, spcforc=0.9e-6, binary_d3plot=3.7e-6)
    return deck


def crack_lines() -> Deck:
    """A ball on plies that crack along lines between interfaces that fail, within a frame.

    Below it they lie on a rough punch.
    """
    cells = 8
    mesh = regular(SIDE, SIDE, cells, cells, 4)
    deck = Deck("cracks to be broken off", END)
    deck.control()
    middle = np.abs(mesh.points[mesh.quads].mean(axis=1) / SIDE - 0.5).max(axis=1)
    deck.mesh(mesh, [2 if away < 0.5 - 1.0 / cells else 1 for away in middle])
    weak_ply(deck)
    for part in (1, 2):
        plies = [(1, PLY, angle, 0, k + 1) for k, angle in enumerate((0.0, 45.0, 90.0, -45.0))]
        deck.add("PART_COMPOSITE_LONG", "laminate", (part, 0), *plies)
        deck.add("SECTION_LAYERWISE", (part, 0, 1))
    bond = Bond((1.0e5, 5.0e4), (10.0, 15.0), (0.05, 0.1), 1.0, friction=0.3)
    deck.cohesive(bond, nodal=True, parts=(1, 2))
    deck.add("CRACK_LINES", (2, 2.5, 0.05, 0.3))
    deck.hold(mesh.boundary(), "z")
    centre = (0.5 * SIDE, 0.5 * SIDE, RADIUS + 2.0 * PLY + 0.01)
    deck.sphere(Sphere(RADIUS, 5.0e-6, centre, (1.0e2, 0.0, -8.0e3), part=0))
    below = (2, 0.5 * SIDE, 0.5 * SIDE, 0.0, 0.0, 0.3 * SIDE)
    deck.add("FIXTURE_PUNCH", (7, BOTTOM, 0.0, 0.5, 0.4, 0.2, 1.0e-3), below)
    deck.histories([mesh.at(0.5 * SIDE, 0.5 * SIDE)], 1.1e-6)
    deck.profile(1, 1.0, 1.0, 4.3e-6)
    deck.intervals(impactor=0.0, glstat=0.7e-6, spcforc=0.9e-6, binary_d3plot=3.7e-6)
    return deck


#: Every kind of model that a run may be broken off with
KINDS: dict[str, Callable[[], Deck]] = {
    "nodes on sphere": lambda: impact(1),
    "implicit springs": lambda: impact(1, "springs", implicit=1),
    "implicit thickness": lambda: impact(2, "springs", implicit=2),
    "failing interfaces": lambda: impact(1, "cohesive"),
    "failing plies": lambda: impact(1, "springs", failing=True),
    "planes of fracture": lambda: impact(1, "springs", fracture=True),
    "averages over neighbours": averaged,
    "metal": metal,
    "bricks of one point": lambda: bricks(1),
    "bricks of eight points": lambda: bricks(8),
    "crack lines": crack_lines,
    "bricks that crack": lambda: bricks(1, failing=True),
}


def unlike(whole: Path, broken: Path) -> list[str]:
    """Files of two folders that differ: tables in any byte, fields in any value."""
    names = sorted(path.name for path in whole.glob("*.csv"))
    assert names == sorted(path.name for path in broken.glob("*.csv"))
    assert names
    wrong = [name for name in names if (whole / name).read_bytes() != (broken / name).read_bytes()]
    for path in sorted(whole.glob("*.vtkhdf")):
        with h5py.File(path) as one, h5py.File(broken / path.name) as other:
            wrong += [f"{path.name}/{name}" for name in _unlike_datasets(one, other)]
    return wrong


def _unlike_datasets(one: h5py.File, other: h5py.File) -> list[str]:
    """Datasets of two files that differ."""
    datasets: dict[str, np.ndarray] = {}

    def take(name: str, item: object) -> None:
        if isinstance(item, h5py.Dataset):
            datasets[name] = item[()]

    one.visititems(take)
    found = [name for name, value in datasets.items() if not _same(value, other[name][()])]
    if one["VTKHDF/Steps"].attrs["NSteps"] != other["VTKHDF/Steps"].attrs["NSteps"]:
        found.append("NSteps")
    return found


def _same(one: np.ndarray, other: np.ndarray) -> bool:
    """Same shape and values; what is not a number is the same as itself."""
    return one.shape == other.shape and np.array_equal(one, other, equal_nan=True)
