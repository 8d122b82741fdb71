"""A coupon of 3.6 million degrees of freedom on 16 to 512 cores, on paper.

    .venv/bin/python tests/bench/coupon_scaling.py [--repeats N] [--into manual/scaling.md]

Takes ten minutes; needs build/release and the preprocessor. Chunks are timed on this machine, in a
small plate that the caches hold and in one that they do not; the solver divides coupons among 16
ranks without running them. The model is that of `paper.py`: compute by what caches and memory
allow, halo, sums and contact by a network. Prints a table, or puts it into a page.
No test: nothing is compared; `test_paper.py` has the limits of the model.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))

import coupon  # noqa: E402
import jobs  # noqa: E402
import paper  # noqa: E402
from run import machine, publish, table  # noqa: E402
from scaling import SOLVER, check, fastest_steps  # noqa: E402
from shares import ANYHOW  # noqa: E402

TEMPLATE = "astm-d7136"
MARKS = ("<!-- coupon -->", "<!-- /coupon -->")
# the coupon, and coarser ones that 16 ranks divide: about as many chunks for a rank as 128 and 512
# ranks have of the first; mm
QUAD, COARSER, DIVIDED = 1.0, (5.0, 25.0), 16
# coupons that the caches hold, and that they do not; steps that are timed by the difference of two
# runs, for what begins and ends a run of the larger one takes as long as hundreds of its steps
NEAR, FAR, STEPS = 25.0, QUAD, {25.0: 1000, QUAD: 100}
RANKS = (1, 16, 32, 64, 128, 256, 512)
QUADS_OF_CHUNK = 8
# a row of the table of plies in a listing
PLY = r"(?m)^ +\d+(?: +-?\d+\.\d+){3}(?: +\d+){3} "
MICRO, MEGA, GIGA = 1.0e6, 1.0e6, 1.0e9


def deck_of(quad: float, folder: Path) -> Path:
    """The template's coupon of 24 plies without crack lines, on quads of a size and nine nodes."""
    program = ROOT / ".venv/bin/plydyn-pre"
    recipe, deck = folder / "coupon.toml", folder / f"coupon_{quad:g}.k"
    if not recipe.exists():
        subprocess.run(
            [program, "new", recipe, "--template", TEMPLATE], check=True, capture_output=True
        )
    settings = ["cracks=false", "laminate.join_alike=false", "mesh.order=2", f"mesh.quad={quad}"]
    words = [word for setting in settings for word in ("--set", setting)]
    subprocess.run([program, "deck", recipe, "-o", deck, *words], check=True, capture_output=True)
    return deck


def counted(listing: str) -> tuple[int, float]:
    """Degrees of freedom, and bytes that a run has while all is intact."""
    mesh = jobs.number(listing, r"memory of mesh and motion\s+(\S+) MB")
    intact = jobs.number(listing, r"while all is intact\s+(\S+) MB")
    return int(jobs.number(listing, r"degrees of freedom\s+(\d+)")), MEGA * (mesh + intact)


def quads_in(deck: Path) -> int:
    """Quads of a deck."""
    return len(re.findall(r"(?m)^(?: +\d+){2}$", deck.read_text().split("*ELEMENT_PLATE_Q9")[1]))


def load_of(folder: Path, chunks: int, bytes_of: tuple[float, float], repeats: int) -> paper.Load:
    """Times of a chunk, from steps of a small and a large coupon on one core."""
    near, far = (
        jobs.step_time(SOLVER, deck, STEPS[quad], 1, repeats)[0] * QUADS_OF_CHUNK / quads_in(deck)
        for quad, deck in ((quad, deck_of(quad, folder)) for quad in (NEAR, FAR))
    )
    # a chunk of the small coupon has more than its share of the fixtures
    return paper.Load(min(near, far), far, *(each / chunks for each in bytes_of))


