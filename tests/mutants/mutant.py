"""A changed line of the solver, and what tests have made of it so far."""

from __future__ import annotations

import json
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

#: What a test makes of a mutant, and of the program without one
PASSES, FAILS = "passes", "fails"


@dataclass(frozen=True)
class Mutant:
    """A line of a file, and what it becomes."""

    path: Path  # from the root
    number: int  # from 1
    old: str
    new: str
    before: str  # the line before it


#: The program as it is
SOUND = Mutant(Path(), 0, "", "", "")


class Kept:
    """What tests made of mutants, kept in a file line by line."""

    def __init__(self, file: Path | None) -> None:
        """Take what an earlier run has left in the file."""
        self.file = file
        lines = file.read_text().splitlines() if file is not None and file.exists() else []
        self.fates = {tuple(one[:4]): one[4] for one in map(json.loads, lines)}
        #: How many mutants each test has killed
        self.kills = Counter(key[3] for key, fate in self.fates.items() if fate == FAILS and key[0])

    def fate(self, mutant: Mutant, test: str) -> str | None:
        """What a test made of it; nothing where it has not met that test."""
        return self.fates.get(_key(mutant, test))

    def keep(self, mutant: Mutant, test: str, fate: str) -> None:
        """Keep what a test made of it."""
        key = _key(mutant, test)
        self.fates[key] = fate
        self.kills[test] += fate == FAILS and mutant != SOUND
        if self.file is not None:
            with self.file.open("a") as file:
                file.write(json.dumps([*key, fate]) + "\n")


def _key(mutant: Mutant, test: str) -> tuple[str, int, str, str]:
    return str(mutant.path), mutant.number, mutant.new, test
