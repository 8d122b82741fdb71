"""Keywords of a deck: their cards, and the fate of every field."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from plydyn_pre.errors import PreError
from plydyn_pre.translate.entry import IDLE, LOST, REPLACED, TAKEN, Entry

__all__ = ["IDLE", "LOST", "REPLACED", "TAKEN", "Block", "Row", "TranslateError", "Value"]

Value = float | int | str


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

    def whole(self, name: str, default: int | None = None) -> int:
        """A whole number that is taken."""
        return int(self.number(name, default))

    def ids(self, start: str) -> list[int]:
        """Whole numbers of the fields with a name and a number, taken."""
        self.mark(TAKEN, "", *(f"{start}{n}" for n in range(1, 9)))
        return [value for row in self.rows for value in row.numbers(start)]
