"""Decks, requests and command lines changed by chance: refused in words or run, never a crash.

`FUZZ=5000 pytest tests/deck/test_fuzz.py` tries that many mutants instead of some hundred;
`FUZZ_SEED=7` tries others. A mutant that fails is kept in the folder of the test.
"""

from __future__ import annotations

import os
import random
import resource
import subprocess
from pathlib import Path

import pytest

from mutants import mutate
from ranks import launch
from runs import ROOT, SOLVER

MUTANTS = int(os.environ.get("FUZZ", "240"))
SEED = int(os.environ.get("FUZZ_SEED", "20260"))
NORMAL, USAGE, INPUT, RUN, STOPPED, OUTPUT = range(6)
# words of the run-time libraries, none of which is to be seen
CRASHES = ("Backtrace", "Fortran runtime error", "SIGSEGV", "Operating system error", "MPI_ABORT")
REPEATED = 10  # good decks are fewer
SECONDS, BYTES = 20.0, 4_000_000_000


def bound() -> None:
    """Limits of the child: memory and files of results."""
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    resource.setrlimit(resource.RLIMIT_FSIZE, (200_000_000, 200_000_000))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(folder: Path, *words: object) -> subprocess.CompletedProcess[bytes]:
    """The solver on some words, within bounds of time and memory."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_MCA_btl": "self"}
    return subprocess.run(
        [SOLVER, *map(str, words)],
        cwd=folder,
        capture_output=True,
        timeout=SECONDS,
        check=False,
        preexec_fn=bound,
        env=environment,
    )


def check(done: subprocess.CompletedProcess[bytes], codes: set[int], what: str) -> None:
    """An exit code that is documented, and words."""
    said = (done.stdout + done.stderr).decode("utf-8", "replace")
    assert done.returncode in codes, f"{what}: {done.returncode}\n{said[-3000:]}"
    assert not any(crash in said for crash in CRASHES), f"{what}\n{said[-3000:]}"
    assert done.returncode == NORMAL or done.stderr.strip(), f"{what}: no words"
    assert len(said) < 400_000, f"{what}: {len(said)} characters"
    assert "\x1b" not in said, f"{what}: steers the terminal"


def seeds() -> list[str]:
    """Decks of the tests, of a size that is read in no time; about as many good ones as bad."""
    paths = sorted((ROOT / "tests" / "deck").glob("*/deck.k"))
    texts = [path.read_text() for path in paths] * REPEATED
    parts = ROOT / "tests" / "deck" / "errors"
    for path in sorted(parts.glob("*.k")):
        texts.append(path.read_text().replace("\ngood/", f"\n{parts}/good/"))
    return [text for text in texts if len(text) < 20_000]


@pytest.mark.parametrize("part", range(4))
def test_mutants_of_decks(part: int, tmp_path: Path) -> None:
    """All are checked, and some of those that pass run for a second."""
    texts = seeds()
    chance = random.Random(SEED + part)
    for i in range(MUTANTS // 4):
        deck = tmp_path / "mutant.k"
        text = mutate(chance.choice(texts), chance)
        deck.write_text(text, errors="replace")
        before = deck.read_bytes()
        done = run(tmp_path, "check", deck)
        check(done, {NORMAL, INPUT, RUN}, f"mutant {part}.{i}")
        if done.returncode == NORMAL and chance.random() < 0.15:
            done = run(tmp_path, "run", deck, "-j", "job", "--wall-time", "1")
            check(done, {NORMAL, INPUT, RUN, STOPPED, OUTPUT}, f"run of mutant {part}.{i}")
            for path in tmp_path.glob("job.*"):
                path.unlink()
        assert deck.read_bytes() == before, f"mutant {part}.{i} was changed"


def test_mutants_on_ranks(tmp_path: Path) -> None:
    """Two ranks end as one does, and the root alone says why."""
    texts, chance = seeds(), random.Random(SEED + 4)
    for i in range(max(2, MUTANTS // 12)):
        deck = tmp_path / "mutant.k"
        deck.write_text(mutate(chance.choice(texts), chance), errors="replace")
        words = ("run", deck, "-o", tmp_path / "out", "--wall-time", "1")
        alone = run(tmp_path, *words[:2], "-o", tmp_path / "one", "--wall-time", "1")
        both = launch(2, *words, seconds=3 * SECONDS)
        if STOPPED not in (alone.returncode, both.returncode):
            assert both.returncode == alone.returncode, f"mutant {i}: {both.stdout + both.stderr}"
        said = both.stdout + both.stderr
        assert not any(crash in said for crash in CRASHES[:-1]), f"mutant {i}\n{said[-3000:]}"
        if alone.returncode == INPUT:
            assert both.stderr.count(alone.stderr.decode().splitlines()[-1]) == 1, f"mutant {i}"


def test_requests_by_chance(tmp_path: Path) -> None:
    """Whatever stands in JOB.ctl, the run ends as it should."""
    deck = ROOT / "tests" / "deck" / "heads" / "deck.k"
    words = ["stop", "dump", "plot", "status", "flush", "end-time", "sw1", "5e-4", "=", "\x1b[2J"]
    chance = random.Random(SEED)
    for i in range(max(2, MUTANTS // 60)):
        lines = [
            " ".join(chance.choices(words, k=chance.randrange(4)))
            for _ in range(chance.randrange(200))
        ]
        (tmp_path / "job.ctl").write_text("\n".join(lines))
        done = run(tmp_path, "run", deck, "-j", "job")
        check(done, {NORMAL, STOPPED}, f"requests {i}")


def test_command_lines_by_chance(tmp_path: Path) -> None:
    """Words of a command line in any order."""
    deck = ROOT / "tests" / "deck" / "heads" / "deck.k"
    words = ["check", "check", str(deck), "-j", "job", "-o", "out", "-p", "a=1", "--wall-time"]
    words += ["1:2:3:4", ".", "1e9", "ncpu=1", "ncpu=9999999999", "i=", "r=", "--keywords", ""]
    words += ["\x01", "*NODE", "--version", "x" * 5000, "-", "restart", "jobid=", f"i={deck}"]
    chance = random.Random(SEED)
    for i in range(max(20, MUTANTS // 6)):
        chosen = chance.choices(words, k=chance.randrange(6))
        done = run(tmp_path, *chosen)
        check(done, {NORMAL, USAGE, INPUT, OUTPUT}, f"command line {i}: {chosen}")
