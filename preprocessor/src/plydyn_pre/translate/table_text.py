"""The page "From LS-DYNA": what becomes of each keyword, by the table of the translation."""

from __future__ import annotations

from collections.abc import Iterator

from plydyn_pre.translate.schema import ALIASES, Entry, table

_OPENING = """# From LS-DYNA

What `plydyn-pre translate` makes of each keyword of LS-DYNA, as printed by `plydyn-pre foreign`.
*Taken*: the keyword of the same name. *Replaced*: another one does its work. *No effect here*: the
result does not depend on it. *Lost*: it changes the result, which is an error, or a note with
`--allow-lost`.
`...` at the end of a name stands for all names that begin so and are not listed themselves.
`_TITLE` and `_ID` are read everywhere. What becomes of each field is in the report of a
translation ([decks of LS-DYNA](recipes.md#decks-of-ls-dyna)).
"""


def table_lines() -> Iterator[str]:
    """The page in Markdown."""
    yield from _OPENING.splitlines()
    yield ""
    yield "| keyword | also | becomes | fields without effect here |"
    yield "| --- | --- | --- | --- |"
    for name, entry in sorted(table().items()):
        others = sorted(other for other, full in ALIASES.items() if full == name)
        also = ", ".join(f"`*{other}`" for other in others)
        words = f"{entry.fate}{': ' if entry.words else ''}{entry.words}"
        shown = f"`*{name.replace('*', '...')}`"
        yield f"| {shown} | {also} | {words} | {_idle(entry)} |"


def _idle(entry: Entry) -> str:
    """Fields without effect, and why."""
    rows = [
        f"{'all others' if names == '*' else names.replace('|', '/')}: {words}"
        for words, names in entry.idle.items()
    ]
    return "; ".join(rows)
