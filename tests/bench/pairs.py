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

Decks = tuple[Path, Path]
Loops = tuple[float, float]


def loops(solver: Path, decks: Decks, threads: int) -> Loops:
    """Seconds in the loop of a short run and of a long one."""
    short, long = (jobs.loop(jobs.run(solver, deck, threads)[0]) for deck in decks)
    return short, long


def twins(solver: Path, decks: list[Decks]) -> Loops:
    """The same of two runs at once, each on one thread: their mean."""
    with ThreadPoolExecutor(len(decks)) as pool:
        each = list(pool.map(lambda pair: loops(solver, pair, 1), decks))
    return statistics.mean(x[0] for x in each), statistics.mean(x[1] for x in each)


def step(times: list[Loops]) -> list[float]:
    """Seconds of a step: the median, and that of the fastest runs."""
    short, long = (min(column) for column in zip(*times, strict=True))
    return [statistics.median(b - a for a, b in times) / STEPS, (long - short) / STEPS]


def measure(solver: Path, folder: Path) -> list[tuple[str, list[float], list[float]]]:
    """What is run; seconds of a step, and the steps of one thread in the same time."""
    deck = jobs.recipe_deck(RECIPE, folder)
    decks = jobs.stopped(deck, STEPS), jobs.stopped(deck, 2 * STEPS)
    second = folder / "second"
    second.mkdir()
    copies = shutil.copy(decks[0], second), shutil.copy(decks[1], second)
    pairs = [decks, (Path(copies[0]), Path(copies[1]))]
    times = [
        (loops(solver, decks, 1), loops(solver, decks, 2), twins(solver, pairs))
        for _ in range(REPEATS)
    ]
    one, two, both = (step(list(column)) for column in zip(*times, strict=True))
    return [
        ("one thread", one, [1.0, 1.0]),
        ("two threads", two, [a / b for a, b in zip(one, two, strict=True)]),
        ("two runs at once", both, [2.0 * a / b for a, b in zip(one, both, strict=True)]),
    ]
