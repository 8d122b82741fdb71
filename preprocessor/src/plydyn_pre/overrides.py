"""Values that replace those of a recipe, as ``mesh.n=6`` or ``supports[1].set=left``."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Sequence
from typing import Any

from plydyn_pre.errors import RecipeError
from plydyn_pre.tables import Table, merged

#: A key of a table, or the place of a list's entry counted from 1
Step = str | int

_EXAMPLE = "is no override such as mesh.n=6 or supports[1].set=left"
_STEP = re.compile(
    r"(?:^|\.)\s*(?:(?P<bare>[A-Za-z0-9_-]+)|\"(?P<double>[^\"]*)\"|'(?P<single>[^']*)')\s*"
    r"|\[(?P<entry>\d{1,6})\]\s*"
)
_LONGEST_TITLE = 80  # columns of a title in a deck


def with_overrides(table: Table, overrides: Iterable[str]) -> Table:
    """A table with some values replaced."""
    for override in overrides:
        table = _replaced(table, *parse_override(override), "")
    return table


def title_with(title: str, overrides: Sequence[str]) -> str:
    """A title that tells what was replaced, cut where it leaves its columns.

    One that was itself replaced stays as it is.
    """
    if not overrides or any(parse_override(text)[0][0] == "title" for text in overrides):
        return title
    text = " ".join(f"{title}; {' '.join(overrides)}".split())
    return text if len(text) <= _LONGEST_TITLE else f"{text[: _LONGEST_TITLE - 3]}..."


def parse_override(text: str) -> tuple[list[Step], Any]:
    """The keys and the value of an override; a value that is not TOML is text."""
    steps: list[Step] = []
    at = 0
    while at < len(text) and text[at] != "=":
        match = _STEP.match(text, at)
        if match is None or (match["entry"] and not steps):
            raise RecipeError("", f"{text!r} {_EXAMPLE}")
        names = (match["bare"], match["double"], match["single"])
        name = next((name for name in names if name is not None), None)
        steps.append(int(match["entry"]) if name is None else name)
        at = match.end()
    if not steps or at >= len(text):
        raise RecipeError("", f"{text!r} {_EXAMPLE}")
    value = text[at + 1 :]
    for candidate in (value, f'"{value.strip()}"'):
        try:
            table = tomllib.loads(f"value = {candidate}")
        except (ValueError, RecursionError):
            continue
        if len(table) == 1:
            return steps, table["value"]
    raise RecipeError("", f"{text!r} {_EXAMPLE}")


def _replaced(under: object, steps: list[Step], value: object, path: str) -> Any:  # noqa: ANN401
    """What is under some keys, with a value replaced; tables are merged."""
    if not steps:
        return merged({"": under}, {"": value})[""]
    step, *rest = steps
    if isinstance(step, int):
        return _replaced_entry(under, step, rest, value, path)
    if isinstance(under, list):
        rule = f"a list of {len(under)} was given; name an entry, as {path}[1].{step}"
        raise RecipeError(path, rule)
    table = dict(under) if isinstance(under, dict) else {}
    inner = f"{path}.{step}" if path else step
    if not rest and step == "kind" and table.get("kind") != value:
        return {"kind": value}
    table[step] = _replaced(table.get(step), rest, value, inner)
    return table


def _replaced_entry(
    under: object, number: int, rest: list[Step], value: object, path: str
) -> list[Any]:
    """A list with an entry replaced; entries are counted from 1."""
    entries = list(under) if isinstance(under, list) else []
    rule = f"there is no entry {number}; the recipe has {len(entries)}, counted from 1"
    if not 1 <= number <= len(entries):
        raise RecipeError(f"{path}[{number}]", rule)
    inner = f"{path}[{number}]"
    entries[number - 1] = _replaced(entries[number - 1], rest, value, inner)
    return entries
