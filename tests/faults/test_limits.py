"""Limits of the system: too little stack or memory is told in one sentence."""

from __future__ import annotations

import os
import re
import resource
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from broken import impact
from decks import Deck, Ply
from elasticity import CARBON
from meshes import regular
from ranks import command

NORMAL, FAILED = 0, 3
KIB, MIB = 1024, 1024**2
ENOUGH = 256 * KIB  # bytes of stack


def limited(kind: int, size: int) -> Callable[[], None]:
    """What limits a resource of a program that is about to start."""
    return lambda: resource.setrlimit(kind, (size, size))


def ended(
    words: list[object], limit: Callable[[], None] | None, ranks: int = 1, **environment: str
) -> subprocess.CompletedProcess[str]:
    """The program within a limit."""
    return subprocess.run(
        command(ranks, [str(word) for word in words]),
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=limit,
        env={**os.environ, "OMP_NUM_THREADS": "1", **environment},
    )


def told(done: subprocess.CompletedProcess[str]) -> str:
    """The one sentence of a run that failed."""
    assert done.returncode == FAILED, done.stdout + done.stderr
    assert done.stderr.count("\n") == 1
    return done.stderr


@pytest.mark.parametrize("stack", [32, 64, 128, 255])
def test_small_stack_is_told(stack: int) -> None:
    """Not even the version can be asked for.

    With 16 KiB the loader of shared libraries itself ends in 3 of 100 starts, before the
    program's first line.
    """
    done = ended(["--version"], limited(resource.RLIMIT_STACK, stack * KIB))
    assert f"the stack is limited to {stack} KiB; right would be: at least 256" in told(done)


@pytest.mark.parametrize("size", ["64", "64k", "100000b"])
def test_small_stacks_of_threads_are_told(size: str, tmp_path: Path) -> None:
    """OMP_STACKSIZE counts in KiB; what it means with other letters is left to OpenMP."""
    deck = impact(1, "cohesive", end=1.0e-6).write(tmp_path / "job.k")
    words = ["check", deck]
    done = ended(words, None, OMP_STACKSIZE=size)
    assert f"OMP_STACKSIZE limits the stacks of threads to {size}" in told(done)
    for good in ("256k", "1M", "1G", "2097152", "x", ""):
        assert ended(words, None, OMP_STACKSIZE=good).returncode == NORMAL


@pytest.mark.parametrize("law", ["tied", "apart", "cohesive"])
def test_least_stack_is_enough(law: str, tmp_path: Path) -> None:
    """For the program and for its threads."""
    deck = impact(1, law, end=1.0e-5).write(tmp_path / "job.k")
    words = ["run", deck, "-o", tmp_path, "ncpu=2"]
    done = ended(words, limited(resource.RLIMIT_STACK, ENOUGH), OMP_STACKSIZE="256k")
    assert done.returncode == NORMAL, done.stdout + done.stderr


def large(quads: int, sublayers: int) -> Deck:
    """A plate of so many layers."""
    mesh = regular(20.0, 20.0, quads, quads, 9)
    deck = Deck("large", 1.0e-6)
    deck.control()
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 5.0), Ply(CARBON, 5.0, 90.0)], 2, sublayers)
    deck.hold(mesh.where(x=0.0), "xyz")
    return deck


def test_size_is_told_before_it_is_taken(tmp_path: Path) -> None:
    """The machine is not filled first."""
    deck = large(40, 100).write(tmp_path / "job.k")
    done = ended(["check", deck], limited(resource.RLIMIT_AS, 400 * MIB))
    sizes = re.search(r"the model takes (\S+) GB more at least, and (\S+) GB are free", told(done))
    assert sizes is not None, told(done)
    taken, free = (float(size) for size in sizes.groups())
    # displacement, velocity and acceleration of the points of all layers, and little else
    motion = 3 * 8 * 3 * 200 * 3 * 81**2 / 1.0e9
    assert motion < taken < 2.0 * motion
    assert 0.0 < free < taken


@pytest.mark.parametrize("kib", range(110_000, 260_000, 15_000))
def test_any_allocation_may_fail(kib: int, tmp_path: Path) -> None:
    """Wherever memory ends, it ends in words; the last of the limits is enough."""
    deck = large(20, 6).write(tmp_path / "job.k")
    done = ended(["check", deck], limited(resource.RLIMIT_AS, kib * KIB))
    if done.returncode != NORMAL:
        assert "out of memory: " in told(done)


def test_memory_of_ranks_is_told(tmp_path: Path) -> None:
    """By the root alone."""
    deck = large(40, 100).write(tmp_path / "job.k")
    done = ended(["check", deck], limited(resource.RLIMIT_AS, 300 * MIB), ranks=2)
    assert done.returncode == FAILED, done.stdout + done.stderr
    assert done.stderr.count("out of memory: the model takes") == 1
