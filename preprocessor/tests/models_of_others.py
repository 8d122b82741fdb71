"""Models of other programs in a file of some name, translated or refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from deck_cards import cards_of
from foreign_decks import translate

from plydyn_pre.errors import PreError
from plydyn_pre.translate import Choices


def translated_model(
    name: str, folder: Path, text: str, **choices: object
) -> tuple[dict[str, list[str]], str]:
    """The cards of the new deck, and the page."""
    (folder / name).write_text(text, encoding="utf-8")
    lines, page, _ = translate(folder / name, folder / "job.k", Choices(**choices))
    return cards_of("\n".join(lines) + "\n"), page


def refused_model(name: str, folder: Path, text: str, *words: str, **choices: object) -> str:
    """What is said of a file that is not translated."""
    with pytest.raises(PreError) as caught:
        translated_model(name, folder, text, **choices)
    for each in words:
        assert each in str(caught.value)
    return str(caught.value)


def numbers(rows: list[str]) -> list[list[float]]:
    """Rows of numbers; titles are left out."""
    return [[float(word) for word in row.split()] for row in rows if not row[:1].isalpha()]
