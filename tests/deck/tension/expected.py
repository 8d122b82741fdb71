"""Uniaxial stress: E1 times the strain, contractions by nu12 = PRBA EA / EB and nu13 alike."""

import numpy as np
import pytest

from runs import DIGITS, Results, Table

LENGTH = 20.0
STRAIN = 0.002 / LENGTH
WIDTH, THICKNESS = 5.0, 0.5
YOUNG, POISSON = 150.0e3, 0.02 * 150.0e3 / 10.0e3


def check(results: Results) -> None:
    """At rest to exp(-38) of the start: what is left is round-off.

    The slowest motion is shear across the bar, at (pi / 2 L) sqrt(G12 / rho) = 1.5e5 rad/s; the
    damping of 2e5 /s is less than critical for it, so that all motion falls as exp(-1e5 t).
    """
    profile, stress = results.profile(1), YOUNG * STRAIN
    rows = np.ones(len(profile["z"]))
    assert profile["sxx"] == pytest.approx(stress * rows, rel=DIGITS)
    for name in ("syy", "szz", "sxy", "sxz", "syz"):
        assert np.abs(profile[name]).max() < DIGITS * stress
    assert profile["exx"] == pytest.approx(STRAIN * rows, rel=DIGITS)
    for name in ("eyy", "ezz"):
        assert profile[name] == pytest.approx(-POISSON * STRAIN * rows, rel=DIGITS)
    assert sorted(set(profile["ply"])) == [1.0, 2.0]
    check_forces(results.table("supports"), stress * WIDTH * THICKNESS)
    energy = results.table("energy")
    stored = 0.5 * stress * STRAIN * LENGTH * WIDTH * THICKNESS
    assert energy["stored"][-1] == pytest.approx(stored, rel=DIGITS)
    assert np.abs(energy["stored error"]).max() < DIGITS


def check_forces(supports: Table, pull: float) -> None:
    """Both ends carry the pull, against each other; nothing else does."""
    assert supports["motion 2 fx"][-1] == pytest.approx(pull, rel=DIGITS)
    assert supports["spc 1 fx"][-1] == pytest.approx(-pull, rel=DIGITS)
    others = [f"f{axis}" for axis in "xyz"] + ["spc 3 fy", "face 4 bottom fz"]
    assert max(abs(supports[name][-1]) for name in others) < DIGITS * pull
    # nothing is held or moved in these directions
    free = ["spc 1 fy", "spc 1 fz", "spc 3 fx", "face 4 bottom fx", "motion 2 fy", "motion 2 fz"]
    assert all(not supports[name].any() for name in free)
