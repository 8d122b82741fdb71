"""What is known of a keyword of another program."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib.resources import files
from typing import Any

TAKEN, REPLACED, IDLE, LOST = "taken", "replaced", "no effect here", "lost"
#: What the tables call them
FATES = {"taken": TAKEN, "replaced": REPLACED, "idle": IDLE, "lost": LOST}


@dataclass(frozen=True)
class Entry:
    """What becomes of a keyword and of its fields."""

    fate: str
    words: str = ""
    cards: tuple[str, ...] | None = None  # None for one whose fields are only counted
    sets: bool = False
    idle: Mapping[str, str] = field(default_factory=dict)  # patterns of names, by reason
    titles: tuple[str, ...] = ()  # cards in front
    each: bool = False  # titles stand in front of each group of cards
    options: frozenset[str] = frozenset()  # parameters that are read; none of LS-DYNA's
    refused: Mapping[str, str] = field(default_factory=dict)  # what is said of fields, by name
    rest: bool = True  # whether fields behind the named ones are read

    def why_idle(self, name: str) -> str:
        """Why a field has no effect here; empty where it has one."""
        for words, names in self.idle.items():
            if names == "*" or any(re.fullmatch(each, name) for each in names.split()):
                return words
        return ""


def raw_table(name: str) -> dict[str, Any]:
    """A table of keywords as it stands; what an entry lacks is that of the one it is like.

    What is refused is told of the one keyword alone.
    """
    text = files("plydyn_pre.translate").joinpath(name).read_text(encoding="utf-8")
    raw = tomllib.loads(text)
    found = {key: raw.get(data.get("like", ""), {}) | data for key, data in raw.items()}
    return {key: data | {"refused": raw[key].get("refused", {})} for key, data in found.items()}
