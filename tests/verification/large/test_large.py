"""Large displacements: the total Lagrangian form against closed forms."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from decks import BOTTOM, Deck, Ply, ramp
from elastica import tip
from elasticity import isotropic
from meshes import distorted, regular
from runs import run


@pytest.mark.parametrize(
    ("load", "across", "shortening"),
    [(1.0, 0.30172, 0.05643), (2.0, 0.49346, 0.16064), (10.0, 0.81061, 0.55500)],
)
def test_elastica_is_as_printed(load: float, across: float, shortening: float) -> None:
    """Mattiasson 1981, five digits."""
    along, deflection = tip(load)
    assert (1.0 - along, deflection) == pytest.approx((shortening, across), abs=0.6e-5)


@pytest.mark.parametrize("stretch", [1.4, 0.8])
@pytest.mark.parametrize(("nodes", "order"), [(4, 1), (9, 1), (9, 2), (9, 3), (9, 4)])
def test_large_stretch(nodes: int, order: int, stretch: float, tmp_path: Path) -> None:
    """Saint Venant-Kirchhoff in tension along x: S = E (l^2 - 1) / 2, force l S A.

    The deformation is homogeneous and so in the space of any mesh: relaxation and round-off only.
    """
    young, poisson, length, width, thickness = 1.0e3, 0.3, 3.0, 2.0, 1.0
    speed = np.sqrt(young / 1.0e-9)
    rate = 0.5 * np.pi * speed / length
    rise = 4.0 * np.pi / rate
    time = rise + 40.0 / rate
    mesh = distorted(regular(length, width, 3, 2, nodes), 0.08)
    deck = Deck("large stretch", time)
    deck.control(damping=2.0 * rate)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(1.0e-9, young, poisson), thickness)], order)
    curve = deck.curve(ramp(rise))
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(mesh.where(y=0.0), "y")
    deck.hold_face(range(len(mesh.points)), BOTTOM, "z")
    deck.move(mesh.where(x=length), 1, curve, (stretch - 1.0) * length)
    deck.histories([mesh.at(length, width)], time / 50.0)
    deck.intervals(glstat=time / 50.0, spcforc=time / 50.0)
    results = run(deck, tmp_path)

    strain = 0.5 * (stretch**2 - 1.0)
    across = np.sqrt(1.0 - 2.0 * poisson * strain) - 1.0
    table, node = results.table("nodes"), mesh.at(length, width) + 1
    assert table[f"n{node} top uy"][-1] == pytest.approx(across * width, rel=1e-7)
    assert table[f"n{node} top uz"][-1] == pytest.approx(across * thickness, rel=1e-7)
    energy = results.table("energy")["internal"][-1]
    volume = length * width * thickness
    assert energy == pytest.approx(0.5 * young * strain**2 * volume, rel=1e-7)


@pytest.mark.parametrize("load", [2.0, 10.0])
@pytest.mark.parametrize("order", [1, 2])
def test_cantilever_bends_as_the_elastica(order: int, load: float, tmp_path: Path) -> None:
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
    assert (along / length, across / length) == pytest.approx(tip(load), abs=1.5e-3)
