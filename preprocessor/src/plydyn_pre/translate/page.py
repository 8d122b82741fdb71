"""The page of a translation: what became of every keyword and every field."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from plydyn_pre.translate.block import TAKEN, Block
from plydyn_pre.translate.source import Source

_SHOWN = 3  # values of a repeated field


def page_text(source: Path, deck: Path, read: Source, notes: list[str]) -> str:
    """The page in Markdown."""
    lines = [f"# {source.name} as a deck of plydyn", ""]
    lines += [
        f"`{source.name}` was translated to `{deck.name}`.",
        "*Taken*: value and meaning are kept. *Replaced*: something else does its work, as told.",
        "*No effect here*: the result does not depend on it, as told. *Lost*: it changes the",
        f"result of {read.program}, and nothing in the new deck does what it did (only with",
        "`--allow-lost`).",
        "",
        "## What to look at",
        "",
        *(f"- {note}" for note in notes),
        "",
        "## Keyword by keyword",
    ]
    for block in read.shown:
        lines += ["", *_block_lines(block)]
    return "\n".join(lines) + "\n"


def _block_lines(block: Block) -> Iterator[str]:
    """A table of the fields of a keyword."""
    yield f"### {block.title}, line {block.line} of {block.file.name}"
    yield ""
    entry = block.entry
    if entry.words:
        yield from (f"{entry.fate[0].upper()}{entry.fate[1:]}: {entry.words}.", "")
    for remark in block.remarks:
        yield from (f"{remark[0].upper()}{remark[1:]}.", "")
    known: dict[str, list[object]] = {}
    for row in block.rows:
        for name, value in row.values.items():
            known.setdefault(name, []).append(value)
    if not known:
        yield f"No field is filled: {entry.fate}."
        return
    yield "| field | value | became |"
    yield "| --- | --- | --- |"
    for name, values in known.items():
        fate, words = block.fates.get(name, (TAKEN, "zero asks for nothing"))
        yield f"| {name} | {_shown(values)} | {fate}{': ' if words else ''}{words} |"


def _shown(values: list[object]) -> str:
    """Values of a field, cut where there are many."""
    words = [f"{value:g}" if isinstance(value, float) else str(value) for value in values[:_SHOWN]]
    more = f", ... ({len(values)} values)" if len(values) > _SHOWN else ""
    return ", ".join(words).replace("|", "\\|") + more
