"""Words of recipes that go into decks as they are: those that the solver's keywords know."""

from __future__ import annotations

from typing import get_args, get_type_hints

import pytest

from plydyn_pre.keywords import keywords
from plydyn_pre.study.control import Quantity, Units

#: Second names of units, which LS-DYNA has and recipes do without
SECOND = {"sec", "ton", "mtrc_ton"}
UNITS = get_type_hints(Units)


@pytest.mark.parametrize(
    ("keyword", "field", "known"),
    [
        ("DATABASE_FIELD", "NAME", get_args(Quantity)),
        *(("CONTROL_UNITS", name.upper(), get_args(kind)) for name, kind in UNITS.items()),
    ],
)
def test_recipes_have_the_words_of_the_keyword(
    keyword: str, field: str, known: tuple[str, ...]
) -> None:
    """All of them, and no others."""
    cards = keywords()[keyword].cards
    words = next(each.words for card in cards for each in card.fields if each.name == field)
    assert {word.lower() for word in words} - SECOND == set(known)
