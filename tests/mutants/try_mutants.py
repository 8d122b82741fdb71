"""Change one line of the solver at a time, and look whether the tests of its folder notice.

`.venv/bin/python tests/mutants/try_mutants.py --count 100 --seed 1` chooses changes by chance in
all folders of src, builds each in a copy of the tree, and runs the unit tests of its folder one by
one, that of its file first. Mutants that these leave alive then meet other tests that look at the
folder, a file at a time, those first that speak of the changed file and have killed before; the
first failure ends it. A test that fails without a mutant, too, does not count. A mutant of which
the compiler makes the same code changes nothing. `--kept FILE` keeps what has become of each, a
line of JSON a mutant: a second run with it goes on where the first was ended. By hand: a mutant
takes a minute, a survivor as long as the tests of its folder.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
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
#: Longest time of a unit test and of a file of tests, s: a mutant may never end
_LONGEST_UNIT, _LONGEST_FILE = 120.0, 1200.0
#: A build that is quick to make: no optimisation across files
_FLAGS = ("-DCMAKE_BUILD_TYPE=Mutants", "-DCMAKE_Fortran_FLAGS_MUTANTS=-O1 -march=native")


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


class Copy:
    """A copy of the tree with a build of its own, in which one line is changed at a time."""

    def __init__(self, folder: Path) -> None:
        """Copy all files that git knows, and build the program."""
        self.folder, self.build = folder, folder / "build" / "mutants"
        self.kills: Counter[str] = Counter()
        self.broken: set[str] = set()
        names = subprocess.check_output(["git", "ls-files", "-z"], cwd=ROOT, text=True)
        for name in names.split("\0")[:-1]:
            _copy(ROOT / name, folder / name)
        configure = ["cmake", "-S", ".", "-B", str(self.build), "-G", "Ninja", *_FLAGS]
        subprocess.run(configure, cwd=folder, check=True, capture_output=True)
        if not self.builds("plydyn"):
            raise SystemExit(f"the copy in {folder} does not build")
        #: The libraries of folders and the program without a mutant
        self.libraries = {part: self._library(part) for part in FOLDERS}
        self.sound = shutil.copy2(self.build / "plydyn", folder / "build" / "sound")

    def builds(self, *targets: str) -> bool:
        """Whether some programs build."""
        command = ["cmake", "--build", str(self.build), "--target", *targets]
        return subprocess.run(command, capture_output=True, check=False).returncode == 0

    @contextmanager
    def changed(self, mutant: Mutant) -> Iterator[None]:
        """The copy with a mutant, which is gone afterwards."""
        path = self.folder / mutant.path
        text = path.read_text()
        lines = text.splitlines()
        lines[mutant.number - 1] = mutant.new
        path.write_text("\n".join(lines) + "\n")
        try:
            yield
        finally:
            path.write_text(text)

    def _library(self, part: str) -> str:
        """A sum over the bytes of the library of a folder."""
        path = self.build / "src" / f"libplydyn_{part}.a"
        return hashlib.sha256(path.read_bytes()).hexdigest()

    def meets_units(self, mutant: Mutant) -> str:
        """What the unit tests of its folder make of a mutant."""
        part = mutant.path.parts[1]
        units = sorted(path.stem for path in self.folder.glob(f"tests/unit/test_{part}_*.f90"))
        own = "_".join(("test", *mutant.path.with_suffix("").parts[1:]))
        units.sort(key=lambda unit: not own.startswith(unit))
        with self.changed(mutant):
            if not self.builds(part):
                return "does not build"
            if self._library(part) == self.libraries[part]:
                return "changes nothing"
            failing = (unit for unit in units if unit not in self.broken and self._unit_fails(unit))
            killer = next(failing, "")
        if killer and self.kills[killer] == 0 and self._unit_fails(killer):
            self.broken.add(killer)
            return self.meets_units(mutant)
        self.kills[killer] += 1
        return f"killed by {killer}" if killer else ""

    def meets_files(self, mutant: Mutant) -> str:
        """What the other tests of its folder make of it."""
        roots = [self.folder / "tests" / name for name in FOLDERS[mutant.path.parts[1]]]
        files = [
            str(file.relative_to(self.folder))
            for root in roots
            for file in (sorted(root.rglob("test_*.py")) if root.is_dir() else [root])
        ]
        with self.changed(mutant):
            if not self.builds("plydyn"):
                return "does not build"
            for file in sorted(files, key=lambda name: self._order(name, mutant)):
                if file not in self.broken and self._kills(file):
                    self.kills[file] += 1
                    return f"killed by {file.removeprefix('tests/')}"
        return "survived"

    def _order(self, file: str, mutant: Mutant) -> tuple[int, int]:
        """Place of a file of tests: by the words of the mutant's file in it, then by its kills."""
        words = set(re.split(r"\W|_", str(mutant.path.with_suffix("")))) - {"src", ""}
        text = (self.folder / file).read_text() + 3 * file
        return -sum(word in text for word in words), -self.kills[file]

    def _kills(self, file: str) -> bool:
        """Whether a file of tests fails with the mutant, and without it does not."""
        if not self._file_fails(file, self.build / "plydyn"):
            return False
        if self.kills[file] == 0 and self._file_fails(file, self.sound):
            self.broken.add(file)
            return False
        return True

    def _unit_fails(self, unit: str) -> bool:
        """Whether a unit test does not build, fails, or does not end."""
        if not self.builds(unit):
            return True
        program = next(path for path in self.build.rglob(unit) if path.is_file())
        return _fails([str(program)], self.build, _LONGEST_UNIT)

    def _file_fails(self, file: str, program: Path) -> bool:
        """Whether a file of tests fails, or does not end."""
        words = ["-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", file]
        own = {"PLYDYN": str(program), "OMP_NUM_THREADS": "1"}
        return _fails([sys.executable, *words], self.folder, _LONGEST_FILE, own)


