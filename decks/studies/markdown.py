"""Tables in Markdown, and their place in a page."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from studies.jobs import StudyError


def table(headings: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table; the first column is set left, the others right."""
    lines = [headings, ["---", *["---:"] * (len(headings) - 1)], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def insert(page: Path, mark: str, text: str) -> None:
    """Replace what stands in a page between ``<!-- mark -->`` and ``<!-- end of mark -->``."""
    first, last = f"<!-- {mark} -->", f"<!-- end of {mark} -->"
    whole = page.read_text(encoding="utf-8")
    before, found, rest = whole.partition(first)
    _, ended, after = rest.partition(last)
    if not (found and ended):
        raise StudyError(f"{page} has no lines {first} and {last} for the table to stand between")
    page.write_text(f"{before}{first}\n\n{text.strip()}\n\n{last}{after}", encoding="utf-8")


def write(path: Path, sections: Sequence[tuple[str, str]]) -> Path:
    """Write a page of sections, each a heading and its text."""
    path.parent.mkdir(parents=True, exist_ok=True)
    parts = [f"## {heading}\n\n{text.strip()}\n" for heading, text in sections]
    path.write_text("\n".join(parts), encoding="utf-8")
    return path
