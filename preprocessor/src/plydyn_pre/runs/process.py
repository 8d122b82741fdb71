"""A process of the solver: what it prints is kept and followed, signals are passed on."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from types import FrameType

_DONE = re.compile(r"\s(\d+\.\d)%\s")
#: Signals at which the solver writes a restart file and ends
_PASSED_ON = (signal.SIGTERM, signal.SIGUSR1, signal.SIGUSR2, signal.SIGHUP)


@dataclass(frozen=True)
class Ended:
    """How a process ended, and what it took."""

    code: int
    last: str  # line that it printed
    wall: float  # s
    processor: float  # s, with its children


def share_done(line: str) -> float | None:
    """The share of a run that is done, of a line of progress."""
    found = _DONE.search(line)
    return float(found[1]) / 100.0 if found else None


def follow(
    words: Sequence[str | Path],
    told: Callable[[str], None],
    log: Path | None = None,
    environment: Mapping[str, str] | None = None,
) -> Ended:
    """Run a command, give each line that it prints to `told`, and keep it in a file.

    In the main thread signals are passed on; elsewhere those of the terminal reach the command.
    """
    start, last = time.perf_counter(), ""
    leads = threading.current_thread() is threading.main_thread()
    with (
        subprocess.Popen(
            words,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            env=environment,
            process_group=0 if leads else None,
        ) as process,
        passing_on(process.send_signal) if leads else nullcontext(),
        log.open("w", buffering=1, encoding="utf-8") if log else nullcontext() as file,
    ):
        for line in process.stdout or ():
            last = line.rstrip("\n")
            if file:
                file.write(line)
            told(last)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    wall = time.perf_counter() - start
    return Ended(process.returncode, last, wall, usage.ru_utime + usage.ru_stime)


@contextmanager
def passing_on(send: Callable[[int], None]) -> Iterator[None]:
    """Pass signals on; Ctrl-C becomes SIGTERM, so that the solver writes a restart file.

    That the terminal was closed means nothing to what nohup has started.
    """

    def pass_on(number: int, _: FrameType | None) -> None:
        got.append(number)
        send(signal.SIGTERM if number == signal.SIGINT else number)

    got: list[int] = []
    wanted = [*_PASSED_ON, signal.SIGINT]
    if signal.getsignal(signal.SIGHUP) is signal.SIG_IGN:
        wanted.remove(signal.SIGHUP)
    before = {each: signal.signal(each, pass_on) for each in wanted}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    if signal.SIGINT in got:
        raise KeyboardInterrupt
