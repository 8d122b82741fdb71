"""Messages that the manual quotes: the source of the program has their words."""

from __future__ import annotations

import re
from functools import cache

import pytest

from runs import ROOT

PAGES = ("faq.md", "running.md", "static.md", "tutorial.md", "hpc.md", "listing.md")
#: A quotation in bold, from which other words are left out: **"quad … is pressed to …"**
QUOTED = re.compile(r'\*\*"([^"]+?)"\.?\*\*')


def quotations() -> list[tuple[str, str]]:
    """Page and words of each message."""
    return [
        (page, " ".join(words.split()))
        for page in PAGES
        for words in QUOTED.findall((ROOT / "manual" / page).read_text())
    ]


@cache
def literals() -> str:
    """The texts of the program, a line each; joined where one goes on in the next line."""
    found = []
    for path in sorted((ROOT / "src").rglob("*.f90*")):
        code = re.sub(r"^\s*!.*\n", "", path.read_text(), flags=re.MULTILINE)
        code = re.sub(r"&\s*\n\s*&", "", code)
        code = re.sub(r'"\s*//\s*"', "", code)
        found += re.findall(r'"([^"\n]*)"', code)
    return "\n".join(found)


@pytest.mark.parametrize(("page", "words"), quotations())
def test_message_is_one_of_the_program(page: str, words: str) -> None:
    """All words between the gaps."""
    parts = [part.strip() for part in words.split("…")]
    assert any(len(part) > 5 for part in parts), page
    assert not [part for part in parts if part not in literals()], page


def test_there_are_messages_on_both_pages_of_trouble() -> None:
    """The pages quote in the form that is looked for."""
    pages = [page for page, _ in quotations()]
    assert pages.count("faq.md") >= 8
    assert pages.count("running.md") >= 12
