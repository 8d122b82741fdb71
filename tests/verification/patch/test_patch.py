"""Patch tests: a linear displacement field gives the exact uniform strain on any mesh.

The boundary is moved and held; strong damping brings the inside to rest. What remains of the
motion after the time of the run is below exp(-25) of its start, and the fields of the exact
solution are in the space of every order: the tolerance is that of relaxation and round-off.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, TOP, Deck, Ply, ramp
from elasticity import CARBON, GLASS, Array, stiffness
from meshes import Mesh, distorted, regular
from runs import Results, Table, run

TOLERANCE = 1.0e-6

ONE_MATERIAL = [Ply(CARBON, 0.5, 30.0)] * 3
MANY_MATERIALS = [Ply(CARBON, 0.4, 0.0), Ply(GLASS, 0.6, 40.0), Ply(CARBON, 0.5, 90.0)]
LAMINATES = {"one material": ONE_MATERIAL, "many materials": MANY_MATERIALS}
JOINTS = ["tied", "springs", "apart"]
SPRINGS = (8.0e4, 5.0e4)  # normal, shear
ORDERS = [1, 2, 3, 4]
PLACES = [(1.3, 0.9), (4.1, 3.7)]

STRESS = ("sxx", "syy", "szz", "sxy", "sxz", "syz")
STRAIN = ("exx", "eyy", "ezz", "gxy", "gxz", "gyz")


def patch(nodes: int) -> Mesh:
    """Nine quads, distorted by as much as they bear with a positive mass at every node."""
    return distorted(regular(6.0, 5.0, 3, 3, nodes), 0.4 if nodes == 4 else 0.12)


def start(plies: list[Ply], order: int, joint: str, mesh: Mesh, time: float, rate: float) -> Deck:
    """A damped deck with its laminate, ready for supports."""
    deck = Deck("patch test", time)
    deck.intervals(glstat=time)
    deck.control(linear=True, damping=2.0 * rate)
    deck.mesh(mesh)
    deck.laminate(plies, order)
    if joint == "springs":
        deck.interfaces(*SPRINGS)
    elif joint == "apart":
        deck.interfaces()
    for k, (x, y) in enumerate(PLACES):
        deck.profile(k + 1, x, y, time)
    return deck


def check_profiles(
    compare: Comparison, results: Results, strains: list[Array], plies: list[Ply]
) -> None:
    """Strain and stress of every ply at every place."""
    exact = [stiffness(p.material, p.angle) @ e for p, e in zip(plies, strains, strict=True)]
    for k in range(len(PLACES)):
        profile = results.profile(k + 1)
        check_columns(compare, "strain of the plies", profile, STRAIN, strains)
        check_columns(compare, "stress of the plies", profile, STRESS, exact)


def check_columns(
    compare: Comparison, what: str, profile: Table, names: tuple[str, ...], exact: list[Array]
) -> None:
    """Six columns against the values of each ply, relative to the largest of all."""
    found = np.stack([profile[name] for name in names], axis=1)
    wanted = np.array([exact[int(ply) - 1] for ply in profile["ply"]])
    assert set(profile["ply"]) == set(range(1, len(exact) + 1))
    compare.values(what, found, wanted, abs=TOLERANCE * np.abs(wanted).max())


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("nodes", [4, 9])
@pytest.mark.parametrize("joint", JOINTS)
@pytest.mark.parametrize("laminate", LAMINATES)
def test_stretch_in_the_plane(
    laminate: str, joint: str, nodes: int, order: int, compare: Comparison, tmp_path: Path
) -> None:
    """Edges moved linearly in the plane, faces free: no stress along z in any ply."""
    plies, mesh, rate = LAMINATES[laminate], patch(nodes), 4.0e5
    deck = start(plies, order, joint, mesh, 8.0e-5, rate)
    curve = deck.curve(ramp(1.0e-5))
    gradient = np.array([[1.0e-3, 2.0e-4], [6.0e-4, -5.0e-4]])
    for node in mesh.boundary():
        for k, value in enumerate(gradient @ mesh.points[node]):
            if value != 0.0:
                deck.move([node], k + 1, curve, value)
            else:
                deck.hold([node], "xyz"[k])
    plane = [gradient[0, 0], gradient[1, 1], gradient[0, 1] + gradient[1, 0]]
    strains = []
    for ply in plies:
        c = stiffness(ply.material, ply.angle)
        across = -(c[2, [0, 1, 3]] @ plane) / c[2, 2]
        strains.append(np.array([plane[0], plane[1], across, plane[2], 0.0, 0.0]))
    check_profiles(compare, run(deck, tmp_path), strains, plies)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("nodes", [4, 9])
@pytest.mark.parametrize("joint", ["tied", "springs"])
@pytest.mark.parametrize("laminate", LAMINATES)
def test_stretch_through_the_thickness(
    laminate: str, joint: str, nodes: int, order: int, compare: Comparison, tmp_path: Path
) -> None:
    """Faces pulled apart, edges held in the plane: the same stress along z in every ply."""
    plies, mesh, pull = LAMINATES[laminate], patch(nodes), 1.0e-3
    deck = start(plies, order, joint, mesh, 4.0e-5, 1.0e6)
    curve = deck.curve(ramp(5.0e-6))
    every = range(len(mesh.points))
    deck.hold(mesh.boundary(), "xy")
    deck.move_face(every, TOP, 3, curve, pull)
    deck.move_face(every, BOTTOM, 3, curve, -pull)
    moduli = [stiffness(ply.material, ply.angle)[2, 2] for ply in plies]
    compliance = sum(ply.thickness / c for ply, c in zip(plies, moduli, strict=True))
    if joint == "springs":
        compliance += (len(plies) - 1) / SPRINGS[0]
    stress = 2.0 * pull / compliance
    strains = [np.array([0.0, 0.0, stress / c, 0.0, 0.0, 0.0]) for c in moduli]
    check_profiles(compare, run(deck, tmp_path), strains, plies)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("nodes", [4, 9])
@pytest.mark.parametrize("joint", ["tied", "springs"])
@pytest.mark.parametrize("laminate", LAMINATES)
def test_shear_through_the_thickness(
    laminate: str, joint: str, nodes: int, order: int, compare: Comparison, tmp_path: Path
) -> None:
    """Faces slid over each other along x and y: the same traction in every ply."""
    plies, mesh, slide = LAMINATES[laminate], patch(nodes), np.array([8.0e-4, -5.0e-4])
    deck = start(plies, order, joint, mesh, 4.0e-5, 1.0e6)
    curve = deck.curve(ramp(5.0e-6))
    every = range(len(mesh.points))
    deck.hold(mesh.boundary(), "z")
    for k in (0, 1):
        deck.move_face(every, TOP, k + 1, curve, slide[k])
        deck.move_face(every, BOTTOM, k + 1, curve, -slide[k])
    inverses = [np.linalg.inv(stiffness(ply.material, ply.angle)[4:, 4:]) for ply in plies]
    compliance = sum(ply.thickness * s for ply, s in zip(plies, inverses, strict=True))
    if joint == "springs":
        compliance = compliance + (len(plies) - 1) / SPRINGS[1] * np.eye(2)
    traction = np.linalg.solve(compliance, 2.0 * slide)
    strains = [np.array([0.0, 0.0, 0.0, 0.0, *(s @ traction)]) for s in inverses]
    check_profiles(compare, run(deck, tmp_path), strains, plies)
