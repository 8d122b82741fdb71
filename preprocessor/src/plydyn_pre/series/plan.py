"""The file of a parameter study: a recipe, and lists of values for some of its keys."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

from plydyn_pre.errors import RecipeError, require
from plydyn_pre.recipe import blaming
from plydyn_pre.suggest import suggestion

#: Most cases of a study
MOST = 10_000
_KEYS = {"recipe", "show", "values"}


@dataclass(frozen=True)
class Case:
    """One combination of values."""

    name: str  # of its folder: 01, 02, ...
    values: tuple[Any, ...]  # in the order of the keys
    overrides: tuple[str, ...]  # of the recipe, such as mesh.n=6


@dataclass(frozen=True)
class Series:
    """A recipe with lists of values; the cases are all their combinations."""

    recipe: Path
    keys: tuple[str, ...]
    cases: tuple[Case, ...]
    show: str  # the number that the figure shows


def read_series(path: Path) -> Series:
    """Read the file of a study; the last key changes fastest."""
    with blaming(path):
        table = _parse(path)
        for key in table.keys() - _KEYS:
            raise RecipeError(key, f"a study has no such key; {suggestion(key, _KEYS)}")
        recipe = _word(table, "recipe", "the name of a recipe")
        show = _word({"show": "peak force"} | table, "show", "the name of a number")
        values = table.get("values")
        if not isinstance(values, dict) or not values:
            raise RecipeError("values", "a table of lists is needed")
        lists = dict(_lists_in(values, ""))
        count = 1
        for each in lists.values():
            count *= len(each)
        require(count <= MOST, "values", f"these are {count:,} cases, at most {MOST:,} can be")
        cases = tuple(_cases(lists, len(str(count))))
        return Series(path.parent / recipe, tuple(lists), cases, show)


def _word(table: dict[str, Any], key: str, what: str) -> str:
    """A text that is needed."""
    value = table.get(key)
    if not isinstance(value, str):
        raise RecipeError(key, f"{what} in quotes is needed")
    return value


def _parse(path: Path) -> dict[str, Any]:
    """The table of a file."""
    try:
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise RecipeError("", f"it cannot be read: {error.strerror}") from error
    except ValueError as error:
        raise RecipeError("", f"it is not TOML: {error}") from error


def _lists_in(table: dict[str, Any], above: str) -> Iterator[tuple[str, list[Any]]]:
    """Keys of the recipe with the list of their values."""
    for name, value in table.items():
        key = f"{above}.{name}" if above else name
        if isinstance(value, dict):
            yield from _lists_in(value, key)
            continue
        place = f"values.{key}"
        require(isinstance(value, list) and bool(value), place, "a list of values is needed")
        for each in value:
            rule = "values are numbers, texts, or lists of these"
            require(_is_plain(each), place, f"{each!r} was given; {rule}")
        twice = [each for number, each in enumerate(value) if each in value[:number]]
        require(not twice, place, f"{twice[:1]} stands in it twice")
        yield key, value


def _is_plain(value: object) -> bool:
    """Whether a value can be given as an override."""
    if isinstance(value, list):
        return all(map(_is_plain, value))
    return isinstance(value, bool | int | float | str)


def _cases(lists: dict[str, list[Any]], digits: int) -> Iterator[Case]:
    """All combinations."""
    for number, values in enumerate(product(*lists.values()), start=1):
        pairs = zip(lists, values, strict=True)
        # what JSON writes of such values is TOML
        words = (f"{key}={json.dumps(value, ensure_ascii=False)}" for key, value in pairs)
        yield Case(f"{number:0{digits}d}", values, tuple(words))
