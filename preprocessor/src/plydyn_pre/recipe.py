"""Recipes: studies as TOML files, on top of each other."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import fields
from importlib.resources import files
from pathlib import Path

from plydyn_pre.curve_file import with_curves
from plydyn_pre.errors import PreError, RecipeError
from plydyn_pre.files import is_file
from plydyn_pre.library import with_library
from plydyn_pre.models import with_models
from plydyn_pre.overrides import parse_override, with_overrides
from plydyn_pre.quantities import with_quantities
from plydyn_pre.study import Study
from plydyn_pre.suggest import suggestion
from plydyn_pre.tables import Table, merged, without_false
from plydyn_pre.typed import build, is_required

#: What the first line of a template begins with that goes on from another one, and what stands
#: there before the name of a table of that one which it does without
_AFTER, _WITHOUT = "# after ", " without "
#: Bytes of a recipe
_LARGEST = 16 << 20
#: Where a text is not TOML, and columns of a line that are shown
_PLACE = re.compile(r"\(at line (\d+), column (\d+)\)")
_SHOWN = 100
#: Keys that can do without a value: false leaves out that of the base
_OPTIONAL = {each.name for each in fields(Study) if not is_required(each)}


def load_recipe(path: str | Path, overrides: Iterable[str] = ()) -> Study:
    """Read a recipe; overrides such as ``mesh.n=6`` have the last word."""
    path = Path(path)
    with blaming(path):
        overrides = list(overrides)
        table = without_false(with_overrides(_read(path, ()), overrides), _OPTIONAL)
        table = with_quantities(table)
        table, origins = with_library(with_curves(table))
        try:
            study = build(Study, with_models(table))
            object.__setattr__(study, "origins", origins)
            return study
        except RecipeError as error:
            why = _of_replaced_kind(overrides, error) or _of_another_kind(path, error)
            raise RecipeError(error.path, error.message + why) from error


def is_given(path: Path, overrides: Iterable[str], key: str) -> bool:
    """Whether a recipe itself, and not its base, or an override has a key such as sets.gauge."""
    name, _, entry = key.partition(".")
    table = _parse(path).get(name, {})
    table = table if isinstance(table, dict) else {}
    steps = [parse_override(text)[0] for text in overrides]
    known = [*table, *(str(step[1]) for step in steps if step[0] == name and len(step) > 1)]
    return any(entry == each or entry.startswith(f"{each}.") for each in known)


def _of_replaced_kind(overrides: list[str], error: RecipeError) -> str:
    """Why a key that is missing is not that of the recipe: an override gave the table a kind."""
    table = error.path.rpartition(".")[0]
    for text in overrides:
        steps, kind = parse_override(text)
        name = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in steps)
        if error.message.startswith("missing") and name == f".{table}.kind":
            return f"; {table}.kind={kind} replaces the whole table, so give its other keys, too"
    return ""


def _of_another_kind(path: Path, error: RecipeError) -> str:
    """Why a key that is missing is not that of the base: the table is of another kind there."""
    table = _parse(path)
    if not error.message.startswith("missing") or "base" not in table:
        return ""
    own, below = table, _read(path.parent / table["base"], (path.resolve(),))
    for key in error.path.split(".")[:-1]:
        own, below = (each.get(key, {}) if isinstance(each, dict) else {} for each in (own, below))
    last = error.path.rpartition(".")[2].split(",")[0]
    if not isinstance(below, dict) or last not in below or "kind" not in own:
        return ""
    kind = below.get("kind")
    before = f"is of kind {kind!r}" if kind else "has no kind"
    return f"; that of the base is not taken, for its table {before}"


@contextmanager
def blaming(path: Path) -> Iterator[None]:
    """Put the name of a recipe before the keys of any error inside."""
    try:
        yield
    except RecipeError as error:
        place = f"{path}: {error.path}" if error.path else str(path)
        raise RecipeError(place, error.message) from error


def templates() -> list[str]:
    """Names of the recipes to begin with."""
    names = (each.name for each in files("plydyn_pre").joinpath("templates").iterdir())
    return sorted(name.removesuffix(".toml") for name in names if name.endswith(".toml"))


def example_recipe(template: str = "impact") -> str:
    """The recipe of a template."""
    known = {name.casefold(): name for name in templates()}
    if template.casefold() not in known:
        hint = suggestion(template, known.values())
        raise PreError(f"{template!r} is not a template; {hint}")
    return _template(known[template.casefold()])


def _template(name: str) -> str:
    """The text of a template; one that is a chain begins with the text of its first stage."""
    text = files("plydyn_pre").joinpath("templates", f"{name}.toml").read_text(encoding="utf-8")
    first, _, rest = text.partition("\n")
    if not first.startswith(_AFTER):
        return text
    below, _, table = first.removeprefix(_AFTER).partition(_WITHOUT)
    parts = _template(below).split("\n\n")
    kept = [part for part in parts if f"[{table}]" not in part.splitlines()]
    return "\n\n".join(kept) + f"\n{rest}"


def _read(path: Path, above: tuple[Path, ...]) -> Table:
    """The table of a recipe, on top of that of its base."""
    if not is_file(path):
        raise RecipeError("base" if above else "", f"there is no file {str(path)!r}")
    path = path.resolve()
    if path in above:
        raise RecipeError("base", f"{path.name} is based on itself")
    table = _parse(path)
    _anchor(table, path.parent)
    base = table.pop("base", None)
    if base is None:
        return table
    if not isinstance(base, str):
        raise RecipeError("base", f"{base!r} was given, the name of a recipe in quotes is needed")
    return merged(_read(path.parent / base, (*above, path)), table)


def _parse(path: Path) -> Table:
    """The table of a file."""
    try:
        if path.stat().st_size > _LARGEST:
            raise RecipeError("", f"{path.name} is larger than {_LARGEST >> 20} MB: no recipe")
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise RecipeError("", f"{path} cannot be read: {error.strerror}") from error
    except ValueError as error:
        if isinstance(error, RecipeError):
            raise
        raise RecipeError("", _not_toml(path, error)) from error
    except RecursionError:
        raise RecipeError("", f"{path.name} has lists or tables nested too deeply") from None


def _not_toml(path: Path, error: ValueError) -> str:
    """What is wrong with a text, and the line where it is."""
    place = _PLACE.search(str(error))
    words = f"not TOML: {error}"
    if not isinstance(error, tomllib.TOMLDecodeError) or place is None:
        return f"{path.name} is {words}"
    line = path.read_text(encoding="utf-8-sig").split("\n")[int(place[1]) - 1]
    mark = " " * (int(place[2]) - 1) + "^"
    shown = f"{path.name} is {words}"
    return f"{shown}\n  {line[:_SHOWN]}\n  {mark}" if len(mark) <= _SHOWN else shown


def _anchor(table: Table, folder: Path) -> None:
    """Take the files of a mesh and of curves relative to the recipe that names them."""
    curves = table.get("curves")
    for each in (table.get("mesh"), *(curves.values() if isinstance(curves, dict) else ())):
        if isinstance(each, dict) and isinstance(each.get("file"), str):
            each["file"] = str(folder / each["file"])
