"""Routines stay short and take few arguments."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

SOURCES = Path(__file__).parents[2] / "src"
#: Lines of a routine without blank ones and comments; arguments with the object itself
MOST_LINES, MOST_ARGUMENTS = 60, 8
#: Templates of kernels, whose loops are long for the compiler
LONG = ("element/kernel/",)

HEAD = re.compile(r"(?!end\b)(?:[\w()=*,: ]+ )?(?:subroutine|function) (\w+) *(?:\(([^)]*)\))?")
END = re.compile(r"end (subroutine|function|program)\b")


@dataclass
class Routine:
    """A routine, without those that it contains."""

    name: str
    arguments: int
    lines: int = 0


def statements(source: str) -> Iterator[tuple[str, int]]:
    """Statements with their continuations joined, and how many lines each takes."""
    joined, count = "", 0
    for raw in source.splitlines():
        line = raw.strip()
        if not line or line.startswith("!"):
            continue
        count += 1
        joined += line.lstrip("&").strip()
        if joined.endswith("&"):
            joined = joined[:-1]
            continue
        yield joined, count
        joined, count = "", 0


def routines(source: str) -> Iterator[Routine]:
    """All routines of a source, inner ones and those of interfaces among them."""
    under_way: list[Routine] = []
    for statement, lines in statements(source):
        head = HEAD.match(statement)
        if head:
            arguments = [name for name in (head[2] or "").split(",") if name.strip()]
            if "bind(" in statement:  # a library has its own
                arguments = []
            under_way.append(Routine(head[1], len(arguments)))
        if under_way:
            under_way[-1].lines += lines
            if END.match(statement):
                yield under_way.pop()


def test_routines_are_short_and_take_few_arguments() -> None:
    wrong, count = [], 0
    for path in sorted([*SOURCES.rglob("*.f90"), *SOURCES.rglob("*.f90.in")]):
        where = path.relative_to(SOURCES)
        for routine in routines(path.read_text()):
            count += 1
            if routine.lines > MOST_LINES and not str(where).startswith(LONG):
                wrong.append(f"{where}: {routine.name} has {routine.lines} lines")
            if routine.arguments > MOST_ARGUMENTS:
                wrong.append(f"{where}: {routine.name} has {routine.arguments} arguments")
    assert count > 1000
    assert not wrong, "\n".join(wrong)


def test_an_inner_routine_counts_for_itself() -> None:
    source = """
   pure real(wp) function outer(a, b) result(c)
      ! a comment
      c = a &
         & + b
   contains
      subroutine inner()
      end subroutine inner
   end function outer
"""
    found = {routine.name: routine for routine in routines(source)}
    assert found["outer"] == Routine("outer", 2, 5)
    assert found["inner"] == Routine("inner", 0, 2)
