"""What a second thread brings, beside what this machine gives to two runs that share nothing."""

from __future__ import annotations

import shutil
import statistics
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import jobs

# the deck of 57,672 degrees of freedom; steps that are timed, and how often, by turns
RECIPE = "damage_impact/q192_le2"
STEPS, REPEATS = 2000, 9


def twins(solver: Path, decks: list[jobs.Decks]) -> jobs.Loops:
    """The same of two runs at once, each on one thread: their mean."""
    with ThreadPoolExecutor(len(decks)) as pool:
        each = list(pool.map(lambda pair: jobs.loops(solver, pair, 1), decks))
    return statistics.mean(x[0] for x in each), statistics.mean(x[1] for x in each)


def measure(solver: Path, folder: Path) -> list[tuple[str, tuple[float, float], list[float]]]:
    """What is run; seconds of a step, and the steps of one thread in the same time."""
    deck = jobs.recipe_deck(RECIPE, folder)
    decks = jobs.stopped(deck, STEPS), jobs.stopped(deck, 2 * STEPS)
    second = folder / "second"
    second.mkdir()
    copies = shutil.copy(decks[0], second), shutil.copy(decks[1], second)
    pairs = [decks, (Path(copies[0]), Path(copies[1]))]
    times = [
        (jobs.loops(solver, decks, 1), jobs.loops(solver, decks, 2), twins(solver, pairs))
        for _ in range(REPEATS)
    ]
    one, two, both = (
        jobs.seconds_of_step(list(column), STEPS) for column in zip(*times, strict=True)
    )
    return [
        ("one thread", one, [1.0, 1.0]),
        ("two threads", two, [a / b for a, b in zip(one, two, strict=True)]),
        ("two runs at once", both, [2.0 * a / b for a, b in zip(one, both, strict=True)]),
    ]
