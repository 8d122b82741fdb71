"""Memory of a plate by the law of its plies: intact, with damage in a tenth, and all damaged.

    .venv/bin/python tests/bench/footprint.py [--print]

Takes some minutes; needs build/release. What `plydyn check` counts is put beside what the system
gives the process at the end of a short run. Strengths are low, and a velocity over the whole plate
or in a circle bends it so fast that every point of every ply and interface there is damaged within
the run. Puts a table into manual/performance.md between its marks. No test: nothing is compared.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))

from run import BUILD, PAGE, machine, publish, table  # noqa: E402

from broken import cracked_ply, weak_ply, yielding  # noqa: E402
from decks import Bond, Deck  # noqa: E402
from elasticity import CARBON  # noqa: E402
from meshes import regular  # noqa: E402

MARKS = ("<!-- footprint -->", "<!-- /footprint -->")
SOLVER = BUILD / "plydyn"
# quads along a side, their size, plies and their angles, mm and degrees
SIDE, QUAD, PLY = 90, 1.0, 0.125
ANGLES = (0.0, 45.0, 90.0, -45.0, -45.0, 90.0, 45.0, 0.0)
STEPS = 30
# an interface that fails at once, so that its points are damaged with those of the plies
BOND = Bond((1.0e5, 5.0e4), (0.1, 0.1), (0.05, 0.1), 1.0, friction=0.3)
# strain rate of the plate and largest velocity of its waves, 1/s and mm/s
RATE, WAVE, WAVES = 1.0e5, 2.0e5, 7.0
MEGA, KIBI, TINY = 1.0e6, 1024.0, 1.0e-9


def elastic(deck: Deck) -> None:
    """Plies without a law."""
    deck.add("MAT_PLY_ELASTIC", (1, CARBON.density, *CARBON.young, *CARBON.poisson), CARBON.shear)


def closing(deck: Deck) -> None:
    """Plies whose cracks close, with a curve of shear."""
    weak_ply(deck, closing=True)


@dataclass(frozen=True)
class Law:
    """A law of plies, with or without interfaces that can fail."""

    name: str
    material: Callable[[Deck], None]
    fails: bool = True


LAWS = (
    Law("elastic, tied", elastic, fails=False),
    Law("elastic, interfaces that fail", elastic),
    Law("`*MAT_PLY_CODAM2`, cracks that stay open", weak_ply),
    Law("`*MAT_PLY_CODAM2`, cracks that close", closing),
    Law("`*MAT_PLY_FRACTURE_3D`", cracked_ply),
    Law("`*MAT_PLASTIC_KINEMATIC`, tied", yielding, fails=False),
)
#: Share of the plate that is damaged
STATES = (0.0, 0.1, 1.0)


def deck_of(law: Law, share: float) -> Deck:
    """A free plate; a share of it, around its middle, moves so that it is damaged."""
    width = SIDE * QUAD
    mesh = regular(width, width, SIDE, SIDE, 9)
    deck = Deck("memory of a law", 1.0, STEPS)
    deck.control()
    deck.mesh(mesh)
    law.material(deck)
    plies = [(1, PLY, angle, 0, k + 1) for k, angle in enumerate(ANGLES)]
    deck.add("PART_COMPOSITE_LONG", "laminate", (1, 0), *plies)
    deck.add("SECTION_LAYERWISE", (1, 0, 1))
    if law.fails:
        deck.cohesive(BOND)
    deck.add("DATABASE_FIELD", "displacement")
    deck.intervals(glstat=1.0, binary_d3plot=1.0)
    x, y = (mesh.points - 0.5 * width).T
    phase = WAVES * np.pi / width
    waves = WAVE * np.sin(phase * (x + 0.3 * y)) * np.cos(phase * (y - 0.2 * x))
    inside = np.ones_like(x)
    if share < 1.0:
        # calm at the border of the circle
        square = (x**2 + y**2) / max(width**2 * share / np.pi, TINY)
        inside = np.maximum(1.0 - square**2, 0.0)
    velocity = np.stack([RATE * x, RATE * y, waves], axis=1) * inside[:, np.newaxis]
    deck.velocities(velocity + np.array([0.0, 0.0, 1.0]))
    return deck


def counted(deck: Path) -> tuple[int, float, float, float]:
    """Degrees of freedom, and what the check counts: mesh and motion, histories, those intact."""
    told = subprocess.run(
        [SOLVER, "check", deck], check=True, capture_output=True, text=True
    ).stdout
    freedoms = re.search(r"degrees of freedom\s+(\d+)", told)
    lines = (
        r"memory of mesh and motion\s+(\S+) MB",
        r"memory of histories\s+(\S+) MB",
        r"while all is intact\s+(\S+) MB",
    )
    sizes = [re.search(line, told) for line in lines]
    assert freedoms
    mesh, whole, intact = (float(each[1]) * MEGA if each else 0.0 for each in sizes)
    return int(freedoms[1]), mesh, whole, intact


def resident(deck: Path) -> float:
    """Most bytes of its own that the process has in memory while it makes steps."""
    begun = deck.with_suffix(".energy.csv")
    begun.unlink(missing_ok=True)
    command = [SOLVER, "run", deck, "-o", deck.parent, "ncpu=1"]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
        most = 0.0
        while process.poll() is None:
            status = Path(f"/proc/{process.pid}/status").read_text()
            found = re.search(r"RssAnon:\s+(\d+) kB", status)
            if found and begun.exists():
                most = max(most, KIBI * float(found[1]))
            time.sleep(0.005)
    if process.returncode or most == 0.0:
        raise SystemExit(f"{deck} ended with code {process.returncode}")
    return most


def row(law: Law, folder: Path) -> list[str]:
    """A row of the table: bytes for each degree of freedom."""
    decks = [deck_of(law, share).write(folder / f"law_{share:g}.k") for share in STATES]
    freedoms, mesh, whole, intact = counted(decks[0])
    numbers = [mesh, intact, whole, mesh + intact, mesh + whole, *map(resident, decks)]
    return [law.name, *(f"{number / freedoms:.0f}" for number in numbers)]


def main() -> None:
    """Measure, and print or write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--print", action="store_true", help="leave the page alone")
    page = None if parser.parse_args().print else PAGE
    os.environ["OMP_WAIT_POLICY"] = "passive"
    heads = ["law of the plies", "mesh and motion", "histories, intact", "all damaged"]
    heads += ["counted, intact", "all damaged", "process, intact", "a tenth damaged", "all damaged"]
    with tempfile.TemporaryDirectory() as name:
        rows = [row(law, Path(name)) for law in LAWS]
    publish(f"{machine()}\n\n{table(heads, rows)}", page, MARKS)


if __name__ == "__main__":
    main()
