"""Pages of the manual: in the contents, with pictures in use; lint follows the links."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from links import links
from runs import ROOT

MANUAL = ROOT / "manual"
PAGES = sorted([ROOT / "README.md", *MANUAL.glob("*.md")])
CASES = sorted((ROOT / "decks").glob("**/README.md"))
#: Words of the field that a search must find on the pages of keywords
SEARCHED = ("mode I)", "mode II)", "fracture energy", "clamped", "time-step scale factor")


def test_contents_have_all_pages() -> None:
    """The first page of the manual names every other one."""
    named = set(links(MANUAL / "README.md"))
    assert {page.name for page in MANUAL.glob("*.md")} - named == {"README.md"}


def test_every_picture_is_used() -> None:
    """On a page of the manual, of the cases, or on the first page."""
    used = {Path(link).name for page in (*PAGES, *CASES) for link in links(page)}
    assert {path.name for path in (MANUAL / "pictures").glob("*.png")} <= used


@pytest.mark.parametrize("words", SEARCHED)
def test_words_of_the_field_are_found(words: str) -> None:
    """A user who searches for the word that other programs have finds it."""
    assert words in (MANUAL / "keywords.md").read_text()


def test_every_keyword_links_to_what_explains_it() -> None:
    """To a section of the theory, or to the page that shows its use; lint follows them."""
    pages = (MANUAL / "keywords.md").read_text().partition("\n# Keywords that are known")[0]
    parts = re.split(r"^## \*(\w+)$", pages, flags=re.MULTILINE)[1:]
    without = [
        name
        for name, text in zip(parts[::2], parts[1::2], strict=True)
        if not re.search(r"^\[(Theory|Use)\]\(\w+\.md#[\w-]+\)$", text, re.MULTILINE)
    ]
    assert len(parts) > 2 * 90
    assert not without
