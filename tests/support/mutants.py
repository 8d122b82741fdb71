"""Seeded mutants of decks: bytes, fields, cards and keywords changed by chance."""

from __future__ import annotations

import random
from collections.abc import Callable

NUMBERS = ["0", "-1", "1", "2", "1e-300", "1e300", "1e-400", "1e99", "-1e30", "2147483648", "NaN"]
NUMBERS += [
    "1,0e-6",
    "0e-6",
    "1.0e-9",
    "99999999",
    "&x",
    "-&x",
    "",
    " ",
    "abc",
    "1.5",
    "3.0",
    "\x1b",
]


def mutate(text: str, chance: random.Random) -> str:
    """The text with one to four changes."""
    lines = text.splitlines()
    for _ in range(chance.choice([1, 1, 1, 2, 4])):
        if not lines:
            break
        lines = chance.choice(CHANGES)(lines, chance)
    mutant = "\n".join(lines) + "\n"
    if chance.random() < 0.05:
        mutant = mutant[: chance.randrange(len(mutant))]
    return mutant


def _place(lines: list[str], chance: random.Random) -> int:
    """A line that is no comment, nor one of many nodes or elements where there are others."""
    starts = [i for i, line in enumerate(lines) if line.startswith("*")]
    if starts and chance.random() < 0.8:
        first = chance.choice(starts)
        return min(first + chance.randrange(4), len(lines) - 1)
    return chance.randrange(len(lines))


def _byte(lines: list[str], chance: random.Random) -> list[str]:
    i = _place(lines, chance)
    line = lines[i]
    k = chance.randrange(len(line) + 1)
    new = chr(chance.choice([0, 9, 13, 27, 32, 36, 38, 42, 44, 45, 46, 48, 57, 101, 127, 233]))
    return [*lines[:i], line[:k] + new + line[k + chance.randrange(2) :], *lines[i + 1 :]]


def _field(lines: list[str], chance: random.Random) -> list[str]:
    i = _place(lines, chance)
    fields = lines[i].split(",") if "," in lines[i] else _columns(lines[i])
    fields[chance.randrange(len(fields))] = chance.choice(NUMBERS)
    return [*lines[:i], ",".join(fields), *lines[i + 1 :]]


def _columns(line: str) -> list[str]:
    return [line[k : k + 10].strip() for k in range(0, len(line), 10)] or [""]


def _drop(lines: list[str], chance: random.Random) -> list[str]:
    i = _place(lines, chance)
    return lines[:i] + lines[i + chance.choice([1, 1, 2]) :]


def _double(lines: list[str], chance: random.Random) -> list[str]:
    i = _place(lines, chance)
    return [*lines[: i + 1], *lines[i:]]


def _swap(lines: list[str], chance: random.Random) -> list[str]:
    i, k = _place(lines, chance), _place(lines, chance)
    lines[i], lines[k] = lines[k], lines[i]
    return lines


def _block(lines: list[str], chance: random.Random) -> list[str]:
    """A keyword with its cards gone, or twice, or elsewhere."""
    starts = [i for i, line in enumerate(lines) if line.startswith("*")] + [len(lines)]
    if len(starts) < 2:
        return lines
    n = chance.randrange(len(starts) - 1)
    block = lines[starts[n] : starts[n + 1]]
    rest = lines[: starts[n]] + lines[starts[n + 1] :]
    if chance.random() < 0.4:
        return rest
    where = chance.choice([s for s in starts if s <= len(rest)])
    kept = rest if chance.random() < 0.5 else lines
    return kept[:where] + block + kept[where:]


def _name(lines: list[str], chance: random.Random) -> list[str]:
    i = _place(lines, chance)
    new = lines[i] + chance.choice(["_TITLE", "_ID", "+", "-", " x", "_LONG", "X"])
    return [*lines[:i], new, *lines[i + 1 :]]


CHANGES: list[Callable[[list[str], random.Random], list[str]]] = [
    _byte,
    _field,
    _field,
    _field,
    _field,
    _drop,
    _double,
    _swap,
    _block,
    _block,
    _name,
]
