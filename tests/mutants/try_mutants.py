"""Change one line of the solver at a time, and look whether the tests of its folder notice.

`.venv/bin/python tests/mutants/try_mutants.py --count 100 --seed 1` chooses changes by chance in
all folders of src, builds each in a copy of the tree, and runs the unit tests of its folder and
then other tests that look at it, up to the first that fails. The table has what was killed, by
what, and what survived. By hand: a mutant takes minutes.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from change_lines import changes

ROOT = Path(__file__).resolve().parents[2]
#: Folders of src, and what looks at each, the unit tests aside
FOLDERS = {
    "base": ["deck/test_restart.py", "faults/test_faults.py"],
    "contact": ["verification/contact", "verification/impactors", "verification/friction"],
    "deck": ["deck/errors", "deck/test_field_size.py", "deck/test_files_of_decks.py"],
    "domain": ["parallel", "verification/mass_scaling", "verification/average"],
    "element": ["verification/patch", "verification/large", "verification/cohesive_point"],
    "fem": ["verification/patch", "verification/bending"],
    "input": ["deck"],
    "io": ["deck", "verification/fixtures", "verification/fields"],
    "law": ["verification/ply_damage", "verification/plasticity", "verification/cohesive_point"],
    "method": ["verification/fixtures", "verification/implicit", "verification/stages"],
    "model": ["deck", "verification/impactors"],
    "parallel": ["parallel"],
    "run": ["deck", "verification/relaxation"],
    "state": ["deck/test_restart.py", "parallel"],
}
#: Longest time of a test, s: a mutant may never end
_LONGEST = 3600.0


@dataclass(frozen=True)
class Mutant:
    """A line of a file, and what it becomes."""

    path: Path  # from the root
    number: int  # from 1
    old: str
    new: str
    before: str  # the line before it


def choose(seed: int, count: int) -> list[Mutant]:
    """Mutants by chance, as many in each folder as in the others."""
    chance = random.Random(seed)
    order = list(FOLDERS)
    chance.shuffle(order)
    return [_mutant(chance, order[k % len(order)]) for k in range(count)]


def _mutant(chance: random.Random, folder: str) -> Mutant:
    """One of a folder: every change of every line alike."""
    return chance.choice(_all_of(folder))


@cache
def _all_of(folder: str) -> list[Mutant]:
    """All of a folder."""
    return [
        Mutant(path.relative_to(ROOT), number, line, new, before)
        for path in sorted((ROOT / "src" / folder).rglob("*.f90"))
        for number, line, before in _numbered(path)
        for new in changes(line, before)
    ]


def _numbered(path: Path) -> Iterator[tuple[int, str, str]]:
    """Lines with their numbers and the lines before them."""
    before = ""
    for number, line in enumerate(path.read_text().splitlines(), start=1):
        yield number, line, before
        before = line


def copy_tree(folder: Path) -> None:
    """A copy of all files that git knows, with its own build."""
    names = subprocess.check_output(["git", "ls-files", "-z"], cwd=ROOT, text=True)
    for name in names.split("\0")[:-1]:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        if (
            not (folder / name).exists()
            or (folder / name).read_bytes() != (ROOT / name).read_bytes()
        ):
            shutil.copyfile(ROOT / name, folder / name)
    subprocess.run(["cmake", "--preset", "release"], cwd=folder, check=True, capture_output=True)
    if not build(folder, "plydyn"):
        raise SystemExit(f"the copy in {folder} does not build")


def build(folder: Path, *targets: str) -> bool:
    """Whether some programs build."""
    command = ["cmake", "--build", "--preset", "release", "--target", *targets]
    return subprocess.run(command, cwd=folder, capture_output=True, check=False).returncode == 0


def fate(folder: Path, mutant: Mutant) -> str:
    """What becomes of a mutant in a copy of the tree, which is as it was afterwards."""
    path = folder / mutant.path
    text = path.read_text()
    lines = text.splitlines()
    lines[mutant.number - 1] = mutant.new
    path.write_text("\n".join(lines) + "\n")
    try:
        return _fate(folder, mutant.path.parts[1])
    finally:
        path.write_text(text)


def _fate(folder: Path, part: str) -> str:
    """Build, then the tests of a folder of src up to the first that fails."""
    units = sorted(path.stem for path in (folder / "tests" / "unit").glob(f"test_{part}_*.f90"))
    if not build(folder, "plydyn", *units):
        return "does not build"
    release = folder / "build" / "release"
    for unit in units:
        if _fails([str(next(release.rglob(unit)))], release):
            return f"killed by {unit}"
    for name in FOLDERS[part]:
        words = ["-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", f"tests/{name}"]
        if _fails([sys.executable, *words], folder):
            return f"killed by {name}"
    return "survived"


def _fails(command: list[str], folder: Path) -> bool:
    """Whether a test fails, or does not end."""
    own = {**os.environ, "PLYDYN": str(folder / "build" / "release" / "plydyn")}
    own.pop("PLYDYN") if command[0] != sys.executable else None
    try:
        done = subprocess.run(
            command, cwd=folder, env=own, capture_output=True, timeout=_LONGEST, check=False
        )
    except subprocess.TimeoutExpired:
        return True
    return done.returncode != 0


def main() -> None:
    """Try mutants, and print what becomes of each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--copy", type=Path, default=ROOT / "build" / "mutants")
    asked = parser.parse_args()
    copy_tree(asked.copy)
    fates: Counter[str] = Counter()
    for mutant in choose(asked.seed, asked.count):
        told = fate(asked.copy, mutant)
        fates[told.split()[0]] += 1
        new = mutant.new.strip() or "(dropped)"
        sys.stdout.write(f"{told:40} {mutant.path}:{mutant.number}\n")
        sys.stdout.write(f"   {mutant.old.strip()}\n   {new}\n")
        sys.stdout.flush()
    sys.stdout.write(", ".join(f"{number} {what}" for what, number in fates.items()) + "\n")


if __name__ == "__main__":
    main()
