"""The same problem seen from elsewhere: turned by 30 degrees, or upside down.

Nothing in the answer may know of x, of the top or of the numbers of plies. All kinds of loads, an
oblique impact and every kind of joint take part.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, TOP, Deck, Ply, Sphere, ramp
from elasticity import CARBON, GLASS, Array
from meshes import Mesh, distorted, regular
from runs import Table, run

ANGLE = 30.0
PLIES = [Ply(CARBON, 0.5, 0.0), Ply(GLASS, 0.4, 45.0), Ply(CARBON, 0.3, -30.0)]
HALF = 0.5 * sum(ply.thickness for ply in PLIES)
END, RISE = 1.5e-5, 8.0e-6
RADIUS = 5.0
# digits of the files, and what a thousand steps make of round-off and of the iterated stable step
CLOSE = 2.0e-6


def plate(nodes: int) -> Mesh:
    """A distorted mesh."""
    return distorted(regular(20.0, 16.0, 5, 4, nodes), 0.35 if nodes == 9 else 0.8)


def deck_of(nodes: int, method: int, joint: str, turn: Array, side: int) -> Deck:
    """The problem, with its plane turned and its z along or against ours."""
    mesh = plate(nodes)
    angle = np.degrees(np.arctan2(turn[1, 0], turn[0, 0]))
    deck = Deck("seen from elsewhere", END)
    deck.control(linear=joint == "springs", damping=500.0)
    deck.mesh(Mesh(mesh.points @ turn.T, mesh.quads))
    deck.laminate([Ply(p.material, p.thickness, p.angle + angle) for p in PLIES[::side]])
    if joint != "tied":
        deck.interfaces(*((1.0e5, 4.0e4) if joint == "springs" else ()))
    deck.hold(mesh.where(x=0.0), "xyz")
    load(deck, mesh, turn, side)
    start = np.zeros((len(mesh.points), 3))
    start[:, :2] = turn @ [1000.0, 300.0]
    start[mesh.where(x=0.0)] = 0.0
    deck.velocities(start)
    below = mesh.points[mesh.at(12.0, 8.0)] + [0.2, 0.3]
    centre, velocity = turn @ below, turn @ [2000.0, -500.0]
    height = side * (HALF + RADIUS + 1.0e-3)
    motion = (velocity[0], velocity[1], -8000.0 * side)
    face = TOP if side > 0 else BOTTOM
    deck.sphere(Sphere(RADIUS, 2.0e-6, (*centre, height), motion, method=method, face=face))
    deck.histories([mesh.at(12.0, 8.0), mesh.at(20.0, 16.0)], 1.0e-7)
    deck.intervals(spcforc=1.0e-7, glstat=1.0e-7, impactor=1.0e-7, binary_d3plot=END)
    return deck


def load(deck: Deck, mesh: Mesh, turn: Array, side: int) -> None:
    """Forces at a corner, a pressure and a line load."""
    top, bottom = (TOP, BOTTOM) if side > 0 else (BOTTOM, TOP)
    curve, corner = deck.curve(ramp(RISE)), mesh.at(20.0, 16.0) + 1
    along, across = turn @ [30.0, 50.0]
    forces = [(top, 1, along), (top, 2, across), (bottom, 3, -20.0 * side)]
    deck.add(
        "LOAD_FACE_POINT",
        *[(corner, face, direction, curve, force) for face, direction, force in forces],
    )
    deck.add("LOAD_FACE_PRESSURE", (0, bottom, curve, 3.0))
    edge = deck.node_set(mesh.where(y=0.0))
    deck.add("LOAD_FACE_LINE", (edge, top, 3, curve, -2.0 * side))


def as_seen(table: Table, turn: Array, side: int) -> Array:
    """Values of a table in the axes and faces of the first problem."""
    names = table.names
    flipped = {"bottom": "top", "top": "bottom"}
    source = list(names)
    if side < 0:
        source = [" ".join(flipped.get(word, word) for word in name.split()) for name in names]
    values = np.stack([table[name] for name in source], axis=1)
    for column, name in enumerate(names):
        if name.endswith("x") and name[:-1] + "y" in names:
            pair = [column, names.index(name[:-1] + "y")]
            values[:, pair] = values[:, pair] @ turn
        along_z = name.endswith("z") or name in ("force", "displacement", "velocity")
        if along_z and side < 0:
            values[:, column] *= -1.0
    return values


def check_same(compare: Comparison, what: str, first: Table, other: Array) -> None:
    """Every column agrees with the largest of its kind in mind."""
    for column, name in enumerate(first.names):
        if name in (
            "step",
            "error",
            "stored error",
            "contacts",
            "half-step correction",
            "penetration",
        ):
            continue
        kind = name[-2:-1] if name[-1] in "xyz" else name
        alike = [c for c, n in enumerate(first.names) if n == name or n[-2:-1] == kind]
        scale = np.abs(first.values[:, alike]).max()
        difference = np.abs(first.values[:, column] - other[:, column]).max() / (scale or 1.0)
        compare.number(f"difference of histories of {what}", difference, 0.0, abs=CLOSE)


@pytest.mark.parametrize("joint", ["tied", "apart", "springs"])
@pytest.mark.parametrize("method", [1, 2])
@pytest.mark.parametrize("nodes", [4, 9])
def test_same_answer(
    nodes: int, method: int, joint: str, compare: Comparison, tmp_path: Path
) -> None:
    """Histories of the plate, the impactor, the supports and the energies."""
    c, s = np.cos(np.radians(ANGLE)), np.sin(np.radians(ANGLE))
    straight, turn = np.eye(2), np.array([[c, -s], [s, c]])
    first = run(deck_of(nodes, method, joint, straight, 1), tmp_path, "first")
    assert first.table("impactor_1")["contacts"].max() > 0
    for job, axes, side in (("turned", turn, 1), ("mirrored", straight, -1)):
        other = run(deck_of(nodes, method, joint, axes, side), tmp_path, job)
        for name in ("nodes", "supports", "impactor_1", "energy"):
            check_same(compare, name, first.table(name), as_seen(other.table(name), axes, side))
