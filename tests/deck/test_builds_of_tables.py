"""Tables of measured and computed figures name the build that made them, and only one."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

from runs import ROOT

#: Pages with figures that a change of the code changes
PAGES = ["performance.md", "kernels.md", "scaling.md", "validation.md"]
BUILD = re.compile(r"plydyn [\d.]+ \((\w{7})(?:, changed since)?\)")
#: Tables whose runs were made by several builds, which `decks/study.py validation` will make by one
SEVERAL = {"Impact of 25 J", "What each mechanism does", "Blind numbers"}
#: Tables without a build: rows of the others, and the beams of the verification
NONE = {"At a glance", "Beams"}


def sections(page: str) -> Iterator[tuple[str, list[str]]]:
    """Titles of the sections of a page with tables, and the builds in force there.

    A section without a build has that of the section above it, as long as the page goes deeper.
    """
    text = (ROOT / "manual" / page).read_text()
    above: dict[int, list[str]] = {}
    for marks, title, body in re.findall(
        r"^(#+) ([^\n]*)\n(.*?)(?=^#+ |\Z)", text, re.MULTILINE | re.DOTALL
    ):
        depth = len(marks)
        above = {level: builds for level, builds in above.items() if level < depth}
        found = sorted(set(BUILD.findall(body)))
        above[depth] = found or (above[max(above)] if above else [])
        if re.search(r"^\| ?:?---", body, re.MULTILINE):
            yield title, above[depth]


TABLES = [(page, title, builds) for page in PAGES for title, builds in sections(page)]


@pytest.mark.parametrize(("page", "title", "builds"), TABLES, ids=[t for _, t, _ in TABLES])
def test_tables_name_one_build(page: str, title: str, builds: list[str]) -> None:
    """But for those that are listed here, which are no more than there are."""
    if title in SEVERAL:
        assert len(builds) > 1, f"{title} is of one build now: take it from the list"
    elif title in NONE:
        assert not builds
    else:
        assert len(builds) == 1, (page, title)


def test_the_lists_are_of_tables() -> None:
    assert {title for _, title, _ in TABLES} >= SEVERAL | NONE
