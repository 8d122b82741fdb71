"""Links of all pages lead to files and headings that exist: prints the others, and then fails."""

from __future__ import annotations

import re
import subprocess
import sys
from functools import cache
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
_FENCED = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)


@cache
def _without_code(page: Path) -> str:
    """The text of a page without its blocks of code."""
    return _FENCED.sub("", page.read_text(encoding="utf-8"))


@cache
def anchors(page: Path) -> frozenset[str]:
    """Headings of a page as links have them."""
    found: list[str] = []
    for heading in re.findall(r"^#+ (.*)$", _without_code(page), re.MULTILINE):
        words = re.sub(r"[^\w -]", "", heading.replace("&lt;", "").replace("&gt;", "")).lower()
        found.append(words.strip().replace(" ", "-"))
    return frozenset(found)


def links(page: Path) -> list[str]:
    """Targets of the links and pictures of a page, without those of other hosts."""
    found = re.findall(r"\]\(([^)\s]+)\)", _without_code(page))
    return [link for link in found if "://" not in link]


def leads_nowhere(page: Path, link: str) -> bool:
    """Whether a link has no file, or no heading in it."""
    name, _, anchor = link.partition("#")
    target = (page.parent / name).resolve() if name else page
    if not target.exists():
        return True
    return bool(anchor) and target.suffix == ".md" and anchor not in anchors(target)


def broken(pages: list[Path]) -> list[str]:
    """What leads nowhere, with the page where it is."""
    return [
        f"{page}: {link}" for page in pages for link in links(page) if leads_nowhere(page, link)
    ]


def main() -> int:
    """Look at all pages of the repository."""
    words = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.md"]
    listed = subprocess.run(words, cwd=TOP, check=True, capture_output=True, text=True).stdout
    found = broken([TOP / name for name in listed.splitlines() if (TOP / name).exists()])
    sys.stdout.write("".join(f"leads nowhere: {line}\n" for line in found))
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
