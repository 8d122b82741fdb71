"""A crack across a strip in tension: strength, softening, energy by toughness times area."""

import numpy as np
import pytest

from runs import Results

YOUNG, STRENGTH, TOUGHNESS = 9080.0, 62.3, 0.277
LENGTH, AREA = 0.4, 1.0 * 0.25
# Strain of the crack at which nothing is left: a quad of 4 nodes opens as a whole
OPENED = 2.0 * TOUGHNESS / (STRENGTH * LENGTH)
# The damped ply lags behind as in `strain_damage`; the corner of onset falls between two steps,
# each 6e-7 of strain
TOLERANCE = 6.0e-7 / (STRENGTH / YOUNG) + 1.0e-3


def falling(strain: float) -> float:
    """Stress beyond onset in uniaxial stress: elastic strain and the crack are in series."""
    # strain = stress/E + (1 - stress/strength) OPENED
    return (OPENED - strain) / (OPENED / STRENGTH - 1.0 / YOUNG)


def check(results: Results) -> None:
    """Along the path; then what the crack has cost."""
    profile = results.table("profile_1")
    before = falling(0.010)
    for time, strain, stress in [
        (2.5e-4, 0.0025, YOUNG * 0.0025),
        (1.0e-3, 0.010, before),
        (1.5e-3, 0.004, before * 0.004 / 0.010),
        (2.5e-3, 0.024, 0.0),
    ]:
        row = np.argmin(np.abs(profile["time"] - time))
        assert profile["exx"][row] == pytest.approx(strain, rel=3.0e-4)
        assert profile["sxx"][row] == pytest.approx(stress, rel=2.0e-3, abs=5.0e-3)
    energy = results.table("energy")
    spent = energy["matrix damage"]
    assert spent[-1] == pytest.approx(TOUGHNESS * AREA, rel=TOLERANCE)
    assert energy["internal"][-1] == pytest.approx(spent[-1], rel=1.0e-3)
    assert np.all(np.diff(spent) >= 0.0)
    assert spent == pytest.approx(energy["dissipated"], rel=1.0e-12)
    assert np.abs(energy["error"]).max() < 1.0e-9
    assert results.field("damage_matrix") == pytest.approx(1.0, abs=2.0e-6)
    assert np.all(results.field("damage_fibre") == 0.0)
    lines = results.listing().splitlines()
    row = next(line for line in lines if line.startswith("matrix tension"))
    widest = 2.0 * YOUNG * TOUGHNESS / STRENGTH**2 / 1.05
    numbers = [float(word) for word in row.split()[2:]]
    assert numbers == pytest.approx([STRENGTH, widest, STRENGTH, 0.0], rel=1.0e-4)
    row = next(line for line in lines if line.startswith("shear strength across"))
    assert float(row.split()[5]) == pytest.approx(75.3, abs=0.05)
