"""Uniaxial stress: E1 times the strain, contractions by nu12 = PRBA EA / EB and nu13 alike."""

import numpy as np
import pytest

from runs import Results

STRAIN = 0.002 / 20.0
WIDTH, THICKNESS = 5.0, 0.5
YOUNG, POISSON = 150.0e3, 0.02 * 150.0e3 / 10.0e3


def check(results: Results) -> None:
    """At rest to exp(-40): relaxation and round-off only."""
    profile, stress = results.profile(1), YOUNG * STRAIN
    rows = np.ones(len(profile["z"]))
    assert profile["sxx"] == pytest.approx(stress * rows, rel=1e-6)
    for name in ("syy", "szz", "sxy", "sxz", "syz"):
        assert np.abs(profile[name]).max() < 1e-6 * stress
    assert profile["exx"] == pytest.approx(STRAIN * rows, rel=1e-6)
    for name in ("eyy", "ezz"):
        assert profile[name] == pytest.approx(-POISSON * STRAIN * rows, rel=1e-6)
    assert sorted(set(profile["ply"])) == [1.0, 2.0]
