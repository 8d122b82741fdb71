"""Tables on top of each other."""

from __future__ import annotations

from collections.abc import Container, Mapping
from typing import Any

Table = dict[str, Any]


def merged(below: Mapping[str, Any], above: Mapping[str, Any]) -> Table:
    """One table on top of another: tables are merged, lists and values are replaced.

    A table that names another `kind` replaces the one below as a whole.
    """
    result = dict(below)
    for key, value in above.items():
        under = result.get(key)
        if isinstance(value, dict) and isinstance(under, dict) and not _differ(value, under):
            result[key] = merged(under, value)
        else:
            result[key] = value
    return result


def without_false(table: Mapping[str, Any], optional: Container[str]) -> Table:
    """A table without those of its optional keys that are false: so a base loses a table."""
    return {key: value for key, value in table.items() if value is not False or key not in optional}


def _differ(above: Mapping[str, Any], below: Mapping[str, Any]) -> bool:
    """Whether two tables are of different kinds."""
    return "kind" in above and above["kind"] != below.get("kind")
