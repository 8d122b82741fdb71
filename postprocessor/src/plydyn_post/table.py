"""CSV files with names and units in one header line."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from plydyn_post.errors import ResultsError
from plydyn_post.units import size

if TYPE_CHECKING:
    from pandas import DataFrame

# No quantity of an impact is larger in any units; squares of larger numbers would overflow
LARGEST = 1e50
# Column of models of a half or a quarter; numbers that are read are those of the whole plate
SHARE = "share of the whole plate"
# Forces, energies, impulses and areas: those along x and y are zero for a whole plate
_EXTENSIVE = re.compile(r"(?:.*(?:[NJ]|lbf)(?:[ .].*)?|.*(?:m|in|ft)2)")
_PARTS = {1: "", 2: "whole plate, 2 x the half", 4: "whole plate, 4 x the quarter"}


@dataclass(frozen=True)
class Table:
    """Columns of numbers with names and units."""

    path: Path
    names: tuple[str, ...]
    units: tuple[str, ...]
    values: np.ndarray  # (rows, columns)
    notes: tuple[str, ...] = ()
    copies: int = 1  # of the model in the whole plate, whose numbers these are

    def __contains__(self, name: str) -> bool:
        return name in self.names

    def __getitem__(self, name: str) -> np.ndarray:
        """Numbers of a column, (rows,)."""
        return self.values[:, self._place(name)]

    def get(self, name: str) -> np.ndarray | None:
        """Numbers of a column, (rows,); nothing if there is no such column."""
        return self.values[:, self.names.index(name)] if name in self.names else None

    def unit(self, name: str) -> str:
        """Unit of a column, empty without one."""
        return self.units[self._place(name)]

    def frame(self) -> DataFrame:
        """The columns as a DataFrame of pandas, with their units in ``attrs["units"]``."""
        try:
            from pandas import DataFrame
        except ImportError as error:
            words = "tables as frames need pandas; pip install plydyn-post[frame] brings it"
            raise ResultsError(words) from error
        frame = DataFrame(dict(zip(self.names, self.values.T, strict=True)))
        frame.attrs["units"] = dict(zip(self.names, self.units, strict=True))
        return frame

    def _place(self, name: str) -> int:
        if name not in self.names:
            known = ", ".join(self.names)
            raise ResultsError(f"{self.path} has no column {name!r}; it has {known}")
        return self.names.index(name)


def write_csv(path: Path, rows: Iterable[Iterable[object]]) -> Path:
    """Write rows of cells; a folder that is missing is made."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)
    return path


def cell(value: float | None) -> str:
    """A number of a table; what is not known is left empty."""
    return "" if value is None else f"{value:.6g}"


def split_header(text: str) -> tuple[str, str]:
    """Name in small letters and unit of a header such as ``time [s]`` or ``Force (kN)``."""
    match = re.fullmatch(r"\s*(.*?)\s*(?:[\[(]\s*(.*?)\s*[\])])?\s*", text)
    name, unit = match.groups() if match else (text.strip(), "")
    return name.lower(), "" if unit in (None, "-") else unit


def read_table(path: Path, from_solver: bool = True) -> Table:
    """Read a CSV.

    The solver ends every line, so that in its files a last line without an end was cut by a kill:
    it is left out with a note. Other programs may well leave the last line open.
    """
    try:
        changed = path.stat()
        return _read_once(path, from_solver, (changed.st_mtime_ns, changed.st_size))
    except (OSError, UnicodeDecodeError) as error:
        raise ResultsError(f"{path} cannot be read: {error}") from error


@lru_cache(maxsize=32)
def _read_once(path: Path, from_solver: bool, stamp: tuple[int, int]) -> Table:
    """Read a CSV, again only when its stamp has changed."""
    text = path.read_text(encoding="utf-8-sig")
    text = text if from_solver else _without_titles(text)
    if not text.strip():
        raise ResultsError(f"{path} is empty: the run wrote nothing to it yet")
    header, _, body = text.partition("\n")
    separator = next((sign for sign in ";\t" if sign in header), ",")
    names, units = _read_header(path, header, separator)
    body, notes = _without_cut_line(path, body) if from_solver else (body, ())
    if not body.strip():
        raise ResultsError(f"{path} has a header but no rows yet")
    values = _read_numbers(path, body, separator, len(names))
    _check_numbers(path, names, values, body)
    copies = 1
    if from_solver and SHARE in names:
        copies = _copies(path, values[:, names.index(SHARE)])
        values = values * [
            copies if _EXTENSIVE.fullmatch(unit) and not name.endswith((" x", " y")) else 1
            for name, unit in zip(names, units, strict=True)
        ]
    values.setflags(write=False)
    return Table(path, names, units, values, notes, copies)


