"""Cards of fixed columns.

A keyword is written in fields of 10 columns. Where one of its numbers would lose digits there, the
keyword as a whole gets a ``+`` behind its name and fields of 20 columns. Numbers keep 13 digits,
coordinates of nodes 10 or more in their 16 columns; a blank column is left between fields.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache

from plydyn_pre.errors import PreError
from plydyn_pre.keywords import keywords

Value = int | float | str
#: Fields of a card by their names, in any order
Card = Mapping[str, Value]

SHORT, LONG = 10, 20
_DIGITS = 13
_LINE = 80


def keyword(name: str, *cards: Card | str) -> str:
    """A keyword of the solver with its cards; text is a card as it stands."""
    placed = (card if isinstance(card, str) else _placed(name, card) for card in cards)
    return written(name, *placed)


def written(name: str, *cards: Card | str) -> str:
    """A keyword of any program, with the fields of its cards in their order."""
    for width, mark in ((SHORT, ""), (LONG, "+")):
        lines = list(_lines(cards, width))
        if None not in lines:
            return "\n".join([f"*{name}{mark}", *map(str, lines)])
    raise PreError(f"a number of *{name} does not fit {LONG} columns")


def titled(name: str, title: str, *cards: Card | str) -> str:
    """A keyword with a title, if there is one."""
    return keyword(f"{name}_TITLE", title_line(title), *cards) if title else keyword(name, *cards)


def id_cards(ids: Iterable[int]) -> list[str]:
    """Numbers of nodes or quads, eight to a line."""
    ids = list(ids)
    rows = (ids[i : i + 8] for i in range(0, len(ids), 8))
    return ["".join(f"{number:{SHORT}d}" for number in row) for row in rows]


def title_line(title: str) -> str:
    """A title as a line of text that every client reads as one."""
    text = " ".join(title.split()).replace(",", ";")[:_LINE]
    return f"'{text}"[:_LINE] if text[:1] in ("*", "$") else text


def number_text(value: float, width: int) -> str | None:
    """The shortest text of a number that leaves a column free; None where there is none."""
    if isinstance(value, int):
        texts = [str(value)]
    else:
        value = float(f"{value:.{_DIGITS - 1}e}")
        texts = [repr(value), _scientific(value)]
    return next((text for text in texts if len(text) < width), None)


def coordinate_text(value: float) -> str:
    """A coordinate in 16 columns."""
    text = f"{value:.12g}"
    if len(text) > 16:
        text = f"{value:.9e}"
    return text if "." in text or "e" in text else f"{text}.0"


def _scientific(value: float) -> str:
    """A number as mantissa and exponent, as short as it goes."""
    mantissa, exponent = f"{value:.{_DIGITS - 1}e}".split("e")
    mantissa = mantissa.rstrip("0")
    return f"{mantissa}{'0' * mantissa.endswith('.')}e{int(exponent)}"


def _placed(name: str, card: Card) -> Card:
    """The fields of a card in the order of the solver; those that it does not use hold 0."""
    layout = _layout(name, tuple(card))
    for key, allowed in layout.items():
        value = card.get(key, 0)
        if allowed and value and value not in allowed:
            raise PreError(f"{key} of *{name} is {value}; the solver has {allowed}")
    return {key: card.get(key, 0) for key in layout}


@cache
def _layout(name: str, given: tuple[str, ...]) -> dict[str, tuple[int, ...]]:
    """All fields of a card up to the last that is given, with the choices that they have."""
    known = keywords()[name.removesuffix("_TITLE")]
    for card in known.cards:
        names = [field.name.lower() for field in card.fields]
        own = {field.lower(): field for field in given}
        if not own.keys() <= set(names):
            continue
        last = max(map(names.index, own))
        unused = {field.name.lower() for field in card.fields if not field.supported}
        if set(names[: last + 1]) - own.keys() <= unused:
            shown = card.fields[: last + 1]
            return {own.get(each.name.lower(), each.name.lower()): each.allowed for each in shown}
    raise PreError(f"the solver has no card {' '.join(given)} of *{name}")


def _lines(cards: Sequence[Card | str], width: int) -> Iterator[str | None]:
    """Lines of cards with their headers; None for one that does not fit."""
    above: tuple[str, ...] | None = None
    for card in cards:
        if isinstance(card, str):
            yield card
            above = None
            continue
        names = tuple(card)
        if names != above:
            yield _header(names, width)
            above = names
        texts = [_field(value, width) for value in card.values()]
        yield None if None in texts else "".join(f"{text:>{width}}" for text in texts)


def _field(value: Value, width: int) -> str | None:
    """A field as text; None for one that does not fit."""
    if isinstance(value, str):
        return value if len(value) < width else None
    return number_text(value, width)


def _header(names: Iterable[str], width: int) -> str:
    """A comment that names the fields of the card below."""
    return f"$#{''.join(f'{name:>{width}}' for name in names)[2:]}"
