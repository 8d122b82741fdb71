"""Decks, requests and command lines changed by chance: refused in words or run, never a crash.

`FUZZ=5000 pytest tests/deck/test_fuzz.py` tries that many mutants instead of some hundred;
`FUZZ_SEED=7` tries others. A mutant that fails is kept in the folder of the test.
"""

from __future__ import annotations

import os
import random
from pathlib import Path

import pytest

from broken import impact
from fixture_decks import all_bodies, all_fixtures
from fuzzing import (
    CRASHES,
    INPUT,
    NORMAL,
    OUTPUT,
    RUN,
    SECONDS,
    STOPPED,
    USAGE,
    check,
    check_finite,
    run,
)
from mutants import mutate
from ranks import launch
from runs import ROOT

MUTANTS = int(os.environ.get("FUZZ", "240"))
SEED = int(os.environ.get("FUZZ_SEED", "20260"))
REPEATED = 10  # good decks are fewer


def seeds() -> list[str]:
    """Decks of the tests, of a size that is read in no time; about as many good ones as bad."""
    paths = sorted((ROOT / "tests" / "deck").glob("*/deck.k"))
    texts = [path.read_text() for path in paths] * REPEATED
    parts = ROOT / "tests" / "deck" / "errors"
    for path in sorted(parts.glob("*.k")):
        texts.append(path.read_text().replace("\ngood/", f"\n{parts}/good/"))
    return [text for text in texts if len(text) < 20_000]


def decks_of_bodies() -> list[str]:
    """Decks with bodies of every kind, and with plies that crack in three dimensions."""
    decks = [all_fixtures(), all_fixtures(1), all_fixtures(linear=True, method=2)]
    decks += [all_bodies(), all_bodies(2), all_bodies(apart=True)]
    decks += [impact(1, joint, fracture=True) for joint in ("tied", "springs", "cohesive")]
    decks += [impact(2, "cohesive", fracture=True, implicit=1)]
    for deck in decks[::2]:
        deck.add("CONTROL_QUASI_STATIC", (0.05,))
        deck.add("DAMPING_RELAXATION", (1.0e-6,))
    return [deck.text() for deck in decks]


def try_mutant(text: str, folder: Path, name: str, chance: random.Random, runs: float) -> None:
    """Check a deck, and run a share of those that pass for a second."""
    deck = folder / "mutant.k"
    deck.write_text(text, errors="replace")
    before = deck.read_bytes()
    done = run(folder, "check", deck)
    check(done, {NORMAL, INPUT, RUN}, f"mutant {name}")
    if done.returncode == NORMAL and chance.random() < runs:
        done = run(folder, "run", deck, "-j", "job", "--wall-time", "1")
        check(done, {NORMAL, INPUT, RUN, STOPPED, OUTPUT}, f"run of mutant {name}")
        if done.returncode in (NORMAL, STOPPED):
            check_finite(folder, "job", f"run of mutant {name}")
        for path in folder.glob("job.*"):
            path.unlink()
    assert deck.read_bytes() == before, f"mutant {name} was changed"


@pytest.mark.parametrize("part", range(4))
def test_mutants_of_decks(part: int, tmp_path: Path) -> None:
    """All are checked, and some of those that pass run for a second."""
    texts, chance = seeds(), random.Random(SEED + part)
    for i in range(MUTANTS // 4):
        try_mutant(mutate(chance.choice(texts), chance), tmp_path, f"{part}.{i}", chance, 0.15)


def test_mutants_of_bodies_and_cracks(tmp_path: Path) -> None:
    """Fixtures, impactors of every shape and planes of fracture; half of what passes runs."""
    texts, chance = decks_of_bodies(), random.Random(SEED + 5)
    for i in range(max(2, MUTANTS // 12)):
        try_mutant(mutate(chance.choice(texts), chance), tmp_path, f"{i}", chance, 0.5)


def test_mutants_on_ranks(tmp_path: Path) -> None:
    """Two ranks end as one does, and the root alone says why."""
    texts, chance = seeds(), random.Random(SEED + 4)
    for i in range(max(2, MUTANTS // 12)):
        deck = tmp_path / "mutant.k"
        deck.write_text(mutate(chance.choice(texts), chance), errors="replace")
        words = ("run", deck, "-o", tmp_path / "out", "--wall-time", "1")
        alone = run(tmp_path, *words[:2], "-o", tmp_path / "one", "--wall-time", "1")
        both = launch(2, *words, seconds=3 * SECONDS)
        if STOPPED not in (alone.returncode, both.returncode):
            assert both.returncode == alone.returncode, f"mutant {i}: {both.stdout + both.stderr}"
        said = both.stdout + both.stderr
        assert not any(crash in said for crash in CRASHES[:-1]), f"mutant {i}\n{said[-3000:]}"
        if alone.returncode == INPUT:
            assert both.stderr.count(alone.stderr.decode().splitlines()[-1]) == 1, f"mutant {i}"


def test_requests_by_chance(tmp_path: Path) -> None:
    """Whatever stands in JOB.ctl, the run ends as it should."""
    deck = ROOT / "tests" / "deck" / "heads" / "deck.k"
    words = ["stop", "dump", "plot", "status", "flush", "end-time", "sw1", "5e-4", "=", "\x1b[2J"]
    chance = random.Random(SEED)
    for i in range(max(2, MUTANTS // 60)):
        lines = [
            " ".join(chance.choices(words, k=chance.randrange(4)))
            for _ in range(chance.randrange(200))
        ]
        (tmp_path / "job.ctl").write_text("\n".join(lines))
        done = run(tmp_path, "run", deck, "-j", "job")
        check(done, {NORMAL, STOPPED}, f"requests {i}")


def test_command_lines_by_chance(tmp_path: Path) -> None:
    """Words of a command line in any order."""
    deck = ROOT / "tests" / "deck" / "heads" / "deck.k"
    words = ["check", "check", str(deck), "-j", "job", "-o", "out", "-p", "a=1", "--wall-time"]
    words += ["1:2:3:4", ".", "1e9", "ncpu=1", "ncpu=9999999999", "i=", "r=", "--keywords", ""]
    words += ["\x01", "*NODE", "--version", "x" * 5000, "-", "restart", "jobid=", f"i={deck}"]
    chance = random.Random(SEED)
    for i in range(max(20, MUTANTS // 6)):
        chosen = chance.choices(words, k=chance.randrange(6))
        done = run(tmp_path, *chosen)
        check(done, {NORMAL, USAGE, INPUT, OUTPUT}, f"command line {i}: {chosen}")
