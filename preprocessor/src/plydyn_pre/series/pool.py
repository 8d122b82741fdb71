"""Cases of a study side by side on this machine, each a process of plydyn-chain."""

from __future__ import annotations

import signal
import subprocess
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from plydyn_pre.runs.process import passing_on, share_done
from plydyn_pre.runs.programs import chain_of
from plydyn_pre.series.folders import Written

#: Seconds between two looks at what runs, and bytes at the end of a log that are read
_PAUSE, _END = 0.2, 4000


@dataclass
class _Pool:
    """What runs now, and how what ran has ended."""

    running: dict[str, subprocess.Popen[bytes]] = field(default_factory=dict)
    codes: dict[str, int] = field(default_factory=dict)
    stopped: bool = False

    def stop(self, _: int) -> None:
        """Start nothing more, and have all that run write restart files and end."""
        self.stopped = True
        for process in self.running.values():
            process.send_signal(signal.SIGTERM)


def run_cases(
    cases: Sequence[Written],
    at_once: int,
    threads: int = 1,
    solver: Path | None = None,
    told: Callable[[float, str], None] = lambda *_: None,
) -> dict[str, int]:
    """Run some cases at once, and give the exit code of each; one that fails stops no other.

    A case that has ended is not run again, and one that was stopped goes on from its newest
    restart file. SIGTERM, SIGUSR1, SIGUSR2, SIGHUP and Ctrl-C stop all that run with restart files.
    `told` gets how many cases are done, and what runs. The lines of the solver are in `log.txt` of
    each folder.
    """
    chain, environment = chain_of(solver, threads)
    waiting, pool = list(cases), _Pool()
    with passing_on(pool.stop):
        while pool.running or (waiting and not pool.stopped):
            while waiting and len(pool.running) < at_once and not pool.stopped:
                case = waiting.pop(0)
                pool.running[case.name] = _start(case, chain, environment)
            time.sleep(_PAUSE)
            _collect(pool)
            told(*_progress(cases, pool))
    return pool.codes


def _start(case: Written, chain: Path, environment: dict[str, str]) -> subprocess.Popen[bytes]:
    """Begin a case, or go on with it, in a process group of its own."""
    folder = case.decks[0].parent
    with (folder / "log.txt").open("w", encoding="utf-8") as log:
        return subprocess.Popen(
            [chain, folder, *case.decks],
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
            env=environment,
            process_group=0,
        )


def _collect(pool: _Pool) -> None:
    """Take out what has ended."""
    for name, process in list(pool.running.items()):
        code = process.poll()
        if code is not None:
            pool.codes[name] = code
            del pool.running[name]


def _progress(cases: Sequence[Written], pool: _Pool) -> tuple[float, str]:
    """How many cases are done, with the shares of those that run, and words on these."""
    done, words = float(len(pool.codes)), []
    for case in cases:
        if case.name in pool.running:
            share = share_of(case)
            done += share
            words.append(f"{case.name} {100.0 * share:.0f} %")
    return done, ", ".join(words)


def share_of(case: Written) -> float:
    """The share of a case that is done, by the last lines of its log; stages count alike."""
    log = case.decks[0].parent / "log.txt"
    with log.open("rb") as file:
        file.seek(max(0, log.stat().st_size - _END))
        lines = file.read().decode("utf-8", errors="replace").splitlines()
    shares = [share for line in lines if (share := share_done(line)) is not None]
    begun = [number for number, deck in enumerate(case.decks) if deck.with_suffix(".out").is_file()]
    stage = begun[-1] if begun else 0
    return (stage + (shares[-1] if shares else 0.0)) / len(case.decks)


def last_line(case: Written) -> str:
    """The last line that a case has printed."""
    log = case.decks[0].parent / "log.txt"
    lines = log.read_text(encoding="utf-8", errors="replace").split("\n") if log.is_file() else []
    return next((line for line in reversed(lines) if line.strip()), "")
