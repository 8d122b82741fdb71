"""The page of keywords in parts: an index, and a page for each keyword."""

from __future__ import annotations

import re

#: A link to a keyword, on the page of keywords itself or on another
_ON_PAGE, _ELSEWHERE = (
    re.compile(r"\]\(#(\w+)\)"),
    re.compile(r"\]\(([^)\s]*?)keywords\.md#(\w+)\)"),
)
_HEADING = re.compile(r"^## \*(\w+)$", re.MULTILINE)
_OF_OTHERS = re.compile(r"\]\((?!https?:|#|/)([^)\s]+)\)")


def part(text: str) -> tuple[str, dict[str, str]]:
    """The index, with links into a folder `keywords`, and the text of each page by its anchor."""
    plain, mark, rest = text.partition("\n# Keywords that are known")
    pieces = _HEADING.split(plain)
    pages = {
        name.lower(): _page(name, body)
        for name, body in zip(pieces[1::2], pieces[2::2], strict=True)
    }
    tail = re.sub(r"^# ", "## ", f"{mark}{rest}", flags=re.MULTILINE)
    return _ON_PAGE.sub(r"](keywords/\1.md)", pieces[0] + tail), pages


def _page(name: str, body: str) -> str:
    """The page of a keyword; it lies a folder deeper than the page of all of them."""
    body = _ON_PAGE.sub(r"](\1.md)", _OF_OTHERS.sub(r"](../\1)", body))
    return f"# \\*{name}{body}".rstrip() + "\n"


def follow(text: str) -> str:
    """A page whose links to keywords lead to their own pages."""
    return _ELSEWHERE.sub(r"](\1keywords/\2.md)", text)
