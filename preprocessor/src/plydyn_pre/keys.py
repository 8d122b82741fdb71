"""Keys of recipes: every table and key with type, default and sentence, from the dataclasses.

The sentence of a key is the comment at its field, on its line or on the lines above; one holds for
the fields of the same type that follow without one. So what the code says of a field is what the
page, the command and the schema say of the key.
"""

from __future__ import annotations

import inspect
import io
import re
import tokenize
from collections.abc import Iterator
from dataclasses import MISSING, Field, dataclass, fields, is_dataclass
from pathlib import Path
from types import NoneType, UnionType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from plydyn_pre.errors import PreError
from plydyn_pre.study import Material, Study
from plydyn_pre.suggest import suggestion

_FIELD = re.compile(r" {4}(\w+): ([^=]+)")
_TYPES = {float: "number", int: "whole number", str: "text", bool: "true or false", Path: "file"}
_SCHEMA = {float: "number", int: "integer", str: "string", bool: "boolean", Path: "string"}


#: Keys of the same meaning in many tables
_USUAL = {
    "title": "words for the listing",
    "face": "of the plate; all of them, and plane the middle one, for what acts on nodes",
    "direction": "axis along which it acts",
    "quantity": "what the curve prescribes",
    "centre": "x, y; the middle of the mesh if absent",
}


#: Keys that are gone when a study is made: of a recipe, and of materials
_ON_TOP = {
    "base": (
        str,
        "recipe below this one: tables are merged, values and lists replaced; a table of it that is"
        " false here is left out",
    )
}
_OF_MATERIALS = {
    "like": (str, "card of the library that gives the keys which this table has not"),
    "model": (str, "set of values for keys that neither this table nor `like` gives"),
}


@dataclass(frozen=True)
class Key:
    """A key of a table."""

    name: str
    kind: Any  # its type hint
    default: object  # MISSING for a key that is needed
    words: str  # its sentence


@dataclass(frozen=True)
class KeyTable:
    """A table of recipes, or one of its kinds."""

    path: str  # such as materials.NAME or fixtures[]
    kind: str  # the value of its key `kind`, empty without one
    words: str
    keys: tuple[Key, ...]

    @property
    def name(self) -> str:
        """The path with the kind, as a heading."""
        return f'{self.path} (kind = "{self.kind}")' if self.kind else self.path


def tables() -> list[KeyTable]:
    """All tables in the order of the study, those inside of others behind them; each once."""
    return list(_tables_of(Study, "", set()))


def find_tables(name: str) -> list[KeyTable]:
    """The tables of a path or a kind, such as "control" or "ply_codam2"."""
    known = tables()
    found = [each for each in known if name in (each.path, each.path.rstrip("[]"), each.kind)]
    if not found:
        names = {each.path for each in known} | {each.kind for each in known if each.kind}
        raise PreError(f"recipes have no table {name!r}; {suggestion(name, sorted(names))}")
    return found


def key_lines(found: list[KeyTable]) -> Iterator[str]:
    """Tables as Markdown."""
    for table in found:
        yield f"## {table.name or 'top of a recipe'}"
        yield ""
        yield table.words
        yield ""
        yield "| key | value | default | meaning |"
        yield "| --- | --- | --- | --- |"
        for key in table.keys:
            words = key.words.replace("|", "\\|")
            kind = _type_words(key.kind).replace("|", "\\|")
            yield f"| `{key.name}` | {kind} | {_default(key.default)} | {words} |"
        yield ""


def schema() -> dict[str, Any]:
    """A JSON Schema of recipes, for editors that complete and check TOML."""
    words = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "recipe"}
    return words | _schema_of_table(Study)


def _tables_of(kind: Any, path: str, told: set[Any]) -> Iterator[KeyTable]:  # noqa: ANN401
    """The table of a dataclass, and those of its fields that have not been told."""
    told.add(kind)
    found = tuple(_keys_of(kind))
    yield KeyTable(path, getattr(kind, "kind", ""), _summary_of(kind), found)
    for key in found:
        for inner, end in _dataclasses_in(key.kind):
            if inner not in told:
                yield from _tables_of(inner, f"{path}.{key.name}{end}".lstrip("."), told)


def _dataclasses_in(hint: Any, end: str = "") -> Iterator[tuple[Any, str]]:  # noqa: ANN401
    """The dataclasses that a type hint allows, and what is behind the key in their paths."""
    origin, inner = get_origin(hint), get_args(hint)
    if is_dataclass(hint):
        yield hint, end
    elif origin in (Union, UnionType):
        for each in inner:
            yield from _dataclasses_in(each, end)
    elif origin is tuple:
        yield from _dataclasses_in(inner[0], f"{end}[]")
    elif origin is dict:
        yield from _dataclasses_in(inner[1], f"{end}.NAME")


