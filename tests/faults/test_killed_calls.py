"""A run that is killed at any call that changes a file goes on to the same bits."""

from __future__ import annotations

import os
import random
import re
import shutil
import signal
import subprocess
from pathlib import Path

import pytest

from broken import impact, said, unlike
from runs import SOLVER

SOURCE = Path(__file__).parents[1] / "support" / "killing_calls.c"
NORMAL = 0
# of some hundred calls; KILLS=1000 tries that many
KILLS, SEED = int(os.environ.get("KILLS", "24")), 11


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What is put in front of the C library."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("this machine has no compiler of C")
    path = tmp_path_factory.mktemp("killing") / "killing_calls.so"
    subprocess.run([compiler, "-O1", "-shared", "-fPIC", "-o", path, SOURCE, "-ldl"], check=True)
    return path


def killed_at(call: int, library: Path, *words: object) -> subprocess.CompletedProcess[str]:
    """The program, killed before a call."""
    return subprocess.run(
        [SOLVER, *map(str, words)],
        env={**os.environ, "KILL_AT": str(call), "LD_PRELOAD": str(library)},
        capture_output=True,
        text=True,
        check=False,
    )


def next_words(deck: Path, folder: Path) -> tuple[object, ...]:
    """How a run goes on: from its restart file, or anew where there is none yet."""
    dump = folder / "job.runrsf"
    return ("restart", dump) if dump.exists() else ("run", deck, "-o", folder)


def test_kill_at_every_call(library: Path, tmp_path: Path) -> None:
    """From the first file to the last; what was killed on its way back is killed again."""
    deck = impact(1, "cohesive", end=6.0e-6)
    deck.add("DATABASE_BINARY_RUNRSF", (20,))
    deck.add("DATABASE_BINARY_D3DUMP", (45,))
    path, whole = deck.write(tmp_path / "job.k"), tmp_path / "whole"
    done = killed_at(0, library, "run", path, "-o", whole)
    assert done.returncode == NORMAL, done.stdout + done.stderr
    found = re.search(r"(\d+) watched calls", done.stderr)
    assert found is not None
    calls = int(found[1])
    chance = random.Random(SEED)
    for call in sorted(chance.sample(range(1, calls + 1), min(KILLS, calls))):
        folder = tmp_path / f"killed_{call}"
        done = killed_at(call, library, "run", path, "-o", folder)
        assert done.returncode == -signal.SIGKILL, f"call {call}: {done.stdout + done.stderr}"
        done = killed_at(chance.randrange(1, calls), library, *next_words(path, folder))
        if done.returncode != NORMAL:
            code, text = said(*next_words(path, folder))
            assert code == NORMAL, f"call {call}: {text}"
        assert unlike(whole, folder) == [], f"call {call}"
        shutil.rmtree(folder)
