"""Fibre damage of one quad: onset at the strength, unloading to the origin, toughness spent."""

import numpy as np
import pytest

from runs import Results

YOUNG, STRENGTH, TOUGHNESS = 153.0e3, 2537.0, 91.6
LENGTH, AREA = 2.0, 1.0 * 0.25
RESIDUAL = 1.0e-6
ONSET = STRENGTH / YOUNG
FINISH = 2.0 * TOUGHNESS / (LENGTH * STRENGTH)

# The damped ply lags behind by the inertia of 30 1/s times 2 mm: 1e-3 MPa; the corner of onset
# falls between two steps, each 4e-7 of strain
TOLERANCE = 4.0e-7 / ONSET


def falling(strain: float) -> float:
    """Stress on the line of softening."""
    return STRENGTH * (FINISH - strain) / (FINISH - ONSET)


def check(results: Results) -> None:
    """Along the path; then what is written of the end."""
    profile = results.table("profile_1")
    for time, strain, stress in [
        (5.0e-4, 0.0125, YOUNG * 0.0125),
        (1.0e-3, 0.025, falling(0.025)),
        (1.5e-3, 0.010, falling(0.025) * 0.010 / 0.025),
        (2.0e-3, 0.025, falling(0.025)),
        (2.5e-3, 0.040, RESIDUAL * YOUNG * 0.040),
    ]:
        row = np.argmin(np.abs(profile["time"] - time))
        assert profile["exx"][row] == pytest.approx(strain, rel=2.0e-4)
        assert profile["sxx"][row] == pytest.approx(stress, rel=3.0e-4, abs=1.0e-5)
    energy = results.table("energy")
    force = np.diff(energy["external"]) / np.diff(energy["time"]) / (25.0 * LENGTH)
    # a line of the file is 2.5e-5 of strain
    assert force.max() == pytest.approx(STRENGTH * AREA, rel=2.5e-5 / ONSET)
    check_energy(results)
    check_fields(results)


def check_energy(results: Results) -> None:
    """All of the work is spent on fibres, never given back, and is toughness times area."""
    energy = results.table("energy")
    spent = energy["fibre damage"]
    assert spent[-1] == pytest.approx(TOUGHNESS * AREA, rel=TOLERANCE)
    assert energy["internal"][-1] == pytest.approx(spent[-1], rel=1.0e-4)
    assert np.all(np.diff(spent) >= 0.0)
    # shear of round-off, 1e-16, leaves work on its curve by the cube of it
    nothing = 1.0e-40 * spent[-1]
    assert np.all(np.abs(energy["dissipated"] - spent) <= nothing)
    for other in (
        "matrix damage",
        "ply plasticity",
        "metal plasticity",
        "delamination",
        "friction",
    ):
        assert np.all(energy[other] <= nothing)
    waiting = (energy["time"] > 1.0e-3) & (energy["time"] < 2.0e-3)
    assert np.ptp(spent[waiting]) <= 2.0e-3 * spent[-1]
    assert np.abs(energy["error"]).max() < 1.0e-9


def check_fields(results: Results) -> None:
    """Broken fibres carry no shear either; the listing tells the strains."""
    assert results.field("damage_fibre") == pytest.approx(1.0 - RESIDUAL, abs=1.0e-7)
    assert np.all(results.field("damage_matrix") == 0.0)
    assert results.field("damage_shear") == pytest.approx(1.0 - RESIDUAL, abs=1.0e-7)
    assert results.field("dissipated") == pytest.approx(TOUGHNESS / LENGTH, rel=TOLERANCE)
    row = next(line for line in results.listing().splitlines() if line.startswith("fibre tension"))
    numbers = [float(word) for word in row.split()[2:]]
    longest = 2.0 * YOUNG * TOUGHNESS / STRENGTH**2 / 1.05
    assert numbers == pytest.approx(
        [STRENGTH, longest, STRENGTH, ONSET, FINISH, FINISH, 0], rel=1.0e-4
    )
