"""The page of a translation: what became of every keyword and every field."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from plydyn_pre.translate.reader import LOST, TAKEN, Block

_SHOWN = 3  # values of a repeated field
#: Why fields of some keywords are lost
_REASONS = {
    "SECTION_": "plates are layer-wise and impactors are rigid: there is nothing to choose",
    "MAT_": "the law of plydyn has nothing like it: no failure strains, no deletion of elements",
    "PART_INERTIA": "a sphere that rotates has the inertia of a solid ball",
    "CONTACT": "contact is by Lagrange multipliers: there is no penalty and nothing to tune",
    "CONTROL_": "plydyn has no such choice",
    "DATABASE_": "plydyn has no such output, or writes it without being asked",
    "HOURGLASS": "full integration has no hourglass modes",
}


def page_text(source: Path, deck: Path, blocks: list[Block], notes: list[str]) -> str:
    """The page in Markdown."""
    lines = [f"# {source.name} as a deck of plydyn", ""]
    lines += [
        f"`{source.name}` was translated to `{deck.name}`.",
        "*Taken*: value and meaning are kept. *Replaced*: something else does its work, as told.",
        "*Lost*: nothing in the new deck does what it did.",
        "",
        "## What to look at",
        "",
        *(f"- {note}" for note in notes),
        "",
        "## Keyword by keyword",
    ]
    for block in blocks:
        lines += ["", *_block_lines(block)]
    return "\n".join(lines) + "\n"


def _block_lines(block: Block) -> Iterator[str]:
    """A table of the fields of a keyword."""
    yield f"### *{block.written}, line {block.line} of {block.file.name}"
    yield ""
    for remark in block.remarks:
        yield from (f"{remark[0].upper()}{remark[1:]}.", "")
    known: dict[str, list[object]] = {}
    for row in block.rows:
        for name, value in row.values.items():
            known.setdefault(name, []).append(value)
    if not known:
        yield f"No field is filled: {LOST}, {_why(block)}."
        return
    yield "| field | value | became |"
    yield "| --- | --- | --- |"
    for name, values in known.items():
        fate, words = block.fates.get(name) or _unknown(block, name, values)
        yield f"| {name} | {_shown(values)} | {fate}{': ' if words else ''}{words} |"


def _unknown(block: Block, name: str, values: list[object]) -> tuple[str, str]:
    """What becomes of a field that nothing reads, and why."""
    if all(value in (0, 0.0) for value in values):
        return TAKEN, "zero asks for nothing"
    return LOST, "titles of such keywords are not kept" if name == "NAME" else _why(block)


def _why(block: Block) -> str:
    """Why what nothing reads is lost."""
    for start, words in _REASONS.items():
        if block.name.startswith(start):
            return words
    return "plydyn has nothing like it"


def _shown(values: list[object]) -> str:
    """Values of a field, cut where there are many."""
    words = [f"{value:g}" if isinstance(value, float) else str(value) for value in values[:_SHOWN]]
    more = f", ... ({len(values)} values)" if len(values) > _SHOWN else ""
    return ", ".join(words).replace("|", "\\|") + more
