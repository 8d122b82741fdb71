"""Threads: the results are the same to the last bit for any number of them."""

from __future__ import annotations

import csv
import os
import subprocess
from pathlib import Path

import pytest

from broken import averaged, said
from runs import SOLVER
from spread import metal, springs, tied


def run(
    deck: Path, folder: Path, threads: int, words: list[str], waiting: str = "passive"
) -> dict[str, bytes]:
    """What a run writes, but for the listing with its times.

    Threads wait `passive`, which is kinder to what else runs, or `active`.
    """
    folder.mkdir()
    environment = dict(os.environ)
    environment.pop("OMP_NUM_THREADS", None)
    environment["OMP_WAIT_POLICY"] = waiting
    if not words:
        environment["OMP_NUM_THREADS"] = str(threads)
    done = subprocess.run(
        [SOLVER, "run", deck, "-o", folder, *words],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    listing = (folder / "deck.out").read_text()
    assert f"threads                       {threads}\n" in listing
    results = {path.name: path.read_bytes() for path in folder.iterdir()}
    del results["deck.out"]
    return results


@pytest.mark.parametrize("make", [tied, springs, metal, averaged])
def test_same_bits_for_any_number_of_threads(make: object, tmp_path: Path) -> None:
    """Every file of histories, profiles and fields is the same, byte by byte."""
    deck = make().write(tmp_path / "deck.k")  # type: ignore[operator]
    alone = run(deck, tmp_path / "1", 1, ["ncpu=1"])
    assert {"deck.vtkhdf", "deck.energy.csv", "deck.profile_1.csv"} <= set(alone)
    rows = csv.DictReader(alone["deck.impactor_1.csv"].decode().splitlines())
    assert any(int(row["contacts [-]"]) > 0 for row in rows), "the impactor touches the plate"
    for threads in (2, 3, 5):
        assert run(deck, tmp_path / str(threads), threads, [f"ncpu={threads}"]) == alone
    assert run(deck, tmp_path / "environment", 2, []) == alone


def test_deck_asks_for_threads(tmp_path: Path) -> None:
    """NCPU of *CONTROL_PARALLEL; the command line goes before."""
    deck = springs()
    deck.add("CONTROL_PARALLEL", (3, 0, 0))
    path = deck.write(tmp_path / "deck.k")
    asked = run(path, tmp_path / "deck", 3, ["-j", "deck"])
    assert run(path, tmp_path / "word", 2, ["ncpu=2"]) == asked


@pytest.mark.parametrize(
    ("threads", "words"),
    [
        ("0", ""),
        ("100000", "100000 threads are too many for this machine: right would be at most"),
        ("99999999999", "an integer of at least 0; it is too large"),
        ("-1", "NCPU cannot be -1"),
        ("1.5", "NCPU: '1.5' is not an integer"),
    ],
)
def test_threads_of_a_deck_have_a_bound(threads: str, words: str, tmp_path: Path) -> None:
    """A number that no machine has is refused before it takes any memory; 0 is the usual one."""
    deck = springs()
    deck.add("CONTROL_PARALLEL", f"{threads},")
    code, text = said("check", deck.write(tmp_path / "deck.k"))
    assert code == (2 if words else 0), text
    assert words in text


def test_points_of_constraints_are_led_before_their_forces(tmp_path: Path) -> None:
    """A lever moves its points while other threads sum forces: five runs have the bits of one.

    More threads than cores, which wait actively, meet in most runs where one does not wait.
    """
    deck = Path(__file__).parent / "lever" / "deck.k"
    names = ("deck.constraints.csv", "deck.nodes.csv")
    alone = run(deck, tmp_path / "alone", 1, ["ncpu=1"])
    for k in range(5):
        results = run(deck, tmp_path / f"three_{k}", 3, ["ncpu=3"], "active")
        assert all(results[name] == alone[name] for name in names)
