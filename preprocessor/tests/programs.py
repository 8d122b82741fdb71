"""Runs plydyn-pre, in a copy of this process that has its modules already, and the solver."""

from __future__ import annotations

import os
import re
import resource
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from typer.testing import CliRunner

from plydyn_pre import cli

# typer loads what reads parameters with the first command that has one: here, once for all copies
CliRunner().invoke(cli.app, ["layup", "[0]"])


@dataclass(frozen=True)
class Done:
    """How a command ended, and what it said and took."""

    returncode: int
    stdout: str
    stderr: str
    seconds: float
    resident: int  # kB


def plydyn_pre(
    folder: Path, *words: object, memory: int | None = None, seconds: int | None = None
) -> Done:
    """Run the command in a folder; with bounds of the bytes that it adds and of its time."""
    line = ["plydyn-pre", *map(str, words)]
    with TemporaryDirectory() as place:
        paths = [Path(place) / name for name in ("output", "error")]
        child = os.fork()
        if child == 0:
            _run_here(folder, line, paths, memory, seconds)
        _, status, usage = os.wait4(child, 0)
        output, error = (path.read_text(encoding="utf-8", errors="replace") for path in paths)
    seconds = usage.ru_utime + usage.ru_stime
    return Done(os.waitstatus_to_exitcode(status), output, error, seconds, usage.ru_maxrss)


def _run_here(
    folder: Path, line: list[str], paths: list[Path], memory: int | None, seconds: int | None
) -> None:
    """Run the command in this process, which ends with it."""
    code = 99
    try:
        for number, path in enumerate(paths, start=1):
            os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT), number)
        sys.stdout, sys.stderr = (os.fdopen(fd, "w", encoding="utf-8") for fd in (1, 2))
        os.chdir(folder)
        if memory is not None:
            most = _data() + memory
            resource.setrlimit(resource.RLIMIT_DATA, (most, most))
        if seconds is not None:
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
        sys.argv = line
        cli.main()
        code = 0
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException as error:
        sys.stderr.write(f"Traceback: {error!r}\n")
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)


def _data() -> int:
    """Bytes of data that this process has."""
    found = re.search(r"VmData:\s+(\d+) kB", Path("/proc/self/status").read_text(encoding="utf-8"))
    return 1024 * int(found[1]) if found else 0


def solve(solver: str, folder: Path, *words: object) -> str:
    """Run the solver in a folder to a good end; what it says."""
    line = [solver, *map(str, words)]
    done = subprocess.run(line, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout + done.stderr


def run_deck(solver: str, folder: Path, name: str) -> str:
    """Run a deck to a good end; a row of energies in each step would take longer than the steps."""
    path = folder / name
    text = path.read_text(encoding="utf-8")
    if "*DATABASE_GLSTAT" not in text:
        rarely = text.replace("\n*END", "\n*DATABASE_GLSTAT\n1.0e-6,\n*END")
        path.write_text(rarely, encoding="utf-8")
    return solve(solver, folder, "run", name)
