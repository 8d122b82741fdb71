"""Metals that yield along a curve or by Johnson and Cook's law: as they stand."""

from __future__ import annotations

from collections.abc import Callable

from plydyn_pre.deck.cards import keyword
from plydyn_pre.keywords import Card, keywords
from plydyn_pre.translate.block import IDLE, TAKEN, Block, Value
from plydyn_pre.translate.laws import METALS

__all__ = ["METALS", "metal_text"]

#: What asks for an effect of the rate: of MAT_024 and of MAT_098
_RATES = {"MAT_PIECEWISE_LINEAR_PLASTICITY": "P", "MAT_SIMPLIFIED_JOHNSON_COOK": "C"}


def metal_text(block: Block, number: int, curve: Callable[[int], int]) -> str:
    """The keyword of a metal with the number of its material and of its curve."""
    if block.raw(_RATES[block.name], 0.0) and block.raw("VP", 0.0) != 1.0:
        words = "0 with an effect of the rate is that of the whole strain, which is not"
        block.lose(f"{words} translated; 1 is that of plastic strain", "VP")
    own: dict[str, Value] = {"MID": number, "VP": float(block.raw("VP", 0.0))}
    if block.has("LCSS"):
        own["LCSS"] = curve(int(block.raw("LCSS")))
    cards = [_card(block, card, own) for card in keywords()[block.name].cards]
    while not any(cards[-1].values()):
        cards.pop()
    return keyword(block.name, *cards)


def _card(block: Block, card: Card, own: dict[str, Value]) -> dict[str, Value]:
    """The values of a card; fields that the solver has not are zero, or told as lost."""
    found: dict[str, Value] = {}
    for field in card.fields:
        value = block.raw(field.name, 0.0)
        if field.supported:
            block.mark(TAKEN, "", field.name) if field.name not in block.fates else None
            found[field.name.lower()] = own.get(field.name, value)
            continue
        found[field.name.lower()] = 0.0
        if value in field.allowed:
            block.mark(IDLE, "it stands for none", field.name)
        elif value:
            words = "no metal is deleted" if "FAIL" in field.name else f"{value} is not translated"
            block.lose(words, field.name, line=block.line_of(field.name))
    return found
