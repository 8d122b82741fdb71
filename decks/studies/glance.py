"""The first table of the validation page as a picture: computed over measured, test by test."""

from __future__ import annotations

import re
import textwrap
from dataclasses import dataclass
from pathlib import Path

from plydyn_post.style import COLOURS, INK, WIDE, figure, finish
from runner.cases import ROOT
from runner.commands import app
from runner.jobs import console
from runner.pages import NOTHING, PICTURES

PAGE = ROOT / "manual/validation.md"
FIGURE = "validation_glance.png"
TABLE = re.compile(r"## At a glance\n\n\|.*\n\| ---.*\n((?:\|.*\n)+)")
NUMBER = re.compile(r"[+-]\d+(?:\.\d+)?(?= (?:%|to ))")
LINK = re.compile(r"\[([^]]*)\]\([^)]*\)")
#: A word of each quantity, and its mark
MARKS = {"force": "o", "displacement": "s", "duration": "^", "absorbed": "D", "area": "P"}
MARKS |= {"strength": "X"}
#: Letters in a line of the name of a test
WIDEST = 52


@dataclass(frozen=True)
class Deviation:
    """How far a quantity of a test is off: one share, or several that runs or specimens have."""

    test: str
    quantity: str
    shares: tuple[float, ...]  # computed over measured, less one

    @property
    def kind(self) -> str:
        """The word of its mark."""
        return next(word for word in MARKS if word in self.quantity)


def read_deviations(page: str) -> list[Deviation]:
    """Rows of the table with numbers that were measured; an empty first cell is the test before."""
    rows = TABLE.search(page)
    found, test = [], ""
    for row in rows[1].splitlines() if rows else ():
        cells = [LINK.sub(r"\1", cell).strip() for cell in row.split("|")[1:-1]]
        test = cells[0] or test
        quantities, parts = cells[1].split(", "), cells[2].split(", ")
        if len(quantities) != len(parts):
            quantities, parts = [cells[1]], [cells[2]]
        for quantity, part in zip(quantities, parts, strict=True):
            shares = tuple(float(one) / 100.0 for one in NUMBER.findall(part))
            if shares and not quantity.startswith(NOTHING):
                found.append(Deviation(test, quantity, shares))
    return found


@app.command()
def glance(page: Path = PAGE, into: Path = PICTURES / FIGURE) -> None:
    """Draw the first table of the validation page; in a second."""
    draw_deviations(read_deviations(page.read_text(encoding="utf-8")), into)
    console.print(str(into), markup=False, soft_wrap=True)


def draw_deviations(found: list[Deviation], path: Path) -> None:
    """A row of marks for each test, the first on top; grey up to a tenth."""
    tests = list(dict.fromkeys(one.test for one in found))
    with figure(size=(WIDE, 1.1 + 0.27 * len(tests))) as (made, axes):
        axes.axvspan(0.9, 1.1, color="#eeeeee", zorder=0)
        axes.axvline(1.0, color=INK, linewidth=0.8, zorder=1)
        for (kind, mark), colour in zip(MARKS.items(), COLOURS, strict=True):
            own = [one for one in found if one.kind == kind]
            across = [1.0 + share for one in own for share in one.shares]
            down = [tests.index(one.test) for one in own for _ in one.shares]
            axes.plot(across, down, mark, color=colour, markersize=4.5, label=kind, zorder=3)
        axes.set_yticks(range(len(tests)), [textwrap.fill(test, WIDEST) for test in tests])
        axes.set_ylim(len(tests) - 0.5, -0.5)
        axes.set_xlabel("computed over measured; grey: up to a tenth off")
        made.legend(loc="outside upper center", ncols=len(MARKS))
        finish(made, path)
