"""LS-DYNA's keyword files: blocks of cards with the line and the fate of every field."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from plydyn_pre.errors import PreError
from plydyn_pre.files import is_file, read_included
from plydyn_pre.translate.block import Block, TranslateError
from plydyn_pre.translate.cursor import Cursor, Lines, columns
from plydyn_pre.translate.numbers import number_of
from plydyn_pre.translate.parameters import Parameters
from plydyn_pre.translate.schema import find

_INCLUDES = ("INCLUDE", "INCLUDE_PATH", "INCLUDE_PATH_RELATIVE")
#: Marks behind the name of a keyword: long fields, usual ones, whole numbers of ten columns
_FORMATS = ("+", "-", "%")
_LOCAL, _EXPRESSION = "_LOCAL", "_EXPRESSION"


def read_deck(path: Path) -> tuple[list[Block], list[PreError]]:
    """The keywords of a deck and of the files that it includes, and what is wrong with them."""
    reader = _Reader(path)
    reader.read(path, 0)
    if not reader.blocks and not reader.problems:
        raise TranslateError(path, 1, "*KEYWORD", "missing; no keyword is in the file")
    return reader.blocks, reader.problems


class _Reader:
    """Files one after the other, into blocks."""

    def __init__(self, main: Path) -> None:
        self.blocks: list[Block] = []
        self.problems: list[PreError] = []
        self.parameters = Parameters()
        self.folders = [main.parent]
        self.long = self.wide = False

    def read(self, path: Path, depth: int) -> None:
        """Read a file; includes where they stand."""
        text = read_included(path, depth)
        names, form = self.parameters.names, (self.long, self.wide)
        self.parameters.names = names.new_child()
        for start, name, data in _keywords(text.splitlines()):
            if name == "END":
                break
            try:
                self._keyword(path, start, name, data, depth)
            except TranslateError as error:
                self.problems.append(error)
        self.parameters.names = names
        self.long, self.wide = form

    def _keyword(self, path: Path, start: int, name: str, data: Lines, depth: int) -> None:
        """Read a keyword."""
        words = name.replace(" ", "")
        if name.startswith("KEYWORD"):
            self.long = "LONG=Y" in words or "LONG=K" in words
            self.wide = "I10=Y" in words
        elif words in _INCLUDES:
            self._include(path, words, data, depth)
        elif words.startswith("PARAMETER") and not words.startswith("PARAMETER_DUP"):
            self._parameters(path, words, data)
        else:
            word, *marks = name.split()
            mark = marks[0] if marks and marks[0] in _FORMATS else ""
            self._blocks(path, start, word + mark, data)

    def _include(self, path: Path, name: str, data: Lines, depth: int) -> None:
        """Read a file, or add a folder in which files are looked for."""
        for line in _names_of_files(data):
            if name == "INCLUDE":
                places = [folder / line for folder in (path.parent, *self.folders)]
                self.read(next((p for p in places if is_file(p)), places[0]), depth + 1)
            else:
                near = self.folders[0] if name.endswith("RELATIVE") else Path()
                self.folders.append(near / line)

    def _parameters(self, path: Path, name: str, data: Lines) -> None:
        """Read names for numbers and what is computed."""
        local, computed = _LOCAL in name, _EXPRESSION in name
        pairs: list[tuple[int, str, str]] = []
        for line, text in data:
            if computed and not text[:10].strip() and pairs:
                pairs[-1] = (pairs[-1][0], pairs[-1][1], pairs[-1][2] + text[10:].strip())
                continue
            if computed:
                head, _, tail = (
                    text.partition(",") if "," in text[:11] else (text[:10], "", text[10:])
                )
                words = [head, tail]
            else:
                words = text[:80].split(",") if "," in text else columns(text[:80], (10,) * 8)
            words = [word.strip() for word in words]
            names = zip(words[::2], words[1::2], strict=False)
            pairs += [(line, key, value) for key, value in names if key]
        for line, key, value in pairs:
            self._put(path, line, (name, key, value), local, computed)

    def _put(
        self, path: Path, line: int, words: tuple[str, str, str], local: bool, computed: bool
    ) -> None:
        """Give a parameter its value."""
        keyword, key, value = words
        kind, name = key[:1].upper(), key[1:].strip()
        try:
            if computed:
                value = f"{self.parameters.value_of(value):.15g}"
            value = self.parameters.filled(value)
        except (KeyError, ValueError) as error:
            message = f"{value!r} has no value: {error}"
            raise TranslateError(path, line, f"*{keyword} {name}", message) from error
        if kind != "C" and number_of(value) is None:
            raise TranslateError(path, line, f"*{keyword} {name}", f"{value!r} is no number")
        try:
            self.parameters.put(name, value, local)
        except ValueError as error:
            message = f"{value!r} is a second value: {error}, and LS-DYNA may keep either"
            raise TranslateError(path, line, f"*{keyword} {name}", message) from error

    def _blocks(self, path: Path, start: int, name: str, data: Lines) -> None:
        """The cards of a keyword; each set of them becomes a block."""
        long, wide = self.long, self.wide
        if name[-1] in _FORMATS and len(name) > 1:
            long, wide, name = name[-1] == "+", name[-1] == "%", name[:-1]
        base, entry = find(name)
        least = len(entry.cards or ()) + len(entry.titles)
        while data and not data[-1][1].strip() and len(data) > least:
            data = data[:-1]
        cursor = Cursor(self.parameters, entry, data, long, wide)
        while True:
            block = Block(base, name, path, start, entry)
            self.blocks.append(block)
            cursor.fill(block)
            self.problems += cursor.problems
            cursor.problems = []
            start = cursor.line
            if not (entry.sets and start):
                break


def _names_of_files(data: Lines) -> list[str]:
    """Names, of which one that ends in a plus goes on in the next line; Windows' with slashes."""
    text = "\n".join(line.strip() for _, line in data if line.strip())
    return text.replace(" +\n", "").replace("\\", "/").splitlines()


def _keywords(lines: list[str]) -> Iterator[tuple[int, str, Lines]]:
    """Keywords with their first line and their lines of data."""
    name, start = "", 0
    data: Lines = []
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