def rows_of(
    chunks: int,
    costs: paper.Costs,
    load: paper.Load,
    known: list[paper.Division],
    options: argparse.Namespace,
) -> list[list[str]]:
    """A row for each number of ranks."""
    node = paper.Node(options.cores, options.memory, coupon.limits()[1], options.cache)
    network = paper.Network(options.latency, options.bandwidth)
    rows, alone = [], 0.0
    for ranks in RANKS:
        division = paper.imagine(chunks, ranks, known)
        chunk = paper.time_of_chunk(division.most, ranks, load, node)
        step = paper.step_of(division, replace(costs, chunk=chunk), network, hit=True)
        alone = alone or step.total
        held = min(1.0, node.cache / (division.most * load.held))
        parts = (step.compute, step.halo, step.sums + step.gather, step.contact, step.total)
        gain = alone / step.total
        rows.append(
            [
                f"{ranks}",
                f"{division.most}",
                f"{division.imbalance:.2f}",
                f"{100 * held:.0f} %",
                *(f"{MICRO * part:.0f}" for part in parts),
                f"{gain:.0f}",
                f"{100 * gain / ranks:.0f} %",
                f"{costs.freedoms * chunks / (ranks * step.total):.1e}",
            ]
        )
    return rows


def tables(options: argparse.Namespace) -> str:
    """Measure, divide and extrapolate."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        deck = deck_of(QUAD, folder)
        listing = check(deck, 1, options)
        freedoms, held = counted(listing)
        quads, plies = quads_in(deck), len(re.findall(PLY, listing))
        chunks = -(-quads // QUADS_OF_CHUNK)
        size = coupon.Coupon(freedoms, quads, plies, plies - 1)
        load = load_of(folder, chunks, (held, size.bytes()), options.repeats)
        struck = [jobs.panel_deck(16, folder, spheres) for spheres in (0, 16)]
        flies, hit = fastest_steps(struck, 1000, options.repeats)
        costs = paper.Costs(
            QUADS_OF_CHUNK,
            load.far,
            max(0.0, hit - flies) / 16,
            freedoms / chunks,
            paper.Bytes(0.0, 0.0),
        )
        known = [
            paper.read_division(check(deck_of(each, folder), DIVIDED, options))
            for each in (QUAD, *COARSER)
        ]
        rows = rows_of(chunks, costs, load, known, options)
    said = (
        f"{freedoms:,} degrees of freedom, {size.plies} plies, {quads} quads, {chunks} chunks. A "
        f"chunk takes {MICRO * load.near:.0f} us where the caches hold it, {MICRO * load.far:.0f} "
        f"us where they do not; it has {load.held / MEGA:.2f} MB, of which a step moves "
        f"{load.moved / MEGA:.2f} MB. A node has {options.cores} cores and "
        f"{options.memory / GIGA:g} GB/s, a core {options.cache / MEGA:g} MB of caches; the "
        f"network has {MICRO * options.latency:g} us and {options.bandwidth / GIGA:g} GB/s."
    )
    heads = ["cores", "most chunks", "imbalance", "in the caches", "compute [us]", "halo [us]"]
    heads += ["sums [us]", "contact [us]", "step [us]", "speed-up", "efficiency"]
    return f"{machine()}\n\n{said}\n\n{table([*heads, 'DOF-steps/s/core'], rows)}"


def main() -> None:
    """Measure, and print or write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--launcher", default=ANYHOW, help='the number follows, as "srun -n"')
    parser.add_argument("--repeats", type=int, default=3, help="runs that are timed, by turns")
    parser.add_argument("--cores", type=int, default=64, help="of a node")
    parser.add_argument("--memory", type=float, default=4.0e11, help="of a node, bytes/s")
    parser.add_argument("--cache", type=float, default=5.0e6, help="of a core, bytes")
    parser.add_argument("--latency", type=float, default=1.5e-6, help="of the network, s")
    parser.add_argument("--bandwidth", type=float, default=12.5e9, help="of the network, bytes/s")
    parser.add_argument("--into", type=Path, help=f"page with {MARKS[0]} and {MARKS[1]}")
    options = parser.parse_args()
    publish(tables(options), options.into, MARKS)


if __name__ == "__main__":
    main()
