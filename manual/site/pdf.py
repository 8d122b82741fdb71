"""All pages of the manual as one PDF, by pandoc and typst, which come as wheels."""

from __future__ import annotations

import re
from pathlib import Path

import pypandoc
import typst

from pages import MANUAL, contents

_HEAD = """#set page(paper: "a4", margin: 20mm, numbering: "1")
#set text(size: 9.5pt)
#set par(justify: true)
#show raw: set text(size: 7.5pt)
#show table: set text(size: 7.5pt)
#show heading.where(level: 1): it => { pagebreak(weak: true); it }
#let horizontalrule = line(length: 100%)
#let is-svg = path => false
#align(center + horizon)[#text(size: 26pt)[Manual of plydyn]]
#outline(depth: 2)
"""


def write_pdf(folder: Path, path: Path) -> None:
    """The pages in the order of the contents, from where they are laid together."""
    pieces = [_HEAD]
    for _, pages in contents():
        pieces += [_as_typst(folder, page) for page in pages if page.name != "gallery.md"]
    book = folder / MANUAL / "book.typ"
    book.write_text("\n\n".join(pieces), encoding="utf-8")
    typst.compile(str(book), output=str(path), root=str(folder))


def _as_typst(folder: Path, page: Path) -> str:
    """A page; links between pages become words."""
    text = (folder / page).read_text(encoding="utf-8")
    text = re.sub(r"^```\{math\}$", "```math", text, flags=re.MULTILINE)
    text = re.sub(r"^```\{toctree\}.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"(?<!!)\[([^\]]+)\]\((?!https?:)[^)\s]*\)", r"\1", text)
    return pypandoc.convert_text(text, "typst", format="gfm+tex_math_dollars")
