"""Double cantilever and end notch of AS4/PEEK: force and resistance against corrected beam theory.

`study.py` runs all tests, orders and sizes of quads; the manual has its table.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from delamination import TESTS, Outcome, simulate


def test_double_cantilever_opens_at_the_toughness(tmp_path: Path) -> None:
    """Quads of 1 mm: a zone of 1.4 mm spans less than three distances between nodes.

    So the force is uneven, up to 7 % above theory; its mean resistance is the toughness.
    """
    specimen, _ = TESTS["DCB"]
    found = simulate(specimen, tmp_path)
    theory = float(specimen.force(specimen.crack))
    assert found.peak == pytest.approx(theory, rel=0.07)
    grown = found.growing(1.0, 4.0, specimen.crack)
    rate = specimen.resistance(found.force[grown], found.deflection[grown])
    assert rate.mean() == pytest.approx(specimen.bond.toughness[0], rel=0.05)
    check_energy(specimen.crack, found)


def test_end_notch_slides_at_the_toughness(tmp_path: Path) -> None:
    """The zone is of the size of the arms, so that the peak is some 4 % below theory."""
    specimen = replace(TESTS["ENF"][0], size=2.0)
    found = simulate(specimen, tmp_path)
    theory = float(specimen.force(specimen.crack))
    assert 0.93 * theory < found.peak < 1.01 * theory
    grown = found.growing(1.0, 4.0, specimen.crack)
    rate = specimen.resistance(found.force[grown], found.deflection[grown])
    assert rate.mean() == pytest.approx(specimen.bond.toughness[1], rel=0.05)
    check_energy(specimen.crack, found)


def check_energy(crack: float, found: Outcome) -> None:
    """Slow enough, balanced, and the interface took its toughness over what has failed."""
    onset = int((found.crack > crack).argmax())
    assert found.kinetic[onset] < 0.01
    energy = found.results.table("energy")
    assert np.abs(energy["error"]).max() < 1e-6
    assert np.all(np.diff(energy["delamination"]) >= 0.0)
