"""The same impact in other units: powers of two scale every number of a run without rounding.

What a program keeps for itself, as a tolerance in millimetres or a smallest stress, would show.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

from comparison import Comparison
from damage import HTS40, DamagedPly
from decks import BOTTOM, Bond, Deck, Ply, Sphere
from elasticity import Array
from meshes import regular
from runs import DIGITS, run_once

END, STATES = 6.0e-5, 50


@dataclass(frozen=True)
class Units:
    """How many of the new units are in a millimetre, a second and a tonne."""

    length: float = 1.0
    time: float = 1.0
    mass: float = 1.0

    @property
    def stress(self) -> float:
        """Of a megapascal."""
        return self.mass / (self.length * self.time**2)

    @property
    def toughness(self) -> float:
        """Of a newton per millimetre."""
        return self.mass / self.time**2

    @property
    def speed(self) -> float:
        """Of a millimetre per second."""
        return self.length / self.time

    @property
    def force(self) -> float:
        """Of a newton."""
        return self.mass * self.length / self.time**2


PLAIN = Units()
# About metres and milliseconds; micrometres and microseconds; numbers far from one
OTHERS = {
    "large": Units(2.0**-10, 2.0**10, 2.0**12),
    "small": Units(2.0**10, 2.0**20, 2.0**40),
    "far from one": Units(2.0**-20, 2.0**-20, 2.0**-30),
}


def damaged(deck: Deck, units: Units) -> None:
    """Three plies of *MAT_PLY_CODAM2, whose shear follows a curve."""
    deck.laminate([Ply(scaled(units), 0.5 * units.length, angle) for angle in (0.0, 45.0, 90.0)], 1)


def scaled(units: Units) -> DamagedPly:
    """The ply in other units."""

    def times(factor: float, *values: float) -> tuple[float, ...]:
        return tuple(factor * value for value in values)

    ply, stress, toughness = HTS40, units.stress, units.toughness
    fields = {
        "density": ply.density * units.mass / units.length**3,
        "young": times(stress, *ply.young),
        "shear": times(stress, *ply.shear),
        "fibre_strength": times(stress, *ply.fibre_strength),
        "matrix_strength": times(stress, *ply.matrix_strength),
        "shear_strength": stress * ply.shear_strength,
        "cross_strength": 0.0,
        "fibre_toughness": times(toughness, *ply.fibre_toughness),
        "matrix_toughness": times(toughness, *ply.matrix_toughness),
    }
    return replace(ply, largest=0.999, curve=(1, 0, 0.05), **fields)


def fractured(deck: Deck, units: Units) -> None:
    """The same of *MAT_PLY_FRACTURE_3D, which can be crushed."""
    stress, density = units.stress, 1.58e-9 * units.mass / units.length**3
    moduli = stress * np.array([171.42e3, 9.08e3, 9.08e3, 5.29e3, 5.29e3, 3.131e3])
    cards = [
        (1, density, *moduli[:3], 0.32, 0.32, 0.45),
        tuple(moduli[3:]),
        tuple(stress * np.array([2326.2, 1200.1, 62.3, 199.8, 92.3])),
        (*(units.toughness * np.array([97.8, 106.3, 0.277, 0.788])), 0, 0.999),
        (4, 0, 0, 66.9 * stress, 0.05),
        (0.3, 0.1, 0, 400.0 * stress),
    ]
    stack(deck, units, "MAT_PLY_FRACTURE_3D", cards)


def metallic(deck: Deck, units: Units) -> None:
    """Three layers of a metal that hardens, more so at high rates."""
    stress, density = units.stress, 7.8e-9 * units.mass / units.length**3
    first = (1, density, 210.0e3 * stress, 0.3, 250.0 * stress, 2.0e3 * stress, 0.5)
    stack(deck, units, "MAT_PLASTIC_KINEMATIC", [first, (40.0 / units.time, 5.0)])


def stack(deck: Deck, units: Units, keyword: str, cards: list[tuple[float, ...]]) -> None:
    """Layers of a material that the deck writer does not know."""
    deck.add(keyword, *cards)
    angles = enumerate((0.0, 45.0, 90.0), start=1)
    plies = [(1, 0.5 * units.length, angle, 0, k) for k, angle in angles]
    deck.add("PART_COMPOSITE_LONG", "laminate", (1, 0), *plies)
    deck.add("SECTION_LAYERWISE", (1, 0, 1))


LAWS = {"damaged": damaged, "fractured": fractured, "metallic": metallic}
ENERGIES = ("kinetic", "internal", "stored", "dissipated", "contact", "contact friction")


def struck(law: str, units: Units) -> tuple[Array, Array, Array]:
    """Energies, motion and force of the ball over time, in the plain units."""
    length, force = units.length, units.force
    deck = Deck("an impact in some units", END * units.time)
    deck.control(share=0.7)
    mesh = regular(20.0 * length, 16.0 * length, 5, 4, 9)
    deck.mesh(mesh)
    LAWS[law](deck, units)
    stiff, tough = units.stress / length, units.toughness
    bond = Bond(
        (1.0e5 * stiff, 5.0e4 * stiff),
        (50.0 * units.stress, 80.0 * units.stress),
        (0.25 * tough, 0.7 * tough),
        -1.5,
    )
    deck.cohesive(replace(bond, friction=0.3, by_work=law == "fractured", pressure_gain=0.3))
    ball = Sphere(
        3.0 * length,
        4.0e-6 * units.mass,
        (9.2 * length, 7.7 * length, 3.76 * length),
        (800.0 * units.speed, 0.0, -6000.0 * units.speed),
        gravity=-9810.0 * units.speed / units.time,
        method=1,
        friction=(0.3, 0.2, 1.0e-4 / units.speed),
    )
    deck.sphere(ball)
    window = (1, *(length * np.array([10.0, 8.0, 14.0, 10.0, 1.0])))
    deck.add("FIXTURE_PLANE", (1, BOTTOM, 0.0, 0.5 * length, 0.3), window)
    tip = tuple(length * np.array([2.0, 2.0, 0.0, 1.8]))
    deck.add("FIXTURE_CLAMP", (2, 1, 20.0 * force, 0, 0.0, 0.2), tip)
    interval = END * units.time / STATES
    deck.intervals(glstat=interval, impactor=interval)
    results = run_once(deck)
    table, flight = results.table("energy"), results.table("impactor_1")
    energies = np.column_stack([table[name] for name in ENERGIES]) / (force * length)
    motion = np.column_stack([flight["displacement"], flight["displacement x"]]) / length
    return energies, motion, flight["force"] / force


@pytest.mark.parametrize("units", list(OTHERS))
@pytest.mark.parametrize("law", list(LAWS))
def test_units_do_not_matter(law: str, units: str, compare: Comparison) -> None:
    """Plies and interfaces that fail, a ball and fixtures with friction: the digits of the files.

    No number of a deck or of the run is rounded in another way; what is left is that of printing.
    """
    plain, other = struck(law, PLAIN), struck(law, OTHERS[units])
    dissipated = plain[0][-1, ENERGIES.index("dissipated")]
    assert dissipated > 1.0
    assert plain[2].max() > 100.0
    for name, unit, found, wanted in zip(
        ("energies", "motion of the ball", "force of the ball"),
        ("mJ", "mm", "N"),
        other,
        plain,
        strict=True,
    ):
        close = 2.0 * DIGITS * np.abs(wanted).max()
        compare.values(f"{name} in other units", found, wanted, unit=unit, abs=close)
