"""How plydyn scales with ranks: measured on this machine, and on paper for many more.

    .venv/bin/python tests/bench/scaling.py [--ranks 1,2,4] [--launcher "srun -n"] [--into PAGE]

Measures the time of a step on some numbers of ranks, and lets the solver divide panels without
running them; from the time of a chunk, these divisions, what ranks have of a panel (`shares.py`)
and a network it computes them up to 1024 ranks. Prints tables, or puts them into a page between its
marks. Needs build/release and the preprocessor. No test: nothing is compared with anything.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))

import jobs  # noqa: E402
import paper  # noqa: E402
from run import machine, publish, table  # noqa: E402
from shares import (  # noqa: E402
    ANYHOW,
    PANELS,
    SOLVER,
    freedoms_of,
    launcher_of,
    memory,
    numbers,
    patient,
)

MARKS = ("<!-- scaling -->", "<!-- /scaling -->")
RECIPE, RECIPE_STEPS = "damage_impact/q192_le2", 1500
# quads along a side of a panel: what is timed, and the large one on paper
TIMED, TIMED_STEPS, LARGE = 40, 400, 156
# how often a step is timed: ranks wait for the slowest, and one that the machine halts is slow
REPEATS = 9
# so many that hit a panel that their contact is seen, and one so small that it is
SPHERES, STRUCK, STRUCK_STEPS = 16, 16, 1000
# panels and ranks that the solver divides: about as many chunks for a rank as on paper
DIVIDED = ((156, 16), (80, 16), (40, 16), (40, 64))
MANY = (1, 4, 16, 64, 256, 1024)
# quads for each rank where the model grows with the ranks
WEAK = 400
MICRO, MEGA, GIGA = 1.0e6, 1.0e-6, 1.0e-9


def measured(title: str, deck: Path, steps: int, options: argparse.Namespace) -> list[list[str]]:
    """Time of a step over ranks, a row for each number: runs made by turns."""
    decks = jobs.stopped(deck, steps), jobs.stopped(deck, 2 * steps)
    times: dict[int, list[jobs.Loops]] = {ranks: [] for ranks in options.ranks}
    for _ in range(REPEATS):
        for ranks, own in times.items():
            own.append(jobs.loops(SOLVER, decks, 1, launcher_of(options.launcher, ranks)))
    rows, alone = [], (0.0, 0.0)
    for ranks, own in times.items():
        step = jobs.seconds_of_step(own, steps)
        if not any(alone):
            alone = (step[0] * ranks, step[1] * ranks)
        gains = [a / b for a, b in zip(alone, step, strict=True)]
        rows.append(
            [
                title,
                f"{ranks}",
                *(f"{MICRO * each:.0f}" for each in step),
                *(f"{gain:.2f}" for gain in gains),
                f"{100 * gains[1] / ranks:.0f} %",
            ]
        )
    return rows


def check(deck: Path, ranks: int, options: argparse.Namespace) -> str:
    """The listing of a deck, not run."""
    words = [*launcher_of(options.launcher, ranks), SOLVER, "check", deck]
    done = subprocess.run(words, capture_output=True, text=True, check=False, env=patient())
    if done.returncode:
        raise RuntimeError(f"{deck} on {ranks} ranks: {done.stderr}")
    return done.stdout


def divide(folder: Path, options: argparse.Namespace) -> list[paper.Division]:
    """Let the solver divide panels."""
    return [
        paper.read_division(check(jobs.panel_deck(quads, folder), ranks, options))
        for quads, ranks in DIVIDED
    ]


def division_rows(known: list[paper.Division]) -> list[list[str]]:
    """What the solver said of its divisions."""
    return [
        [
            f"{one.chunks}",
            f"{one.ranks}",
            f"{one.mean:.2f}",
            f"{one.most}",
            f"{one.imbalance:.2f}",
            f"{100 * one.shared / one.nodes:.0f} %",
            f"{one.meets}",
            f"{1.0e-3 * one.sends:.0f}",
            f"{1.0e-3 * one.sends_in_all:.0f}",
        ]
        for one in known
    ]


def fastest_steps(decks: list[Path], steps: int, repeats: int = REPEATS) -> list[float]:
    """Seconds of a step of some decks on one rank, by turns, from the fastest runs."""
    pairs = [(jobs.stopped(deck, steps), jobs.stopped(deck, 2 * steps)) for deck in decks]
    times = [[jobs.loops(SOLVER, pair, 1) for pair in pairs] for _ in range(repeats)]
    return [jobs.seconds_of_step(list(own), steps)[1] for own in zip(*times, strict=True)]


def costs_of(folder: Path, quads: int, each: paper.Bytes) -> paper.Costs:
    """Times of a chunk and of contact on one rank."""
    chunks = TIMED**2 // quads
    (step,) = fastest_steps([jobs.panel_deck(TIMED, folder)], TIMED_STEPS)
    struck = [jobs.panel_deck(STRUCK, folder, spheres) for spheres in (0, SPHERES)]
    flies, hit = fastest_steps(struck, STRUCK_STEPS)
    return paper.Costs(
        quads=quads,
        chunk=step / chunks,
        contact=max(0.0, hit - flies) / SPHERES,
        freedoms=freedoms_of(TIMED, folder) / chunks,
        memory=each,
    )


def strong_rows(
    chunks: int, costs: paper.Costs, known: list[paper.Division], network: paper.Network
) -> list[list[str]]:
    """One panel on more and more ranks."""
    rows, alone, alone_hit = [], 0.0, 0.0
    for ranks in MANY:
        division = paper.imagine(chunks, ranks, known)
        step = paper.step_of(division, costs, network)
        hit = paper.step_of(division, costs, network, hit=True)
        alone, alone_hit = alone or step.total, alone_hit or hit.total
        gain = alone / step.total
        rows.append(
            [
                f"{ranks}",
                f"{division.imbalance:.2f}",
                *(f"{MICRO * part:.0f}" for part in (step.compute, step.halo, step.sums)),
                f"{MICRO * step.total:.0f}",
                f"{gain:.0f}",
                f"{100 * gain / ranks:.0f} %",
                *(f"{MICRO * part:.0f}" for part in (hit.gather, hit.contact)),
                f"{alone_hit / hit.total:.0f}",
            ]
        )
    return rows


def weak_rows(
    costs: paper.Costs, known: list[paper.Division], network: paper.Network
) -> list[list[str]]:
    """A panel that grows with the ranks."""
    rows, alone, alone_hit = [], 0.0, 0.0
    for ranks in MANY:
        chunks = WEAK * ranks // costs.quads
        freedoms = costs.freedoms * chunks
        division = paper.imagine(chunks, ranks, known)
        step = paper.step_of(division, costs, network)
        hit = paper.step_of(division, costs, network, hit=True)
        alone, alone_hit = alone or step.total, alone_hit or hit.total
        rows.append(
            [
                f"{ranks}",
                f"{MEGA * freedoms:.2f}",
                f"{MICRO * step.total:.0f}",
                f"{100 * alone / step.total:.0f} %",
                f"{MICRO * hit.total:.0f}",
                f"{100 * alone_hit / hit.total:.0f} %",
                f"{GIGA * costs.memory.of_rank(ranks) * freedoms:.2f}",
            ]
        )
    return rows


def on_paper(folder: Path, options: argparse.Namespace, each: paper.Bytes) -> list[str]:
    """Tables of what was divided, and of what follows."""
    known = divide(folder, options)
    quads = round(DIVIDED[0][0] ** 2 / known[0].chunks)
    costs = costs_of(folder, quads, each)
    network = paper.Network(options.latency, options.bandwidth)
    chunks = LARGE**2 // quads
    said = (
        f"A chunk of {quads} quads takes {MICRO * costs.chunk:.1f} us on one rank, contact "
        f"of an impactor {MICRO * costs.contact:.1f} us on every rank; the network has "
        f"{MICRO * network.latency:g} us and {GIGA * network.bandwidth:g} GB/s."
    )
    heads = ["ranks", "imbalance", "compute [us]", "halo [us]", "sums [us]", "step [us]"]
    return [
        "#### As the solver divides",
        table(
            [
                *("chunks", "ranks", "for each", "most of a rank", "imbalance", "nodes of others"),
                *("meets", "a rank sends [kB]", "all send [kB]"),
            ],
            division_rows(known),
        ),
        "#### Extrapolated, one panel on more ranks",
        f"{LARGE} x {LARGE} quads, {chunks} chunks, {MEGA * costs.freedoms * chunks:.1f} million "
        f"degrees of freedom. {said}",
        table(
            [
                *heads,
                *("speed-up", "efficiency", "points gathered [us]", "contact [us]", "speed-up hit"),
            ],
            strong_rows(chunks, costs, known, network),
        ),
        "#### Extrapolated, a panel that grows with the ranks",
        f"{WEAK} quads, {WEAK // quads} chunks for each rank.",
        table(
            [
                *("ranks", "million DOF", "step [us]", "efficiency", "step hit [us]"),
                *("efficiency hit", "a rank but the root [GB]"),
            ],
            weak_rows(costs, known, network),
        ),
    ]


def tables(options: argparse.Namespace) -> str:
    """Measure everything."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        panel = f"panel, {TIMED} x {TIMED} quads"
        rows = measured("192 Q9/LE2", jobs.recipe_deck(RECIPE, folder), RECIPE_STEPS, options)
        rows += measured(panel, jobs.panel_deck(TIMED, folder), TIMED_STEPS, options)
        _, bytes_each = memory(PANELS[0], folder, options.memory_ranks, options.launcher)
        parts = [
            machine(),
            "#### Measured, one thread each",
            table(
                [
                    *("model", "ranks", "us per step, median", "fastest"),
                    *("speed-up, median", "fastest", "efficiency, fastest"),
                ],
                rows,
            ),
            *on_paper(folder, options, bytes_each),
        ]
    return "\n\n".join(parts)


def main() -> None:
    """Measure, extrapolate, and print or write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ranks", type=numbers, default=[1, 2], help="to be timed, as 1,2,4")
    parser.add_argument("--memory-ranks", type=numbers, default=[2, 4])
    parser.add_argument("--launcher", default=ANYHOW, help='the number follows, as "srun -n"')
    parser.add_argument("--latency", type=float, default=1.5e-6, help="of the network, s")
    parser.add_argument("--bandwidth", type=float, default=12.5e9, help="of the network, bytes/s")
    parser.add_argument("--into", type=Path, help=f"page with {MARKS[0]} and {MARKS[1]}")
    options = parser.parse_args()
    publish(tables(options), options.into, MARKS)


if __name__ == "__main__":
    main()
