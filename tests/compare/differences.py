"""Whether the results in two folders have the same bits, whatever their data are called."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import known_names
from hdf5_differences import compare_hdf5
from known_names import reason, renamed
from report import Report

#: Words and copies of the deck: nothing that a run computes
WORDS = (".out", ".k", ".screen")
_RESTART = re.compile(r"\.(dump|runrsf)\d*$")


def compare_folders(old: Path, new: Path, case: str = "") -> Report:
    """Compare the histories, fields and restart files of a job."""
    report = Report(case)
    olds, news = _results(old), _results(new)
    if not olds:
        report.differ(old.name, "", "", "no results", f"{len(news)} files")
    for name in sorted(olds):
        other = renamed(known_names.RENAMED_FILES, name)
        if other != name:
            report.note(f"{name} is called {other}")
        if other in news:
            news.discard(other)
            _compare_files(old / name, new / other, report)
        elif why := reason(known_names.DROPPED_FILES, name):
            report.note(f"{name} is written no longer: {why}")
        else:
            report.differ(name, "", "", "a file", "no file")
    for name in sorted(news):
        if why := reason(known_names.ADDED_FILES, name):
            report.note(f"{name} is new: {why}")
        else:
            report.differ(name, "", "", "no file", "a file")
    return report


def _results(folder: Path) -> set[str]:
    """Names of the files that hold numbers."""
    return {path.name for path in folder.iterdir() if path.is_file() and path.suffix not in WORDS}


def _compare_files(old: Path, new: Path, report: Report) -> None:
    """Compare two files as what they are."""
    if old.suffix == ".csv":
        compare_tables(old, new, report)
    elif old.suffix == ".vtkhdf" or _RESTART.search(old.name):
        compare_hdf5(old, new, report)
    elif old.read_bytes() != new.read_bytes():
        report.differ(old.name, "bytes", "", "", "others")
    report.files += 1


@dataclass(frozen=True)
class _Table:
    """A history: headers, and rows of words."""

    heads: list[str]
    rows: list[bytes] = field(repr=False)

    def words(self, kept: list[int]) -> list[list[str]]:
        """Rows of some of the columns."""
        every = [row.decode().split(",") for row in self.rows]
        return [[row[i].strip() if i < len(row) else "" for i in kept] for row in every]


def _read(path: Path) -> _Table:
    """The table of a CSV file."""
    lines = path.read_bytes().splitlines()
    heads = lines[0].decode().split(",") if lines else []
    return _Table([head.strip() for head in heads], lines[1:])


def compare_tables(old: Path, new: Path, report: Report) -> None:
    """Compare two histories, column by column in their order."""
    first, second = _read(old), _read(new)
    mine = _kept(first, old, known_names.DROPPED_COLUMNS, "is written no longer", report)
    others = _kept(second, new, known_names.ADDED_COLUMNS, "is new", report)
    if len(mine) != len(others):
        _report_columns(old.name, first.heads, second.heads, report)
        return
    others = _in_order(first, mine, second, others, old.name)
    for i, j in zip(mine, others, strict=True):
        if first.heads[i] != second.heads[j]:
            report.note(f"{old.name}: column {first.heads[i]!r} is called {second.heads[j]!r}")
    if len(first.rows) != len(second.rows):
        report.differ(old.name, "rows", "", len(first.rows), len(second.rows))
    report.numbers += len(mine) * len(first.rows)
    if first.rows != second.rows or len(first.heads) != len(second.heads):
        heads = [first.heads[i] for i in mine]
        _compare_words(old.name, heads, first.words(mine), second.words(others), report)


def _in_order(old: _Table, mine: list[int], new: _Table, others: list[int], file: str) -> list[int]:
    """Columns of the new table in the order of the old: moved ones by header, others by place."""
    moved = {}
    for i in mine:
        head = renamed(known_names.RENAMED_COLUMNS, f"{file}: {old.heads[i]}").partition(": ")[2]
        if head != old.heads[i] and head in new.heads:
            moved[i] = new.heads.index(head)
    rest = iter([j for j in others if j not in moved.values()])
    return [moved[i] if i in moved else next(rest) for i in mine]


def _kept(
    table: _Table, path: Path, known: dict[str, str], words: str, report: Report
) -> list[int]:
    """Columns that both builds write."""
    kept = []
    for i, head in enumerate(table.heads):
        if why := reason(known, f"{path.name}: {head}"):
            report.note(f"{path.name}: column {head!r} {words}: {why}")
        else:
            kept.append(i)
    return kept


def _report_columns(name: str, old: list[str], new: list[str], report: Report) -> None:
    """Headers that only one of two histories has."""
    gone = [head for head in old if head not in new]
    fresh = [head for head in new if head not in old]
    report.differ(name, "columns", "", f"{len(old)}, alone {gone}", f"{len(new)}, alone {fresh}")


def _compare_words(
    name: str, heads: list[str], old: list[list[str]], new: list[list[str]], report: Report
) -> None:
    """The first number of each column that differs."""
    for column, head in enumerate(heads):
        most = _round_off(f"{report.case} {name}: {head}", report)
        for row, (mine, other) in enumerate(zip(old, new, strict=False)):
            if not _same_number(mine[column], other[column], most):
                place = f"row {row + 1} ({heads[0]} {mine[0]})"
                report.differ(name, head, place, mine[column], other[column])
                break


def _round_off(name: str, report: Report) -> float:
    """Largest difference of the numbers of a column, `case file: header`."""
    for key, (most, why) in known_names.ROUNDED_COLUMNS.items():
        if re.fullmatch(key, name):
            report.note(f"{name} may differ by {most:g}: {why}")
            return most
    return 0.0


def _same_number(one: str, other: str, most: float) -> bool:
    """Whether two words are the same number, however written, or differ by `most` above 0."""
    if one == other:
        return True
    try:
        first, second = float(one), float(other)
    except ValueError:
        return False
    return first.hex() == second.hex() or 0.0 < abs(first - second) <= most
