"""Measure plydyn on this machine, and put the tables into manual/performance.md and kernels.md.

    .venv/bin/python tests/bench/run.py [--print]

Takes five to ten minutes on a quiet machine; needs plydyn and bench in build/release, and the
preprocessor. `--print` shows the tables and leaves the pages alone. No test: nothing is compared
with anything.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from datetime import date
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))

import flops  # noqa: E402
import jobs  # noqa: E402
import pairs  # noqa: E402

PAGE, KERNELS = ROOT / "manual/performance.md", ROOT / "manual/kernels.md"
BUILD = ROOT / "build/release"
MARKS = ("<!-- bench -->", "<!-- /bench -->")

# recipe, name in the paper, and what the paper says: Table 2 on one core, Table 7 on six
ELASTIC = [
    ("elastic_impact/le1", "CUF-LE1", "0:10:29"),
    ("elastic_impact/le2", "CUF-LE2", "0:37:55"),
    ("elastic_impact/le3", "CUF-LE3", "1:30:46"),
    ("elastic_impact/3le1", "CUF-3LE1", "1:38:53"),
]
DAMAGE = [
    ("damage_impact/q132_le2", "132 Q9/LE2", "5:13:44"),
    ("damage_impact/q192_le1", "192 Q9/LE1", "6:45:13"),
    ("damage_impact/q192_le2", "192 Q9/LE2", "8:46:22"),
    ("damage_impact/q192_le3", "192 Q9/LE3", "11:37:57"),
    ("damage_impact/q260_le2", "260 Q9/LE2", "11:49:58"),
]
# and bricks, of which there are so many, on one core; steps that are timed, and repeats
BRICKS = [
    ("elastic_impact/bricks_1", "ABQ-Coarse, elastic", 102_400, "0:09:04", 100, 3),
    ("elastic_impact/bricks_3", "ABQ-Medium, elastic", 307_200, "1:15:06", 40, 3),
    ("elastic_impact/bricks_5", "ABQ-Refined, elastic", 512_000, "3:16:33", 25, 3),
    ("bimetal_impact/bricks_1", "ABQ-Coarse, metals", 102_400, "0:24:18", 100, 3),
    ("bimetal_impact/bricks_2", "ABQ-Refined, metals", 270_848, "1:55:12", 40, 3),
]
STEPS = 1000
# quads along a side of the panels, and steps that are timed
PANELS = [(10, 800), (20, 200), (40, 60), (80, 40), (156, 20)]
THREADS = (1, 2)


def table(heads: list[str], rows: list[list[str]]) -> str:
    """A table of the manual, names left and numbers right."""
    marks = ["---"] + ["---:"] * (len(heads) - 1)
    return "\n".join("| " + " | ".join(row) + " |" for row in [heads, marks, *rows])


def publish(text: str, page: Path | None, marks: tuple[str, str]) -> None:
    """Print tables, or put them into a page between its marks."""
    if page is None:
        sys.stdout.write(text + "\n")
        return
    whole, (first, last) = page.read_text(), marks
    before, after = whole.split(first)[0], whole.split(last)[1]
    page.write_text(f"{before}{first}\n\n{text}\n\n{last}{after}")


def clock(seconds: float) -> str:
    """Hours, minutes, seconds."""
    whole = round(seconds)
    return f"{whole // 3600}:{whole // 60 % 60:02d}:{whole % 60:02d}"


def machine() -> str:
    """Processor, cores, and the build."""
    told = subprocess.run(["lscpu"], capture_output=True, text=True, check=True).stdout
    name = next(line.split(":")[1].strip() for line in told.splitlines() if "Model name" in line)
    build = subprocess.run(
        [BUILD / "plydyn", "--version"], capture_output=True, text=True, check=True
    ).stdout
    words = "; ".join(line.strip() for line in build.splitlines() if line.strip())
    return f"{name}, {os.cpu_count()} cores. {words}. Measured on {date.today().isoformat()}."


def kernels() -> str:
    """Time and share of the peak of every kernel."""
    bench = BUILD / "tests/bench/bench"
    if not bench.is_file():
        raise SystemExit(f"there is no {bench}: cmake --build --preset release")
    told = subprocess.run([bench], capture_output=True, text=True, check=True).stdout
    times = {name: float(value) for name, value in (line.split(",") for line in told.splitlines())}
    peak = times.pop("peak GFLOP/s")
    rows, others = [], []
    for name, value in times.items():
        kind = " ".join(name.split()[:-2])
        if kind not in ("linear", "large", "damage linear", "damage large"):
            unit = "us" if kind.startswith("step") else "ns"
            others.append([name, f"{value:.1f} {unit}"])
            continue
        nodes, order = (int(word.lstrip("qle")) for word in name.split()[-2:])
        count = flops.plate(nodes, order, kind)
        share = 100.0 * count / (value * peak)
        rows.append([name, f"{value:.1f}", f"{count}", f"{count / value:.0f}", f"{share:.0f} %"])
    heads = ["kernel", "ns per ply element", "operations", "GFLOP/s", "share of the peak"]
    return (
        f"Peak of a core, multiplications and additions only: {peak:.0f} GFLOP/s.\n\n"
        + table(heads, rows)
        + "\n\n"
        + table(["other kernels, per element; parts of a step of 192 Q9/LE2", "time"], others)
    )


def models(chosen: list[tuple[str, str, str]], folder: Path) -> str:
    """Time of whole steps of the paper's models, and of whole runs from them."""
    rows = []
    for recipe, name, paper in chosen:
        deck = jobs.recipe_deck(recipe, folder)
        one, two = (jobs.measure(BUILD / "plydyn", deck, STEPS, n) for n in THREADS)
        rows.append(
            [
                name,
                f"{one.freedoms:,}",
                f"{one.steps:,}",
                f"{1e6 * one.step:.0f}",
                f"{1e6 * two.step:.0f}",
                f"{one.rate(1):.2e}",
                f"{two.rate(2):.2e}",
                clock(one.step * one.steps),
                paper,
            ]
        )
    heads = ["model", "DOF", "steps", "us per step, 1 thread", "2 threads", "DOF-steps/s/core"]
    return table([*heads, "2 threads", "whole run so, 1 thread", "in the paper"], rows)


