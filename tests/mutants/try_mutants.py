"""Change one line of the solver at a time, and look whether the tests of its folder notice.

`.venv/bin/python tests/mutants/try_mutants.py --count 100 --seed 1` chooses changes by chance in
all folders of src, builds each in a copy of the tree, and runs the unit tests of its folder and
those that use its module one by one, that of its file first. Mutants that these leave alive then
meet other tests a file at a time, those first that look at the folder, speak of the changed file,
have killed before and are short; the first failure ends it, and so do `--seconds`, which the table
says. A test that fails without a mutant, too, does not count. A mutant of which the compiler makes
the same code changes nothing. `--kept FILE` keeps what tests made of mutants: a second run with it,
of more seconds, goes on where the first was ended. By hand: a mutant takes a minute.
"""

from __future__ import annotations

import argparse
import random
import signal
import sys
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from change_lines import changes
from changed_copy import ROOT, Copy
from mutant import Kept, Mutant

#: Folders of src, and what looks at each first, the unit tests aside
FOLDERS = {
    "base": ["deck/test_restart.py", "faults/test_faults.py"],
    "contact": ["verification/contact", "verification/impactors", "verification/friction"],
    "deck": ["deck/errors", "deck/test_field_size.py", "deck/test_files_of_decks.py"],
    "domain": ["parallel", "verification/mass_scaling", "verification/average"],
    "element": ["verification/patch", "verification/large", "verification/cohesive_point"],
    "fem": ["verification/patch", "verification/bending"],
    "input": ["deck"],
    "io": ["deck", "verification/fixtures", "verification/fields"],
    "law": ["verification/ply_damage", "verification/plasticity", "verification/cohesive_point"],
    "method": ["verification/fixtures", "verification/implicit", "verification/stages"],
    "model": ["deck", "verification/impactors"],
    "parallel": ["parallel"],
    "run": ["deck", "verification/relaxation"],
    "state": ["deck/test_restart.py", "parallel"],
}


def choose(seed: int, count: int) -> list[Mutant]:
    """Mutants by chance, as many in each folder as in the others."""
    chance = random.Random(seed)
    order = list(FOLDERS)
    chance.shuffle(order)
    return [_mutant(chance, order[k % len(order)]) for k in range(count)]


def _mutant(chance: random.Random, folder: str) -> Mutant:
    """One of a folder: every change of every line alike."""
    return chance.choice(_all_of(folder))


@cache
def _all_of(folder: str) -> list[Mutant]:
    """All of a folder."""
    return [
        Mutant(path.relative_to(ROOT), number, line, new, before)
        for path in sorted((ROOT / "src" / folder).rglob("*.f90"))
        for number, line, before in _numbered(path)
        for new in changes(line, before)
    ]


def _numbered(path: Path) -> Iterator[tuple[int, str, str]]:
    """Lines with their numbers and the lines before them."""
    before = ""
    for number, line in enumerate(path.read_text().splitlines(), start=1):
        yield number, line, before
        before = line


def _tell(mutant: Mutant, fate: str) -> None:
    """Print what has become of a mutant."""
    sys.stdout.write(f"{fate:40} {mutant.path}:{mutant.number}\n")
    sys.stdout.write(f"   {mutant.old.strip()}\n   {mutant.new.strip() or '(dropped)'}\n")
    sys.stdout.flush()


def main() -> None:
    """Try mutants, and print what becomes of each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=240.0)
    parser.add_argument("--copy", type=Path, default=ROOT / "build" / "mutants")
    parser.add_argument("--kept", type=Path)
    asked = parser.parse_args()
    # the copy is put right at the end of a run that is broken off
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    kept = Kept(asked.kept)
    copy = Copy(asked.copy.resolve(), FOLDERS, kept)
    alive = []
    fates: Counter[str] = Counter()
    for mutant in choose(asked.seed, asked.count):
        fate = kept.fate(mutant, "unit")
        if fate is None:
            fate = copy.meets_units(mutant)
            kept.keep(mutant, "unit", fate)
        if fate:
            fates[fate if " by " not in fate else "killed by unit tests"] += 1
            _tell(mutant, fate)
        else:
            alive.append(mutant)
    for mutant in alive:
        fate = copy.meets_files(mutant, asked.seconds)
        fates[fate.split(" by ")[0].split(" of ")[0].rstrip("0123456789 ")] += 1
        _tell(mutant, fate)
    sys.stdout.write(", ".join(f"{number} {what}" for what, number in fates.items()) + "\n")


if __name__ == "__main__":
    main()
