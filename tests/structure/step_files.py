"""Which source files one step of a damaged plate executes: what a reader of the step meets.

    .venv/bin/python tests/structure/step_files.py [--build build/coverage] [--routines]

Builds the solver with gcov's counters, runs a small impact on plies of nine nodes and second order,
goes on from its restart file twice, the second time some steps longer, and prints the files with
lines that have run more often, with the number of these lines, and the longest chain of procedures
that call each other from the loop on: its frames. Damage grows in these steps and no observer is
due; what the clock alone makes due, a look for a control file, may add files. Of the plate kernels
the templates count. `--routines` names the procedures, too. No test: it takes minutes.
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
#: Steps before the restart file, and how many the two runs from it take, of which none is a
#: multiple of 16 or 200, at which observers are due, as they are at the first and the last. A
#: restart times no steps in advance, whose number depends on the machine
BEFORE, FEW, MORE = 978, 2, 8
#: A file and one of its lines, with the procedure that it is in
Line = tuple[Path, int, str]
#: Procedures by their addresses, each called by the one before it
Chain = tuple[str, ...]
#: The loop over the steps, and the pieces of a procedure that threads share
LOOP, SHARED = "__plydyn_run_loop_MOD_run", "._omp_fn."


def main(words: Sequence[str] | None = None) -> None:
    """Build, run twice, and print the table."""
    reader = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    reader.add_argument("--build", type=Path, default=ROOT / "build/coverage")
    reader.add_argument("--routines", action="store_true")
    asked = reader.parse_args(words)
    build = asked.build.resolve()
    _configure(build)
    start = _start(build)
    before, frames_before = _go_on(build, start, FEW)
    after, frames_after = _go_on(build, start, MORE)
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
    names = _names(build)
    more = {chain for chain, calls in frames_after.items() if calls > frames_before.get(chain, 0)}
    longest = max(sorted(_from_loop(chain, names, more) for chain in more), key=len)
    sys.stdout.write("".join(f"{k:5d}  {name}\n" for k, name in enumerate(longest, start=1)))
    sys.stdout.write(f"{len(longest)} frames\n")


def _configure(build: Path) -> None:
    """The solver with counters of its lines and of its calls."""
    build.mkdir(parents=True, exist_ok=True)
    frames = build / "frames.o"
    counters = "-O0 --coverage -finstrument-functions"
    flags = [
        "-DCMAKE_BUILD_TYPE=Coverage",
        f"-DCMAKE_Fortran_FLAGS_COVERAGE={counters}",
        f"-DCMAKE_EXE_LINKER_FLAGS=-no-pie {frames}",
    ]
    compile_frames = ["gcc", "-O2", "-c", Path(__file__).with_name("frames.c"), "-o", frames]
    configure = ["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", *flags]
    for command in (compile_frames, configure, ["cmake", "--build", build, "--target", "plydyn"]):
        subprocess.run(command, check=True, stdout=sys.stderr)


def _deck() -> Deck:
    """A sphere, with contact nodes as in the paper, on a small plate of two plies."""
    deck = Deck("one damaged step", 1.0, BEFORE)
    deck.control()
    mesh = regular(10.0, 10.0, 4, 4, 9)
    deck.mesh(mesh)
    deck.laminate([Ply(HTS40, 0.25), Ply(HTS40, 0.25, 90.0)], order=2)
    deck.hold(mesh.boundary(), "xyz")
    deck.sphere(Sphere(5.0, 1.0e-3, (5.0, 5.0, 5.25), (0.0, 0.0, -2.0e4), method=1))
    deck.intervals(glstat=1.0, impactor=1.0)
    deck.add("DATABASE_BINARY_D3DUMP", (BEFORE,))
    return deck


def _start(build: Path) -> Path:
    """The folder of a run with a restart file."""
    folder = build / "step_files"
    # results that are in place of new ones are looked at
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    _solve(build, folder, "run", _deck().write(folder / "step.k"))
    return folder


def _solve(build: Path, folder: Path, *words: str | Path) -> None:
    """Run the solver on one thread."""
    threads = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    subprocess.run(
        [build / "plydyn", *words, "-o", folder],
        check=True,
        capture_output=True,
        env=os.environ | threads | {"FRAMES": str(folder / "frames")},
    )


def _go_on(build: Path, start: Path, steps: int) -> tuple[dict[Line, int], dict[Chain, int]]:
    """How often each line and each chain of calls runs in some steps from a restart file."""
    for old in build.rglob("*.gcda"):
        old.unlink()
    folder = start.with_name(f"step_files_{steps}")
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(start, folder)
    changes = folder / "longer.k"
    changes.write_text(f"*KEYWORD\n*CONTROL_TERMINATION\n1.0, {BEFORE + steps}\n*END\n")
    _solve(build, folder, "restart", folder / "step.dump01", changes)
    return _lines_run(build), _chains(folder / "frames")


def _lines_run(build: Path) -> dict[Line, int]:
    """How often each line has run."""
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


def _chains(file: Path) -> dict[Chain, int]:
    """How often each chain of calls was made."""
    rows = {number: row for number, *row in (line.split() for line in file.open())}

    def chain_of(number: str) -> Chain:
        if number == "0":
            return ()
        caller, procedure, _ = rows[number]
        return (*chain_of(caller), procedure)

    return {chain_of(number): int(row[2]) for number, row in rows.items()}


def _names(build: Path) -> dict[str, str]:
    """Names of procedures by their addresses."""
    words = ["nm", "--defined-only", build / "plydyn"]
    found = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    return {row[0].lstrip("0"): row[2] for row in map(str.split, found.splitlines())}


def _from_loop(chain: Chain, names: dict[str, str], more: set[Chain]) -> list[str]:
    """Names of a chain from the loop on, if all of its calls there belong to a step, else none."""
    called = [names.get(address, address) for address in chain]
    if LOOP not in called:
        return []
    loop = called.index(LOOP)
    if any(chain[:k] not in more for k in range(loop + 2, len(chain))):
        return []
    return [name for name in called[loop:] if SHARED not in name]


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
