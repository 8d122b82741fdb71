"""Tables in Markdown, the pages that they stand on, and their place in another page."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from plydyn_post.results import Results
from runner.cases import ROOT, Case, StudyError

#: What stands in a cell for a number that there is not
NOTHING = "–"
#: Where the pictures of the manual and of the pages of decks lie
PICTURES = ROOT / "manual/pictures"


@dataclass(frozen=True)
class Column:
    """A column of a table: its heading, and the cell of a row beside one to compare with."""

    heading: str
    cell: Callable[[Any, Any], str]


@dataclass(frozen=True)
class Quantity:
    """A column of a number or of words that are read off a row."""

    heading: str
    value: Callable[[Any], float | str | None]
    form: str = ""
    scale: float = 1

    def cell(self, row: object, _other: object = None) -> str:
        """The cell of a row."""
        value = self.value(row)
        if value is None or isinstance(value, str):
            return value or NOTHING
        return format(self.scale * value, self.form)


def with_change(*quantities: Quantity) -> Iterator[Quantity | Column]:
    """Numbers, each followed by how far it is from that of the row to compare with."""
    for one in quantities:
        yield one
        yield _change_of(one)


def _change_of(one: Quantity) -> Column:
    """How far a number is from that of the row to compare with."""
    return Column("change", lambda row, other: change(one.value(row), one.value(other)))


def change(value: float | str | None, base: float | str | None) -> str:
    """A change as a share, with its sign; of numbers."""
    if isinstance(value, str | None) or isinstance(base, str | None) or base in (value, 0.0):
        return NOTHING
    return f"{round(100.0 * (value / base - 1.0)):+d} %"


def percent(share: float) -> str:
    """A share in print."""
    return f"{100.0 * share:.1f} %"


def clock(seconds: float | None) -> str:
    """Seconds as h:mm:ss."""
    if seconds is None:
        return NOTHING
    whole = round(seconds)
    return f"{whole // 3600}:{whole % 3600 // 60:02d}:{whole % 60:02d}"


def tabulate(
    columns: Sequence[Column | Quantity],
    rows: Sequence[Any],
    compared: Callable[[Any], Any] = lambda row: row,
) -> str:
    """A table of columns; ``compared`` gives the row that another is compared with."""
    headings = [column.heading for column in columns]
    cells = [[column.cell(row, compared(row)) for column in columns] for row in rows]
    return table(headings, cells)


def table(headings: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table; the first column is set left, the others right."""
    lines = [headings, ["---", *["---:"] * (len(headings) - 1)], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


@dataclass(frozen=True)
class Section:
    """A part of a page; with a mark it has a place in another page, behind others of that mark."""

    heading: str
    text: str
    mark: str = ""


@dataclass(frozen=True)
class Page:
    """What a study makes: tables, figures, and which of them are pictures of the manual."""

    name: str
    sections: Sequence[Section] = ()
    figures: Sequence[Path] = ()
    pictures: Mapping[str, Path] = field(default_factory=dict)  # by their names in the manual

    def write(self, folder: Path) -> Path:
        """Write the tables."""
        path = folder / f"{self.name}.md"
        path.parent.mkdir(parents=True, exist_ok=True)
        parts = [f"## {one.heading}\n\n{one.text.strip()}\n" for one in self.sections]
        path.write_text("\n".join(parts), encoding="utf-8")
        return path

    def put_into(self, page: Path) -> None:
        """Put the tables between their marks on a page, and its pictures beside those it has."""
        marks = dict.fromkeys(one.mark for one in self.sections if one.mark)
        for mark in marks:
            insert(page, mark, "\n".join(one.text for one in self.sections if one.mark == mark))
        if page.resolve().is_relative_to(ROOT):
            for name, picture in self.pictures.items():
                shutil.copy(picture, PICTURES / name)


def one_section(
    heading: str, text: Callable[[list[Any]], str], mark: str = ""
) -> Callable[[list[Any], Path], list[Page]]:
    """A report without figures: a section on a page of the name of its mark."""
    mark = mark or heading.lower()
    name = mark.replace(" ", "")
    return lambda runs, _folder: [Page(name, [Section(heading, text(runs), mark)])]


def draw_all(
    drawings: Mapping[str, Callable[[Results, Path], object]], results: Results, folder: Path
) -> dict[str, Path]:
    """Draw some results by each function into the file of its name; gives the files."""
    for name, draw in drawings.items():
        draw(results, folder / name)
    return {name: folder / name for name in drawings}


def not_run(cases: Sequence[Case], names: Collection[str]) -> str:
    """A sentence on those cases whose names are not among some, if there are any."""
    missing = [case.label for case in cases if case.name not in names]
    return f"\nNot run: {'; '.join(missing)}.\n" if missing else ""


def insert(page: Path, mark: str, text: str) -> None:
    """Replace what stands in a page between ``<!-- mark -->`` and ``<!-- end of mark -->``."""
    first, last = f"<!-- {mark} -->", f"<!-- end of {mark} -->"
    whole = page.read_text(encoding="utf-8")
    before, found, rest = whole.partition(first)
    _, ended, after = rest.partition(last)
    if not (found and ended):
        raise StudyError(f"{page} has no lines {first} and {last} for the table to stand between")
    page.write_text(f"{before}{first}\n\n{text.strip()}\n\n{last}{after}", encoding="utf-8")
