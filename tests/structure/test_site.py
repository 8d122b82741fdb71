"""The site shows every page, each keyword on a page of its own, and every recipe in its gallery."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import gallery
import pages
from docstrings import unfenced
from keyword_pages import follow, part
from links import TOP, broken
from network import fetched
from plydyn_pre.recipe import templates


@pytest.fixture
def site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The pages of the site, without the pictures of meshes."""
    monkeypatch.setattr(pages, "with_pictures", lambda page, *_: page)
    pages.stage(tmp_path / "site", tmp_path / "pictures")
    return tmp_path / "site"


def test_every_page_of_the_manual_is_in_its_contents() -> None:
    """Each once, in a group that has a name."""
    placed = [page for _, group in pages.contents() for page in group]
    manual = {path.relative_to(TOP) for path in (TOP / "manual").glob("*.md")}
    assert set(placed) == manual - {pages.CONTENTS}
    assert len(placed) == len(set(placed))


def test_links_of_the_site_lead_somewhere(site: Path) -> None:
    """Also those to keywords, which are on pages of their own here."""
    made = sorted(site.rglob("*.md"))
    assert len(made) > 120
    assert broken(made) == []


def test_sides_of_the_site_name_every_page(site: Path) -> None:
    """A page is reached from the first one by tables of contents alone."""
    named = {"index"}
    for page in site.rglob("*.md"):
        for tree in re.findall(r"^```\{toctree\}\n(.*?)^```", page.read_text(), re.M | re.S):
            names = [line for line in tree.splitlines() if line and not line.startswith(":")]
            here = page.parent.relative_to(site)
            named |= {str(here / name.removesuffix(".md")) for name in names}
    assert named == {str(page.relative_to(site).with_suffix("")) for page in site.rglob("*.md")}


def test_each_keyword_has_a_page(site: Path) -> None:
    """With its cards and its example, in the words of the page of all keywords."""
    whole = (TOP / "manual/keywords.md").read_text()
    names = re.findall(r"^## \*(\w+)$", whole, re.MULTILINE)
    assert len(names) > 90
    for name in names:
        text = (site / "manual/keywords" / f"{name.lower()}.md").read_text()
        assert text.startswith(f"# \\*{name}\n")
        assert f"```\n*{name}" in text or name in ("COMMENT", "KEYWORD", "END")


def test_links_to_keywords_follow() -> None:
    """Those of the index, those between keywords, those to other pages, and those from there."""
    words = "# Keywords\n| [*A](#a) |\n\n## *A\n\nas [*B](#b), [Use](running.md#x)\n\n## *B\n\nb\n"
    index, made = part(f"{words}\n# Keywords that are known and ignored\n\n`*C`\n")
    assert "| [*A](keywords/a.md) |" in index
    assert "## Keywords that are known and ignored" in index
    assert made["a"] == "# \\*A\n\nas [*B](b.md), [Use](../running.md#x)\n"
    assert follow("[x](../manual/keywords.md#a)") == "[x](../manual/keywords/a.md)"
    assert follow("[x](keywords.md)") == "[x](keywords.md)"


def test_gallery_lists_every_recipe() -> None:
    """What the page says is what the recipes say; run manual/site/gallery.py."""
    page = gallery.PAGE.read_text()
    numbers = gallery.kept(page)
    told = page.partition(gallery.LISTED)
    assert told[1] + told[2] == gallery.listed(numbers)
    recipes = {f"templates/{name}" for name in templates()}
    decks = (TOP / "decks").glob("*/*.toml")
    recipes |= {f"{path.parent.name}/{path.stem}" for path in decks if path.name != "ruff.toml"}
    assert set(numbers) == recipes
    for size, time in numbers.values():
        assert re.fullmatch(r"\d[\d,]*", size)
        assert re.fullmatch(r"(up to )?\d+ (s|min|h)", time)
    assert all(entry.sentence for entry in gallery.entries())


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.3, "1 s"), (6.4, "7 s"), (50.0, "45 s"), (55.0, "1 min"), (3022.9, "45 min"), (8e3, "2 h")],
)
def test_times_are_rounded(seconds: float, words: str) -> None:
    """To few digits, in the unit in which they are read."""
    assert gallery.in_words(seconds) == words


def test_numbers_of_a_page_are_kept() -> None:
    """By the group and the name of a recipe."""
    lists = "## Cases in `a`\n| `x` | s<br>c | 1,000 | 5 s |\n"
    assert gallery.kept(f"{gallery.LISTED}\n{lists}") == {"a/x": ("1,000", "5 s")}


def test_code_in_docstrings_is_indented() -> None:
    """With the mark of a literal block before it."""
    lines = ["Words.", "", "```python", "a = 1", "", "b = 2", "```", "More."]
    made = ["Words.", "", "::", "", "    a = 1", "", "    b = 2", "More."]
    assert unfenced(lines) == made


def test_what_a_page_fetches_is_found() -> None:
    """Scripts, styles and pictures of other hosts; not its own, and not links to follow."""
    other = '<script async src="https://a.org/x.js"></script><img alt="" src="//a.org/x.png">'
    style = (
        '<link rel="stylesheet" href="https://a.org/x.css"><link rel="canonical" href="https://a"/>'
    )
    own = '<script src="_static/x.js"></script><a href="https://a.org">a</a>'
    assert len(fetched(other)) == 2
    assert len(fetched(style)) == 1
    assert fetched(own) == []