def bricks(folder: Path) -> str:
    """Time of whole steps of bricks of one point; metals before they yield."""
    rows = []
    for recipe, name, count, paper, steps, repeats in BRICKS:
        deck = jobs.recipe_deck(recipe, folder)
        one = jobs.measure(BUILD / "plydyn", deck, steps, 1, repeats)
        rows.append(
            [
                name,
                f"{count:,}",
                f"{one.freedoms:,}",
                f"{one.steps:,}",
                f"{1e3 * one.step:.2f}",
                f"{count / one.step:.2e}",
                clock(one.step * one.steps),
                paper,
            ]
        )
        deck.unlink()
    heads = ["model", "bricks", "DOF", "steps", "ms per step", "brick-steps/s/core"]
    return table([*heads, "whole run so, 1 thread", "in the paper"], rows)


def second_core(folder: Path) -> str:
    """What a second core brings to the mesh of 57,672 degrees of freedom."""
    rows = [
        [name, *(f"{1e6 * step:.0f}" for step in steps), *(f"{gain:.2f}" for gain in gains)]
        for name, steps, gains in pairs.measure(BUILD / "plydyn", folder)
    ]
    heads = ["192 Q9/LE2", "us per step, median", "best", "times one thread, median", "best"]
    return table(heads, rows)


def panels(folder: Path) -> str:
    """Time and memory over size."""
    rows = []
    for quads, steps in PANELS:
        deck = jobs.panel_deck(quads, folder)
        one, two = (jobs.measure(BUILD / "plydyn", deck, steps, n) for n in THREADS)
        rows.append(
            [
                f"{quads} x {quads}",
                f"{one.freedoms:,}",
                f"{1e3 * one.step:.2f}",
                f"{1e3 * two.step:.2f}",
                f"{one.rate(1):.2e}",
                f"{two.rate(2):.2e}",
                f"{one.memory:.0f}",
                f"{1e6 * one.memory / one.freedoms:.0f}",
                f"{one.peak:.0f}",
            ]
        )
    heads = ["quads", "DOF", "ms per step, 1 thread", "2 threads", "DOF-steps/s/core", "2 threads"]
    return table([*heads, "memory [MB]", "bytes per DOF", "most of the process [MB]"], rows)


def main() -> None:
    """Measure everything and write it."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        text = "\n\n".join(
            [
                machine(),
                "### Elastic impact (Table 2 of the paper, one core)",
                models(ELASTIC, folder),
                "### Impact with interfaces (Table 7 of the paper, six cores)",
                models(DAMAGE, folder),
                "### A second core",
                second_core(folder),
                "### Panels of eight tied plies of order 2, total Lagrangian",
                panels(folder),
                # last: the most memory of a process counts what this script has when it starts it
                "### Bricks of one point (Tables 2 and 4 of the paper, one core)",
                bricks(folder),
            ]
        )
    only_printed = "--print" in sys.argv
    publish(f"{machine()}\n\n{kernels()}", None if only_printed else KERNELS, MARKS)
    publish(text, None if only_printed else PAGE, MARKS)


if __name__ == "__main__":
    main()
