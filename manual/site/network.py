"""What a built page would fetch from elsewhere when it is read."""

from __future__ import annotations

import re
from pathlib import Path

_FETCHED = re.compile(
    r"""<(?:script|img|iframe|link(?=[^>]*stylesheet))[^>]*?(?:src|href)=["'](?:https?:)?//[^"']+"""
)


def fetched(html: str) -> list[str]:
    """Tags of a page whose scripts, styles or pictures are on another host."""
    return _FETCHED.findall(html)


def pages_that_fetch(folder: Path) -> list[str]:
    """All of a site, with what they fetch."""
    return [
        f"{page.relative_to(folder)}: {tag}"
        for page in sorted(folder.rglob("*.html"))
        for tag in fetched(page.read_text(encoding="utf-8"))
    ]
