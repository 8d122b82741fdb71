"""Whether the results in two folders have the same bits, whatever their data are called."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import known_names
from hdf5_differences import compare_hdf5, same_sums
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
    """Compare two histories: moved columns by their headers, the others in their order."""
    first, second = _read(old), _read(new)
    names = _new_heads(first, second, old.name)
    dropped, added = known_names.DROPPED_COLUMNS, known_names.ADDED_COLUMNS
    mine = _kept(first, second.heads, dropped, old.name, report)
    others = _kept(second, names, added, old.name, report)
    if len(mine) != len(others):
        _report_columns(old.name, first.heads, second.heads, report)
        return
    moved = {i: second.heads.index(names[i]) for i in mine if names[i] != first.heads[i]}
    rest = iter([j for j in others if j not in moved.values()])
    others = [moved[i] if i in moved else next(rest) for i in mine]
    for i, j in zip(mine, others, strict=True):
        if first.heads[i] != second.heads[j]:
            report.note(f"{old.name}: column {first.heads[i]!r} is called {second.heads[j]!r}")
    if len(first.rows) != len(second.rows):
        report.differ(old.name, "rows", "", len(first.rows), len(second.rows))
    report.numbers += len(mine) * len(first.rows)
    if first.rows != second.rows or mine != others:
        heads = [first.heads[i] for i in mine]
        words = first.words(mine), second.words(others)
        _take_shifted(old.name, heads, *words, report)
        _compare_words(old.name, heads, *words, report)


def _new_heads(old: _Table, new: _Table, file: str) -> list[str]:
    """Headers of the columns of a table in the new build: another one only where it is new."""
    heads = []
    for head in old.heads:
        other = renamed(known_names.RENAMED_COLUMNS, f"{file}: {head}").partition(": ")[2]
        heads.append(other if other in new.heads and other not in old.heads else head)
    return heads


def _kept(
    table: _Table, others: list[str], known: dict[str, str], file: str, report: Report
) -> list[int]:
    """Columns that both builds write: those that are not known to be dropped or new."""
    kept = []
    for i, head in enumerate(table.heads):
        why = reason(known, f"{file}: {head}")
        if why and head not in others:
            report.note(f"{file}: column {head!r} is in one build alone: {why}")
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


def _take_shifted(
    name: str, heads: list[str], old: list[list[str]], new: list[list[str]], report: Report
) -> None:
    """Take two columns for the same where their sum is, as the table says."""
    for key, (one, other, why) in known_names.SHIFTED_COLUMNS.items():
        places = [i for i, head in enumerate(heads) if head.split(" [")[0] in (one, other)]
        if not re.fullmatch(key, name) or len(places) != 2 or len(old) != len(new):
            continue
        pairs = [[[float(row[i]) for i in places] for row in rows] for rows in (old, new)]
        if pairs[0] != pairs[1] and same_sums(*pairs):
            report.note(f"{name}: {one} and {other} have the same sum: {why}")
            for mine, theirs in zip(old, new, strict=True):
                for i in places:
                    theirs[i] = mine[i]


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
