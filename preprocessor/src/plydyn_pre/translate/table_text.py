"""The page "From LS-DYNA, Abaqus, Nastran": what becomes of each keyword, by the tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from plydyn_pre.translate.block import Entry
from plydyn_pre.translate.schema import ALIASES, table
from plydyn_pre.translate.source import dialect

_OPENING = """# From LS-DYNA, Abaqus, Nastran

What `plydyn-pre translate` makes of each keyword, as printed by `plydyn-pre foreign`.
*Taken*: value and meaning are kept. *Replaced*: another keyword does its work. *No effect here*:
the result does not depend on it. *Lost*: it changes the result, which is an error, or a note with
`--allow-lost`. A keyword that is not listed is lost.
`...` at the end of a name stands for all names that begin so and are not listed themselves. What
becomes of each field is in the report of a translation
([decks of other programs](recipes.md#decks-of-other-programs)).

The program is known by the first lines of the deck.
"""
_LSDYNA = "`_TITLE` and `_ID` are read everywhere."
_REFUSED = """Of keywords that are taken or replaced, these have values that change the result and
are not translated: each is an error with its line and this cause. What is said of one keyword
holds for those of its kind (laws of plies, contacts, supports, loads, velocities)."""
_ABAQUS = """A parameter that is neither read nor without effect is lost. Elements: S4, S4R, S4RS,
S8R, S8R5, S9R5 and SC8R with plies in `*SHELL SECTION`, C3D8, C3D8R, C3D8I as plies, COH3D8
between them; R3D3 and R3D4, S3, C3D4 and C3D6 in rigid bodies; MASS and ROTARYI at reference
nodes. Orientations lie in the plate."""
_NASTRAN = """Fields of 8 and of 16 columns and those with commas are read, and INCLUDE. The case
control chooses sets; without it all sets hold. A field that is neither read nor without effect is
lost. CORD2R as THETA turns plies; THETA without one counts from the edge G1-G2."""


def table_lines() -> Iterator[str]:
    """The page in Markdown."""
    yield from _OPENING.splitlines()
    yield from ("", "## LS-DYNA", "", *_LSDYNA.splitlines(), "")
    yield "| keyword | also | becomes | fields without effect here |"
    yield "| --- | --- | --- | --- |"
    for name, entry in sorted(table().items()):
        others = sorted(other for other, full in ALIASES.items() if full == name)
        also = ", ".join(f"`*{other}`" for other in others)
        yield f"| `*{name.replace('*', '...')}` | {also} | {_becomes(entry)} | {_idle(entry)} |"
    yield from _refused("field", table(), "*")
    for program, star, words in (("Abaqus", "*", _ABAQUS), ("Nastran", "", _NASTRAN)):
        yield from ("", f"## {program}", "", *words.splitlines(), "")
        read = "parameters" if star else "fields"
        yield f"| keyword | becomes | {read} that are read | without effect here |"
        yield "| --- | --- | --- | --- |"
        for name, entry in sorted(dialect(program.lower()).items()):
            shown = f"`{star}{name.replace('*', '...')}`"
            options = ", ".join(sorted(entry.options))
            yield f"| {shown} | {_becomes(entry)} | {options} | {_idle(entry)} |"
        yield from _refused(read[:-1], dialect(program.lower()), star)


def _refused(read: str, known: Mapping[str, Entry], star: str) -> Iterator[str]:
    """What is refused of keywords that are taken or replaced."""
    yield from ("", "### Values that are refused", "", *_REFUSED.splitlines(), "")
    yield f"| keyword | {read} | cause |"
    yield "| --- | --- | --- |"
    for name, entry in sorted(known.items()):
        for field, words in entry.refused.items():
            yield f"| `{star}{name}` | {field} | {words} |"


def _becomes(entry: Entry) -> str:
    """What becomes of a keyword."""
    return f"{entry.fate}{': ' if entry.words else ''}{entry.words}"


def _idle(entry: Entry) -> str:
    """Fields without effect, and why."""
    rows = []
    for words, names in entry.idle.items():
        shown = "all others" if names == "*" else names.replace("|", "/")
        rows.append(f"{shown}: {words}")
    return "; ".join(rows)
