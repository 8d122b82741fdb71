"""Blocks of code in docstrings, fenced as in Markdown, for Sphinx: an extension."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sphinx.application import Sphinx


def unfenced(lines: list[str]) -> list[str]:
    """The lines of a docstring with each fenced block as an indented one."""
    made, inside = [], False
    for line in lines:
        if line.startswith("```"):
            made += [] if inside else ["::", ""]
            inside = not inside
        else:
            made.append(f"    {line}" if inside and line else line)
    return made


def _process(
    _app: Sphinx, _what: str, _name: str, _thing: object, _options: object, lines: list[str]
) -> None:
    """Change a docstring in place, as Sphinx wants it."""
    lines[:] = unfenced(lines)


def setup(app: Sphinx) -> dict[str, bool]:
    """Tell Sphinx of it."""
    app.connect("autodoc-process-docstring", _process)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
