"""Run a command as one of several ranks, and tell how much memory it had.

    mpirun -n 2 python tests/bench/memory.py plydyn run deck.k

At its end each prints a line `memory PEAK LOOP` in MB: the most that the process ever had, and what
it had half-way through its life, which is the loop where that is long enough. Linux only.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import time
from pathlib import Path

INTERVAL = 0.01  # s between two looks
KILOBYTE, MEGABYTE = 1024.0, 1.0e6


def resident(process: int) -> float | None:
    """What a process has now, MB; none once it is at its end."""
    try:
        status = Path(f"/proc/{process}/status").read_text()
    except OSError:
        return None
    found = re.search(r"VmRSS:\s+(\d+) kB", status)
    return None if found is None else float(found[1]) * KILOBYTE / MEGABYTE


def main() -> None:
    """Watch the command to its end."""
    samples = []
    with subprocess.Popen(sys.argv[1:], stdout=subprocess.DEVNULL) as process:
        while (now := resident(process.pid)) is not None:
            samples.append(now)
            time.sleep(INTERVAL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    peak = usage.ru_maxrss * KILOBYTE / MEGABYTE
    # one write, so that lines of ranks do not mix
    sys.stderr.write(f"memory {peak:.1f} {samples[len(samples) // 2]:.1f}\n")
    sys.exit(process.returncode)


if __name__ == "__main__":
    main()
