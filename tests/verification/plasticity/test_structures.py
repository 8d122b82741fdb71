"""Structures of metal that flow as a whole: a thick cylinder, and a disc on its rim.

In a long cylinder that its inner wall opens, metal without change of volume shears by
(2/sqrt 3) u a / r^2, u being the displacement of the inner wall a, so that the pressure is the
integral of (2/sqrt 3) yield(strain) / r over the wall (Hill, The Mathematical Theory of Plasticity,
1950, chapter V); with a constant yield stress (2/sqrt 3) yield ln(b/a).
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from comparison import Comparison
from decks import PLANE, Deck, ramp
from elasticity import Array
from meshes import Mesh, disc, regular
from runs import Results, run

YOUNG, POISSON, DENSITY, YIELD = 210.0e3, 0.3, 7.8e-9, 210.0
SHEAR = YOUNG / (2.0 * (1.0 + POISSON))
INNER, OUTER, HEIGHT = 10.0, 20.0, 1.0
OUTER_RADIUS = 50.0
# Strain over which both metals harden
STRAINS = np.array([0.0, 0.02, 0.2])
STRESSES = np.array([210.0, 300.0, 420.0])


def perfect(deck: Deck) -> None:
    """No hardening."""
    deck.add("MAT_PIECEWISE_LINEAR_PLASTICITY", (1, DENSITY, YOUNG, POISSON, YIELD))


def by_curve(deck: Deck) -> None:
    """Hardening by a curve."""
    deck.add("DEFINE_CURVE", (900,), *zip(STRAINS, STRESSES, strict=True))
    first = (1, DENSITY, YOUNG, POISSON)
    deck.add("MAT_PIECEWISE_LINEAR_PLASTICITY", first, (0.0, 0.0, 900))


def johnson_cook(deck: Deck) -> None:
    """Hardening by a power."""
    deck.add("MAT_SIMPLIFIED_JOHNSON_COOK", (1, DENSITY, YOUNG, POISSON), (YIELD, 400.0, 0.5, 0.0))


def quarter(rings: int, sectors: int) -> Mesh:
    """A quarter of a ring; the sides of the quads grow with the radius."""
    mesh = regular(1.0, 1.0, rings, sectors, 9)
    radius = INNER * (OUTER / INNER) ** mesh.points[:, 0]
    angle = 0.5 * np.pi * mesh.points[:, 1]
    return Mesh(np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1), mesh.quads)


def pressure(opening: float, yield_stress: Callable[[float], float]) -> float:
    """Pressure of the inner wall; strain less its elastic part is plastic."""

    def shear_stress(radius: float) -> float:
        strain = 2.0 / np.sqrt(3.0) * opening * INNER / radius**2

        def excess(flow: float) -> float:
            return 3.0 * SHEAR * (strain - flow) - yield_stress(flow)

        return yield_stress(brentq(excess, 0.0, strain)) / radius

    return 2.0 / np.sqrt(3.0) * quad(shear_stress, INNER, OUTER)[0]


def work_rate(results: Results, opened: Array, from_share: float) -> float:
    """Work of the loads over opening, as the slope over the last part of a run."""
    energy = results.table("energy")
    used = energy["time"] > from_share * energy["time"][-1]
    way = np.interp(energy["time"], *opened)
    return float(np.polyfit(way[used] - way[used].mean(), energy["external"][used], 2)[1])


def steady(until: float) -> list[tuple[float, float]]:
    """A motion that starts softly and then goes on at one velocity, 1 at the end."""
    times = np.linspace(0.0, 1.0, 41)
    way = np.where(times < 0.25, 2.0 * times**2, times - 0.125) / 0.875
    return list(zip((until * times).tolist(), way.tolist(), strict=True))


@pytest.mark.parametrize(
    ("material", "yield_stress"),
    [
        (perfect, lambda flow: YIELD),
        (by_curve, lambda flow: float(np.interp(flow, STRAINS, STRESSES))),
        (johnson_cook, lambda flow: YIELD + 400.0 * np.sqrt(max(flow, 0.0))),
    ],
)
def test_thick_cylinder(
    material: Callable[[Deck], None],
    yield_stress: Callable[[float], float],
    compare: Comparison,
    tmp_path: Path,
) -> None:
    """The pressure that opens a cylinder by 3 % of its inner radius."""
    mesh, opening, end = quarter(6, 4), 0.3, 6.0e-4
    radius = np.hypot(*mesh.points.T)
    deck = Deck("thick cylinder", end)
    deck.control(linear=True, damping=2.0e4)
    material(deck)
    deck.mesh(mesh)
    deck.add("PART_COMPOSITE_LONG", "ring", (1, 0), (1, HEIGHT, 0.0, 0, 1))
    deck.add("SECTION_LAYERWISE", (1, 0, 1))
    deck.hold(range(len(mesh.points)), "z")
    inner = np.flatnonzero(radius < INNER * (1.0 + 1e-9))
    points = steady(end)
    curve = deck.curve(points)
    for direction in range(2):
        deck.hold(np.flatnonzero(mesh.points[:, direction] < 1e-9), "xy"[direction])
        for node in inner:
            if mesh.points[node, direction] > 1e-9:
                scale = opening * mesh.points[node, direction] / INNER
                deck.move([node], direction + 1, curve, scale)
    deck.intervals(glstat=end / 200, binary_d3plot=end)
    results = run(deck, tmp_path)
    opened = (np.array([t for t, _ in points]), opening * np.array([w for _, w in points]))
    middle = opening * (np.interp(0.8 * end, opened[0], opened[1]) / opening)
    area = 0.5 * np.pi * INNER * HEIGHT
    # elastic volume, 0.1 % of 3 %, inertia and the mesh
    found, hill = work_rate(results, opened, 0.6) / area, pressure(middle, yield_stress)
    compare.number("pressure of a thick cylinder", found, hill, unit="MPa", rel=0.01)


def test_plate_collapses(compare: Comparison, tmp_path: Path) -> None:
    """A disc on a rim flows under 6.51 M / R^2, M = yield h^2 / 4 (Hopkins and Wang, 1954)."""
    thickness, end = 4.0, 2.0e-3
    collapse = 6.51 * YIELD * thickness**2 / 4.0 / OUTER_RADIUS**2
    mesh = disc(3, 3, OUTER_RADIUS, 30.0)
    deck = Deck("disc that flows", end)
    deck.control(linear=True, damping=4.5e3)
    perfect(deck)
    deck.mesh(mesh)
    deck.add("PART_COMPOSITE_LONG", "disc", (1, 0), (1, thickness, 0.0, 0, 1))
    deck.add("SECTION_LAYERWISE", (1, 0, 2), (1, 1, 2, 3))
    rim = np.flatnonzero(np.hypot(*mesh.points.T) > OUTER_RADIUS - 1e-6)
    deck.hold_face(rim, PLANE, "z")
    middle = mesh.at(0.0, 0.0)
    deck.hold([middle], "xy")
    deck.hold_face(mesh.where(y=0.0), PLANE, "y")
    pressure = 1.2 * collapse
    deck.add("LOAD_FACE_PRESSURE", (0, 1, deck.curve(ramp(0.3 * end)), pressure))
    deck.intervals(glstat=end / 100, binary_d3plot=end)
    energy = run(deck, tmp_path).table("energy")
    flows = energy["time"] > 0.7 * end
    assert np.ptp(energy["kinetic"][flows]) < 0.1 * energy["kinetic"][-1]
    share = np.polyfit(energy["external"][flows], energy["dissipated"][flows], 1)[0]
    # damping carries what is more than the collapse load
    compare.number("collapse of a disc", share * pressure, collapse, unit="MPa", rel=0.03)
