"""Entries of Nastran's bulk data, and the commands of its case control."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from plydyn_pre.errors import PreError
from plydyn_pre.files import read_included
from plydyn_pre.translate.block import Block, Row, TranslateError, Value, named
from plydyn_pre.translate.numbers import number_of
from plydyn_pre.translate.source import dialect, entry_of, source_path

#: Entries of which a file has thousands; they share one table of the report
_MANY = ("GRID", "CQUAD4", "CQUADR", "CQUAD8", "CTRIA3", "CTRIAR", "CHEXA", "CPENTA", "CTETRA")


@dataclass(frozen=True)
class Card:
    """An entry: its fields behind the name, over all its lines."""

    name: str
    words: tuple[str, ...]
    block: Block
    line: int

    def fail(self, name: str, message: str) -> TranslateError:
        """An error about a field."""
        return self.block.fail(name, message, self.line)

    def lose(self, words: str, *names: str) -> None:
        """Tell of what changes the result and does not arrive."""
        self.block.lose(words, *names, line=self.line)

    def word(self, name: str) -> str:
        """A field by its name in the table."""
        return self.at((self.block.entry.cards or ()).index(name))

    def at(self, place: int) -> str:
        """A field by its place behind the name."""
        return self.words[place] if place < len(self.words) else ""

    def number(self, name: str, default: float | None = 0.0) -> float:
        """A number; an error if it is blank and has no default."""
        return self.number_of(name, self.word(name), default)

    def number_of(self, name: str, word: str, default: float | None = 0.0) -> float:
        """A word as a number."""
        if not word and default is not None:
            return default
        value = number_of(word)
        if value is None:
            shown = f"{word!r} was given" if word else "missing"
            raise self.fail(name, f"{shown}, a number is needed")
        return value

    def whole(self, name: str, default: int | None = 0) -> int:
        """A whole number."""
        return self.whole_of(name, self.word(name), default)

    def whole_of(self, name: str, word: str, default: int | None = 0) -> int:
        """A word as a whole number."""
        value = self.number_of(name, word, default)
        if value != int(value):
            raise self.fail(name, f"{word!r} was given, a whole number is needed")
        return int(value)

    def ids(self, start: int) -> list[int]:
        """Whole numbers from a place on; THRU stands for those between, BY for their steps."""
        found: list[int] = []
        words = [word.upper() for word in self.words[start:] if word]
        at = 0
        while at < len(words):
            if words[at] != "THRU":
                found.append(self.whole_of("", words[at], None))
                at += 1
                continue
            step = 1
            if words[at + 2 : at + 3] == ["BY"]:
                step = self.whole_of("BY", (*words, "")[at + 3], None)
            last = self.whole_of("THRU", (*words, "")[at + 1], None)
            if not found or last - found[-1] > 10_000_000 or step < 1:
                raise self.fail("THRU", "numbers run from low to high")
            found += range(found[-1] + step, last + 1, step)
            at += 4 if step > 1 else 2
        return found


@dataclass
class Deck:
    """The entries of a file, and its commands."""

    cards: list[Card] = field(default_factory=list)
    case: dict[str, Card] = field(default_factory=dict)  # commands by their names
    shown: list[Block] = field(default_factory=list)
    problems: list[PreError] = field(default_factory=list)

    def each(self, *names: str) -> Iterator[Card]:
        """Entries of some names."""
        return (card for card in self.cards if card.name in names)

    def chosen(self, command: str) -> int:
        """The set that a command of the case control chooses; 0 for none."""
        card = self.case.get(command)
        return card.whole_of("", card.at(0), 0) if card and card.at(0).isdigit() else 0


def read_deck(path: Path) -> Deck:
    """The entries of a file and of those that it includes."""
    deck = Deck()
    _read(deck, path, 0)
    return deck


def _read(deck: Deck, path: Path, depth: int) -> None:
    """Read a file; includes where they stand."""
    whole = read_included(path, depth).splitlines()
    # without remarks
    lines = [(n, line.split("$")[0].rstrip()) for n, line in enumerate(whole, start=1)]
    begin = next((k for k, (_, line) in enumerate(lines) if _is(line, "BEGIN")), -1)
    commands = lines[:begin] if begin >= 0 else []
    for number, line in commands:
        if line.strip():
            _command(deck, path, number, line)
    pending: list[tuple[int, list[str]]] = []
    for number, line in lines[begin + 1 :]:
        if _is(line, "ENDDATA"):
            break
        if _is(line, "INCLUDE"):
            name = line.strip()[len("INCLUDE") :]
            _read(deck, source_path(path, name, path.parent), depth + 1)
        elif line.strip():
            words = _fields(line)
            _check_length(deck, (path, number), line)
            if words[0] and words[0][0] not in "+*":
                pending.append((number, words))
            elif pending:
                pending[-1][1].extend(words[1:])
    for number, words in pending:
        _card(deck, path, number, words)


def _is(line: str, word: str) -> bool:
    """Whether a line begins with a word."""
    return line.strip().upper().startswith(word)


def _command(deck: Deck, path: Path, number: int, line: str) -> None:
    """Read a command of the executive or case control."""
    head, _, value = line.strip().partition("=")
    if not value and " " in head:
        head, _, value = head.partition(" ")
    name = head.upper().split("(")[0].strip()
    name = "SUBCASE" if name.startswith("SUBCASE") else name
    entry = entry_of(dialect("nastran"), f"case {name}")
    block = Block(f"case {name}", name, path, number, entry, label=name)
    block.rows.append(Row(number, {"value": value.strip()} if value.strip() else {}))
    if name == "SUBCASE" and name in deck.case:
        block.lose("a second subcase is not translated")
    deck.case[name] = Card(name, (value.strip(),), block, number)
    deck.shown.append(block)


def _fields(line: str) -> list[str]:
    """The name and the fields of a line: with commas, or of 8 or 16 columns."""
    if "," in line:
        words = [word.strip() for word in line.split(",")]
        if words[0].endswith("*") or words[0].startswith("*"):
            return [words[0], *(*words[1:5], *[""] * 4)[:4]]
        return [words[0], *(*words[1:9], *[""] * 8)[:8]]
    line = line.expandtabs(8)
    head = line[:8].strip()
    if head.endswith("*") or head.startswith("*"):
        return [head, *(line[at : at + 16].strip() for at in range(8, 72, 16))]
    return [head, *(line[at : at + 8].strip() for at in range(8, 72, 8))]


def _check_length(deck: Deck, place: tuple[Path, int], line: str) -> None:
    """Refuse more fields between commas than an entry has; the last one marks its next line."""
    words = [word.strip() for word in line.split(",")]
    most = 5 if "*" in words[0] else 9
    if rest := [word for word in words[most:] if word and word[0] not in "+*"]:
        message = f"{rest[0]!r} is a field too many: {most - 1} fit between commas"
        deck.problems.append(TranslateError(*place, words[0].upper(), message))


def _card(deck: Deck, path: Path, number: int, words: list[str]) -> None:
    """Read an entry."""
    name = words[0].rstrip("*").upper()
    entry = entry_of(dialect("nastran"), name)
    last = deck.shown[-1] if deck.shown else None
    while len(words) > 1 and not words[-1]:
        words.pop()
    joined = last is not None and last.name == name and last.file == path
    if not (joined and name in _MANY and last):
        last = Block(name, name, path, number, entry, label=name)
        deck.shown.append(last)
    card = Card(name, tuple(words[1:]), last, number)
    deck.cards.append(card)
    values: dict[str, Value] = {}
    for key, word in named(entry.cards or (), words[1:]):
        value = number_of(word)
        values[key] = word if value is None else value
    last.rows.append(Row(number, values))
