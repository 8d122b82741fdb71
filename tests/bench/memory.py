"""Run a command as one of several ranks, and tell how much memory it had.

    mpirun -n 2 python tests/bench/memory.py plydyn run deck.k

At its end each prints a line `memory PEAK` in MB, the most that the process ever had. Linux only.
"""

from __future__ import annotations

import os
import subprocess
import sys

KILOBYTE, MEGABYTE = 1024.0, 1.0e6


def main() -> None:
    """Wait for the command's end."""
    with subprocess.Popen(sys.argv[1:], stdout=subprocess.DEVNULL) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    # one write, so that lines of ranks do not mix
    sys.stderr.write(f"memory {usage.ru_maxrss * KILOBYTE / MEGABYTE:.1f}\n")
    sys.exit(process.returncode)


if __name__ == "__main__":
    main()
