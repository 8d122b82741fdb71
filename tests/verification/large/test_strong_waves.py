"""Waves through plies that strain by some per cent: what share of the stable step bears them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from decks import BOTTOM, TOP, Deck, Ply
from elasticity import CARBON
from meshes import regular
from runs import run

# The share at which the fastest motion repeats after three steps
RESONANT = 0.5 * np.sqrt(3.0)


def bears(share: float, amplitude: float) -> bool:
    """Whether one point on a bar of Saint Venant and Kirchhoff stays bounded, by any phase."""
    phases = np.linspace(0.0, 2.0 * np.pi, 48, endpoint=False)
    before = amplitude * np.cos(phases)
    now = amplitude * np.cos(phases + 2.0 * np.arcsin(share))
    for _ in range(5000):
        force = now + 1.5 * now**2 + 0.5 * now**3
        before, now = now, 2.0 * now - before - (2.0 * share) ** 2 * force
        if np.abs(now).max() > 0.9:
            return False
    return True


@pytest.mark.parametrize(
    ("share", "strain"),
    [(0.8, 0.14), (0.85, 0.027), (0.86, 0.0095), (0.88, 0.0195), (0.9, 0.043), (0.95, 0.08)],
)
def test_strain_that_a_share_of_the_step_bears(share: float, strain: float) -> None:
    """The table of the theory page, section 10."""
    assert bears(share, 0.95 * strain)
    assert not bears(share, 1.15 * strain)


def test_resonance_bears_least() -> None:
    """A motion of three steps: strain squared pushes at the same places in every turn."""
    assert not bears(RESONANT, 0.002)


def struck(share: float, linear: bool, folder: Path) -> float:
    """Energy over the work of a blow of 1 GPa on four plies, which strains them by per cents."""
    end = 1.0e-4
    deck = Deck("a blow", end)
    deck.control(linear=linear, share=share)
    mesh = regular(2.5, 2.5, 2, 2, 9)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.25, angle) for angle in (0.0, 90.0, 0.0, 90.0)], 3)
    deck.hold_face(range(len(mesh.points)), BOTTOM, "xyz")
    curve = deck.curve([(0.0, 0.0), (5.0e-8, 1.0), (1.0e-7, 0.0), (1.0, 0.0)])
    deck.add("LOAD_FACE_PRESSURE", (0, TOP, curve, 1000.0))
    deck.intervals(glstat=end / 200.0, binary_d3plot=end)
    energy = run(deck, folder).table("energy")
    stored = energy["kinetic"] + energy["internal"] - energy["half-step correction"]
    stored = stored / energy["external"][-1]
    return float(stored[len(stored) // 2 :].mean())


def test_strong_waves_need_four_fifths_of_the_step(compare: Comparison, tmp_path: Path) -> None:
    """With large displacement 0.8 bears them and 0.9 does not; linear strain bears any share."""
    for share, linear, name in ((0.8, False, "large displacement"), (0.95, True, "linear strain")):
        found = struck(share, linear, tmp_path / name)
        compare.number(f"energy over work at {share:g} of the step, {name}", found, 1.0, abs=0.01)
    # growing waves are seen in the motion or, first, in what is stored
    guards = "the motion is unstable|have given back more energy than they took"
    with pytest.raises(AssertionError, match=guards):
        struck(0.9, False, tmp_path / "more")
