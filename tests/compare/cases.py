"""The decks that two builds run, and in which ways."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import known_names
import spread
from broken import (
    CYCLES,
    KINDS,
    averaged_parts,
    impact,
    metal,
    yielding_by_points,
    yielding_by_power,
)
from decks import Deck

ROOT = Path(__file__).resolve().parents[2]
#: One rank of two threads; two ranks; on from the restart file half-way, on two threads
THREADS, RANKS, RESTART = "threads", "ranks", "restart"
ALL = (THREADS, RANKS, RESTART)
#: Steps of a deck that a test of verification wrote
RECORDED_STEPS = 400
_FAST = "impactor.velocity=[0.0,0.0,-60000.0]"
#: A deck that ends earlier than the others has its restart file earlier
_EARLY = {
    "bonds_of_parts": 8,
    "heads": 8,
    "held_twice": 6,
    "two_parts": 20,
    "implicit_supports": 30,
}
_LATE = {
    "average": 15000,
    "fibre_damage": 15000,
    "plastic_tension": 100000,
    "released": 400,
    "strain_damage": 15000,
    "tension": 6000,
}
#: What a quick comparison runs on two ranks, too: all kinds of exchange between them
_ON_RANKS = (
    "implicit_springs",
    "failing_interfaces",
    "averages_in_two_parts",
    "springs",
    "bricks_of_many_chunks",
)


@dataclass(frozen=True)
class Case:
    """A deck, how to run it, and what must have happened for the comparison to mean something."""

    name: str
    write: Callable[[Path], None]  # puts deck.k into a folder
    ways: tuple[str, ...] = ALL
    quick: tuple[str, ...] = (THREADS, RESTART)  # ways of a quick comparison
    damaged: bool = False  # energy is dissipated, or the comparison does not show what it should


def all_cases() -> Iterator[Case]:
    """Every case, those of a quick comparison among them."""
    yield from _made_cases()
    yield from _deck_cases()
    yield from _recipe_cases()


def _made_cases() -> Iterator[Case]:
    """Decks of the Python tests, with every kind of model."""
    making: dict[str, Callable[[], Deck]] = {
        **KINDS,
        "points of plate": lambda: impact(2),
        "springs of one chunk": lambda: impact(1, "springs"),
        "implicit failing interfaces": lambda: impact(1, "cohesive", implicit=1),
        "thick linear plies": lambda: impact(1, linear=True, order=4),
        "failing plies that close": lambda: impact(1, "springs", failing=True, closing=True),
        "averages in two parts": averaged_parts,
        "metal by points": lambda: metal(yielding_by_points),
        "metal by a power": lambda: metal(yielding_by_power),
        "tied": spread.tied,
        "springs": spread.springs,
        "metal of many chunks": spread.metal,
        "bricks of many chunks": spread.solid,
    }
    lossy = ("metal", "failing", "averages", "bricks of one", "bricks of eight", "bricks that")
    for name, make in making.items():
        every = CYCLES // 2 if make.__module__ == spread.__name__ else 2 * CYCLES
        damaged = name.startswith(lossy) and "many" not in name
        called = name.replace(" ", "_")
        quick = ALL if called in _ON_RANKS else (THREADS, RESTART)
        if f"made/{called}" not in known_names.CHANGED_CASES:
            yield Case(f"made/{called}", _maker(make, every), quick=quick, damaged=damaged)


def _maker(make: Callable[[], Deck], every: int) -> Callable[[Path], None]:
    """What writes a deck of Python, with restart files every so many steps."""

    def write(folder: Path) -> None:
        deck = make()
        deck.add("DATABASE_BINARY_D3DUMP", (every,))
        deck.write(folder / "deck.k")

    return write


def _deck_cases() -> Iterator[Case]:
    """The decks of tests/deck, whole."""
    for path in sorted((ROOT / "tests/deck").glob("*/deck.k")):
        name = path.parent.name
        if f"deck/{name}" in known_names.CHANGED_CASES:
            continue
        every = _EARLY.get(name, _LATE.get(name, 100))
        yield Case(f"deck/{name}", _copier(path, every))


def _copier(path: Path, every: int) -> Callable[[Path], None]:
    """What copies a deck and its include files, with restart files every so many steps."""

    def write(folder: Path) -> None:
        for other in path.parent.glob("*.k"):
            shutil.copy(other, folder)
        _change(folder / "deck.k", every)

    return write


def _change(deck: Path, every: int, last: int = 0) -> None:
    """Ask for restart files, and let the run end with a cycle."""
    text = deck.read_text()
    dumps = f"*DATABASE_BINARY_D3DUMP\n{every},\n*END"
    text = re.sub(r"^\*END\s*\Z", dumps + "\n", text, flags=re.MULTILINE)
    if last:
        head = r"(^\*CONTROL_TERMINATION\n(?:\$.*\n)*"
        columns = head + r"[^,\n]{10})[^,\n]{10}(?=[^,\n]*$)"
        text = re.sub(columns, rf"\g<1>{last:10d}", text, flags=re.MULTILINE)
        text = re.sub(head + r"[^,\n]+,)\d+", rf"\g<1>{last:10d}", text, flags=re.MULTILINE)
    if dumps not in text or (last and f"{last:10d}" not in text):
        raise ValueError(f"{deck} has not the form that restart files are added to")
    deck.write_text(text)


@dataclass(frozen=True)
class _Recipe:
    """How far a recipe is run, and what is changed in it."""

    steps: int = 300
    overrides: tuple[str, ...] = ()
    suffix: str = ""
    ways: tuple[str, ...] = ALL
    quick: tuple[str, ...] = ()
    damaged: bool = False


#: How recipes are run, by the beginning of their names; the first that fits
_RECIPES: tuple[tuple[str, tuple[_Recipe, ...]], ...] = (
    (
        "damage_impact/coarse",
        (
            _Recipe(),
            _Recipe(400, (_FAST,), "_fast", quick=ALL, damaged=True),
            _Recipe(
                400,
                (_FAST, "control.scheme=explicit"),
                "_fast_explicit",
                damaged=True,
            ),
        ),
    ),
    ("damage_impact/quarter_elastic", (_Recipe(),)),
    ("damage_impact/tied", (_Recipe(),)),
    ("damage_impact/", (_Recipe(), _Recipe(600, (_FAST,), "_fast", (THREADS,), damaged=True))),
    ("validation/", (_Recipe(40),)),
    ("elastic_impact/bricks_5", (_Recipe(8, (), "", (THREADS,)),)),
    ("elastic_impact/bricks_3", (_Recipe(8, (), "", (THREADS,)),)),
    ("bimetal_impact/bricks_2", (_Recipe(10, (), "", (THREADS,)),)),
    ("elastic_impact/bricks_1", (_Recipe(20),)),
    ("bimetal_impact/bricks_1", (_Recipe(20),)),
    ("elastic_impact/le2", (_Recipe(quick=(THREADS,)),)),
    ("elastic_impact_ladder/n16", (_Recipe(60),)),
    ("elastic_impact_ladder/n12", (_Recipe(100),)),
    ("", (_Recipe(),)),
)


def recorded_cases(decks: Iterable[Path]) -> Iterator[Case]:
    """The first steps of decks that tests wrote; those with dumps of their own as they are."""
    for path in decks:
        yield Case(f"verification/{path.stem}", _short(path), (THREADS,), quick=())


def _short(path: Path) -> Callable[[Path], None]:
    """What copies a deck and cuts it short, with one restart file at the end."""

    def write(folder: Path) -> None:
        deck = Path(shutil.copy(path, folder / "deck.k"))
        if "DATABASE_BINARY_D3DUMP" not in deck.read_text():
            _change(deck, RECORDED_STEPS, RECORDED_STEPS)

    return write


def _recipe_cases() -> Iterator[Case]:
    """The first steps of all recipes; where plies fail late, of an impact that is faster too."""
    for path in sorted((ROOT / "decks").glob("*/*.toml")):
        name = f"{path.parent.name}/{path.stem}"
        for how in next(hows for start, hows in _RECIPES if name.startswith(start)):
            writer = _recipe_writer(path, how)
            called = f"recipe/{name}{how.suffix}"
            yield Case(called, writer, how.ways, how.quick, how.damaged)


def _recipe_writer(path: Path, how: _Recipe) -> Callable[[Path], None]:
    """What makes the deck of a recipe and cuts it short."""

    def write(folder: Path) -> None:
        program = Path(sys.executable).parent / "plydyn-pre"
        words = [word for override in how.overrides for word in ("--set", override)]
        command = [program, "deck", path, "-o", folder / "deck.k", *words]
        made = subprocess.run(command, capture_output=True, text=True, check=False)
        if made.returncode:
            raise ValueError(f"{path}: {made.stderr.strip() or made.stdout.strip()}")
        _change(folder / "deck.k", how.steps // 2, how.steps)

    return write
