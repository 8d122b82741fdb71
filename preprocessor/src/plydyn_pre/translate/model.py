"""What a translation knows of a deck while it goes on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from plydyn_pre.errors import PreError
from plydyn_pre.translate.block import IDLE, LOST, TAKEN, Block, Entry, Gathering, Value

Place = tuple[float, float, float]
#: CON1 and CON2 by what they hold
CODES = {"": 0, "x": 1, "y": 2, "z": 3, "xy": 4, "yz": 5, "xz": 6, "xyz": 7}


def triple(values: Iterable[float]) -> Place:
    """Three numbers as a place or a direction."""
    x, y, z = values
    return x, y, z


@dataclass
class Model(Gathering):
    """The keywords of a deck, and what has been found wrong or worth a note so far."""

    blocks: list[Block]
    problems: list[PreError]
    notes: list[str] = field(default_factory=list)

    def find(self, *names: str) -> Iterator[Block]:
        """Keywords of some names."""
        return (block for block in self.blocks if block.name in names)

    def first(self, *names: str) -> Block | None:
        """The first keyword of some names."""
        return next(self.find(*names), None)

    def numbered(self, key: str, names: Iterable[str]) -> dict[int, Block]:
        """Keywords by the number in a field; one that is there twice is a problem."""
        found: dict[int, Block] = {}
        for block in self.blocks:
            if block.name in names and block.has(key):
                number = int(block.raw(key))
                if number in found:
                    words = f"{number} is defined twice, in line {found[number].line} too"
                    self.problems.append(block.fail(key, words))
                found[number] = block
        return found

    @property
    def end(self) -> float:
        """The end of the run."""
        block = self.first("CONTROL_TERMINATION")
        return float(block.raw("ENDTIM", 0.0)) if block else 0.0

    def curve(self, block: Block, lcid: int, line: int = 0) -> list[tuple[float, float]]:
        """The points of a curve."""
        for each in self.find("DEFINE_CURVE"):
            if each.raw("LCID", 0) == lcid:
                if each.raw("SIDR", 0) == 1:
                    words = f"{lcid} is a curve of the dynamic relaxation alone (SIDR 1)"
                    raise block.fail("LCID", words, line)
                each.mark(TAKEN, "", "LCID", "A1", "O1", "SFA", "SFO", "OFFA", "OFFO")
                scale = [float(each.raw(name, 0.0)) or 1.0 for name in ("SFA", "SFO")]
                shift = [float(each.raw(name, 0.0)) for name in ("OFFA", "OFFO")]
                rows = [row for row in each.rows if "A1" in row.values or "O1" in row.values]
                points = [
                    (
                        scale[0] * (row.number("A1") + shift[0]),
                        scale[1] * (row.number("O1") + shift[1]),
                    )
                    for row in rows
                ]
                _check_curve(each, [row.line for row in rows], points)
                return points
        words = self.other_form("DEFINE_", lcid) or f"there is no *DEFINE_CURVE {lcid}"
        raise block.fail("LCID", words, line)

    def history(self, block: Block, lcid: int, line: int = 0) -> list[tuple[float, float]]:
        """The points of a curve over time; with a note where the run leaves it on a slope."""
        points = self.curve(block, lcid, line)
        (t0, y0), (t1, y1) = points[0], points[-1]
        outside = {f"begins at {t0:g}": t0 > 0.0 and y0 != points[1][1]}
        outside |= {f"ends at {t1:g}": t1 < self.end and y1 != points[-2][1]}
        for words, has_slope in outside.items() if not block.label else ():
            said = f"curve {lcid} {words}: its value there holds on, in LS-DYNA its slope"
            if has_slope and said not in self.notes:
                self.notes.append(said)
        return points

    def other_form(self, start: str, number: int) -> str:
        """What is said of a number that a keyword has which is not translated; nothing for none."""
        for block in self.blocks:
            if block.name.startswith(start) and block.entry.cards is None:
                firsts = [
                    row.values.get(f"card {n} field 1") for n, row in enumerate(block.rows, 1)
                ]
                if f"{number}" in firsts[:2]:
                    return f"{number} is of {block.title} (line {block.line}), not translated"
        return ""


def _check_curve(block: Block, lines: list[int], points: list[tuple[float, float]]) -> None:
    """Refuse a curve of one point, of abscissas that do not rise, or of a jump at its offset."""
    if len(points) < 2:
        raise block.fail("A1", "two points or more are needed")
    for line, before, after in zip(lines[1:], points, points[1:], strict=False):
        if after[0] <= before[0]:
            pair = f"{after[0]:g} behind {before[0] + 0.0:g}"
            words = f"{pair}: each abscissa must be above the one before"
            raise block.fail("A1", words, line)
    if block.raw("OFFA", 0.0) and points[0][0] > 0.0 and points[0][1]:
        words = "a curve that LS-DYNA begins with zero before its offset: give that in its points"
        block.lose(words, "OFFA", line=block.line_of("OFFA"))


#: Keywords that nothing need name
_NAMED = ("MAT_", "SECTION_", "SET_", "DEFINE_", "INTEGRATION_", "PART")
_REMARKS = ("NAME", "TITLE", "SOLVER", "ITS")


def settle(model: Model, whole: bool) -> None:
    """Give every field that nothing has marked its fate by the table of keywords.

    Those of known keywords are told only after a `whole` translation.
    """
    for block in model.blocks:
        entry = block.entry
        unused = block.name.startswith(_NAMED) and not block.fates
        acts = entry.fate == LOST and block.name.startswith(("PART", "MAT_ADD", "DEFINE"))
        unused = unused and not acts
        if entry.cards is None and entry.fate == LOST and not unused:
            block.lose(entry.words)
        for row in block.rows:
            for name, value in row.values.items():
                if name not in block.fates and (whole or entry.cards is None):
                    _settle(block, entry, (name, value, row.line), unused)


def _settle(block: Block, entry: Entry, what: tuple[str, Value, int], unused: bool) -> None:
    """Give a field its fate."""
    name, value, line = what
    if entry.cards is None or entry.fate == IDLE:
        block.mark(entry.fate, entry.words, name)
    elif words := entry.why_idle(name):
        block.mark(IDLE, words, name)
    elif name in _REMARKS or name.startswith("UNUSED"):
        block.mark(IDLE, "a title or a remark", name)
    elif unused:
        block.mark(IDLE, "nothing that is translated names it", name)
    elif value not in (0, 0.0) and not block.failed:
        shown = f"{value:g}" if isinstance(value, float) else value
        block.lose(f"{shown} is not translated", name, line=line)
