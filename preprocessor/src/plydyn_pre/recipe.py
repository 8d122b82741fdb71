"""Recipes: studies as TOML files, on top of each other."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from importlib.resources import files
from pathlib import Path

from plydyn_pre.errors import PreError, RecipeError
from plydyn_pre.files import is_file
from plydyn_pre.library import with_library
from plydyn_pre.models import with_models
from plydyn_pre.overrides import with_overrides
from plydyn_pre.study import Study
from plydyn_pre.suggest import suggestion
from plydyn_pre.tables import Table, merged
from plydyn_pre.typed import build

#: What the first line of a template begins with that goes on from another one
_AFTER = "# after "
#: Bytes of a recipe
_LARGEST = 16 << 20


def load_recipe(path: Path, overrides: Iterable[str] = ()) -> Study:
    """Read a recipe; overrides such as ``mesh.n=6`` have the last word."""
    with blaming(path):
        table = _read(path, ())
        return build(Study, with_models(with_library(with_overrides(table, overrides))))


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
    """A recipe that explains itself."""
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
    return f"{_template(first.removeprefix(_AFTER))}\n{rest}"


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
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise RecipeError("", f"{path} cannot be read: {error.strerror}") from error
    except ValueError as error:
        if isinstance(error, RecipeError):
            raise
        raise RecipeError("", f"{path.name} is not TOML: {error}") from error
    except RecursionError:
        raise RecipeError("", f"{path.name} has lists or tables nested too deeply") from None


def _anchor(table: Table, folder: Path) -> None:
    """Take the file of a mesh relative to the recipe that names it."""
    mesh = table.get("mesh")
    if isinstance(mesh, dict) and isinstance(mesh.get("file"), str):
        mesh["file"] = str(folder / mesh["file"])
