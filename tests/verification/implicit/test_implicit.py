"""Locally implicit schemes against central differences: an impact on plies joined by springs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import Deck, Ply, Sphere
from elasticity import CARBON
from meshes import distorted, regular
from runs import Results, run

SIDE, PLY, DURATION = 30.0, 0.25, 1.5e-4
MASS, SPEED = 2.0e-6, 3.0e3
STIFFNESS = 1.0e6
EXPLICIT, INTERFACES, THICKNESS = 0, 1, 2
# A mode of the frequency w is slowed down by 1/4 (w dt)^2 with implicit steps and hurried by
# 1/24 (w dt)^2 with explicit ones. What matters here is slower than 1 / 5 us, the longest step is
# 0.2 us: 4e-4. Single nodes in contact are not that slow, and add a few parts in a thousand.
SLOW = 5.0e-3


def impact(scheme: int, linear: bool, folder: Path) -> Results:
    """A small sphere hits and leaves a plate of four plies that is held along its edges."""
    mesh = distorted(regular(SIDE, SIDE, 6, 6, 9), 0.05)
    made = Deck("implicit", DURATION)
    made.control(linear=linear, scheme=scheme)
    made.mesh(mesh)
    made.laminate([Ply(CARBON, PLY, angle) for angle in (0.0, 90.0, 90.0, 0.0)], 2)
    made.interfaces(STIFFNESS, 0.5 * STIFFNESS)
    made.hold(mesh.boundary(), "xyz")
    centre = (0.5 * SIDE, 0.5 * SIDE, 2.0 * PLY + 4.0)
    made.sphere(Sphere(4.0, MASS, centre, (0.0, 0.0, -SPEED), method=1))
    made.intervals(impactor=1.0e-6, glstat=1.0e-6)
    return run(made, folder)


@pytest.mark.parametrize("linear", [True, False], ids=["linear", "large"])
def test_impact_is_that_of_central_differences(
    linear: bool, compare: Comparison, tmp_path: Path
) -> None:
    """Motion of the sphere, with longer steps and a balance that closes."""
    found = [impact(scheme, linear, tmp_path / str(scheme)) for scheme in range(THICKNESS + 1)]
    tables = [results.table("impactor_1") for results in found]
    energies = [results.table("energy") for results in found]
    steps = [np.median(energy["step"]) for energy in energies]
    assert steps[INTERFACES] > 3.0 * steps[EXPLICIT]
    assert steps[THICKNESS] > 10.0 * steps[EXPLICIT]
    base = tables[EXPLICIT]
    schemes = ("IMPL 1", "IMPL 2")
    for scheme, table, energy in zip(
        schemes, tables[INTERFACES:], energies[INTERFACES:], strict=True
    ):
        assert np.abs(energy["error"]).max() < 1.0e-9
        for name, size in (
            ("velocity", SPEED),
            ("displacement", np.abs(base["displacement"]).max()),
        ):
            ours = np.interp(base["time"], table["time"], table[name])
            compare.values(f"{name} of the sphere, {scheme}", ours, base[name], abs=SLOW * size)
