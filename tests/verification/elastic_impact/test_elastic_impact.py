"""The impact of decks/elastic_impact (Nagaraj et al. 2020, section 4.1), from recipe to results."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from elastic_reference import TABLE
from recipes import make_deck
from runs import DIGITS, ROOT, SOLVER, Results, Table, run_deck

RECIPES = ROOT / "decks" / "elastic_impact"
MASS, VELOCITY, RADIUS, GAP = 1.673e-5, 5.0e3, 8.0, 1.0e-3
PLATE_MASS = 1.7e-9 * 100.0 * 100.0 * 16.0 * 0.125


def deck_of(recipe: str, folder: Path, *changes: str) -> Path:
    """Make the deck of a recipe with plydyn-pre, some of its values replaced."""
    return make_deck(RECIPES / f"{recipe}.toml", folder / f"{recipe}.k", *changes)


@pytest.fixture(scope="module")
def impact(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str, str], Results]:
    """Runs a recipe with a method of contact once, with the history of the ball in every step."""

    @cache
    def run(recipe: str, method: str) -> Results:
        folder = tmp_path_factory.mktemp("impact")
        changes = (
            f"contact.method={method}",
            "outputs.impactor_interval=1e-9",
            'outputs.fields=["displacement"]',
        )
        return run_deck(deck_of(recipe, folder, *changes), folder, recipe)

    return run


def listed(listing: str, name: str) -> float:
    """A number of the listing, by its words."""
    found = re.search(rf"^{name} +([-+.\dEe]+)", listing, re.MULTILINE)
    assert found is not None, name
    return float(found.group(1))


@pytest.mark.parametrize(
    ("recipe", "freedoms"), [("le1", 10659), ("le2", 20691), ("le3", 30723), ("3le1", 30723)]
)
def test_size_is_that_of_table_2(
    recipe: str, freedoms: int, compare: Comparison, tmp_path: Path
) -> None:
    """Degrees of freedom as in the paper; mass of the square exactly, as its edges are straight."""
    command = [SOLVER, "check", deck_of(recipe, tmp_path)]
    listing = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    compare.number("degrees of freedom", listed(listing, "degrees of freedom"), freedoms)
    assert listed(listing, "nodes of the plane") == 209
    assert listed(listing, "quads") == 48
    assert listed(listing, "mass of the plate") == pytest.approx(PLATE_MASS, rel=1e-7)
    assert listed(listing, "impactor 1") == pytest.approx(MASS, rel=1e-7)


def running_mean(history: Table, window: float) -> np.ndarray:
    """Force averaged over a window of time."""
    count = round(window / float(np.median(np.diff(history["time"]))))
    return np.convolve(history["force"], np.ones(count) / count, "valid")


@pytest.mark.parametrize("recipe", TABLE)
def test_impact_is_that_of_an_independent_code(
    recipe: str, impact: Callable[[str, str], Results], compare: Comparison
) -> None:
    """The other code is `tests/support/elastic_reference.py`, which computes the table anew.

    Two codes differ by their steps, 2 %, and by the last printed digit.

    Deflection, rebound and mean force do not feel the step. The largest force is that of one step
    while the node in contact swings against the ball, sampled at other times: 0.5 %.
    """
    raw, mean, deflection, rebound, end = TABLE[recipe]
    results = impact(recipe, "points_on_plate")
    ball, nodes = results.table("impactor_1"), results.table("nodes")
    bottom = nodes[next(name for name in nodes.names if name.endswith("bottom uz"))]
    found = running_mean(ball, 20e-6).max()
    compare.number("largest 20 µs mean of the force", found, mean, unit="N", rel=1e-3)
    compare.number("largest deflection", -bottom.min(), deflection, unit="mm", abs=1e-4)
    compare.number("rebound", ball["velocity"][-1], rebound, unit="mm/s", abs=1.0)
    last = 1e3 * ball["time"][ball["force"] > 0.0].max()
    compare.number("end of contact", last, 1e3 * (end + GAP / VELOCITY), unit="ms", abs=1e-3)
    compare.number("largest force", ball["force"].max(), raw, unit="N", rel=5e-3)


def test_balances_close(impact: Callable[[str, str], Results], compare: Comparison) -> None:
    """Impulse and momentum to the digits of the file; energy but for the onsets of contact.

    An onset is a plastic collision of the ball with the node in the middle. With LE1 that node has
    25/9 mm^2 and half a ply, which takes 2e-5 of the energy; there are a few onsets.
    """
    results = impact("le1", "nodes_on_impactor")
    ball, energy = results.table("impactor_1"), results.table("energy")
    impulse = np.trapezoid(ball["force"], ball["time"])
    gained = MASS * (ball["velocity"][-1] - ball["velocity"][0])
    compare.number("impulse of the force", impulse, gained, unit="N s", rel=10.0 * DIGITS)
    start = 0.5 * MASS * VELOCITY**2
    assert energy["total"] == pytest.approx(np.full(len(energy["total"]), start), rel=DIGITS)
    assert 0.0 <= energy["contact"][-1] < 1e-4 * start
    assert np.diff(energy["contact"]).min() > -DIGITS * start
    assert ball["force"].min() >= 0.0
    assert ball["force"][-1] == 0.0


def test_both_contacts_give_the_same_force(
    impact: Callable[[str, str], Results], compare: Comparison
) -> None:
    """On this mesh one node meets the lowest point of the ball, whichever of them is projected."""
    forces = []
    for method in ("points_on_plate", "nodes_on_impactor"):
        ball = impact("le2", method).table("impactor_1")
        assert ball["contacts"].max() == 1.0
        forces.append(ball["force"])
    close = 1e-6 * forces[1].max()
    compare.values("force, points of the plate beside nodes", *forces, unit="N", abs=close)
