"""The keywords of the solver, as ``plydyn --keywords --json`` prints them."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any


@dataclass(frozen=True)
class Field:
    """A field of a card."""

    name: str
    kind: str  # integer, real, word, words or text
    width: int  # columns
    supported: bool
    allowed: tuple[int, ...]  # numbers that stand for choices; none where any number may be
    words: tuple[str, ...]  # that the field may hold, in capitals; none where any word may be


@dataclass(frozen=True)
class Card:
    """A card of a keyword."""

    fields: tuple[Field, ...]
    optional: bool
    repeated: bool


@dataclass(frozen=True)
class Keyword:
    """A keyword that the solver reads."""

    name: str
    alias: str  # by its number, empty without one
    cards: tuple[Card, ...]


@cache
def keywords() -> dict[str, Keyword]:
    """All keywords that the solver reads, by their names."""
    text = files("plydyn_pre").joinpath("keywords.json").read_text(encoding="utf-8")
    return {each["name"]: _keyword(each) for each in json.loads(text) if each["status"] == "read"}


def _keyword(data: dict[str, Any]) -> Keyword:
    """A keyword; one that repeats its only card has rows of it."""
    rows = data["repeated"] and len(data["cards"]) == 1
    cards = (
        Card(tuple(map(_field, each["fields"])), each["optional"], each["repeated"] or rows)
        for each in data["cards"]
    )
    return Keyword(data["name"], data["alias"], tuple(cards))


def _field(data: dict[str, Any]) -> Field:
    """A field of a card."""
    first, last = data["columns"]
    allowed = tuple(data.get("allowed", ()))
    supported = data.get("supported", True)
    words = tuple(data.get("words", ()))
    return Field(data["name"], data["kind"], last - first + 1, supported, allowed, words)