def _copy(source: Path, target: Path) -> None:
    """Copy a file where it has changed."""
    target.parent.mkdir(parents=True, exist_ok=True)
    if not target.exists() or target.read_bytes() != source.read_bytes():
        shutil.copy2(source, target)


def _fails(
    command: list[str], folder: Path, longest: float, own: dict[str, str] | None = None
) -> bool:
    """Whether a command fails, or does not end; what it has started ends with it."""
    with subprocess.Popen(
        command,
        cwd=folder,
        env=os.environ | (own or {}),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    ) as started:
        try:
            return started.wait(longest) != 0
        except subprocess.TimeoutExpired:
            os.killpg(started.pid, signal.SIGKILL)
            return True


def _tell(mutant: Mutant, fate: str) -> None:
    """Print what has become of a mutant."""
    sys.stdout.write(f"{fate:40} {mutant.path}:{mutant.number}\n")
    sys.stdout.write(f"   {mutant.old.strip()}\n   {mutant.new.strip() or '(dropped)'}\n")
    sys.stdout.flush()


class Kept:
    """What has become of mutants, kept in a file line by line."""

    def __init__(self, file: Path | None) -> None:
        """Take what an earlier run has left in the file."""
        self.file = file
        lines = file.read_text().splitlines() if file is not None and file.exists() else []
        self.fates = {tuple(one[:4]): one[4] for one in map(json.loads, lines)}

    def fate(self, mutant: Mutant, met: str) -> str | None:
        """What the tests that it met made of it; nothing where it has not met them."""
        return self.fates.get(self._key(mutant, met))

    def keep(self, mutant: Mutant, met: str, fate: str) -> None:
        """Keep what the tests that it met made of it."""
        key = self._key(mutant, met)
        self.fates[key] = fate
        if self.file is not None:
            with self.file.open("a") as file:
                file.write(json.dumps([*key, fate]) + "\n")

    @staticmethod
    def _key(mutant: Mutant, met: str) -> tuple[str, int, str, str]:
        return str(mutant.path), mutant.number, mutant.new, met


def main() -> None:
    """Try mutants, and print what becomes of each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--copy", type=Path, default=ROOT / "build" / "mutants")
    parser.add_argument("--kept", type=Path)
    asked = parser.parse_args()
    alive = choose(asked.seed, asked.count)
    copy, kept = Copy(asked.copy.resolve()), Kept(asked.kept)
    fates: Counter[str] = Counter()
    for meets in (copy.meets_units, copy.meets_files):
        mutants, alive = alive, []
        for mutant in mutants:
            fate = kept.fate(mutant, meets.__name__)
            if fate is None:
                fate = meets(mutant)
                kept.keep(mutant, meets.__name__, fate)
            if not fate:
                alive.append(mutant)
                continue
            fates[fate if " by " not in fate else "killed"] += 1
            _tell(mutant, fate)
    sys.stdout.write(", ".join(f"{number} {what}" for what, number in fates.items()) + "\n")


if __name__ == "__main__":
    main()
