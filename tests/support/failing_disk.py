"""A disk that fails for one of several ranks, whatever there is room for."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from ranks import PATIENT, command

SOURCE = Path(__file__).with_suffix(".c")


@pytest.fixture(scope="session")
def failing_disk(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What is put in front of the C library."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("this machine has no compiler of C")
    library = tmp_path_factory.mktemp("failing") / "failing_disk.so"
    subprocess.run([compiler, "-O1", "-shared", "-fPIC", "-o", library, SOURCE, "-ldl"], check=True)
    return library


def launch_failing(
    library: Path, case: tuple[int, str, int], ranks: int, *words: str | Path, seconds: float
) -> subprocess.CompletedProcess[str]:
    """Run on ranks of which one cannot write a file: rank, end of the file's name, first write."""
    names = ("FAILING_RANK", "FAILING_NAME", "FAILING_FIRST")
    failing = dict(zip(names, map(str, case), strict=True))
    return subprocess.run(
        command(ranks, list(words)),
        env={**os.environ, **PATIENT, **failing, "LD_PRELOAD": str(library)},
        capture_output=True,
        text=True,
        check=False,
        timeout=seconds,
    )


def watched_writes(done: subprocess.CompletedProcess[str]) -> int:
    """How many writes the rank made to the file, in a run without a failure."""
    return max(int(number) for number in re.findall(r"(\d+) watched writes", done.stderr))
