"""Keywords of an Abaqus input file with their parameters and lines of data."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from plydyn_pre.errors import PreError
from plydyn_pre.files import is_file, read_included
from plydyn_pre.translate.block import Block, Row, TranslateError, named
from plydyn_pre.translate.numbers import number_of
from plydyn_pre.translate.source import dialect, entry_of, source_path

#: Keywords whose data are read word by word elsewhere, and too many for the report
_TEXT = ("HEADING",)


@dataclass(frozen=True)
class Keyword:
    """A keyword as the file has it, in the part or instance that it belongs to."""

    name: str
    options: dict[str, str]  # parameters; a flag is an empty text
    data: list[tuple[int, list[str]]]  # words by line
    block: Block
    space: str = ""  # name of the instance

    def within(self, space: str) -> Keyword:
        """The keyword in an instance."""
        return replace(self, space=space)

    def fail(self, name: str, message: str, line: int = 0) -> TranslateError:
        """An error about a parameter or a field."""
        return self.block.fail(name, message, line)

    def option(self, name: str) -> str:
        """A parameter that must be there."""
        if not self.options.get(name):
            raise self.fail(name, "missing")
        return self.options[name]

    def kind(self, name: str, default: str, *known: str) -> str:
        """A parameter that must be one of some words."""
        word = self.options.get(name, default).upper()
        if word not in known:
            raise self.fail(name, f"{word} is not translated; {', '.join(known)} are")
        return word

    def numbers(self, name: str, words: list[str], line: int) -> list[float]:
        """Words as numbers; blanks are zeros."""
        found = []
        for word in words:
            value = number_of(word) if word else 0.0
            if value is None:
                raise self.fail(name, f"{word!r} was given, a number is needed", line)
            found.append(value)
        return found

    def all_numbers(self, name: str, least: int = 0) -> list[float]:
        """All data as numbers."""
        found = [n for line, words in self.data for n in self.numbers(name, words, line)]
        if len(found) < least:
            words = f"{least} numbers are needed, {len(found)} are there"
            raise self.fail(name, words, self.data[-1][0] if self.data else 0)
        return found


@dataclass
class _Reader:
    """Files one after the other."""

    keywords: list[Keyword] = field(default_factory=list)
    problems: list[PreError] = field(default_factory=list)

    def read(self, path: Path, depth: int) -> None:
        """Read a file; includes where they stand."""
        for keyword in _keywords(path, read_included(path, depth).splitlines()):
            name = keyword.options.get("INPUT", "")
            if keyword.name == "INCLUDE":
                self.read(source_path(path, keyword.option("INPUT"), path.parent), depth + 1)
            elif name and keyword.name in ("NODE", "ELEMENT", "NSET", "ELSET"):
                data = _data(source_path(path, name, path.parent))
                keyword.data.extend(data)
                self.keywords.append(keyword)
            else:
                self.keywords.append(keyword)


def read_keywords(path: Path) -> tuple[list[Keyword], list[PreError]]:
    """The keywords of a file and of those that it includes."""
    reader = _Reader()
    reader.read(path, 0)
    return reader.keywords, reader.problems


def _keywords(path: Path, lines: list[str]) -> Iterator[Keyword]:
    """The keywords of a file."""
    found: Keyword | None = None
    head, start = "", 0
    for number, line in enumerate(lines, start=1):
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            found = _keyword(path, start, head) if head else found
            if found:
                yield _shown(found)
            found, head, start = None, line.strip(), number
        elif head:  # a line of parameters goes on
            head += line.strip()
        elif found and line.strip():
            found.data.append((number, _words(line)))
        if head and not head.endswith(","):
            found, head = _keyword(path, start, head), ""
    found = _keyword(path, start, head) if head else found
    if found:
        yield _shown(found)


def _keyword(path: Path, line: int, text: str) -> Keyword:
    """A keyword by its line."""
    first, *rest = text[1:].split(",")
    name = " ".join(first.upper().split())
    options: dict[str, str] = {}
    for word in rest:
        key, _, value = word.partition("=")
        if key.strip():
            options[" ".join(key.upper().split())] = value.strip().strip("\"'").strip()
    entry = entry_of(dialect("abaqus"), name)
    block = Block(name, name, path, line, entry, label=f"*{name}")
    if options:
        block.rows.append(Row(line, {key: value or "yes" for key, value in options.items()}))
    return Keyword(name, options, [], block)


def _shown(keyword: Keyword) -> Keyword:
    """The keyword with its data in the rows of its block, by the names of the table."""
    names = keyword.block.entry.cards or ()
    if keyword.name in _TEXT:
        return keyword
    for line, words in keyword.data:
        keyword.block.rows.append(Row(line, dict(named(names, words))))
    return keyword


def _words(line: str) -> list[str]:
    """The words of a line of data, at least one; blank ones at its end are dropped."""
    words = [word.strip().strip("\"'") for word in line.split(",")]
    while len(words) > 1 and not words[-1]:
        words.pop()
    return words


def _data(path: Path) -> list[tuple[int, list[str]]]:
    """The data of a file of its own."""
    if not is_file(path):
        raise PreError(f"{path}: there is no such file")
    lines = path.read_text(encoding="utf-8-sig", errors="replace").splitlines()
    return [(n, _words(line)) for n, line in enumerate(lines, start=1) if line[:2] != "**"]
