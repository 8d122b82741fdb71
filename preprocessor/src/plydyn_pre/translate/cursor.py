"""The cards of a keyword: lines of a file as named fields."""

from __future__ import annotations

import re

from plydyn_pre.errors import PreError
from plydyn_pre.translate.block import Block, Entry, Row, TranslateError, Value, named
from plydyn_pre.translate.numbers import number_of
from plydyn_pre.translate.parameters import Parameters

_CARD = re.compile(r"(?:([\d,]+) )?([?&*]?)(.*)")
#: The two lines of a brick in the format of ten nodes
_HEAD, _TEN_NODES = "8 i:EID i:PID", f"8 {' '.join(f'i:N{n}' for n in range(1, 11))}"


def _parts(card: str) -> tuple[str | None, str, str]:
    """Widths of a card of the table, its mark, and the names of its fields."""
    found = _CARD.fullmatch(card)
    if found is None:
        raise ValueError(card)
    return found[1], found[2], found[3]


Lines = list[tuple[int, str]]


class Cursor:
    """The lines of a keyword, taken card by card."""

    def __init__(
        self, parameters: Parameters, entry: Entry, data: Lines, long: bool, wide: bool
    ) -> None:
        self.parameters = parameters
        self.entry = entry
        self.lines = data[::-1]
        self.long, self.wide = long, wide
        self.problems: list[PreError] = []

    @property
    def line(self) -> int:
        """Number of the next line; 0 at the end."""
        return self.lines[-1][0] if self.lines else 0

    def fill(self, block: Block) -> None:
        """Read the cards of a block."""
        if self.entry.cards is None:
            self._count(block)
            return
        cards = list(self.entry.cards)
        cut = next((i for i, card in enumerate(cards) if _parts(card)[1] == "*"), len(cards))
        head, group = cards[:cut], cards[cut:]
        titles = list(self.entry.titles)
        if not self.entry.each:
            head, titles = titles + head, []
        for card in head:
            self._card(block, card)
        while group and self.lines:
            self._group(block, [*titles, *group])
        if not any(text.strip() for _, text in self.lines):
            self.lines = []
        if self.lines and not self.entry.sets:
            line, text = self.lines[-1]
            self.problems.append(block.fail("", f"{text.strip()!r} is a card too many", line))
            self.lines = []

    def _count(self, block: Block) -> None:
        """Fields of a keyword that is not known, by card and place."""
        for card, (line, text) in enumerate(reversed(self.lines), start=1):
            words = enumerate(split_fields(text, (20 if self.long else 10,) * 8), start=1)
            values: dict[str, Value] = {f"card {card} field {i}": w for i, w in words if w}
            block.rows.append(Row(line, values))
        self.lines = []

    def _card(self, block: Block, card: str) -> None:
        """Read a card at the front of a keyword."""
        if card.startswith("angles"):
            points = int(block.raw("NIP", 2)) or 2
            count = -(-points // 8) if block.raw("ICOMP", 0) == 1 else 0
            for _ in range(min(count, len(self.lines))):
                line, text = self.lines.pop()
                names = " ".join(f"B{n}" for n in range(1, 9))
                block.rows.append(Row(line, self._fields(block, names, line, text)))
            return
        if card.startswith("local "):
            if block.raw("IRCS", 0) != 1:
                return
            card = card.removeprefix("local ")
        _, mark, _ = _parts(card)
        if mark == "&" and not (self.lines and self.lines[-1][1].startswith("&")):
            return
        if not self.lines:
            if mark not in ("?", "&"):
                names = " ".join(word.rpartition(":")[2] for word in card.split())
                problem = block.fail("", f"card {len(block.rows) + 1} is missing: {names}")
                self.problems.append(problem)
            return
        line, text = self.lines.pop()
        block.rows.append(
            Row(line, self._fields(block, card, line, text.replace("&", " ", mark == "&")))
        )

    def _group(self, block: Block, cards: list[str]) -> None:
        """Read cards that belong together, as one row."""
        first, values = self.line, dict[str, Value]()
        for number, card in enumerate(cards):
            if not self.lines:
                break
            line, text = self.lines.pop()
            if block.name == "ELEMENT_SOLID" and self.lines and self._is_head(text):
                values |= self._fields(block, _HEAD, line, text)
                line, text = self.lines.pop()
                values |= self._fields(block, _TEN_NODES, line, text)
                continue
            values |= self._fields(block, card, line, text)
            if number == 1 and block.name.startswith("ELEMENT_SHELL_COMPOSITE"):
                self._plies(block, values, card)
        if values:
            block.rows.append(Row(first, values))

    def _is_head(self, text: str) -> bool:
        """Whether a line has only the number and the part of a brick, whose nodes follow."""
        words = [word for word in split_fields(text, self._widths("8")) if word]
        return len(words) == 2

    def _plies(self, block: Block, values: dict[str, Value], card: str) -> None:
        """The other cards of the plies of an element, until the next element."""
        each = 2 if "MID2" in card else 1
        before = each
        while self.lines and "." in self.lines[-1][1]:
            line, text = self.lines.pop()
            for name, value in self._fields(block, card, line, text).items():
                values[f"{name[:-1]}{int(name[-1]) + before}"] = value
            before += each

    def _fields(self, block: Block, card: str, line: int, text: str) -> dict[str, Value]:
        """The filled fields of a line."""
        widths, _, names = _parts(card)
        if names.startswith("t:") and " " not in names:
            return {names[2:]: text.strip()} if text.strip() else {}
        if "," not in text:
            text = text[: 200 if self.long else 100 if self.wide else 80].rstrip()
            if "\t" in text:
                told = "columns are counted in blanks, of which a tab is none; commas do as well"
                self.problems.append(block.fail("", told, line))
                return {}
        words = split_fields(text, self._widths(widths))
        values: dict[str, Value] = {}
        for name, word in named(names.split(), words):
            try:
                kind, _, plain = name.rpartition(":")
                values[plain] = self._value(block, plain, kind, word, line)
            except TranslateError as error:
                self.problems.append(error)
        return values

    def _widths(self, text: str | None) -> tuple[int, ...]:
        """Widths of the columns of a card."""
        if self.long:
            return (20,) * 10
        widths = tuple(map(int, (text or "10").split(",")))
        if self.wide:
            widths = tuple(10 if width == 8 else width for width in widths)
        return widths if len(widths) > 1 else widths * (80 // widths[0])

    def _value(self, block: Block, name: str, kind: str, word: str, line: int) -> Value:
        """The value of a field."""
        if "&" in word[:2] or word.startswith("<"):
            try:
                word = self.parameters.filled(word)
            except KeyError as error:
                raise block.fail(
                    name, f"there is no parameter {error.args[0].lower()!r}", line
                ) from error
            except ValueError as error:
                raise block.fail(name, f"{word!r} has no value", line) from error
        if kind == "w":
            return word
        value = number_of(word)
        if name.startswith("field ") and value != 0.0:
            raise block.fail("", f"{word!r} is a field too many", line)
        if value is None:
            raise block.fail(name, f"{word!r} was given, a number is needed", line)
        if kind == "i" and value != round(value):
            raise block.fail(name, f"{word!r} was given, a whole number is needed", line)
        return int(value) if kind == "i" else value


def split_fields(text: str, widths: tuple[int, ...]) -> list[str]:
    """The fields of a line, by commas or by columns."""
    return [word.strip() for word in text.split(",")] if "," in text else columns(text, widths)


def columns(text: str, widths: tuple[int, ...]) -> list[str]:
    """The fields of a line by columns, and what is behind them."""
    words, at = [], 0
    for width in widths:
        words.append(text[at : at + width].strip())
        at += width
    return [*words, text[at:].strip()] if text[at:].strip() else words
