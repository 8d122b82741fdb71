"""Runs of the solver, timed by the difference between two numbers of steps."""

from __future__ import annotations

import os
import re
import shutil
import statistics
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from decks import Deck, Ply
from elasticity import CARBON
from meshes import regular

Words = Sequence[str | Path]
Decks = tuple[Path, Path]
Loops = tuple[float, float]

ROOT = Path(__file__).resolve().parents[2]
MEGABYTE = 1.0e6
KILOBYTE = 1024.0
FOREVER = 1.0
# the panels: side of a quad, plies and their angles, and spheres that hit them; mm, t, degrees
QUAD, PLY, RADIUS, MASS = 1.5, 0.25, 4.0, 1.0e-4
# largest radius of spheres side by side, over the distance of their centres
APART = 0.45
ANGLES = (0, 45, 90, -45, -45, 90, 45, 0)


@dataclass(frozen=True)
class Timing:
    """What a step of a job takes."""

    freedoms: int
    step: float  # s on the wall
    steps: int  # of the whole run
    memory: float  # MB that the listing counts, without histories
    peak: float  # MB that the process had at most

    def rate(self, threads: int) -> float:
        """Degrees of freedom and steps per second and core."""
        return self.freedoms / (self.step * threads)


def recipe_deck(recipe: str, folder: Path) -> Path:
    """The deck of a recipe of decks/."""
    program = Path(sys.executable).parent / "plydyn-pre"
    words = [program if program.exists() else shutil.which("plydyn-pre") or program, "deck"]
    deck = folder / (recipe.replace("/", "_") + ".k")
    subprocess.run(
        [*words, ROOT / f"decks/{recipe}.toml", "-o", deck],
        check=True,
        capture_output=True,
    )
    return deck


def panel_deck(quads: int, folder: Path, spheres: int = 0) -> Path:
    """A square panel of eight tied plies of order 2 that is held all round and flies on.

    Into some spheres above its diagonal, if it is to be hit.
    """
    mesh = regular(QUAD * quads, QUAD * quads, quads, quads, 9)
    deck = Deck("panel", FOREVER)
    deck.control()
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, PLY, angle) for angle in ANGLES])
    deck.hold(mesh.boundary(), "xyz")
    deck.add("INITIAL_VELOCITY", (0,), (0.0, 0.0, 1.0e3))
    # bodies in each other's place are refused
    radius = min(RADIUS, APART * QUAD * quads * 2.0**0.5 / (spheres + 1))
    height = 0.5 * PLY * len(ANGLES) + radius
    for k in range(1, spheres + 1):
        place = QUAD * quads * k / (spheres + 1)
        deck.add("IMPACTOR_SPHERE", (k, radius, MASS, place, place, height), (0.0, 0.0, -1.0e3))
        deck.add("CONTACT_IMPACTOR", (k, k, 1, 1, 2))
    deck.add("DATABASE_FIELD", "displacement")
    deck.intervals(glstat=FOREVER, binary_d3plot=FOREVER, impactor=FOREVER)
    return deck.write(folder / f"panel_{quads}_{spheres}.k")


def stopped(deck: Path, steps: int) -> Path:
    """The deck, stopped after some steps."""
    text, count = re.subn(
        r"(\*CONTROL_TERMINATION\n(?:\$.*\n)*)[ ,]*([-+.\deE]+)[ ,]+\d+.*",
        rf"\g<1>\g<2>,{steps}",
        deck.read_text(),
    )
    if count != 1:
        raise ValueError(f"{deck} has no *CONTROL_TERMINATION to replace")
    short = deck.with_name(f"{deck.stem}_{steps}.k")
    short.write_text(text)
    return short


def run(solver: Path, deck: Path, threads: int, launcher: Words = ()) -> tuple[str, float]:
    """Run a deck; its listing, and the most memory that the process had, MB.

    With a launcher it is the launcher's memory.
    """
    words = [*launcher, solver, "run", deck, "-o", deck.parent, f"ncpu={threads}"]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        assert process.stderr is not None
        said = process.stderr.read().decode()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise RuntimeError(f"{deck}: {said}")
    return deck.with_suffix(".out").read_text(), usage.ru_maxrss * KILOBYTE / MEGABYTE


def memory(
    solver: Path, deck: Path, launcher: Words, environment: Mapping[str, str]
) -> list[float]:
    """Most memory of each rank, MB, from the largest down."""
    watch = [sys.executable, ROOT / "tests/bench/memory.py"]
    told = subprocess.run(
        [*launcher, *watch, solver, "run", deck, "-o", deck.parent, "ncpu=1"],
        capture_output=True,
        text=True,
        check=True,
        env=environment,
    ).stderr
    lines = (line.split() for line in told.splitlines() if line.startswith("memory "))
    return sorted((float(line[1]) for line in lines), reverse=True)


def number(listing: str, pattern: str) -> float:
    """A number of a listing."""
    found = re.search(pattern, listing)
    if found is None:
        raise ValueError(f"the listing has no line like {pattern}")
    return float(found[1])


def loop(listing: str) -> float:
    """Seconds in the loop."""
    return number(listing, r"seconds\s+(\S+) in the loop")


def loops(solver: Path, decks: Decks, threads: int, launcher: Words = ()) -> Loops:
    """Seconds in the loop of a short run and of a long one."""
    short, long = (loop(run(solver, deck, threads, launcher)[0]) for deck in decks)
    return short, long


def seconds_of_step(times: list[Loops], steps: int) -> tuple[float, float]:
    """Seconds of a step from runs of some steps and of twice as many: median, and fastest run.

    A machine that changes its pace between two runs makes their difference too large or too small;
    the fastest long run is the one that others on the machine have held up least. It counts what
    begins a loop, too, rather than the difference of two runs that need not be alike.
    """
    differences = [long - short for short, long in times]
    return statistics.median(differences) / steps, min(long for _, long in times) / (2 * steps)


def step_time(
    solver: Path, deck: Path, steps: int, threads: int, repeats: int = 3, launcher: Words = ()
) -> tuple[float, float]:
    """Seconds of a step, and most memory of the longer runs, MB.

    The difference of the fastest long and the fastest short run: what else the machine does only
    ever lengthens a run, and a pair of which one was held up says nothing.
    """
    decks = stopped(deck, steps), stopped(deck, 2 * steps)
    pairs = [[run(solver, each, threads, launcher) for each in decks] for _ in range(repeats)]
    short, long = (min(loop(pair[k][0]) for pair in pairs) for k in range(2))
    if long <= short:
        raise ValueError(f"{deck}: the machine is too busy to time a step of {steps}")
    return (long - short) / steps, max(pair[1][1] for pair in pairs)


def measure(solver: Path, deck: Path, steps: int, threads: int, repeats: int = 3) -> Timing:
    """Time and memory of a job."""
    checked = subprocess.run([solver, "check", deck], check=True, capture_output=True, text=True)
    step, peak = step_time(solver, deck, steps, threads, repeats)
    return Timing(
        freedoms=int(number(checked.stdout, r"degrees of freedom\s+(\d+)")),
        step=step,
        steps=int(number(checked.stdout, r"\nsteps\s+(\d+)")),
        memory=number(checked.stdout, r"memory of mesh and motion\s+(\S+) MB"),
        peak=peak,
    )
