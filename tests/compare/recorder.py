"""Stands in for the solver: keeps the deck of the test that calls it, and ends with an error."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
#: Environment variable that names the folder for decks
FOLDER = "PLYDYN_RECORDED_DECKS"
#: Exit code of the stand-in, so that a test ends with its first deck
RECORDED = 3


def record(folder: Path, tests: Path, workers: int) -> list[Path]:
    """The first deck of each test of a folder, named after the test; nothing is run."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    stand_in = folder / "plydyn"
    stand_in.write_text(f'#!/bin/sh\nexec "{sys.executable}" "{Path(__file__).resolve()}" "$@"\n')
    stand_in.chmod(0o755)
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-n", str(workers)]
    environment = {**os.environ, "PLYDYN": str(stand_in), FOLDER: str(folder)}
    subprocess.run(
        [*command, tests], cwd=ROOT, env=environment, capture_output=True, text=True, check=False
    )
    decks = sorted(folder.glob("*.k"))
    if not decks:
        raise ValueError(f"the tests of {tests} wrote no deck")
    return decks


def keep(words: list[str]) -> None:
    """Copy the deck that is to be run."""
    test = os.environ["PYTEST_CURRENT_TEST"].split(" (")[0].split("verification/")[-1]
    name = re.sub(r"\W+", "_", test.replace(".py::test", "")).strip("_")
    for word in words:
        if word.endswith(".k"):
            shutil.copy(word, Path(os.environ[FOLDER]) / f"{name}.k")


if __name__ == "__main__":
    keep(sys.argv[1:])
    sys.exit(RECORDED)
