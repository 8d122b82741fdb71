"""Curves of a recipe: over time or strain, in its lists or in a file of two columns."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from plydyn_pre.errors import RecipeError, require
from plydyn_pre.suggest import suggestion
from plydyn_pre.tables import Table
from plydyn_pre.units import TIMES, unit_factor

_STRAINS = {"1": 1.0, "mm/mm": 1.0, "%": 1e-2, "permille": 1e-3, "microstrain": 1e-6}
#: In MPa
_STRESSES = {"Pa": 1e-6, "kPa": 1e-3, "MPa": 1.0, "GPa": 1e3, "psi": 6.894757e-3, "ksi": 6.894757}
#: What separates two columns, and the mark of decimals there
_COLUMNS = ((";", ","), ("\t", ","), (",", "."), (None, ","))


def with_curves(table: Table) -> Table:
    """The table of a recipe whose curves are lists `time` and `value`, in its units."""
    curves = table.get("curves")
    if not isinstance(curves, dict):
        return table
    units = table.get("units", {})
    units = units if isinstance(units, dict) else {}
    return table | {"curves": {name: _curve(name, each, units) for name, each in curves.items()}}


def _curve(name: str, curve: Any, units: Table) -> Any:  # noqa: ANN401 - any value of a recipe
    """A curve as two lists; wrong types are left to be refused."""
    path = f"curves.{name}"
    if not isinstance(curve, dict):
        return curve
    if not isinstance(curve.get("file"), str):
        renamed = {"strain": "time", "stress": "value"}
        for key, other in renamed.items():
            both = key in curve and other in curve
            require(not both, f"{path}.{key}", f"given beside {other}, which is the same list")
        return {renamed.get(key, key): each for key, each in curve.items()}
    rest = {key: each for key, each in curve.items() if key not in ("file", "strain", "stress")}
    first, second = read_columns(Path(curve["file"]), f"{path}.file")
    if "time" in rest and not {"strain", "stress"} & set(curve):
        scale = _unit(path, "time", curve, TIMES) * unit_factor((0, 1, 0), units)
        return rest | {"time": [scale * each for each in first], "value": second}
    along = _unit(path, "strain", curve, _STRAINS)
    up = _unit(path, "stress", curve, _STRESSES) * unit_factor((-1, -2, 1), units)
    lists = {"time": [along * each for each in first], "value": [up * each for each in second]}
    return rest | lists


def _unit(path: str, key: str, curve: Table, known: dict[str, float]) -> float:
    """What numbers of a column are multiplied by."""
    word = curve.get(key)
    if not isinstance(word, str) or word not in known:
        words = ", ".join(f'"{each}"' for each in known)
        given = "missing" if word is None else f"{word!r} was given"
        hint = "; or time, for a curve over time" if key == "strain" and word is None else ""
        rule = f"{given}; the unit of this column is needed, one of {words}{hint}"
        raise RecipeError(f"{path}.{key}", rule)
    return known[word]


def read_columns(path: Path, key: str) -> tuple[list[float], list[float]]:
    """Two columns of numbers, with decimal points or commas, below lines of titles."""
    try:
        lines = path.read_text(encoding="utf-8-sig", errors="replace").splitlines()
    except OSError as error:
        files = [each.name for each in path.parent.glob("*.csv")]
        hint = f"; {suggestion(path.name, files)}" if files else ""
        raise RecipeError(key, f"{path} cannot be read: {error.strerror}{hint}") from error
    rows: list[tuple[float, float]] = []
    for number, line in enumerate(lines, start=1):
        row = _row(line)
        if row is not None:
            rows.append(row)
        elif rows and line.strip():
            rule = f"{path.name}, line {number}: {line[:60]!r} is not two numbers"
            raise RecipeError(key, rule)
    require(len(rows) >= 2, key, f"{path.name} has no two lines of two numbers")
    return [row[0] for row in rows], [row[1] for row in rows]


def _row(line: str) -> tuple[float, float] | None:
    """The two numbers of a line; None where there are others."""
    for separator, decimal in _COLUMNS:
        words = [word.strip(' "').replace(decimal, ".") for word in line.strip().split(separator)]
        try:
            first, second = map(float, words)
        except ValueError:
            continue
        return first, second
    return None
