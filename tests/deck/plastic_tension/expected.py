"""Uniaxial stress with linear mixed hardening: yield, slope, unloading, reverse yield, energies."""

import numpy as np
import pytest

from runs import Results

YOUNG, YIELD, TANGENT, ISOTROPIC = 210.0e3, 210.0, 2100.0, 0.4
MODULUS = YOUNG * TANGENT / (YOUNG - TANGENT)
VOLUME = 2.0 * 1.0 * 0.5
PULLED, LET_GO = 0.0060, 0.0055

# Where the motion starts and stops, the sides of the bar, which move at half of 6 /s times 1 mm,
# ring by density times wave speed times velocity, 0.15 MPa, until they are braked
TOLERANCE = 0.15 / YIELD


def hardened(strain: np.ndarray | float) -> np.ndarray | float:
    """Stress of a strain beyond yield."""
    return YIELD + TANGENT * (strain - YIELD / YOUNG)


def at(results: Results, time: float) -> tuple[float, float]:
    """Strain and stress along the bar at a time, the same at all heights."""
    profile = results.table("profile_1")
    rows = np.abs(profile["time"] - time) < 1.0e-6
    strain, stress = profile["exx"][rows], profile["sxx"][rows]
    assert len(strain) == 4
    assert strain == pytest.approx(strain[0], rel=1.0e-6)
    assert stress == pytest.approx(stress[0], rel=TOLERANCE)
    return strain[0], stress[0]


def check(results: Results) -> None:
    """Along the path, then what is left of it at its end, where the bar has its first length."""
    for time in (2.5e-4, 5.0e-4, 7.5e-4, 1.0e-3):
        strain, stress = at(results, time)
        assert strain == pytest.approx(6.0 * time, rel=1.0e-3)
        assert stress == pytest.approx(hardened(strain), rel=TOLERANCE)
    rise = at(results, 1.0e-3)[1] - at(results, 2.5e-4)[1]
    assert rise == pytest.approx(TANGENT * 0.0045, rel=2.0e-2)
    unloaded = hardened(PULLED) - YOUNG * (PULLED - LET_GO)
    assert at(results, 1.75e-3)[1] == pytest.approx(unloaded, rel=TOLERANCE * YIELD / unloaded)
    check_end(results)


def check_end(results: Results) -> None:
    """Back stress (1 - beta) H times plastic strain, yield stress SIGY + beta H times its path."""
    forth = PULLED - hardened(PULLED) / YOUNG
    back = forth * (YOUNG + (1.0 - 2.0 * ISOTROPIC) * MODULUS) - YIELD
    back /= YOUNG + MODULUS
    stress, path, left = -YOUNG * (forth - back), forth + back, forth - back
    assert at(results, 3.0e-3)[1] == pytest.approx(stress, rel=TOLERANCE)
    assert results.field("plastic_strain") == pytest.approx(path, rel=TOLERANCE)

    energy = results.table("energy")
    dissipated = YIELD * path + 0.5 * ISOTROPIC * MODULUS * path**2
    stored = 0.5 * stress**2 / YOUNG + 0.5 * (1.0 - ISOTROPIC) * MODULUS * left**2
    assert energy["dissipated"][-1] == pytest.approx(VOLUME * dissipated, rel=TOLERANCE)
    whole = VOLUME * (stored + dissipated)
    assert energy["internal"][-1] == pytest.approx(whole, rel=TOLERANCE)
    assert np.all(np.diff(energy["dissipated"]) >= 0.0)
    assert energy["dissipated"][energy["time"] == 0.0] == 0.0
