"""Measure steps of whole coupons, which no cache holds, and put a table into the manual.

    .venv/bin/python tests/bench/coupon.py [--beside PLYDYN] [--deck NAME] [--print]

Takes twenty minutes; needs plydyn and bench in build/release. `--beside` names a solver of another
commit, whose runs are made by turns with those of this one. The decks are frozen: they do not move
with the defaults of recipes. A step is the difference of two runs that end one row of energies
apart, with all rows that recipes write by default. No test: nothing is compared with a limit.
"""

from __future__ import annotations

import argparse
import lzma
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))

import flops  # noqa: E402
from run import BUILD, PAGE, machine, publish, table  # noqa: E402

DECKS = ("t700gc_25J_1mm", "astm_d7136_standard")
# time of the first run and of the row behind it, seconds; how much faster the impactor is
STATES = {"before damage": (5.0e-7, 1.0), "amid damage": (6.0e-6, 10.0)}
ROW = 5.0e-6
MICRO, MILLI, MEGA, GIGA = 1.0e-6, 1.0e-3, 1.0e6, 1.0e9
# bytes of a step that cannot be saved: displacement, velocity and force of a degree of freedom are
# read and written, masses and their inverses read, one for three of them; of an intact point of a
# ply the largest and the permanent shear strain, of one of an interface its damage
FREEDOM = 8 * (3 * 2 + 2 / 3)
PLY_POINT, INTERFACE_POINT = 2 * 8, 8
NODES, ORDER, LANES = 9, 1, 8


@dataclass(frozen=True)
class Coupon:
    """Sizes of a deck."""

    freedoms: int
    quads: int
    plies: int
    interfaces: int

    def bytes(self) -> float:
        """Bytes that an intact step must move."""
        blocks = -(-self.plies // LANES) * LANES
        between = -(-self.interfaces // LANES) * LANES
        points = NODES * (ORDER + 1) * blocks * PLY_POINT + NODES * between * INTERFACE_POINT
        return FREEDOM * self.freedoms + self.quads * points

    def operations(self) -> float:
        """Multiplications and additions of the plies in an intact step."""
        return self.quads * self.plies * flops.plate(NODES, ORDER, "damage large")


@dataclass(frozen=True)
class Crew:
    """Who makes a run; a crew of one is timed by its processor time, others on the wall."""

    solver: Path
    threads: int = 1
    ranks: int = 1

    def is_alone(self) -> bool:
        """Whether there is no other to wait for."""
        return self.threads * self.ranks == 1


# who runs, and decks that end one row of energies apart
Job = tuple[Crew, tuple[Path, Path]]


def thawed(name: str, folder: Path, end: float, speed: float) -> Path:
    """A frozen deck that ends at a time, with an impactor so many times as fast."""
    packed = ROOT / f"tests/bench/decks/{name}.k.xz"
    text = lzma.decompress(packed.read_bytes()).decode()
    text, ends = re.subn(
        r"(\*CONTROL_TERMINATION\n\$.*\n) *\S+", lambda found: f"{found[1]}{end:>10.3g}", text
    )
    text, hits = re.subn(
        r"(\$# +vx +vy +vz.*\n *\S+ +\S+ +)(\S+)",
        lambda found: f"{found[1]}{speed * float(found[2]):>{len(found[2])}.0f}",
        text,
    )
    if (ends, hits) != (1, 1):
        raise SystemExit(f"{packed} has not one end and one impactor")
    deck = folder / f"{name}_{end:.3g}_{speed:.0f}.k"
    deck.write_text(text)
    return deck


def sizes(deck: Path) -> Coupon:
    """What the check of a deck says, and the plies and interfaces that it has."""
    text = deck.read_text()
    told = subprocess.run(
        [BUILD / "plydyn", "check", deck], check=True, capture_output=True, text=True
    ).stdout
    plies = re.search(r"\*PART_COMPOSITE_LONG\n(?:.*\n){4}((?: +\S+){6}\n(?: .*\n)*)", text)
    pairs = re.search(r"\*INTERFACE_COHESIVE\n\$.*\n((?: .*\n)+)", text)
    counted = re.search(r"degrees of freedom\s+(\d+)", told)
    assert plies and pairs and counted
    count = len(plies[1].splitlines())
    joined = 0
    for line in pairs[1].splitlines():
        first, last = (int(word) for word in line.split()[1:3])
        joined += last - first + 1 if first else count - 1
    quads = len(re.findall(r"(?m)^(?: +\d+){2}$", text.split("*ELEMENT_PLATE_Q9")[1]))
    return Coupon(int(counted[1]), quads, count, joined)


def run(crew: Crew, deck: Path) -> tuple[float, int]:
    """Seconds of a run, and its steps."""
    words = [crew.solver, "run", deck, "-o", deck.parent, f"ncpu={crew.threads}"]
    if crew.ranks > 1:
        words = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(crew.ranks), *words]
    quiet = {"OMP_WAIT_POLICY": "passive", "OMPI_MCA_mpi_yield_when_idle": "1"}
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL, env={**os.environ, **quiet})
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    listing = deck.with_suffix(".out").read_text()
    ended = re.findall(r"cycle (\d+), time", listing)
    return sum(after[:2]) - sum(before[:2]) if crew.is_alone() else wall, int(ended[-1])


