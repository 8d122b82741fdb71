"""What fast paths of the ply-damage law save of a step of 192 Q9/LE2, and what mechanisms cost.

    .venv/bin/python tests/bench/paths.py [--print]

Takes two minutes; needs plydyn and bench in build/release. Puts tables into manual/kernels.md
between its marks: the time of a point of eight plies by a path and by the one that would take its
place, and their difference at all points as a share of the step that takes longer; the time of a
point with planes of fracture beside one of the other law; and the times with and without single
mechanisms. No test: nothing is compared.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))

from run import BUILD, KERNELS, machine, publish, table  # noqa: E402

MARKS = ("<!-- paths -->", "<!-- /paths -->")
# quads, and points of a quad of nine nodes and order 2
POINTS = 192 * 27
NANO, MICRO = 1.0e-9, 1.0e-6
# a path, the state of the points, and what would take its place
PATHS = [("elastic path", "intact", "no-growth path"), ("no-growth path", "damaged", "whole law")]
STEP = ("forces", "accelerate", "advance")
TURNS = 5


def measure() -> dict[str, float]:
    """Values of the bench by their names, the least of some turns."""
    best: dict[str, float] = {}
    for _ in range(TURNS):
        told = subprocess.run(
            [BUILD / "tests/bench/bench", "law"], capture_output=True, text=True, check=True
        ).stdout
        for name, value in (line.split(",") for line in told.splitlines()):
            best[name] = min(float(value), best.get(name, float(value)))
    return best


def share(fast: float, slow: float, step: float) -> float:
    """Share of a step that would be longer by what a path saves at all points.

    ``step`` is that of intact points, on the elastic path; times of points in ns, of steps in us.
    """
    saved = POINTS * NANO * (slow - fast)
    return saved / (MICRO * step + saved)


def rows(times: dict[str, float]) -> list[list[str]]:
    """A row for each path."""
    intact = sum(times[f"step damage law {part}"] for part in STEP)
    elastic = times["intact damage law elastic path"]
    out = []
    for path, state, other in PATHS:
        fast, slow = (times[f"{state} damage law {name}"] for name in (path, other))
        step = intact + POINTS * NANO / MICRO * (fast - elastic)
        out.append(
            [
                path,
                state,
                f"{fast:.1f}",
                other,
                f"{slow:.1f}",
                f"{100 * share(fast, slow, step):.0f} %",
            ]
        )
    return out


# state of a point with planes of fracture, and what of *MAT_PLY_CODAM2 it is set beside
FRACTURE = [
    ("intact", "intact damage law elastic path"),
    ("open", "damaged damage law whole law"),
    ("closed", "damaged damage law whole law"),
]


def fracture_rows(times: dict[str, float]) -> list[list[str]]:
    """A row for each state of a point with planes of fracture."""
    out = []
    for state, other in FRACTURE:
        here, beside = times[f"{state} fracture law"], times[other]
        path = other.split(" law ")[1]
        out.append([state, f"{here:.1f}", path, f"{beside:.1f}", f"{here / beside:.2f}"])
    return out


# a mechanism, what is timed, its unit, and the names in the bench with and without it
POINT = "point with planes of fracture"
MECHANISMS = [
    ("barrier, looked for", "elastic ply element", "ns", "barrier elastic law {}", "strained"),
    ("barrier, acts", "elastic ply element", "ns", "barrier elastic law {}", "pressed"),
    ("barrier, looked for", "ply element with a law", "ns", "barrier plastic law {}", "strained"),
    ("barrier, acts", "ply element with a law", "ns", "barrier plastic law {}", "pressed"),
    ("search for the plane near onset", POINT, "ns", "{} fracture law", "near onset"),
    ("friction of closed cracks", POINT, "ns", "{} fracture law", "closed"),
    ("debris in closed cracks", POINT, "ns", "{} fracture law", "debris"),
    ("permanent shear, hardening", POINT, "ns", "{} fracture law", "hardening"),
    ("permanent shear, power curve", POINT, "ns", "{} fracture law", "power curve"),
    ("crushing", POINT, "ns", "{} fracture law", "crushing"),
    ("average over {} neighbours", "forces, 192 Q9/LE2", "us", "step law {} averages", "with"),
]
WITHOUT = {
    "strained": "rest",
    "pressed": "rest",
    "closed": "smooth",
    "debris": "closed",
    "near onset": "sheared",
    "hardening": "sheared",
    "power curve": "sheared",
    "crushing": "sheared",
    "with": "without",
}


def mechanism_rows(times: dict[str, float]) -> list[list[str]]:
    """A row for each mechanism."""
    counted = next(name for name in times if name.startswith("averages law of "))
    neighbours = counted.removeprefix("averages law of ").removesuffix(" points")
    out = []
    for mechanism, timed, unit, name, state in MECHANISMS:
        here, beside = times[name.format(state)], times[name.format(WITHOUT[state])]
        row = [mechanism.format(neighbours), timed, f"{here:.1f} {unit}", f"{beside:.1f} {unit}"]
        out.append([*row, f"{here / beside:.2f}"])
    alone = f"{times[counted]:.1f} ns"
    out.append([f"average over {neighbours} neighbours", "point, alone", alone, "–", "–"])
    return out


def main() -> None:
    """Measure, and print or write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--print", action="store_true", help="leave the page alone")
    heads = ["path", "points", "ns per point", "else", "ns per point", "saves of a step"]
    times = measure()
    beside = [
        "`*MAT_PLY_FRACTURE_3D`",
        "ns per point",
        "`*MAT_PLY_CODAM2`",
        "ns per point",
        "ratio",
    ]
    costs = ["mechanism", "timed", "with", "without", "ratio"]
    tables = (
        table(heads, rows(times)),
        table(beside, fracture_rows(times)),
        table(costs, mechanism_rows(times)),
    )
    text = "\n\n".join((machine(), *tables))
    publish(text, None if parser.parse_args().print else KERNELS, MARKS)


if __name__ == "__main__":
    main()
