"""Keywords of a deck: their cards, and the fate of every field."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib.resources import files
from itertools import chain, count
from pathlib import Path
from typing import Any

from plydyn_pre.errors import PreError

TAKEN, REPLACED, IDLE, LOST = "taken", "replaced", "no effect here", "lost"
#: What the tables call them
FATES = {"taken": TAKEN, "replaced": REPLACED, "idle": IDLE, "lost": LOST}

Value = float | int | str


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


def by_start(known: Mapping[str, Entry], name: str) -> Entry:
    """The entry of all names that begin as this one."""
    starts = [key for key in known if key[-1] == "*" and name.startswith(key[:-1])]
    return known[max(starts, key=len)] if starts else Entry(LOST, "this keyword is not translated")


def named(names: Sequence[str], words: Sequence[str]) -> Iterator[tuple[str, str]]:
    """The filled words of a row by their fields, which have numbers behind the last name."""
    fields = chain(names, (f"field {n}" for n in count(len(names) + 1)))
    return ((name, word) for name, word in zip(fields, words, strict=False) if word)


class Gathering:
    """What goes on where something is refused, and keeps it."""

    problems: list[PreError]

    @contextmanager
    def gathered(self) -> Iterator[None]:
        """Keep what is refused inside, and go on."""
        try:
            yield
        except PreError as error:
            self.problems.append(error)


class TranslateError(PreError):
    """A deck that cannot be translated, with the place that is wrong."""

    def __init__(self, file: Path, line: int, place: str, message: str) -> None:
        """Say what is wrong in which field of which keyword."""
        super().__init__(f"{file}:{line}: {place}: {message}")


@dataclass(frozen=True)
class Row:
    """A card, or a group of cards that is repeated: fields by name; blank ones are left out."""

    line: int
    values: dict[str, Value]

    def whole(self, name: str) -> int:
        """A whole number; 0 for a blank."""
        return int(self.values.get(name, 0))

    def number(self, name: str, default: float = 0.0) -> float:
        """A number."""
        return float(self.values.get(name, default))

    def numbers(self, start: str) -> list[int]:
        """Whole numbers other than 0 of the fields whose names are `start` and a number."""
        named = (
            v for n, v in self.values.items() if n.startswith(start) and n[len(start) :].isdigit()
        )
        return [int(value) for value in named if value]


@dataclass(eq=False)
class Block:
    """A keyword with its cards, and what becomes of each of its fields."""

    name: str  # without suffixes, by its full name
    written: str  # as the deck has it
    file: Path
    line: int
    entry: Entry
    rows: list[Row] = field(default_factory=list)
    fates: dict[str, tuple[str, str]] = field(default_factory=dict)
    remarks: list[str] = field(default_factory=list)
    losses: list[TranslateError] = field(default_factory=list)
    failed: bool = False  # whether something of it has been refused
    label: str = ""  # what its own program calls it, where that is not LS-DYNA
    names: Mapping[str, str] = field(default_factory=dict)  # and its fields

    @property
    def title(self) -> str:
        """What it is called in messages."""
        return self.label or f"*{self.written}"

    def fail(self, name: str, message: str, line: int = 0) -> TranslateError:
        """An error about a field."""
        self.failed = True
        shown = " ".join(self.names.get(word, word) for word in name.split())
        place = f"{self.title} {shown}".rstrip()
        return TranslateError(self.file, line or self.line, place, message)

    def mark(self, fate: str, words: str, *names: str) -> None:
        """Tell what becomes of some fields."""
        for name in names:
            self.fates[name] = (fate, words)

    def lose(self, words: str, *names: str, line: int = 0) -> None:
        """Tell of fields that change the result and do not arrive."""
        self.mark(LOST, words, *names)
        self.losses.append(self.fail(" ".join(names), words, line))

    def lose_filled(self, words: str, *names: str) -> None:
        """Tell of those among some fields that are filled, other than with zero."""
        for name in names:
            line = next((row.line for row in self.rows if row.values.get(name)), 0)
            if line:
                self.lose(words, name, line=line)

    def has(self, name: str) -> bool:
        """Whether a field is filled."""
        return any(name in row.values for row in self.rows)

    def line_of(self, name: str) -> int:
        """The line of a field."""
        return next((row.line for row in self.rows if name in row.values), self.line)

    def raw(self, name: str, default: Value | None = None) -> Value:
        """The value of a field on any card; an error if it is blank and has no default."""
        for row in self.rows:
            if name in row.values:
                return row.values[name]
        if default is None:
            raise self.fail(name, "missing; a value is needed")
        return default

    def number(self, name: str, default: float | None = None) -> float:
        """A number that is taken."""
        self.mark(TAKEN, "", name)
        return float(self.raw(name, default))

    def positive(self, name: str) -> float:
        """A number above zero that is taken."""
        value = self.number(name)
        if value <= 0.0:
            words = f"{value:g} was given, a number above zero is needed"
            raise self.fail(name, words, self.line_of(name))
        return value

    def refuse_curve(self, name: str, over: str = "") -> None:
        """Refuse a number below zero, which is that of a curve over something."""
        if (value := float(self.raw(name, 0.0))) < 0.0:
            words = f"{value:g} is below zero: a curve{over} is not translated"
            raise self.fail(name, words, self.line_of(name))

    def whole(self, name: str, default: int | None = None) -> int:
        """A whole number that is taken."""
        return int(self.number(name, default))

    def ids(self, start: str) -> list[int]:
        """Whole numbers of the fields with a name and a number, taken."""
        self.mark(TAKEN, "", *(f"{start}{n}" for n in range(1, 9)))
        return [value for row in self.rows for value in row.numbers(start)]
