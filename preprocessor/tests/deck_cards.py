"""Decks as text, taken apart into their cards."""

from __future__ import annotations

import numpy as np

import plydyn_pre as pre

WIDTHS = {"NODE": [8, 16, 16, 16, 8, 8], "ELEMENT_PLATE_Q9": [8] * 9, "ELEMENT_SHELL": [8] * 6}
TEXT_LINES = {"TITLE": 1, "PART_COMPOSITE_LONG": 1}


def text_of(study: pre.Study) -> str:
    """The deck of a study."""
    return "\n".join(pre.deck_text(study, pre.make_mesh(study.mesh))) + "\n"


def cards_of(text: str) -> dict[str, list[str]]:
    """Lines of data of each keyword, repeats joined; comments left out."""
    cards: dict[str, list[str]] = {}
    name = ""
    for line in text.splitlines():
        if line.startswith("*"):
            name = line[1:]
            cards.setdefault(name, [])
        elif not line.startswith("$"):
            cards[name].append(line)
    return cards


def split_columns(line: str, width: int) -> list[str]:
    """Fields of a line of equal columns."""
    return [line[i : i + width].strip() for i in range(0, len(line), width)]


def fields_of(keyword: str, line: str) -> list[str]:
    """Fields of a line of a keyword."""
    if keyword not in WIDTHS:
        return split_columns(line, 20 if keyword.endswith("+") or "CURVE" in keyword else 10)
    ends = np.cumsum(WIDTHS[keyword])
    return [line[end - w : end].strip() for end, w in zip(ends, WIDTHS[keyword], strict=True)]


def read_by_client(text: str) -> dict[str, list]:
    """Keywords as an independent reader of LS-DYNA decks sees them, by their names."""
    # as long to load as some hundred of the tests
    from ansys.dyna.core import Deck

    deck = Deck()
    deck.loads(text)
    found: dict[str, list] = {}
    for item in deck.all_keywords:
        first = item.splitlines()[0][1:] if isinstance(item, str) else ""
        name = first or f"{item.keyword}_{item.subkeyword}".replace("NODE_NODE", "NODE")
        found.setdefault(name, []).append(item)
    return found
