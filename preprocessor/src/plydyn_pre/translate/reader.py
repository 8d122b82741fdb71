"""LS-DYNA's keyword files: blocks of cards with the line and the fate of every field."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path

from plydyn_pre.errors import PreError
from plydyn_pre.files import is_file
from plydyn_pre.translate.schema import ALIASES, SCHEMAS, WIDTHS

TAKEN, REPLACED, LOST = "taken", "replaced", "lost"
_DEEPEST = 20
_LARGEST = 1 << 30  # bytes of a file
_NUMBER = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+))(?:[eEdD]?([-+]\d+)|[eEdD](\d+))?")
_SHORT, _LONG = 10, 20

Value = float | int | str


class TranslateError(PreError):
    """A deck that cannot be translated, with the place that is wrong."""

    def __init__(self, file: Path, line: int, place: str, message: str) -> None:
        """Say what is wrong in which field of which keyword."""
        super().__init__(f"{file}:{line}: {place}: {message}")


@dataclass(frozen=True)
class Row:
    """A card: its fields by name; blank ones are left out."""

    line: int
    values: dict[str, Value]


@dataclass(eq=False)
class Block:
    """A keyword with its cards, and what becomes of each of its fields."""

    name: str  # without suffixes, by its full name
    written: str  # as the deck has it
    file: Path
    line: int
    rows: list[Row] = field(default_factory=list)
    fates: dict[str, tuple[str, str]] = field(default_factory=dict)
    remarks: list[str] = field(default_factory=list)

    def fail(self, name: str, message: str, line: int = 0) -> TranslateError:
        """An error about a field."""
        place = f"*{self.written} {name}".rstrip()
        return TranslateError(self.file, line or self.line, place, message)

    def mark(self, fate: str, words: str, *names: str) -> None:
        """Tell what becomes of some fields."""
        for name in names:
            self.fates[name] = (fate, words)

    def has(self, name: str) -> bool:
        """Whether a field is filled."""
        return any(name in row.values for row in self.rows)

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
            line = next(row.line for row in self.rows if name in row.values)
            raise self.fail(name, f"{value:g} was given, a number above zero is needed", line)
        return value

    def whole(self, name: str, default: int | None = None) -> int:
        """A whole number that is taken."""
        return int(self.number(name, default))


def read_deck(path: Path) -> list[Block]:
    """The keywords of a deck and of the files that it includes."""
    blocks: list[Block] = []
    parameters: dict[str, str] = {}
    reader = _Reader(blocks, parameters)
    reader.read(path, 0)
    if not blocks:
        raise TranslateError(path, 1, "*KEYWORD", "missing; no keyword is in the file")
    return blocks


class _Reader:
    """Files one after the other, into blocks."""

    def __init__(self, blocks: list[Block], parameters: dict[str, str]) -> None:
        self.blocks = blocks
        self.parameters = parameters
        self.long = False

    def read(self, path: Path, depth: int) -> None:
        """Read a file; includes where they stand."""
        if not is_file(path) or path.stat().st_size > _LARGEST:
            raise PreError(f"{path}: there is no such file, or it is larger than 1 GB")
        if depth > _DEEPEST:
            raise PreError(f"{path}: more than {_DEEPEST} files include each other")
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
        for start, name, data in _keywords(lines):
            if name.startswith("END") and name == "END":
                return
            self._keyword(path, start, name, data, depth)

    def _keyword(
        self, path: Path, start: int, name: str, data: list[tuple[int, str]], depth: int
    ) -> None:
        """Read a keyword."""
        if name.startswith("KEYWORD"):
            self.long = "LONG=Y" in name.replace(" ", "") or "LONG=K" in name.replace(" ", "")
        elif name in ("INCLUDE",):
            for _, line in data:
                if line.strip():
                    self.read(path.parent / line.strip(), depth + 1)
        elif name.split()[0] == "PARAMETER":
            self._parameters(path, data)
        else:
            self.blocks.append(self._block(path, start, name, data))

    def _parameters(self, path: Path, data: list[tuple[int, str]]) -> None:
        """Read names for numbers."""
        for line, text in data:
            if not text.strip():
                continue
            words = [text[i : i + _SHORT] for i in range(0, len(text), _SHORT)]
            words = [w.strip() for w in (text.split(",") if "," in text else words)]
            for name, value in zip(words[::2], words[1::2], strict=False):
                if name and _number(value) is None:
                    raise TranslateError(path, line, "*PARAMETER", f"{value!r} is no number")
                self.parameters[name[1:].strip().upper()] = value

    def _block(self, path: Path, start: int, name: str, data: list[tuple[int, str]]) -> Block:
        """The cards of a keyword."""
        long = self.long
        if name[-1] in "+-" and name[-2] != " ":
            long, name = name[-1] == "+", name[:-1]
        base, titles = _base(name)
        block = Block(base, name, path, start)
        cards = [f"t:{title}" for title in titles] + list(_schema(base) or ())
        known = _schema(base) is not None
        while data and not data[-1][1].strip() and len(data) > len(cards):
            data.pop()
        for number, (line, text) in enumerate(data):
            if known and number >= len(cards) and not (cards and cards[-1][0] == "*"):
                raise block.fail("", f"{text.strip()!r} is a card too many", line)
            if known:
                card = cards[min(number, len(cards) - 1)]
            else:
                card = cards[number] if number < len(cards) else f"{number + 1 - len(titles)}"
            values = self._fields(block, card, line, text, long)
            if values or card[0] != "*":
                block.rows.append(Row(line, values))
        needed = [card for card in cards if card[0] not in "?*"]
        if known and len(data) < len(needed):
            names = " ".join(word.rpartition(":")[2] for word in needed[len(data)].split())
            raise block.fail("", f"card {len(data) + 1} is missing: {names}")
        return block

    def _fields(
        self, block: Block, card: str, line: int, text: str, long: bool
    ) -> dict[str, Value]:
        """The filled fields of a line."""
        if card.startswith("t:") and " " not in card:
            return {card[2:]: text.strip()} if text.strip() else {}
        words = _split(text, WIDTHS.get(block.name) if card[0] == "*" else None, long)
        if card.isdigit():
            pairs = enumerate(words, start=1)
            return {f"card {card} field {i}": word for i, word in pairs if word}
        names = card.lstrip("*?").split()
        if len(words) > len(names) and any(words[len(names) :]):
            raise block.fail("", f"{words[len(names)]!r} is a field too many", line)
        values: dict[str, Value] = {}
        for name, word in zip(names, words, strict=False):
            if word:
                kind, _, plain = name.rpartition(":")
                values[plain] = self._value(block, plain, kind, word, line)
        return values

    def _value(self, block: Block, name: str, kind: str, word: str, line: int) -> Value:
        """The value of a field."""
        if kind == "t":
            return word
        sign, key = ("-", word[2:]) if word.startswith("-&") else ("", word[1:])
        if "&" in word[:2]:
            if key.upper() not in self.parameters:
                raise block.fail(name, f"there is no parameter {key!r}", line)
            word = sign + self.parameters[key.upper()]
        value = _number(word)
        if value is None:
            raise block.fail(name, f"{word!r} was given, a number is needed", line)
        if kind == "i" and value != round(value):
            raise block.fail(name, f"{word!r} was given, a whole number is needed", line)
        return int(value) if kind == "i" else value


def _keywords(lines: list[str]) -> Iterator[tuple[int, str, list[tuple[int, str]]]]:
    """Keywords with their first line and their lines of data."""
    name, start, data = "", 0, []
    for number, line in enumerate(lines, start=1):
        if line.startswith("$"):
            continue
        if line.startswith("*"):
            if name:
                yield start, name, data
            name, start, data = line[1:].strip().upper() or "?", number, []
        elif name:
            data.append((number, line))
    if name:
        yield start, name, data


def _base(name: str) -> tuple[str, list[str]]:
    """The full name of a keyword, and the cards that its suffixes put in front."""
    base, titles = name, []
    for suffix in ("_TITLE", "_ID"):
        if base.endswith(suffix) and base != "TITLE":
            base = base.removesuffix(suffix)
            titles = ["NAME"]
    base = ALIASES.get(base, base)
    if base.startswith("CONTACT_"):
        return ("CONTACT_TIEBREAK" if base.endswith("TIEBREAK") else "CONTACT"), titles
    return base, titles


def _schema(base: str) -> tuple[str, ...] | None:
    """The cards of a keyword; None for one that is not known."""
    return SCHEMAS.get(base)


def _split(text: str, widths: tuple[int, ...] | None, long: bool) -> list[str]:
    """The fields of a line, by commas or by columns."""
    if "," in text:
        return [word.strip() for word in text.split(",")]
    if long:
        widths = (_LONG,) * 10
    widths = widths or (_SHORT,) * 8
    words, at = [], 0
    for width in widths:
        words.append(text[at : at + width].strip())
        at += width
    if text[at:].strip():
        words.append(text[at:].strip())
    return words


def _number(word: str) -> float | None:
    """A number as Fortran writes it, or None."""
    match = _NUMBER.fullmatch(word)
    if match is None:
        return None
    value = float(f"{match[1]}e{match[2] or match[3] or 0}")
    return value if isfinite(value) else None
