"""A copy of the tree in which one line is changed at a time, and the tests that look at it."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mutant import FAILS, PASSES, SOUND, Kept, Mutant

ROOT = Path(__file__).resolve().parents[2]
#: Most that a process of a unit test and of another may compute, s: a mutant may never end
_MOST_OF_UNIT, _MOST_OF_FILE = 60, 300
#: Longest time of a test, where others compute at the same time, s
_LONGEST = 1200.0
#: Parts of the tests that start the solver
PARTS = ("deck", "verification", "parallel", "faults")
#: How many times more those promise that look at the folder of a mutant
_LOOKS = 8
#: A file whose time is not known counts as so long, s
_USUAL = 20.0
#: A build that is quick to make: no optimisation across files
_FLAGS = ("-DCMAKE_BUILD_TYPE=Mutants", "-DCMAKE_Fortran_FLAGS_MUTANTS=-O1 -march=native")


class Copy:
    """A copy of the tree with a build of its own."""

    def __init__(self, folder: Path, looks: dict[str, list[str]], kept: Kept) -> None:
        """Copy all files that git knows, and build the program."""
        self.folder, self.build, self.kept = folder, folder / "build" / "mutants", kept
        self.looks = looks
        self.usual: dict[str, float] = {}
        names = subprocess.check_output(["git", "ls-files", "-z"], cwd=ROOT, text=True)
        for name in names.split("\0")[:-1]:
            _copy(ROOT / name, folder / name)
        configure = ["cmake", "-S", ".", "-B", str(self.build), "-G", "Ninja", *_FLAGS]
        subprocess.run(configure, cwd=folder, check=True, capture_output=True)
        if not self._builds("plydyn"):
            raise SystemExit(f"the copy in {folder} does not build")
        #: The libraries of folders and the program without a mutant
        self.libraries = {part: self._library(part) for part in looks}
        self.sound = shutil.copy2(self.build / "plydyn", folder / "build" / "sound")

    def meets_units(self, mutant: Mutant) -> str:
        """What the unit tests of its folder and those that use its module make of a mutant."""
        part = mutant.path.parts[1]
        with self._changed(mutant):
            if not self._builds(part):
                return "does not build"
            if self._library(part) == self.libraries[part]:
                return "changes nothing"
            killer = next(filter(self._unit_fails, self._units(mutant)), "")
        if not killer:
            return ""
        if self.kept.kills[killer] == 0 and self._unit_fails(killer):
            self.kept.keep(SOUND, killer, FAILS)
            return self.meets_units(mutant)
        self.kept.keep(mutant, killer, FAILS)
        return f"killed by {killer}"

    def meets_files(self, mutant: Mutant, seconds: float) -> str:
        """What files of tests make of it in some seconds."""
        files = self._files(mutant)
        met = {file: self.kept.fate(mutant, file) for file in files}
        killer = next((file for file in files if met[file] == FAILS), "")
        left = [file for file in files if met[file] is None]
        if left and not killer:
            with self._changed(mutant):
                if not self._builds("plydyn"):
                    return "does not build"
                killer = self._killer(mutant, left, time.monotonic() + seconds)
        if killer:
            return f"killed by {killer.removeprefix('tests/')}"
        number = sum(self.kept.fate(mutant, file) is not None for file in files)
        return "survived" if number == len(files) else f"survived {number} of {len(files)} files"

    def _killer(self, mutant: Mutant, files: list[str], end: float) -> str:
        """The first of some files that fails with the program as it is built, by some time."""
        for file in files:
            fate = self._meets(file, end - time.monotonic())
            if fate is None:
                return ""
            self.kept.keep(mutant, file, fate)
            if fate == FAILS:
                return file
        return ""

    def _units(self, mutant: Mutant) -> list[str]:
        """Unit tests in the order in which a mutant meets them."""
        part = mutant.path.parts[1]
        module = re.search(r"^module (\w+)", (ROOT / mutant.path).read_text(), re.MULTILINE)
        uses = re.compile(rf"\buse {module[1]}\b") if module else re.compile("^module$")
        own = "_".join(("test", *mutant.path.with_suffix("").parts[1:]))
        texts = {path.stem: path.read_text() for path in self.folder.glob("tests/unit/test_*.f90")}
        order = {
            unit: (not own.startswith(unit), not uses.search(text), unit)
            for unit, text in texts.items()
            if (unit.startswith(f"test_{part}_") or uses.search(text)) and self._is_sound(unit)
        }
        return sorted(order, key=lambda unit: order[unit])

    def _files(self, mutant: Mutant) -> list[str]:
        """Files of other tests in the order in which a mutant meets them."""
        files = [
            str(file.relative_to(self.folder))
            for part in PARTS
            for file in sorted((self.folder / "tests" / part).rglob("test_*.py"))
        ]
        files = [file for file in files if self._is_sound(file)]
        return sorted(files, key=lambda file: -self._promise(file, mutant))

    def _promise(self, file: str, mutant: Mutant) -> float:
        """How much a file of tests says of the mutant's file, for each second it takes."""
        words = set(re.split(r"\W|_", str(mutant.path.with_suffix("")))) - {"src", ""}
        text = (self.folder / file).read_text() + file
        spoken = sum(word in text for word in words)
        looks = any(f"tests/{name}" in file for name in self.looks[mutant.path.parts[1]])
        promise = 1 + spoken**2 + self.kept.kills[file]
        return promise * (_LOOKS if looks else 1) / self.usual.get(file, _USUAL)

    def _is_sound(self, test: str) -> bool:
        """Whether a test is not known to fail without a mutant."""
        return self.kept.fate(SOUND, test) != FAILS

    def _meets(self, file: str, left: float) -> str | None:
        """What a file of tests makes of the program as it is built; nothing if the time is over."""
        begin = time.monotonic()
        code = self._code(file, self.build / "plydyn", left)
        if code == 0:
            self.usual[file] = time.monotonic() - begin
            return PASSES
        if code is None:
            return None
        if self.kept.kills[file] == 0 and self._code(file, self.sound, _LONGEST) != 0:
            self.kept.keep(SOUND, file, FAILS)
            return PASSES
        return FAILS

    def _code(self, file: str, program: Path, longest: float) -> int | None:
        """Exit status of a file of tests; nothing if it does not end."""
        words = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", file]
        own = {"PLYDYN": str(program), "OMP_NUM_THREADS": "1"}
        return _code(["prlimit", f"--cpu={_MOST_OF_FILE}", *words], self.folder, longest, own)

    def _unit_fails(self, unit: str) -> bool:
        """Whether a unit test does not build, fails, or does not end."""
        if not self._builds(unit):
            return True
        program = next(path for path in self.build.rglob(unit) if path.is_file())
        words = ["prlimit", f"--cpu={_MOST_OF_UNIT}", str(program)]
        return _code(words, self.build, _LONGEST) != 0

    def _builds(self, *targets: str) -> bool:
        """Whether some programs build."""
        command = ["cmake", "--build", str(self.build), "--target", *targets]
        return subprocess.run(command, capture_output=True, check=False).returncode == 0

    def _library(self, part: str) -> str:
        """A sum over the bytes of the library of a folder."""
        path = self.build / "src" / f"libplydyn_{part}.a"
        return hashlib.sha256(path.read_bytes()).hexdigest()

    @contextmanager
    def _changed(self, mutant: Mutant) -> Iterator[None]:
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


def _copy(source: Path, target: Path) -> None:
    """Copy a file where it has changed; it counts as new, so that it is built again."""
    target.parent.mkdir(parents=True, exist_ok=True)
    if not target.exists() or target.read_bytes() != source.read_bytes():
        shutil.copy(source, target)


def _code(
    command: list[str], folder: Path, longest: float, own: dict[str, str] | None = None
) -> int | None:
    """Exit status of a command; nothing if it does not end: what it has started ends with it."""
    with subprocess.Popen(
        command,
        cwd=folder,
        env=os.environ | (own or {}),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    ) as started:
        try:
            return started.wait(max(longest, 0.0))
        except subprocess.TimeoutExpired:
            os.killpg(started.pid, signal.SIGKILL)
            return None
