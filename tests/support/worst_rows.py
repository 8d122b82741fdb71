"""Which rows of the tables of the verification are nearest to what their tests allow."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

Row = Sequence[str]
#: Columns of a row
TEST, QUANTITY, ERROR, ALLOWED = 0, 1, 4, 5
_SECTION = re.compile(
    r"^###? (.+?)$|^<!-- (?!end of )(\w+) -->$(.*?)^<!-- end of \2 -->$", re.M | re.S
)
_COUNT = re.compile(r"^(\d+) tests?", re.MULTILINE)


def share_used(row: Row) -> float:
    """The error of a row as a share of what its test allows on that side; 0 where all is exact."""
    error = float(row[ERROR])
    least, _, most = row[ALLOWED].removeprefix("±").partition(" to ")
    bound = float(least) if not most else float(most if error > 0.0 else least)
    return abs(error / bound) if error and bound else 0.0


def worst(rows: Sequence[Row]) -> list[Row]:
    """Of each test the row that uses most of what it allows."""
    tests = list(dict.fromkeys(row[TEST] for row in rows))
    return [max((row for row in rows if row[TEST] == test), key=share_used) for test in tests]


def rows_of(text: str) -> list[Row]:
    """The rows of the table in a text, without its heading."""
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    return [[cell.strip() for cell in line.strip("| ").split(" | ")] for line in lines[2:]]


def overview(page: str) -> Iterator[Row]:
    """A row for each problem of a page: its number of tests, and the worst of its rows."""
    heading = ""
    for found in _SECTION.finditer(page):
        if found[1]:
            heading = found[1]
            continue
        rows = rows_of(found[3])
        count = _COUNT.search(found[3])
        if rows and count:
            one = max(rows, key=share_used)
            link = re.sub(r"[^\w -]", "", heading).lower().replace(" ", "-")
            words = f"{one[TEST]}: {one[QUANTITY]}"
            yield (f"[{heading}](#{link})", count[1], words, one[ERROR], one[ALLOWED])
