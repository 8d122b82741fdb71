"""Count what a run allocates: a library in front of the C library of GNU counts."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

from decks import Deck
from runs import SOLVER

SOURCE = Path(__file__).with_suffix(".c")


@dataclass(frozen=True)
class Allocations:
    """Number of the allocations of a run, and their bytes."""

    number: int
    bytes: int


@pytest.fixture(scope="session")
def counter(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What is put in front of the C library."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("this machine has no compiler of C")
    library = tmp_path_factory.mktemp("counting") / "counter.so"
    subprocess.run([compiler, "-O1", "-shared", "-fPIC", SOURCE, "-o", library], check=True)
    return library


def allocations(library: Path, deck: Deck, folder: Path) -> Allocations:
    """What a run in a new folder allocates on one thread."""
    folder.mkdir()
    path = deck.write(folder / "deck.k")
    done = subprocess.run(
        [SOLVER, "run", path, "-o", folder, "ncpu=1"],
        env={**os.environ, "LD_PRELOAD": str(library)},
        capture_output=True,
        text=True,
        check=False,
    )
    found = re.search(r"(\d+) allocations of (\d+) bytes", done.stderr)
    if done.returncode or found is None:
        raise AssertionError(done.stdout + done.stderr)
    return Allocations(int(found[1]), int(found[2]))