def _copies(path: Path, shares: np.ndarray) -> int:
    """How many times the model makes up the plate."""
    copies = round(1.0 / shares[0]) if shares[0] > 0.0 else 0
    if copies not in _PARTS or np.any(shares != shares[0]):
        raise ResultsError(f"{path}: the {SHARE} must be 0.5 or 0.25 in all rows")
    return copies


def whole_words(copies: int) -> str:
    """What numbers of a whole plate are marked with; empty where the model is the whole."""
    return _PARTS[copies]


def _without_titles(text: str) -> str:
    """A measurement without lines of titles, with points for decimal commas.

    The header is the last line before the numbers; names and units may be in two lines.
    """
    lines = [line for line in text.splitlines() if line.strip()]
    separator = next((sign for sign in ";\t" if any(sign in line for line in lines)), ",")
    if separator != ",":
        lines = [re.sub(r"(?<=\d),(?=\d)", ".", line) for line in lines]

    def is_row(line: str) -> bool:
        return all(_is_number(field) for field in line.rstrip(separator).split(separator))

    first = next((place for place, line in enumerate(lines) if is_row(line)), 0)
    heads, rows = lines[:first], lines[first:]
    columns = rows[0].count(separator) if rows else 0
    if len(heads) > 1 and heads[-2].count(separator) == columns and _is_units(heads[-1], separator):
        names, units = (line.split(separator) for line in heads[-2:])
        pairs = zip(names, units, strict=False)
        heads = [separator.join(f"{name} [{unit.strip('[]() ')}]" for name, unit in pairs)]
    return "\n".join([*heads[-1:], *rows]) + "\n"


def _is_units(line: str, separator: str) -> bool:
    """Whether a line holds nothing but units that are known."""
    return all(size(field.strip("[]() ")) is not None for field in line.split(separator))


def _read_header(path: Path, header: str, separator: str) -> tuple[tuple[str, ...], ...]:
    """Names and units of the columns."""
    header = header.rstrip("\r")
    if not header.replace("\t", " ").isprintable():
        raise ResultsError(f"{path}, line 1: the header is no text: {header!r}")
    labels = next(csv.reader([header], delimiter=separator), [])
    names, units = zip(*(split_header(label) for label in labels or [""]), strict=True)
    twice = [name for name in names if names.count(name) > 1]
    if not all(names) or twice:
        what = f"column {twice[0]!r} stands twice" if twice else "a column has no name"
        raise ResultsError(f"{path}, line 1: {what} in the header")
    return names, units


def _check_numbers(path: Path, names: tuple[str, ...], values: np.ndarray, body: str) -> None:
    """Refuse numbers that are none, and times that fall."""
    line = [number for number, text in enumerate(body.splitlines(), start=2) if text.strip()]
    bad = np.argwhere(~(np.abs(values) <= LARGEST))
    if len(bad):
        row, column = bad[0]
        value = values[row, column]
        raise ResultsError(f"{path}, line {line[row]}: {names[column]} is {value:g}")
    if "time" in names:
        time = values[:, names.index("time")]
        falls = np.flatnonzero(np.diff(time) < 0.0)
        if len(falls):
            row = int(falls[0])
            raise ResultsError(
                f"{path}, line {line[row + 1]}: time falls from {time[row]:g} to {time[row + 1]:g}"
            )


def _without_cut_line(path: Path, body: str) -> tuple[str, tuple[str, ...]]:
    """Leave out a last line without a line end: a kill cut it, perhaps inside a number."""
    if not body or body.endswith("\n"):
        return body, ()
    whole = body.rpartition("\n")[0]
    return whole, (f"{path.name}: the last line was cut short and is left out",)


def _is_number(field: str) -> bool:
    try:
        float(field)
    except ValueError:
        return False
    return True


def _read_numbers(path: Path, body: str, separator: str, columns: int) -> np.ndarray:
    """Numbers of all rows, (rows, columns); the first bad line is named."""
    try:
        values = np.loadtxt(io.StringIO(body), delimiter=separator, ndmin=2, comments=None)
        if values.shape[1] == columns:
            return values
    except ValueError:
        pass
    for number, line in enumerate(body.splitlines(), start=2):
        fields = line.split(separator)
        if line.strip() and len(fields) != columns:
            raise ResultsError(
                f"{path}, line {number}: {len(fields)} numbers where the header names {columns}"
            )
        for field in fields if line.strip() else ():
            if not _is_number(field):
                raise ResultsError(f"{path}, line {number}: {field.strip()!r} is not a number")
    raise ResultsError(f"{path} is not a table of numbers")
