"""*CONTROL_QUASI_STATIC tells the kinetic energy as a share of the internal one."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from broken import said
from decks import Deck, Ply
from elasticity import isotropic
from meshes import regular
from runs import Results, run

DENSITY, YOUNG, LENGTH, SPEED = 1.0e-9, 1.0e3, 10.0, 10.0
#: Time after which a bar that is stretched at a constant rate has moved as long as a wave takes
TRANSIT = LENGTH / np.sqrt(YOUNG / DENSITY)


def stretched_deck(transits: float, share: float | None) -> Deck:
    """A bar without Poisson's ratio whose points all move at once, in proportion to x."""
    end = transits * TRANSIT
    mesh = regular(LENGTH, 1.0, 5, 1, 4)
    deck = Deck("stretched", end)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(DENSITY, YOUNG, 0.0), 1.0)], order=1)
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(range(len(mesh.points)), "yz")
    curve = deck.curve([(0.0, 0.0), (end, 1.0)])
    deck.move(mesh.where(x=LENGTH), 1, curve, SPEED * end)
    speed = SPEED * mesh.points[:, 0] / LENGTH
    deck.velocities(np.stack([speed, 0.0 * speed, 0.0 * speed], axis=1))
    if share is not None:
        deck.add("CONTROL_QUASI_STATIC", (share,))
    return deck


def stretched(transits: float, share: float | None, folder: Path) -> Results:
    """The results of such a bar."""
    return run(stretched_deck(transits, share), folder)


def test_largest_share_is_that_of_the_first_time_looked_at(tmp_path: Path) -> None:
    """K = m v^2 / 6 and U = k (v t)^2 / 2 of a bar: K/U = (transit/t)^2 / 3, from a tenth on."""
    transits = 40.0
    text = stretched(transits, 0.03, tmp_path).listing()
    found = re.search(r"at most ([\d.Ee+-]+) of the internal one, at time ([\d.Ee+-]+)", text)
    assert found is not None, text
    time = float(found[2])
    # the first step after a tenth of the time; a step is 1/5 of a transit at most
    assert 0.1 * transits <= time / TRANSIT * 1.01
    assert time / TRANSIT <= 0.1 * transits + 0.2
    # two digits are printed
    assert float(found[1]) == pytest.approx((TRANSIT / time) ** 2 / 3.0, rel=0.05)
    assert "warning: the kinetic energy" not in text


def test_progress_line_has_the_share(tmp_path: Path) -> None:
    """At the end, (transit/t)^2 / 3, in a column of the deck that asks for it.

    The masses of five quads at their nodes sum x^2 by the trapezoidal rule: 1 + 1/(2 5^2) of it.
    """
    code, text = said("run", stretched_deck(4.0, 0.5).write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == 0, text
    header = next(line for line in text.splitlines() if line.split()[:1] == ["cycle"])
    assert header.split()[-1] == "kinetic"
    last = [line for line in text.splitlines() if line.endswith("%")][-1]
    # two digits behind the point are printed
    assert float(last.split()[-1].rstrip("%")) == pytest.approx(100.0 / 48.0 * 1.02, abs=0.01)


def test_warning_is_given_once(tmp_path: Path) -> None:
    """Above the share, at the first time; the answer is that without the keyword."""
    results = stretched(40.0, 0.01, tmp_path / "told")
    assert results.listing().count("warning: the kinetic energy") == 1
    without = stretched(40.0, None, tmp_path / "silent")
    assert "quasi-static" not in without.listing()
    told, silent = (each.table("energy").values for each in (results, without))
    assert np.array_equal(told, silent)


#: Share of the time over which the power of the loads is averaged, and that at which they slow down
LOOK, SLOW = 0.01, 0.5


def slowed_deck(
    fall: float, name: str = "slowed", *, start: float = 1.0, late: float = 1.2
) -> Deck:
    """A bar whose end moves at a fifth of its speed from half of the time on.

    It starts at some times the speed that goes with that of its end.
    """
    end = 40.0 * TRANSIT
    mesh = regular(LENGTH, 1.0, 5, 1, 4)
    deck = Deck(name, end)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(DENSITY, YOUNG, 0.0), 1.0)], order=1)
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(range(len(mesh.points)), "yz")
    curve = deck.curve([(0.0, 0.0), (SLOW * end, 1.0), (end, late)])
    deck.move(mesh.where(x=LENGTH), 1, curve, SPEED * SLOW * end)
    speed = SPEED * mesh.points[:, 0] / LENGTH
    deck.velocities(np.stack([start * speed, 0.0 * speed, 0.0 * speed], axis=1))
    deck.add("CONTROL_QUASI_STATIC", (0.5, fall))
    return deck


def end_share(results: Results) -> float:
    """Time of the last row over the end time."""
    return float(results.table("energy")["time"][-1] / (40.0 * TRANSIT))


def test_run_ends_after_the_largest_load(tmp_path: Path) -> None:
    """The power falls to a fifth at the half: the first look without the time before."""
    results = run(slowed_deck(0.5), tmp_path)
    share = end_share(results)
    # a look comes with the first step after its time: a step of 1/5 of a transit late at most
    late = 0.2 / 40.0
    assert SLOW < share <= SLOW + 2.0 * LOOK + 3.0 * late
    assert "end after the largest load: the power of the loads fell to 0.2" in results.listing()


@pytest.mark.parametrize("fall", [0.0, 0.15])
def test_smaller_falls_do_not_end_the_run(fall: float, tmp_path: Path) -> None:
    """Not without a share, and not where the load stays above it."""
    assert end_share(run(slowed_deck(fall), tmp_path)) == pytest.approx(1.0)


def test_run_does_not_end_before_there_is_a_load(tmp_path: Path) -> None:
    """A bar that is faster than its end pushes it at first: the work of the support is negative.

    Its force, rho c A v (2 s - 1) at s transits, is below zero in the whole first look.
    """
    results = run(slowed_deck(0.01, start=2.0, late=2.0), tmp_path)
    energy = results.table("energy")
    first = np.searchsorted(energy["time"], LOOK * 40.0 * TRANSIT)
    assert energy["external"][first] < 0.0
    assert end_share(results) == pytest.approx(1.0)


def test_run_does_not_end_as_loading_begins(tmp_path: Path) -> None:
    """A bar that swings: its load falls to less than the share in the first tenth, not later."""
    fall = 0.35
    results = run(slowed_deck(fall, start=4.0, late=2.0), tmp_path)
    energy = results.table("energy")
    looks = np.arange(0.0, 1.0, LOOK)
    work = np.interp(looks, energy["time"] / (40.0 * TRANSIT), energy["external"])
    power = np.diff(work)
    largest = np.maximum.accumulate(power)
    falls = (largest > 0.0) & (power < fall * largest)
    assert falls[looks[1:] < 0.1].any()
    assert not falls[looks[1:] > 0.1].any()
    assert end_share(results) == pytest.approx(1.0)


def test_restart_before_the_fall_ends_at_the_same_step(tmp_path: Path) -> None:
    """The largest power and the last look are in the restart file."""
    whole = run(slowed_deck(0.5), tmp_path / "whole").table("energy").values
    deck = slowed_deck(0.5)
    deck.add("DATABASE_BINARY_D3DUMP", (113,))
    path = deck.write(tmp_path / "job.k")
    code, text = said("run", path, "-o", tmp_path)
    assert code == 0, text
    code, text = said("restart", tmp_path / "job.dump01")
    assert code == 0, text
    gone_on = Results(tmp_path, "job").table("energy").values
    assert np.array_equal(gone_on, whole)
