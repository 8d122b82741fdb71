"""Large displacements: the total Lagrangian form against closed forms."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, Deck, Ply, ramp
from elastica import tip
from elasticity import isotropic
from meshes import distorted, regular
from runs import DIGITS, Results, run


@pytest.mark.parametrize(
    ("load", "across", "shortening"),
    [(1.0, 0.30172, 0.05643), (2.0, 0.49346, 0.16064), (10.0, 0.81061, 0.55500)],
)
def test_elastica_is_as_printed(
    load: float, across: float, shortening: float, compare: Comparison
) -> None:
    """Mattiasson 1981, five digits."""
    along, deflection = tip(load)
    compare.number("shortening of the elastica itself", 1.0 - along, shortening, abs=0.6e-5)
    compare.number("deflection of the elastica itself", deflection, across, abs=0.6e-5)


YOUNG, POISSON, SIZE = 1.0e3, 0.3, (3.0, 2.0, 1.0)


def stretched(nodes: int, order: int, stretch: float, share: float, folder: Path) -> Results:
    """A block pulled along x to a stretch, and brought to rest."""
    length, width, thickness = SIZE
    density = 1.0e-9
    rate = 0.5 * np.pi * np.sqrt(YOUNG / density) / length
    rise = 4.0 * np.pi / rate
    time = rise + 40.0 / rate
    mesh = distorted(regular(length, width, 3, 2, nodes), 0.08)
    deck = Deck("large stretch", time)
    deck.control(damping=2.0 * rate, share=share)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(density, YOUNG, POISSON), thickness)], order)
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(mesh.where(y=0.0), "y")
    deck.hold_face(range(len(mesh.points)), BOTTOM, "z")
    deck.move(mesh.where(x=length), 1, deck.curve(ramp(rise)), (stretch - 1.0) * length)
    deck.profile(1, 1.3, 0.9, time)
    deck.intervals(glstat=time)
    return run(deck, folder)


@pytest.mark.parametrize("stretch", [1.4, 0.8])
@pytest.mark.parametrize(("nodes", "order"), [(4, 1), (9, 1), (9, 2), (9, 3), (9, 4)])
def test_large_stretch(
    nodes: int, order: int, stretch: float, compare: Comparison, tmp_path: Path
) -> None:
    """Saint Venant-Kirchhoff in tension along x: S = E (l^2 - 1) / 2, Cauchy stress l S / across^2.

    The deformation is homogeneous and so in the space of any mesh: the digits of the file are left.
    The internal energy is work summed by the trapezoidal rule, whose error falls with the square of
    the step; what two runs give for no step at all is the energy of the strain.
    """
    results = stretched(nodes, order, stretch, 0.8, tmp_path / "whole")
    strain = 0.5 * (stretch**2 - 1.0)
    second = YOUNG * strain
    across = np.sqrt(1.0 - 2.0 * POISSON * strain)
    exact = {
        "exx": strain,
        "eyy": -POISSON * strain,
        "ezz": -POISSON * strain,
        "sxx": stretch * second / across**2,
        "s11": second,
    }
    profile = results.profile(1)
    for name, value in exact.items():
        compare.values(f"{name} of a block", profile[name], value, rel=DIGITS)
    moved = (across - 1.0) * (profile["z"] + 0.5 * SIZE[2])
    assert profile["uz"] == pytest.approx(moved, rel=DIGITS, abs=1e-12)

    halved = stretched(nodes, order, stretch, 0.4, tmp_path / "halved")
    whole, half = (each.table("energy")["internal"][-1] for each in (results, halved))
    energy = 0.5 * second * strain * np.prod(SIZE)
    assert (half - energy) / (whole - energy) == pytest.approx(0.25, rel=0.02)
    limit = (4.0 * half - whole) / 3.0
    compare.number("energy for no step at all", limit, energy, unit="mJ", rel=1e-6)


@pytest.mark.parametrize(("order", "load"), [(1, 2.0), (1, 10.0), (2, 10.0)])
def test_cantilever_bends_as_the_elastica(
    order: int, load: float, compare: Comparison, tmp_path: Path
) -> None:
    """A strip without Poisson's ratio under a dead force at its tip.

    Shear and stretch, which the elastica leaves out, are of the order (h / L)^2 = 4e-4.
    """
    young, density, length, width, thickness = 1.0e5, 1.0e-9, 50.0, 5.0, 1.0
    bending = young * width * thickness**3 / 12.0
    rate = 3.516 * np.sqrt(bending / (density * width * thickness)) / length**2
    rise = 6.0 / rate
    time = rise + 14.0 / rate
    mesh = regular(length, width, 20, 1, 9)
    deck = Deck("elastica", time)
    deck.control(damping=2.0 * rate)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(density, young, 0.0), thickness)], order)
    deck.hold(mesh.where(x=0.0), "xyz")
    curve = deck.curve(ramp(rise))
    force = load * bending / length**2
    end = sorted(mesh.where(x=length), key=lambda node: mesh.points[node, 1])
    cards = [
        (node + 1, 3, curve, force * share / 6.0)
        for node, share in zip(end, (1.0, 4.0, 1.0), strict=True)
    ]
    deck.add("LOAD_NODE_POINT", *cards)
    deck.histories([end[1]], time / 100.0)
    deck.intervals(glstat=time / 100.0)
    table = run(deck, tmp_path).table("nodes")
    faces = [f"n{end[1] + 1} {face}" for face in ("bottom", "top")]
    along = length + np.mean([table[f"{face} ux"][-1] for face in faces])
    across = np.mean([table[f"{face} uz"][-1] for face in faces])
    exact = tip(load)
    compare.number("tip of a cantilever, along", along / length, exact[0], abs=1.5e-3)
    compare.number("tip of a cantilever, across", across / length, exact[1], abs=1.5e-3)