def steps_of(jobs: Sequence[Job], repeats: int) -> list[float]:
    """Seconds of a step of some jobs, by turns.

    The difference of the fastest run up to each end: what else the machine does only ever
    lengthens a run.
    """
    turns = [[[run(crew, deck) for deck in decks] for crew, decks in jobs] for _ in range(repeats)]
    seconds = []
    for own in zip(*turns, strict=True):
        (short, few), (long, many) = (min(runs) for runs in zip(*own, strict=True))
        seconds.append((long - short) / (many - few))
    return seconds


def limits() -> tuple[float, float, float]:
    """Most operations and bytes of a core in a second, and bytes of two cores at once."""
    told = subprocess.run(
        [BUILD / "tests/bench/bench", "bandwidth"], capture_output=True, text=True, check=True
    ).stdout
    value = dict(line.split(",") for line in told.splitlines())
    names = ("peak GFLOP/s", "bandwidth GB/s", "of two cores GB/s")
    peak, alone, both = (GIGA * float(value[name]) for name in names)
    return peak, alone, both


def measured(frozen: str, solvers: list[Path], folder: Path, repeats: int) -> str:
    """Steps of one deck by turns, and of two threads and two ranks."""
    peak, bandwidth, both = limits()
    rows = []
    for state, (start, speed) in STATES.items():
        decks = (thawed(frozen, folder, start, speed), thawed(frozen, folder, start + ROW, speed))
        coupon = sizes(decks[0])
        crews = [Crew(solver) for solver in solvers]
        if state == "before damage":
            crews += [Crew(solvers[0], threads=2), Crew(solvers[0], ranks=2)]
        here, before, *teams = steps_of([(crew, decks) for crew in crews], repeats)
        row = [
            state,
            f"{coupon.freedoms:,}",
            f"{here / MILLI:.1f}",
            f"{coupon.freedoms / here:.1e}",
            f"{coupon.bytes() / MEGA:.0f}",
            f"{100 * coupon.bytes() / bandwidth / here:.0f} %",
            f"{100 * coupon.operations() / here / peak:.0f} %",
            f"{before / here:.2f}",
            *(f"{here / each:.2f}" for each in teams),
        ]
        rows.append([*row, "", ""][:10])
    heads = ["state", "DOF", "ms per step", "DOF-steps/s/core", "least MB", "of bandwidth"]
    heads += ["of peak, plies alone", f"{name_of(solvers[-1])} takes, times"]
    heads += ["two threads, times one", "two ranks, times one"]
    said = f"A core: {peak / GIGA:.0f} GFLOP/s, {bandwidth / GIGA:.1f} GB/s. "
    said += f"Two at once: {both / GIGA:.1f} GB/s, {both / bandwidth:.2f} times one."
    return f"{said}\n\n{table(heads, rows)}"


def name_of(solver: Path) -> str:
    """The commit of a solver."""
    told = subprocess.run([solver, "--version"], capture_output=True, text=True, check=True).stdout
    found = re.search(r"\((\w{7})", told)
    return found[1] if found else solver.name


def main() -> None:
    """Measure, and print or write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--beside", type=Path, help="a solver of another commit")
    parser.add_argument("--deck", choices=DECKS, help="measure this one alone")
    parser.add_argument("--repeats", type=int, default=3, help="turns of each pair")
    parser.add_argument("--print", action="store_true", help="leave the page alone")
    chosen = parser.parse_args()
    for frozen in [chosen.deck] if chosen.deck else DECKS:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            own = Path(shutil.copy(BUILD / "plydyn", folder))  # a build may go on beside
            solvers = [own, chosen.beside or own]
            text = measured(frozen, solvers, folder, chosen.repeats)
        marks = f"<!-- {frozen} -->", f"<!-- /{frozen} -->"
        publish(f"{machine()}\n\n{text}", None if chosen.print else PAGE, marks)


if __name__ == "__main__":
    main()
