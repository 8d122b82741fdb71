"""Uniaxial strain: Saint Venant and Kirchhoff's stress with the barrier below a ratio of 0.8."""

import re

import numpy as np
import pytest

from runs import Results

YOUNG, POISSON, DENSITY, THICKNESS = 70000.0, 0.3, 2.7e-9, 0.25
C33 = YOUNG * (1.0 - POISSON) / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON))
SPEED, DAMPING = 0.225 / 4.0e-4, 2.0e6
#: What damping of the whole thickness takes off the force on the way from face to face
DRAG = DAMPING * DENSITY * THICKNESS * SPEED
#: The wave of the start, density * c * speed, has fallen by exp(-DAMPING * START / 2)
START = 2.0e-5


def stress(stretch: np.ndarray) -> np.ndarray:
    """Force over area of the undeformed face, equal to the Cauchy stress as the area stays."""
    kirchhoff = 0.5 * stretch * (stretch**2 - 1.0)
    barrier = np.maximum(0.8 - stretch, 0.0) ** 2 / stretch
    return C33 * (kirchhoff - barrier)


def check(results: Results) -> None:
    """The layer is pressed to a tenth, and its stress grows all the way."""
    energy = results.table("energy")
    assert energy["least volume"][-1] == pytest.approx(0.1, rel=1e-3)
    # the step follows the stiffness: 1/sqrt(b'') at least, of the first step
    assert energy["step"][-1] < energy["step"][1] * 0.1 / 0.8
    # both layers are pressed alike, and the first look below 0.3 is at most 200 steps late
    warned = re.search(r"warning: quad [12], ply 1 is pressed to (\S+) of its", results.listing())
    assert warned
    assert 0.3 - 200 * energy["step"][1] * SPEED / THICKNESS < float(warned[1]) < 0.3
    supports = results.table("supports")
    late = supports["time"] > START
    stretch = 1.0 - SPEED * supports["time"][late] / THICKNESS
    exact = stress(stretch)
    assert np.all(np.diff(exact) < 0.0)
    assert stretch[-1] == pytest.approx(0.1)
    for part in (1, 2):
        force = supports[f"face motion {part + 1} top fz"][late]
        assert force == pytest.approx(exact, abs=DRAG)
        profile = results.profile(part)
        assert profile["szz"] == pytest.approx(exact[-1] * np.ones_like(profile["szz"]), rel=1e-3)
