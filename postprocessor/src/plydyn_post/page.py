"""The page of a report: HTML that needs nothing but the pictures beside it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from urllib.parse import quote

from plydyn_post.case import Case, Light
from plydyn_post.fixtures import FixtureSheet
from plydyn_post.header import Header
from plydyn_post.numbers import Comparison
from plydyn_post.units import in_brackets

LOOK = """
body { font: 15px/1.5 system-ui, sans-serif; color: #262626; max-width: 60rem;
       margin: 2.5rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.5rem; margin-bottom: 0.2rem; }
h2 { font-size: 1.1rem; margin: 2.2rem 0 0.6rem; border-bottom: 1px solid #ddd; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: 0.2rem 0.9rem 0.2rem 0; text-align: right; border-bottom: 1px solid #eee; }
th:first-child, td:first-child { text-align: left; }
th { font-weight: 600; border-bottom: 1px solid #999; }
figure { margin: 1rem 0; display: inline-block; vertical-align: top; }
img { max-width: 100%; width: 29rem; }
img.wide { width: 56rem; }
.case td { text-align: left; vertical-align: top; }
.case td:first-child { white-space: nowrap; color: #666; }
.lights { list-style: none; padding: 0; }
.lights li { border-left: 0.5rem solid; padding: 0.1rem 0 0.1rem 0.8rem; margin: 0.3rem 0; }
.red { border-color: #c62828; } .amber { border-color: #f2a900; } .green { border-color: #2e7d32; }
.said { font-size: 1.15rem; margin: 0.4rem 0; } .told { margin: 0.3rem 0; max-width: 46rem; }
figcaption, .quiet { color: #666; font-size: 0.87rem; }
"""
# Images of these sections take the whole width
WIDE_SECTIONS = ("Damage of the plies", "Through the thickness", "The plate")


@dataclass(frozen=True)
class Image:
    """A picture on the page."""

    section: str
    path: Path
    caption: str


@dataclass(frozen=True)
class PageTable:
    """A table of texts with a heading, what is told above it, and a sentence below."""

    title: str
    headings: tuple[str, ...] = ()
    rows: tuple[tuple[str, ...], ...] = ()
    words: str = ""
    above: tuple[str, ...] = ()  # sentences, the first one in large print
    lights: tuple[Light, ...] = ()


@dataclass(frozen=True)
class Sheet:
    """What is on the page."""

    labels: tuple[str, ...]
    headers: tuple[Header, ...]
    comparison: Comparison | None
    images: tuple[Image, ...]
    notes: tuple[str, ...]
    fixtures: tuple[FixtureSheet, ...] = ()
    tables: tuple[PageTable, ...] = ()  # before all numbers
    cases: tuple[Case, ...] = ()  # at the beginning
    first: tuple[PageTable, ...] = ()  # before the cases, each with the images of its section


def write_page(sheet: Sheet, path: Path) -> Path:
    """Write the page; images are named relative to it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(_lines(sheet, path.parent)) + "\n", encoding="utf-8")
    return path


def _lines(sheet: Sheet, folder: Path) -> Iterator[str]:
    title = escape(", ".join(sheet.labels))
    yield "<!DOCTYPE html>"
    yield '<html lang="en"><head><meta charset="utf-8">'
    yield f"<title>{title}</title><style>{LOOK}</style></head><body>"
    yield f"<h1>{title}</h1>"
    for table in sheet.first:
        yield from _part(table, sheet.images, folder)
    for case in sheet.cases:
        yield from _case(case, len(sheet.cases) > 1)
    if sheet.notes:
        yield "<h2>Notes</h2><ul>"
        yield from (f"<li>{escape(note)}</li>" for note in sheet.notes)
        yield "</ul>"
    for table in sheet.tables:
        yield from _part(table, (), folder)
    if sheet.comparison:
        yield "<h2>Numbers</h2>"
        yield from _numbers(sheet.comparison)
    yield from _fixtures(sheet)
    shown = {table.title for table in sheet.first}
    for section in dict.fromkeys(image.section for image in sheet.images):
        if section in shown:
            continue
        yield f"<h2>{escape(section)}</h2>"
        for image in sheet.images:
            if image.section == section:
                yield _figure(image, folder)
    yield from _layups(sheet)
    yield "</body></html>"


def _part(table: PageTable, images: Sequence[Image], folder: Path) -> Iterator[str]:
    """A heading, sentences, lights, a table, and the images of the section of that heading."""
    yield f"<h2>{escape(table.title)}</h2>"
    for place, words in enumerate(table.above):
        yield f'<p class="{"said" if place == 0 else "told"}">{escape(words)}</p>'
    yield from _lights(table.lights)
    if table.rows:
        yield _table(table.headings, table.rows)
    if table.words:
        yield f'<p class="quiet">{escape(table.words)}</p>'
    yield from (_figure(image, folder) for image in images if image.section == table.title)


def _lights(lights: Sequence[Light]) -> Iterator[str]:
    """Findings as traffic lights."""
    if not lights:
        return
    yield "<ul class=lights>"
    for light in lights:
        yield f'<li class="{light.colour}"><b>{light.colour}</b> {escape(light.words)}</li>'
    yield "</ul>"


def _case(case: Case, of_many: bool) -> Iterator[str]:
    """What a job computes, and its findings as traffic lights."""
    of_job = f" of {escape(case.job)}" if of_many else ""
    if case.rows:
        yield f"<h2>Case{of_job}</h2>"
        rows = (f"<tr><td>{escape(a)}</td><td>{escape(b)}</td></tr>" for a, b in case.rows)
        yield f'<table class="case">{"".join(rows)}</table>'
    if case.lights:
        yield f"<h2>Checks{of_job}</h2>"
        yield from _lights(case.lights)


def _numbers(comparison: Comparison) -> Iterator[str]:
    names = [in_brackets(row.name, row.unit) for row in comparison.rows]
    cells = [row.texts() for row in comparison.rows]
    body = [[name, *texts] for name, texts in zip(names, cells, strict=True)]
    yield _table(["", *comparison.labels], body)


def _fixtures(sheet: Sheet) -> Iterator[str]:
    """What the fixtures of each job came to."""
    for held in sheet.fixtures:
        yield f"<h2>Fixtures of {escape(held.job)}</h2>"
        yield _table(held.headings, held.rows)
        if held.words:
            yield f'<p class="quiet">{escape(held.words)}</p>'


def _figure(image: Image, folder: Path) -> str:
    source = quote(image.path.relative_to(folder).as_posix())
    kind = ' class="wide"' if image.section in WIDE_SECTIONS else ""
    caption = escape(image.caption)
    return (
        f'<figure><img{kind} src="{source}" alt="{caption}">'
        f"<figcaption>{caption}</figcaption></figure>"
    )


def _layups(sheet: Sheet) -> Iterator[str]:
    """The ply tables, from the top of the plate down; equal ones once."""
    told: list[tuple[dict[str, float], ...]] = []
    for label, header in zip(sheet.labels, sheet.headers, strict=True):
        if header.plies and header.plies not in told:
            told.append(header.plies)
            yield f"<h2>Plies of {escape(label)}, from the top down</h2>"
            length = header.units.get("length", "")
            units = {"angle": "deg", "bottom": length, "top": length}
            head = [in_brackets(name, units.get(name, "")) for name in header.plies[0]]
            rows = [[f"{one:.6g}" for one in row.values()] for row in reversed(header.plies)]
            yield _table(head, rows)


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    top = "".join(f"<th>{escape(cell)}</th>" for cell in head)
    body = "".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows
    )
    return f"<table><tr>{top}</tr>{body}</table>"
