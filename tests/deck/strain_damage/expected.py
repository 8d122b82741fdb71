"""Matrix damage of one quad between given strains: a line down, and the triangle under it spent."""

import numpy as np
import pytest

from runs import Results

YOUNG, ONSET, FINISH = 9.0e3, 0.008, 0.032
LENGTH, AREA = 2.0, 1.0 * 0.25
SHEAR = 5.0e3
# What remains of a stiffness
RESIDUAL = 1.0e-6

# The damped ply lags behind by the inertia of 30 1/s times 2 mm: 1e-3 MPa; the corner of onset
# falls between two steps, each 2e-6 of strain
TOLERANCE = 2.0e-6 / ONSET


def falling(strain: float) -> float:
    """Stress on the line between onset and saturation."""
    return YOUNG * ONSET * (FINISH - strain) / (FINISH - ONSET)


def check(results: Results) -> None:
    """Along the path; then what is written of the end."""
    profile = results.table("profile_1")
    for time, strain, stress in [
        (2.5e-4, 0.00625, YOUNG * 0.00625),
        (1.0e-3, 0.025, falling(0.025)),
        (1.5e-3, 0.010, falling(0.025) * 0.010 / 0.025),
        (2.0e-3, 0.025, falling(0.025)),
        (2.5e-3, 0.040, RESIDUAL * YOUNG * 0.040),
    ]:
        row = np.argmin(np.abs(profile["time"] - time))
        assert profile["exx"][row] == pytest.approx(strain, rel=3.0e-4)
        assert profile["sxx"][row] == pytest.approx(stress, rel=2.0e-3, abs=2.0e-3)
    energy = results.table("energy")
    spent = energy["matrix damage"]
    assert spent[-1] == pytest.approx(0.5 * YOUNG * ONSET * FINISH * AREA * LENGTH, rel=TOLERANCE)
    assert energy["internal"][-1] == pytest.approx(spent[-1], rel=1.0e-4)
    assert np.all(np.diff(spent) >= 0.0)
    assert np.all(spent == energy["dissipated"])
    assert np.abs(energy["error"]).max() < 1.0e-9
    assert results.field("damage_matrix") == pytest.approx(1.0, abs=1.0e-6)
    assert results.field("damage_shear") == pytest.approx(1.0, abs=1.0e-6)
    assert np.all(results.field("damage_fibre") == 0.0)
    check_listing(results)


def check_listing(results: Results) -> None:
    """Strains, stress at onset, and what a crack costs: a quad of 4 nodes opens as a whole."""
    lines = results.listing().splitlines()
    row = next(line for line in lines if line.startswith("matrix tension"))
    cost = 0.5 * YOUNG * ONSET * FINISH * LENGTH
    numbers = [float(word) for word in row.split()[2:]]
    assert numbers == pytest.approx([ONSET, FINISH, YOUNG * ONSET, cost, cost], rel=1.0e-4)
    row = next(line for line in lines if line.startswith("shear "))
    cost *= 4.0 * SHEAR / YOUNG
    numbers = [float(word) for word in row.split()[1:]]
    expected = [2.0 * ONSET, 2.0 * FINISH, SHEAR * 2.0 * ONSET, cost, cost]
    assert numbers == pytest.approx(expected, rel=1.0e-4)
    row = next(line for line in lines if line.startswith("locking"))
    assert [float(word) for word in row.replace(",", " ").split() if word[0].isdigit()] == [
        0.06,
        0.08,
        0.09,
        0.11,
    ]
