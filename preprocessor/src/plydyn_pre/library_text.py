"""Cards of the library as text: keywords of a deck, and lists with sources."""

from __future__ import annotations

from collections.abc import Iterator

from plydyn_pre.deck.conditions import curve_text
from plydyn_pre.deck.materials import material_text
from plydyn_pre.library import Entry, LibraryCard, sources
from plydyn_pre.study.materials import Material
from plydyn_pre.typed import convert

_UNITS = {"length": "mm", "time": "s", "mass": "t"}


def as_deck(card: LibraryCard) -> Iterator[str]:
    """Lines of a deck: the sources as comments, the keyword, and its curve where it has one."""
    yield f"$ {card.title}: {card.note}"
    yield f"$ units {', '.join(_UNITS.values())}"
    for key, value, source in source_lines(card):
        yield f"$ {key} = {value}: {source}"
    numbers: dict[str, int] = {}

    def number(name: str) -> int:
        return numbers.setdefault(name, len(numbers) + 1) if name else 0

    material = convert(Material, card.table(_UNITS), f"materials.{card.name}")
    yield material_text(material, card.title, 1, number)
    for name, curve in card.curve_tables(_UNITS).items():
        pairs = zip(curve["time"], curve["value"], strict=True)
        yield curve_text(name, numbers[name], pairs)


def as_lsdyna(card: LibraryCard) -> Iterator[str]:
    """Lines of a deck of LS-DYNA."""
    from plydyn_pre.translate.back import lsdyna_lines

    yield f"$ {card.title}: {card.note}"
    yield f"$ units {', '.join(_UNITS.values())}"
    yield from lsdyna_lines(convert(Material, card.table(_UNITS), f"materials.{card.name}"))


def source_lines(card: LibraryCard) -> Iterator[tuple[str, str, str]]:
    """Keys, values and sources of a card."""
    known = sources()
    entries: list[tuple[str, Entry]] = list(card.values.items())
    if card.ply_thickness is not None:
        entries.append(("ply thickness", card.ply_thickness))
    for key, entry in entries:
        yield key, f"{entry.value}", known.get(entry.source, entry.source)
    for name, curve in card.curves.items():
        short, colon, rest = curve["source"].partition(":")
        yield name, "curve", known.get(short, short) + colon + rest
