"""Pages of the manual: in the contents, with links that lead somewhere and pictures in use."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

from runs import ROOT

MANUAL = ROOT / "manual"
PAGES = sorted([ROOT / "README.md", *MANUAL.glob("*.md")])
CASES = sorted((ROOT / "decks").glob("**/README.md"))
#: Words of the field that a search must find on the pages of keywords
SEARCHED = ("mode I)", "mode II)", "fracture energy", "clamped", "time-step scale factor")


@cache
def anchors(page: Path) -> frozenset[str]:
    """Headings of a page as links have them; equal ones are numbered."""
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    found: list[str] = []
    for heading in re.findall(r"^#+ (.*)$", text, re.MULTILINE):
        words = re.sub(r"[^\w -]", "", heading.replace("&lt;", "").replace("&gt;", "")).lower()
        found.append(words.strip().replace(" ", "-"))
    return frozenset(found)


def links(page: Path) -> list[str]:
    """Targets of the links and pictures of a page, without those of other hosts."""
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    found = re.findall(r"\]\(([^)\s]+)\)", text)
    return [link for link in found if "://" not in link]


def leads_nowhere(page: Path, link: str) -> bool:
    """Whether a link has no file, or no heading in it."""
    name, _, anchor = link.partition("#")
    target = (page.parent / name).resolve() if name else page
    if not target.exists():
        return True
    return bool(anchor) and target.suffix == ".md" and anchor not in anchors(target)


@pytest.mark.parametrize("page", [*PAGES, *CASES], ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page: Path) -> None:
    """Files and headings exist."""
    assert not [link for link in links(page) if leads_nowhere(page, link)]


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
    """To a section of the theory, or to the page that shows its use; `test_links…` follows them."""
    pages = (MANUAL / "keywords.md").read_text().partition("\n# Keywords that are known")[0]
    parts = re.split(r"^## \*(\w+)$", pages, flags=re.MULTILINE)[1:]
    without = [
        name
        for name, text in zip(parts[::2], parts[1::2], strict=True)
        if not re.search(r"^\[(Theory|Use)\]\(\w+\.md#[\w-]+\)$", text, re.MULTILINE)
    ]
    assert len(parts) > 2 * 90
    assert not without
