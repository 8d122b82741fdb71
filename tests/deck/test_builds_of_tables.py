"""Tables of measured and computed figures name the build that made them, and only one."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

from runs import ROOT

#: Pages with figures that a change of the code changes
PAGES = ["performance.md", "kernels.md", "scaling.md", "validation.md"]
BUILD = re.compile(r"plydyn [\d.]+ \((\w{7,8})(?:, changed since)?\)")
TABLE = re.compile(r"^\| ?:?---.*\n\|([^|]*)\|", re.MULTILINE)
#: Predictions that stay as they are, by their first rows: which of two builds made which run was
#: not kept, and the page says so
FROZEN = {"T700/M21, 6.5 J, quads of 2.8 mm", "T700/M21, 6.5 J, 5 seeds on 2.8 mm"}
#: Sections without a build: rows of the others, and the beams of the verification
NONE = {"At a glance", "Beams"}


def tables(page: str) -> Iterator[tuple[str, str, list[str]]]:
    """Titles of sections, first cells of their tables, and the builds of each table.

    The next sentence with builds in the section is that of a table, or else the last one before it;
    a section without a build has that of the section above it, as long as the page goes deeper.
    """
    text = (ROOT / "manual" / page).read_text()
    above: dict[int, list[str]] = {}
    for marks, title, body in re.findall(
        r"^(#+) ([^\n]*)\n(.*?)(?=^#+ |\Z)", text, re.MULTILINE | re.DOTALL
    ):
        depth = len(marks)
        above = {level: builds for level, builds in above.items() if level < depth}
        blocks = body.split("\n\n")
        told = [sorted(set(BUILD.findall(block))) for block in blocks]
        found = [builds for builds in told if builds]
        above[depth] = found[-1] if found else (above[max(above)] if above else [])
        for k, block in enumerate(blocks):
            if first := TABLE.search(block):
                after = [builds for builds in told[k:] if builds]
                yield title, first[1].strip(), after[0] if after else above[depth]


TABLES = [(page, *table) for page in PAGES for table in tables(page)]


@pytest.mark.parametrize(
    ("page", "title", "row", "builds"), TABLES, ids=[f"{one[1]}: {one[2]}" for one in TABLES]
)
def test_tables_name_one_build(page: str, title: str, row: str, builds: list[str]) -> None:
    """But for those that are listed here, which are no more than there are."""
    if row in FROZEN and title == "Blind numbers" and len(builds) > 1:
        return
    if title in NONE:
        assert not builds
    else:
        assert len(builds) == 1, (page, title, row)


def test_the_lists_are_of_tables() -> None:
    assert {title for _, title, _, _ in TABLES} >= NONE
    assert {row for _, title, row, builds in TABLES if len(builds) > 1} == FROZEN
