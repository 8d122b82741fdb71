"""A study as the text of a recipe."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import MISSING, Field, fields, is_dataclass
from typing import Any

from plydyn_pre.study import Study


def recipe_lines(study: Study) -> Iterator[str]:
    """The lines of its recipe; what is as without it is left out."""
    yield f"title = {_value(study.title)}"
    for field in fields(study):
        value = getattr(study, field.name)
        if field.name == "title" or not value or _is_default(field, value):
            continue
        if is_dataclass(value):
            yield from ("", f"[{field.name}]", *_keys(value))
        elif isinstance(value, dict):
            for name, each in value.items():
                yield from ("", f"[{field.name}.{_name(name)}]", *_keys(each))
        else:
            for each in value:
                yield from ("", f"[[{field.name}]]", *_keys(each))


def _keys(part: Any) -> Iterator[str]:  # noqa: ANN401
    """The keys of a part of a study."""
    if isinstance(getattr(type(part), "kind", None), str) and "kind" not in _named(part):
        yield f"kind = {_value(part.kind)}"
    for field in fields(part):
        value = getattr(part, field.name)
        if field.init and value is not None and not _is_default(field, value):
            yield f"{field.name} = {_value(value)}"


def _named(part: Any) -> set[str]:  # noqa: ANN401
    """Names of the fields of a part."""
    return {field.name for field in fields(part)}


def _is_default(field: Field[Any], value: object) -> bool:
    """Whether a field is as without its key."""
    if field.default_factory is not MISSING:
        return bool(value == field.default_factory())
    return bool(value == field.default)


def _value(value: object) -> str:
    """A value as TOML has it."""
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{_name(key)} = {_value(each)}' for key, each in value.items())} }}"
    if isinstance(value, tuple):
        return f"[{', '.join(map(_value, value))}]"
    return json.dumps(value, ensure_ascii=False)


def _name(word: str) -> str:
    """A key, in quotes where it needs them."""
    return word if word.replace("_", "").replace("-", "").isalnum() else json.dumps(word)
