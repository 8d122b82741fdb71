"""Which source files one step of a damaged plate executes: what a reader of the step meets.

    .venv/bin/python tests/structure/step_files.py [--build build/coverage] [--routines]

Builds the solver with gcov's counters, runs a small impact on plies of nine nodes and second order
twice, the second time some steps longer, and prints the files with lines that have run more often,
with the number of these lines. Damage grows in these steps and no observer is due; what the clock
alone makes due, a look for a control file, may add files. Of the plate kernels the templates
count. `--routines` names the procedures, too. No test: it takes minutes.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))

from damage import HTS40  # noqa: E402
from decks import Deck, Ply, Sphere  # noqa: E402
from meshes import regular  # noqa: E402

SOURCES = ROOT / "src"
#: Steps of the first run, and how many more the second one takes: none is a multiple of 16 or 200,
#: at which observers are due
STEPS, MORE = 993, 6
#: A file and one of its lines, with the procedure that it is in
Line = tuple[Path, int, str]


def main(words: Sequence[str] | None = None) -> None:
    """Build, run twice, and print the table."""
    reader = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    reader.add_argument("--build", type=Path, default=ROOT / "build/coverage")
    reader.add_argument("--routines", action="store_true")
    asked = reader.parse_args(words)
    build = asked.build.resolve()
    _configure(build)
    before, after = (_lines_run(build, steps) for steps in (STEPS, STEPS + MORE))
    lines, routines = defaultdict(int), defaultdict(set)
    for (path, number, routine), count in after.items():
        if count > before.get((path, number, routine), 0):
            file = _source(path, number)
            lines[file] += 1
            routines[file].add(routine)
    for file in sorted(lines):
        names = " ".join(sorted(routines[file])) if asked.routines else ""
        sys.stdout.write(f"{lines[file]:5d}  {file}  {names}".rstrip() + "\n")
    sys.stdout.write(f"{len(lines)} files, {sum(lines.values())} lines\n")


def _configure(build: Path) -> None:
    """The solver with counters of its lines."""
    flags = ["-DCMAKE_BUILD_TYPE=Coverage", "-DCMAKE_Fortran_FLAGS_COVERAGE=-O0 --coverage"]
    configure = ["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", *flags]
    for command in (configure, ["cmake", "--build", build, "--target", "plydyn"]):
        subprocess.run(command, check=True, stdout=sys.stderr)


def _deck(steps: int) -> Deck:
    """A sphere, with contact nodes as in the paper, on a small plate of two plies."""
    deck = Deck("one damaged step", 1.0, steps)
    deck.control()
    mesh = regular(10.0, 10.0, 4, 4, 9)
    deck.mesh(mesh)
    deck.laminate([Ply(HTS40, 0.25), Ply(HTS40, 0.25, 90.0)], order=2)
    deck.hold(mesh.boundary(), "xyz")
    deck.sphere(Sphere(5.0, 1.0e-3, (5.0, 5.0, 5.25), (0.0, 0.0, -2.0e4), method=1))
    deck.intervals(glstat=1.0, impactor=1.0)
    return deck


def _lines_run(build: Path, steps: int) -> dict[Line, int]:
    """How often each line has run in a number of steps."""
    for old in build.rglob("*.gcda"):
        old.unlink()
    folder = build / "step_files"
    # results that are in place of new ones are looked at
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    deck = _deck(steps).write(folder / "step.k")
    threads = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    subprocess.run(
        [build / "plydyn", "run", deck, "-o", folder],
        check=True,
        capture_output=True,
        env=os.environ | threads,
    )
    counts: dict[Line, int] = defaultdict(int)
    data = sorted(str(path) for path in build.rglob("*.gcda"))
    command = ["gcov", "--json-format", "--stdout", *data]
    found = subprocess.run(command, check=True, capture_output=True, text=True, cwd=build).stdout
    for report in found.splitlines():
        for file in json.loads(report)["files"]:
            for line in file["lines"]:
                place = (Path(file["file"]), line["line_number"], line.get("function_name", ""))
                counts[place] += line["count"]
    return counts


def _source(path: Path, number: int) -> str:
    """The file below src/ that a line stands in; of a kernel, its template."""
    path = path if path.is_absolute() else ROOT / path
    if path.is_relative_to(SOURCES):
        return str(path.relative_to(SOURCES))
    text = path.read_text()
    for template in sorted((SOURCES / "element/kernel").glob("*.f90.in")):
        first = text.find(template.read_text())
        if first < 0:
            continue
        line = text.count("\n", 0, first) + 1
        if line <= number < line + template.read_text().count("\n"):
            return str(template.relative_to(SOURCES))
    return "element/kernel/module.f90.in"


if __name__ == "__main__":
    main()
