"""No lines of the sources stand twice: a run of six that is the same to the letter is refused."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

SOURCES = Path(__file__).parents[2] / "src"
#: Lines that make a run
RUN = 6
#: Lines that say nothing of their own
IMPORT = re.compile(r"(use|import)\b", re.IGNORECASE)
FRAME = re.compile(r"(implicit none|end\b)", re.IGNORECASE)

#: Folders whose own runs may stand: templates, which are expanded one by one; without comments also
#: what differs in the meaning of its arguments alone
OPEN = {True: ("element/kernel/",), False: ("element/kernel/", "law/", "method/")}

#: A line: its number in the file, and what it says with single blanks
Line = tuple[int, str]


def lines_of(source: str, *, with_comments: bool) -> list[Line]:
    """Lines that count: no blank ones, imports or lone punctuation.

    A reader meets the same comments again as the same lines: they count, and lines that frame a
    block with them. Without comments the frames do not count either.
    """
    kept: list[Line] = []
    is_continued = False
    for number, raw in enumerate(source.splitlines(), 1):
        line = " ".join(raw.split())
        is_import = is_continued or IMPORT.match(line) is not None
        is_continued = is_import and line.endswith("&")
        if is_import or not re.search(r"\w", line):
            continue
        if not with_comments and (line.startswith("!") or FRAME.match(line)):
            continue
        kept.append((number, line))
    return kept


def runs(sources: dict[str, str], *, with_comments: bool) -> Iterator[str]:
    """Places at which a run begins that stands at several."""
    places: dict[tuple[str, ...], list[str]] = defaultdict(list)
    for name, source in sources.items():
        lines = lines_of(source, with_comments=with_comments)
        for first in range(len(lines) - RUN + 1):
            run = tuple(text for _, text in lines[first : first + RUN])
            places[run].append(f"{name}:{lines[first][0]}")
    for at in places.values():
        if len(at) > 1 and not all(place.startswith(OPEN[with_comments]) for place in at):
            yield " and ".join(at)


def test_no_run_of_lines_stands_twice() -> None:
    paths = sorted([*SOURCES.rglob("*.f90"), *SOURCES.rglob("*.f90.in")])
    sources = {str(path.relative_to(SOURCES)): path.read_text() for path in paths}
    assert len(sources) > 100
    found = [*runs(sources, with_comments=True), *runs(sources, with_comments=False)]
    assert not found, "\n".join(found)


def test_a_run_is_found() -> None:
    """Blank lines and imports lie between the lines of a run, other lines do not."""
    body = [f"x{i} = {i}" for i in range(RUN)]
    one = "\n".join(body)
    spaced = "\n\nuse a, only : b, &\n   & c\n".join(body)
    other = "\n".join([*body[:3], "y = 1", *body[3:]])
    assert list(runs({"a": one, "b": spaced}, with_comments=True)) == ["a:1 and b:1"]
    assert not list(runs({"a": one, "b": other}, with_comments=True))


def test_comments_count_with_their_lines() -> None:
    commented = "\n".join(f"!> Number {i}\nx{i} = {i}" for i in range(RUN // 2))
    assert list(runs({"a": commented, "b": commented}, with_comments=True))
    assert not list(runs({"a": commented, "b": commented}, with_comments=False))