def _keys_of(kind: Any) -> Iterator[Key]:  # noqa: ANN401
    """The keys of a table in the order of its fields."""
    hints = get_type_hints(kind)
    words: dict[str, str] = {}
    for each in reversed(kind.__mro__[:-1]):
        if is_dataclass(each):
            words |= _sentences(each)
    added = _ON_TOP if kind is Study else _OF_MATERIALS if kind in get_args(Material) else {}
    for name, (hint, said) in added.items():
        yield Key(name, hint, "", said)
    for field in fields(kind):
        key = field.metadata.get("key", field.name)
        if field.init and key is not None:
            hint = hints[field.name]
            said = words.get(field.name) or _USUAL.get(key) or _summary(hint)
            yield Key(key, hint, _default_of(field), said)


def _summary(hint: Any) -> str:  # noqa: ANN401
    """What tables of a field are, of a field that has some of one kind; nothing of others."""
    inside = list(_dataclasses_in(hint))
    return (
        _summary_of(inside[0][0]) if len(inside) == 1 else "tables of several kinds" * bool(inside)
    )


def _summary_of(kind: type) -> str:
    """The first line on a dataclass."""
    return (inspect.getdoc(kind) or "").partition("\n")[0]


def _default_of(field: Field[Any]) -> object:
    """The default of a field, MISSING without one."""
    if field.default_factory is not MISSING:
        return field.default_factory()
    return field.default


def _sentences(kind: Any) -> dict[str, str]:  # noqa: ANN401
    """The comment at each field of a class."""
    found: dict[str, str] = {}
    above: list[str] = []
    group = ("", "")  # type and sentence that hold for fields without a comment of their own
    source = inspect.getsource(kind)
    comments = _comments(source)
    for number, line in enumerate(source.splitlines(), start=1):
        words = comments.get(number, "")
        field = _FIELD.match(line.partition("#")[0])
        if field:
            own = " ".join([*above, words]).strip()
            hint = field[2].strip()
            group = (hint, own) if own else group if hint == group[0] else ("", "")
            found[field[1]] = group[1]
        elif not (words and line.lstrip().startswith("#")):
            group = ("", "")
        above = [*above, words] if words and not field else []
    return found


def _comments(source: str) -> dict[int, str]:
    """The comment of each line."""
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    return {
        token.start[0]: token.string.lstrip("#:").strip()
        for token in tokens
        if token.type == tokenize.COMMENT and "noqa" not in token.string
    }


def _type_words(hint: Any) -> str:  # noqa: ANN401
    """A type hint in words."""
    origin, inner = get_origin(hint), get_args(hint)
    if origin in (Union, UnionType):
        return " or ".join(
            dict.fromkeys(_type_words(each) for each in inner if each is not NoneType)
        )
    if origin is Literal:
        return ", ".join(f'`"{each}"`' if isinstance(each, str) else f"`{each}`" for each in inner)
    if origin is tuple and inner[-1] is Ellipsis:
        return f"list of {_type_words(inner[0])}"
    if origin is tuple:
        return f"[{', '.join(_type_words(each) for each in inner)}]"
    if origin is dict:
        return f"tables by name: {_type_words(inner[1])}"
    if is_dataclass(hint):
        return "table"
    return _TYPES[hint]


def _default(value: object) -> str:
    """A default as a recipe has it."""
    if value is MISSING:
        return "needed"
    if value is None or value in ((), {}, "") or is_dataclass(value):
        return ""
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    if isinstance(value, str):
        return f'`"{value}"`'
    return f"`{list(value) if isinstance(value, tuple) else value}`"


def _schema_of(hint: Any) -> dict[str, Any]:  # noqa: ANN401
    """The schema of a value."""
    origin, inner = get_origin(hint), get_args(hint)
    if origin in (Union, UnionType):
        found = [_schema_of(each) for each in inner if each is not NoneType]
        return found[0] if len(found) == 1 else {"anyOf": found}
    if origin is Literal:
        return {"enum": list(inner)}
    if origin is tuple and inner[-1] is Ellipsis:
        return {"type": "array", "items": _schema_of(inner[0])}
    if origin is tuple:
        count = len(inner)
        items = [_schema_of(each) for each in inner]
        return {"type": "array", "prefixItems": items, "minItems": count, "maxItems": count}
    if origin is dict:
        return {"type": "object", "additionalProperties": _schema_of(inner[1])}
    if is_dataclass(hint):
        return _schema_of_table(hint)
    return {"type": _SCHEMA[hint]}


def _schema_of_table(kind: Any) -> dict[str, Any]:  # noqa: ANN401
    """The schema of a table; none of its keys is required: a base or the library may have it."""
    properties: dict[str, Any] = {}
    for key in _keys_of(kind):
        plain = isinstance(key.default, bool | int | float | str)
        default = {"default": key.default} if plain and key.default != "" else {}
        one = _schema_of(key.kind)
        if kind is Study and key.default is not MISSING and one.get("type") in ("object", "array"):
            one |= {"type": [one["type"], "boolean"], "not": {"const": True}}
        properties[key.name] = one | {"description": key.words} | default
    if getattr(kind, "kind", "") and "kind" not in properties:
        properties["kind"] = {"const": kind.kind}
    return {"type": "object", "additionalProperties": False, "properties": properties}
