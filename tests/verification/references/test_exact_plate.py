"""The exact plate solutions give the numbers that are in print."""

from __future__ import annotations

import numpy as np
import pytest

from comparison import Comparison
from elasticity import CARBON, Material, isotropic
from exact_plate import CrossPly, Harmonic, frequency

# Pagano's ply: E1 = 25 E2, G12 = G13 = E2 / 2, G23 = E2 / 5, nu = 1/4
PAGANO = Material(1.0, (25.0, 1.0, 1.0), (0.25, 0.25, 0.25), (0.5, 0.5, 0.2))


def pagano(ratio: float) -> CrossPly:
    """Three equal plies 0/90/0 of unit thickness in all, `ratio` times as long as thick."""
    plies = tuple((PAGANO, 1.0 / 3.0, angle) for angle in (0.0, 90.0, 0.0))
    return CrossPly(ratio, ratio, plies)


# a/h, sxx top and bottom, syy top and bottom of the 90 ply, txz, tyz at mid-height, txy, w:
# Pagano 1970, table of the three-ply square laminate
PRINTED = [
    (4.0, 0.8008, -0.7548, 0.5341, -0.5563, 0.2559, 0.2172, -0.0511, 2.0059),
    (10.0, 0.5906, -0.5898, 0.2845, -0.2882, 0.3573, 0.1228, -0.0288, 0.7530),
    (20.0, 0.5524, -0.5525, 0.2092, -0.2101, 0.3846, 0.0938, -0.0234, 0.5164),
]


@pytest.mark.parametrize("row", PRINTED, ids=lambda row: f"S={row[0]:g}")
def test_pagano_bending_is_as_printed(row: tuple[float, ...], compare: Comparison) -> None:
    """All stresses and the deflection, to half of the last printed digit."""
    ratio = row[0]
    harmonic = Harmonic(pagano(ratio))
    bottom = harmonic.bottom_under(1.0)
    top, low = harmonic.fields(bottom, 2, 1.0), harmonic.fields(bottom, 0, 0.0)
    above, below = harmonic.fields(bottom, 1, 1.0), harmonic.fields(bottom, 1, 0.0)
    middle = harmonic.fields(bottom, 1, 0.5)
    found = [
        top.stress[0] / ratio**2,
        low.stress[0] / ratio**2,
        above.stress[1] / ratio**2,
        below.stress[1] / ratio**2,
        middle.stress[4] / ratio,
        middle.stress[5] / ratio,
        top.stress[3] / ratio**2,
        100.0 * middle.displacement[2] / ratio**4,
    ]
    compare.values("Pagano's table", found, list(row[1:]), abs=0.6e-4)


def test_faces_carry_what_is_applied() -> None:
    """Tractions: none at the bottom, the load at the top."""
    harmonic = Harmonic(pagano(4.0))
    bottom = harmonic.bottom_under(3.0)
    assert harmonic.fields(bottom, 0, 0.0).stress[[2, 4, 5]] == pytest.approx([0, 0, 0], abs=1e-12)
    assert harmonic.fields(bottom, 2, 1.0).stress[[2, 4, 5]] == pytest.approx([3, 0, 0], abs=1e-11)


@pytest.mark.parametrize(
    ("m", "n", "printed"), [(1, 1, 0.0931), (1, 2, 0.2226), (2, 2, 0.3421), (1, 3, 0.4171)]
)
def test_isotropic_frequencies_are_as_printed(
    m: int, n: int, printed: float, compare: Comparison
) -> None:
    """Square plate, h / a = 0.1, nu = 0.3 (Srinivas, Joga Rao and Rao 1970)."""
    ply = isotropic(1.0, 2.6, 0.3)  # so that G = 1
    plate = CrossPly(10.0, 10.0, ((ply, 1.0, 0.0),))
    found = frequency(plate, m, n, 0.5)
    compare.number(f"frequency of mode {m}, {n}", found, printed, abs=0.6e-4)


def test_frequencies_of_a_carbon_laminate(compare: Comparison) -> None:
    """[0/90]2s of eight plies of 0.25 mm: an independent computation gives these, in Hz."""
    plies = tuple((CARBON, 0.25, a) for a in (0.0, 90.0, 0.0, 90.0, 90.0, 0.0, 90.0, 0.0))
    plate = CrossPly(20.0, 20.0, plies)
    found = [
        frequency(plate, m, n, 6e5) / (2.0 * np.pi) for m, n in ((1, 1), (1, 2), (2, 1), (2, 2))
    ]
    printed = [22458.8, 48078.7, 56633.2, 72100.5]
    compare.values("frequencies of a carbon laminate", found, printed, unit="Hz", rel=1e-5)
