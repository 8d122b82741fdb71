"""Tables of a recipe as frozen dataclasses, checked against their type hints."""

from __future__ import annotations

from dataclasses import MISSING, Field, fields, is_dataclass
from math import isfinite
from pathlib import Path
from types import UnionType
from typing import (
    TYPE_CHECKING,
    Any,
    Literal,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

from plydyn_pre.errors import RecipeError
from plydyn_pre.suggest import suggestion

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

T = TypeVar("T", bound="DataclassInstance")

#: Sizes of numbers that a deck can hold, zero aside; whole numbers are those of four bytes
_SMALLEST, _LARGEST = 1e-100, 1e100
LARGEST_WHOLE = 2**31 - 1
_LONGEST_SHOWN = 60  # characters of a wrong value that a message repeats
_WORDS = {bool: "true or false", int: "a whole number", float: "a number", str: "text in quotes"}
_WORDS |= {dict: "a table", Path: "the name of a file in quotes"}
#: Keys that earlier versions had, by the kind of their table, and what to use in their place
REMOVED: dict[str, dict[str, str]] = {
    "ply_codam2": {
        "onset": "onset is by the stresses on what remains in the other direction",
        "brittle": "the stress of crushed fibres falls along lines, or to plateau",
        "scatter": "strengths of plies do not scatter; those of a cohesive material can",
        "fibre_scatter": "strengths of plies do not scatter; those of a cohesive material can",
        "scatter_length": "strengths of plies do not scatter; those of a cohesive material can",
        "seed": "strengths of plies do not scatter; those of a cohesive material can",
    },
}


def build(kind: type[T], table: object, path: str = "") -> T:
    """Make a dataclass from a table; `path` holds the keys that lead to it.

    A field whose name cannot be that of its key has the key in its metadata, None for no key. All
    keys that are missing are told at once, with what is usually taken for them.
    """
    if not isinstance(table, dict):
        raise RecipeError(path, f"{_shown(table)} was given, a table is needed")
    known = {field.metadata.get("key", field.name): field for field in fields(kind) if field.init}
    known.pop(None, None)
    for key in table:
        if key not in known and not (key == "kind" and hasattr(kind, "kind")):
            removed = REMOVED.get(getattr(kind, "kind", ""), {}).get(key)
            words = f"the key was removed: {removed}" if removed else "there is no such key"
            hint = "" if removed else f"; {suggestion(key, known)}"
            raise RecipeError(_join(path, key), f"{words}{hint}")
    hints = get_type_hints(kind)
    if "kind" in known and "kind" in table:  # other keys depend on it
        convert(hints["kind"], table["kind"], _join(path, "kind"))
    missing = [key for key, each in known.items() if key not in table and is_required(each)]
    if missing:
        words = _missing({key: hints[known[key].name] for key in missing})
        usual = [known[key].metadata["usual"] for key in missing if "usual" in known[key].metadata]
        words += f"; usual where nothing is measured: {', '.join(usual)}" if usual else ""
        raise RecipeError(_join(path, ", ".join(missing)), words)
    values = {
        field.name: convert(hints[field.name], table[key], _join(path, key))
        for key, field in known.items()
        if key in table
    }
    try:
        return kind(**values)
    except RecipeError as error:
        raise error.within(path) from error


def convert(hint: Any, value: object, path: str) -> Any:  # noqa: ANN401 - any type of a field
    """Make what a type hint asks for from a value of a recipe."""
    origin = get_origin(hint)
    if isinstance(hint, type) and is_dataclass(hint):
        return build(hint, value, path)
    if origin in (Union, UnionType):
        return _convert_union(get_args(hint), value, path)
    if origin is Literal:
        return _convert_word(get_args(hint), value, path)
    if origin is tuple:
        return _convert_list(get_args(hint), value, path)
    if origin is dict:
        return _convert_table(get_args(hint)[1], _expected(dict, value, path), path)
    return hint(_expected(hint, value, path))


def _convert_table(hint: Any, table: dict[str, Any], path: str) -> dict[str, Any]:  # noqa: ANN401
    """The members of a table; what is wrong with several is told at once."""
    members: dict[str, Any] = {}
    errors: list[RecipeError] = []
    for key, each in table.items():
        try:
            members[key] = convert(hint, each, _join(path, key))
        except RecipeError as error:
            errors.append(error)
    if errors:
        first, *others = errors
        raise RecipeError(first.path, "\n".join([first.message, *map(str, others)]))
    return members


def _convert_union(choices: tuple[Any, ...], value: object, path: str) -> object:
    """A table of one of some kinds, or a value of one of some types."""
    choices = tuple(choice for choice in choices if choice is not type(None))
    if all(is_dataclass(choice) for choice in choices) and len(choices) > 1:
        return build(_kind_of(choices, value, path), value, path)
    tables = [choice for choice in choices if get_origin(choice) is dict]
    others = [choice for choice in choices if choice not in tables]
    others.sort(key=lambda choice: not _is_like(choice, value))
    return convert((tables if isinstance(value, dict) and tables else others)[0], value, path)


def _is_like(hint: Any, value: object) -> bool:  # noqa: ANN401
    """Whether a type is a list where one is given, a word where one is given, or a number."""
    origin: Any = get_origin(hint)
    is_list, is_word = origin is tuple, origin is Literal
    return is_list == isinstance(value, list) and is_word == isinstance(value, str)


def _kind_of(choices: tuple[Any, ...], value: object, path: str) -> Any:  # noqa: ANN401
    """The dataclass that the key `kind` of a table names."""
    kinds = {choice.kind: choice for choice in choices}
    if not isinstance(value, dict):
        raise RecipeError(path, f"{_shown(value)} was given, a table is needed")
    place, words = _join(path, "kind"), ", ".join(f'"{kind}"' for kind in kinds)
    if "kind" not in value:
        raise RecipeError(place, f"missing; one of {words} is needed")
    if not isinstance(value["kind"], str) or value["kind"] not in kinds:
        raise RecipeError(place, f"{_shown(value['kind'])} was given, one of {words} is needed")
    return kinds[value["kind"]]


def _convert_word(words: tuple[Any, ...], value: object, path: str) -> object:
    """One of some words."""
    if value not in words or isinstance(value, bool):
        known = ", ".join(f'"{word}"' if isinstance(word, str) else str(word) for word in words)
        raise RecipeError(path, f"{_shown(value)} was given, one of {known} is needed")
    return words[words.index(value)]


def _convert_list(hints: tuple[Any, ...], value: object, path: str) -> tuple[Any, ...]:
    """A list of given length, or of any."""
    if not isinstance(value, list):
        raise RecipeError(path, f"{_shown(value)} was given, a list in [ ] is needed")
    if hints[-1] is Ellipsis:
        hints = (hints[0],) * len(value)
    if len(value) != len(hints):
        raise RecipeError(path, f"{len(value)} values were given, {len(hints)} are needed")
    pairs = enumerate(zip(hints, value, strict=True), start=1)
    return tuple(convert(hint, each, f"{path}[{number}]") for number, (hint, each) in pairs)


def _expected(kind: type, value: object, path: str) -> Any:  # noqa: ANN401 - a value of the type
    """A value of a type, or an error; a whole number is a number, true is not."""
    accepted: tuple[type, ...] = {float: (int, float), Path: (str, Path)}.get(kind, (kind,))
    fits = isinstance(value, accepted) and (kind is bool or not isinstance(value, bool))
    if not fits:
        raise RecipeError(path, f"{_shown(value)} was given, {_WORDS[kind]} is needed")
    if isinstance(value, float) and not isfinite(value):
        raise RecipeError(path, f"{value} was given, a finite number is needed")
    if isinstance(value, int | float):
        _expect_size(kind, value, path)
    return value


def _expect_size(kind: type, value: float, path: str) -> None:
    """Refuse a number that a deck cannot hold."""
    if kind is int and abs(value) > LARGEST_WHOLE:
        rule = f"a whole number of at most {LARGEST_WHOLE:,} in size is needed"
        raise RecipeError(path, f"{_shown(value)} was given, {rule}")
    if value != 0 and not _SMALLEST <= abs(value) <= _LARGEST:
        rule = f"a number from {_SMALLEST:g} to {_LARGEST:g} in size, or 0, is needed"
        raise RecipeError(path, f"{_shown(value)} was given, {rule}")


def is_required(field: Field[Any]) -> bool:
    """Whether a field has no default."""
    return field.default is MISSING and field.default_factory is MISSING


def _missing(hints: dict[str, Any]) -> str:
    """What missing keys must hold, in words."""
    needs = [_needed(hint) for hint in hints.values()]
    if len(set(needs)) == 1:
        return f"missing; {needs[0]} is needed{' for each' if len(needs) > 1 else ''}"
    return f"missing; {', '.join(needs)} are needed"


def _needed(hint: Any) -> str:  # noqa: ANN401
    """What a missing key must hold, in words."""
    origin = get_origin(hint)
    if origin is Literal:
        return "one of " + ", ".join(f'"{word}"' for word in get_args(hint))
    if origin is tuple:
        count = len(get_args(hint))
        return "a list in [ ]" if Ellipsis in get_args(hint) else f"a list of {count} values"
    if origin in (Union, UnionType):
        return _needed(get_args(hint)[0])
    return _WORDS.get(origin or hint, "a table")


def _shown(value: object) -> str:
    """A value as it looks in a recipe."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int) and abs(value) > _LARGEST:
        return "a huge number"
    text = "a table" if isinstance(value, dict) else repr(value)
    text = "a list" if isinstance(value, list) else text
    return text if len(text) <= _LONGEST_SHOWN else f"{text[:_LONGEST_SHOWN]}..."


def _join(path: str, key: str) -> str:
    """A key behind those that lead to it."""
    return f"{path}.{key}" if path else key
