"""The listing says before a run how large its files will be, and what lines of energies take."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest

from brick_decks import add_bricks, box
from broken import impact
from decks import BOTTOM, Deck, Ply
from elasticity import CARBON
from meshes import regular
from runs import Results, run

MEGABYTE = 1.0e6
#: Lists of times and offsets grow with states, not with points: they are not counted
UNCOUNTED = 0.01


def bonded(nodes: int, order: int) -> Deck:
    """Two plies with springs between them, over two parts side by side."""
    mesh = regular(30.0, 20.0, 30, 20, nodes)
    deck = Deck("bonded", 1.0e-6)
    deck.control(linear=True)
    deck.mesh(mesh, (1,) * 15 + (2,) * 15)
    for part in (1, 2):
        deck.laminate([Ply(CARBON, 0.5), Ply(CARBON, 0.5, 90.0)], order, part=part)
    for part in (1, 2):
        deck.add("INTERFACE_COHESIVE", (part, 0, 0, 99))
    deck.add("MAT_COHESIVE_ELASTIC", (99, 0.0, 0, 0, 5.0e4, 1.0e5))
    deck.hold(mesh.where(x=0.0), "xyz")
    return deck


def solid() -> Deck:
    """Bricks of two parts, one above the other."""
    mesh = box((30.0, 30.0, 2.0), (30, 30, 2))
    deck = Deck("solid", 1.0e-6)
    deck.control(linear=True)

    def metals(deck: Deck) -> None:
        for number in (1, 2):
            deck.add("MAT_ELASTIC", (number, 2.7e-9, 7.0e4, 0.3))

    add_bricks(deck, mesh, metals, parts=(1,) * 900 + (2,) * 900)
    deck.hold(mesh.where(x=0.0), "xyz")
    return deck


def told(results: Results, what: str) -> float:
    """What the listing says of a file, bytes."""
    found = re.search(rf"^{what} +([\d.]+) MB$", results.listing(), re.MULTILINE)
    assert found is not None
    return MEGABYTE * float(found[1])


def held(path: Path) -> int:
    """Bytes of all that a file holds."""
    sizes = []
    with h5py.File(path) as file:
        file.visititems(
            lambda name, item: sizes.append(item.nbytes) if hasattr(item, "nbytes") else None
        )
    return sum(sizes)


@pytest.mark.parametrize(
    "make", [lambda: bonded(4, 1), lambda: bonded(4, 3), lambda: bonded(9, 2), solid]
)
def test_listing_tells_the_size_of_fields(make: Callable[[], Deck], tmp_path: Path) -> None:
    """For quads of four and nine nodes, and for bricks, in every number of states."""
    deck = make()
    deck.intervals(binary_d3plot=0.3e-6)
    deck.add("DATABASE_FIELD", "displacement stress")
    results = run(deck, tmp_path)
    size = held(tmp_path / "job.vtkhdf")
    assert size > MEGABYTE / 2
    assert told(results, "file of fields") == pytest.approx(size, rel=UNCOUNTED)
    interfaces = tmp_path / "job.interfaces.vtkhdf"
    if interfaces.exists():
        assert told(results, "file of interfaces") == pytest.approx(held(interfaces), rel=UNCOUNTED)


def busy() -> Deck:
    """An impact that can delaminate over a fixture, with all tables and restart files."""
    deck = impact(1, "cohesive", end=1.0e-5)
    deck.add("FIXTURE_BAR", (4, BOTTOM, 0.002, 1.0, 0.3), (1.0, 1.0, 1.0, 19.0))
    deck.intervals(delam=5.0e-8)
    deck.add("DATABASE_BINARY_D3DUMP", (40,))
    return deck


def test_listing_tells_the_size_of_tables_and_restart_files(tmp_path: Path) -> None:
    """Restart files to their heads; tables as if every number had all of its digits."""
    results = run(busy(), tmp_path)
    tables = sum(path.stat().st_size for path in tmp_path.glob("job.*.csv"))
    assert tables < told(results, "tables, about") < 2.0 * tables
    kept = sorted(tmp_path.glob("job.dump*"))
    found = re.search(r"^restart files kept, (\d+) +([\d.]+) MB$", results.listing(), re.MULTILINE)
    assert found is not None
    assert int(found[1]) == len(kept)
    size = sum(path.stat().st_size for path in kept)
    assert MEGABYTE * float(found[2]) == pytest.approx(size, rel=0.2)


@pytest.mark.parametrize(("interval", "is_advised"), [(None, True), (2.5e-7, False)])
def test_listing_counts_lines_of_energies(
    interval: float | None, is_advised: bool, tmp_path: Path
) -> None:
    """A line in each step without an interval; linear plies then take longer for them."""
    deck = bonded(9, 2)
    if interval:
        deck.intervals(glstat=interval)
    results = run(deck, tmp_path)
    found = re.search(r"^a line of energies +[\d.]+ ms, (\d+) of them$", results.listing(), re.M)
    assert found is not None
    # behind that of the start; the end of a run has one more step where it is halved
    assert 0 <= len(results.table("energy")["time"]) - 1 - int(found[1]) <= 1
    assert ("DT of *DATABASE_GLSTAT" in results.listing()) == is_advised
