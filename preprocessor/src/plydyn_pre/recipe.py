"""Recipes: studies as TOML files, on top of each other."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from importlib.resources import files
from pathlib import Path
from typing import Any

from plydyn_pre.errors import RecipeError
from plydyn_pre.study import Study
from plydyn_pre.typed import build

Table = dict[str, Any]


def load_recipe(path: Path, overrides: Iterable[str] = ()) -> Study:
    """Read a recipe; each override, ``mesh.n=6`` for instance, has the last word."""
    with blaming(path):
        table = _read(path, ())
        for override in overrides:
            table = merged(table, parse_override(override))
        return build(Study, table)


@contextmanager
def blaming(path: Path) -> Iterator[None]:
    """Put the name of a recipe before the keys of any error inside."""
    try:
        yield
    except RecipeError as error:
        place = f"{path}: {error.path}" if error.path else str(path)
        raise RecipeError(place, error.message) from error


def example_recipe() -> str:
    """A recipe that explains itself."""
    return files("plydyn_pre").joinpath("example.toml").read_text(encoding="utf-8")


def merged(below: Mapping[str, Any], above: Mapping[str, Any]) -> Table:
    """One table on top of another: tables are merged, lists and values are replaced.

    A table that names another `kind` replaces the one below as a whole.
    """
    result = dict(below)
    for key, value in above.items():
        under = result.get(key)
        if isinstance(value, dict) and isinstance(under, dict) and not _differ(value, under):
            value = merged(under, value)
        result[key] = value
    return result


def parse_override(text: str) -> Table:
    """A table from ``key.key=value``; a value that is not TOML is text."""
    key, equals, value = text.partition("=")
    if not equals or not key.strip():
        raise RecipeError("", f"{text!r} is no override such as mesh.n=6")
    for candidate in (value, f'"{value.strip()}"'):
        try:
            return tomllib.loads(f"{key} = {candidate}")
        except tomllib.TOMLDecodeError:
            continue
    raise RecipeError("", f"{text!r} is no override such as mesh.n=6")


def _read(path: Path, above: tuple[Path, ...]) -> Table:
    """The table of a recipe, on top of that of its base."""
    path = path.resolve()
    if path in above:
        raise RecipeError("base", f"{path.name} is based on itself")
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise RecipeError("", f"{path} cannot be read: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise RecipeError("", f"{path.name} is not TOML: {error}") from error
    _anchor(table, path.parent)
    base = table.pop("base", None)
    if base is None:
        return table
    if not isinstance(base, str):
        raise RecipeError("base", f"{base!r} was given, the name of a recipe in quotes is needed")
    return merged(_read(path.parent / base, (*above, path)), table)


def _anchor(table: Table, folder: Path) -> None:
    """Take the file of a mesh relative to the recipe that names it."""
    mesh = table.get("mesh")
    if isinstance(mesh, dict) and isinstance(mesh.get("file"), str):
        mesh["file"] = str(folder / mesh["file"])


def _differ(above: Mapping[str, Any], below: Mapping[str, Any]) -> bool:
    """Whether two tables are of different kinds."""
    return "kind" in above and above["kind"] != below.get("kind")
