"""Failed faces that open and close give no energy to the plate, near the stable step."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from comparison import Comparison
from reclosing import BOND, WHOLE, Course, deck_of, mean_kinetic
from runs import Table, run_once


def energies(course: Course) -> Table:
    """History of the energies of a run, whose smooth faces other tests may compare with."""
    return run_once(deck_of(course)).table("energy")


def test_falling_penalty_gains_no_energy_at_nine_tenths_of_the_step(compare: Comparison) -> None:
    """The mean kinetic energy is that of a small step; chance of the contacts: 1 %."""
    small = energies(Course(share=0.4))
    large = energies(Course(share=0.9))
    found, expected = mean_kinetic(large), mean_kinetic(small)
    compare.number("mean kinetic energy, TSSFAC 0.9 beside 0.4", found, expected, rel=0.01)


def test_whole_penalty_is_stopped_when_more_comes_out_than_went_in() -> None:
    """A whole penalty at that step gains energy until less than nothing would be stored.

    A third in half a millisecond, so all of it is gone after one, sooner or later with round-off.
    """
    with pytest.raises(AssertionError, match="given back more energy than they took"):
        energies(Course(WHOLE, end=1.5e-3, limit=0.01))


def test_implicit_interfaces_gain_none_with_a_whole_penalty(compare: Comparison) -> None:
    """Nor does the energy of a step that is several times larger grow from half to half."""
    energy = energies(Course(WHOLE, end=2.0e-4, implicit=1))
    early = energy["time"] < 0.5 * energy["time"][-1]
    after = energy["time"] > 0.1 * energy["time"][-1]
    first, second = energy["kinetic"][early & after].mean(), energy["kinetic"][~early].mean()
    bounds = (-1.0, 0.01)
    compare.number("kinetic energy, IMPL 1, second half", second, first, unit="mJ", bounds=bounds)


@pytest.mark.parametrize(("implicit", "share"), [(0, 0.9), (0, 0.98), (1, 0.9), (2, 0.9)])
def test_falling_penalty_makes_no_energy_with_friction(implicit: int, share: float) -> None:
    """What is stored and dissipated exceeds the work by less than the 0.5 % that is a warning.

    At 0.98 of the stable step the product of the highest frequency and the step is 1.96. Friction
    takes a third of the work, and never gives any back: less motion is left than without it.
    """
    rough = Course(replace(BOND, friction=0.3), share, implicit=implicit)
    energy = energies(rough)
    assert energy["stored error"].min() > -5.0e-3
    friction = energy["friction"]
    assert np.all(np.diff(friction) >= 0.0)
    assert friction[-1] > 0.3 * energy["external"][-1]
    smooth = energies(Course(BOND, share, implicit=implicit))
    assert mean_kinetic(energy) < 0.9 * mean_kinetic(smooth)


def test_whole_penalty_makes_energy_with_friction() -> None:
    """Twice the bound of the other penalty: the measure of that test would see it."""
    rough = Course(replace(WHOLE, friction=0.3))
    assert energies(rough)["stored error"].min() < -1.0e-2
