"""The model that extrapolates steps: its limits, which need no run."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from paper import Load, Node, time_of_chunk

NODE = Node(cores=64, bandwidth=64.0e9, alone=10.0e9, cache=4.0e6)
LOAD = Load(near=1.0e-4, far=3.0e-4, held=1.0e6, moved=5.0e5)


def test_chunks_that_the_caches_hold_are_near() -> None:
    """Four chunks of a megabyte fit into four, on any number of ranks."""
    assert time_of_chunk(4, 1, LOAD, NODE) == pytest.approx(LOAD.near)
    assert time_of_chunk(1, 512, LOAD, NODE) == pytest.approx(LOAD.near)


def test_half_of_the_chunks_in_the_caches_is_half_way() -> None:
    """Eight chunks, of which four are held; one core moves what they miss in a twelfth of that."""
    assert time_of_chunk(8, 1, LOAD, NODE) == pytest.approx(2.0e-4)


def test_many_cores_share_the_memory_of_their_node() -> None:
    """A gigabyte a second for each of 64: half a megabyte takes 5e-4 s, but for the share held."""
    assert time_of_chunk(400, 64, LOAD, NODE) == pytest.approx(0.99 * 5.0e-4)
    # further nodes bring memory of their own
    assert time_of_chunk(400, 256, LOAD, NODE) == time_of_chunk(400, 64, LOAD, NODE)
    # eight cores would have 8 GB/s each: the core is what takes time
    assert time_of_chunk(400, 8, LOAD, NODE) == pytest.approx(1.0e-4 + 0.99 * 2.0e-4)
