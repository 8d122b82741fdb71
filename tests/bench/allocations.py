"""Count the allocations of runs with N and with 2N steps: they agree, for the loop makes none.

    .venv/bin/python tests/bench/allocations.py [PLYDYN]

A few may differ: lists of contacts grow, and the last output depends on the state. Needs a C
compiler and the C library of GNU: a library put in front of it counts.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))

from decks import Deck, Ply, Sphere  # noqa: E402
from elasticity import CARBON  # noqa: E402
from meshes import regular  # noqa: E402

STEPS = 40
FEW = STEPS // 4
FOREVER = 1.0


def impact(steps: int, *, joined: bool) -> Deck:
    """An impact without output between the first and the last step."""
    mesh = regular(24.0, 18.0, 8, 6, 9)
    deck = Deck("impact", FOREVER, steps)
    deck.control(linear=joined, damping=1.0)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.5, 45.0 * k) for k in range(4)])
    if joined:
        deck.interfaces(1.0e5, 1.0e5)
    deck.hold(mesh.boundary(), "xyz")
    deck.sphere(Sphere(8.0, 1.0e-5, (12.0, 9.0, 9.0), (0.0, 0.0, -5.0e3), method=1 + int(joined)))
    deck.add("DATABASE_FIELD", "displacement")
    deck.intervals(glstat=FOREVER, impactor=FOREVER, binary_d3plot=FOREVER)
    return deck


def allocations(solver: Path, deck: Deck) -> int:
    """What the library in front counts."""
    with tempfile.TemporaryDirectory() as folder:
        counter = Path(folder) / "counter.so"
        source = Path(__file__).with_name("allocations.c")
        subprocess.run(["cc", "-O1", "-shared", "-fPIC", source, "-o", counter], check=True)
        path = deck.write(Path(folder) / "deck.k")
        words = [solver, "run", path, "-o", folder, "ncpu=1"]
        environment = {**os.environ, "LD_PRELOAD": str(counter)}
        done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    found = re.search(r"(\d+) allocations", done.stderr)
    if done.returncode or found is None:
        raise SystemExit(done.stdout + done.stderr)
    return int(found[1])


def main() -> None:
    """Compare, and leave with 1 where the loop allocates."""
    solver = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build/release/plydyn"
    worst = 0
    for joined in (False, True):
        counts = [allocations(solver, impact(n, joined=joined)) for n in (STEPS, 2 * STEPS)]
        name = "springs, linear" if joined else "tied, large displacement"
        sys.stdout.write(f"{name}: {counts[0]} in {STEPS} steps, {counts[1]} in {2 * STEPS}\n")
        worst = max(worst, abs(counts[1] - counts[0]))
    sys.exit(1 if worst > FEW else 0)


if __name__ == "__main__":
    main()
