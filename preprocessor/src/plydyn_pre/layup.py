"""Stacking sequences: from the notation of a drawing to plies.

``[45/0/-45/90]s``, ``[0/90]2s``, ``[0/90]_{2s}``, ``[±45/0]s``, ``[0_2/90_2]s``,
``[(45/-45)2/0~]s``, ``[M1/M2]4s``, ``[Al/glass:90/Al]``. The first ply of the notation is the
bottom one. A group is first repeated, then mirrored; ``~`` marks the ply on the mid-plane, which
the mirror does not repeat. Other spellings (``notation_text``) are made into these first.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import NoReturn

from plydyn_pre.errors import LayupError
from plydyn_pre.notation_text import plain_notation

#: Behind the name of a material that joins plies of other directions or materials only
BETWEEN_UNLIKE = " between unlike plies"

_SIGN = r"(?P<sign>±|\+-|∓|-\+|[-+−]|)"
_ANGLE = re.compile(_SIGN + r"(?P<size>\d+(?:\.\d*)?|\.\d+)")
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9.-]*")
_PLY_REPEAT = re.compile(r"_(?:\{(\d+)\}|(\d+))")
_MODE = "(?:as|s|t)"
_TAIL = re.compile(
    rf"_\{{(\d+{_MODE}?|{_MODE})\}}({_MODE}?)(?![a-z])|_?(\d+{_MODE}?|{_MODE})(?![a-z])|",
    re.IGNORECASE,
)
#: What a mark that is not expected is likely to mean
_HINTS = {"x": "0_2 stands for two plies of 0", "_": "half a ply on the mid-plane is 0~"}
_HINTS |= dict.fromkeys("X×*^", _HINTS["x"])
_FABRIC = re.compile(r"#|[fw](?![a-z])", re.IGNORECASE)
#: An angle that is above all others because the subscript behind it was lost
_LOST_SUBSCRIPT = re.compile(r"(0|1[0-7]?\d|[1-9]\d)([1-9]\d?)")
_SIGNS: dict[str, tuple[int, ...]] = {"": (1,), "+": (1,), "-": (-1,), "−": (-1,)}
_SIGNS |= {"±": (1, -1), "+-": (1, -1), "∓": (-1, 1), "-+": (-1, 1)}
_LARGEST_ANGLE = 180.0
_MOST_PLIES = 10_000
_DEEPEST = 20  # groups within groups


@dataclass(frozen=True)
class Ply:
    """One ply of a notation."""

    angle: float  # degrees, from the x axis
    material: str | None = None  # None where the notation names none


def parse(notation: str) -> tuple[Ply, ...]:
    """Read a stacking sequence; plies from the bottom up."""
    notation = plain_notation(notation)
    reader = _Reader(notation)
    reader.expect("[", "a stacking sequence starts with [, as in [0/90]2s")
    plies = reader.whole(reader.sequence("]"))
    if reader.take(re.compile(r"[\s,]*$")) is None:
        reader.fail("only a repeat and an s can follow the ], as in ]2s")
    return tuple(plies)


class _Reader:
    """A notation, and how far it has been read."""

    def __init__(self, notation: str) -> None:
        self.notation = notation
        self.at = 0
        self.middle: int | None = None  # where the ~ is
        self.depth = 0  # groups around the present place

    def fail(self, message: str, at: int | None = None) -> NoReturn:
        """Raise an error at a place, the present one unless told."""
        raise LayupError(self.notation, (self.at if at is None else at) + 1, message)

    def take(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        """Read what fits a pattern, behind any blanks."""
        while self.notation[self.at : self.at + 1].isspace():
            self.at += 1
        match = pattern.match(self.notation, self.at)
        if match is not None:
            self.at = match.end()
        return match

    def sees(self, mark: str) -> bool:
        """Read a mark if it comes next."""
        return self.take(re.compile(re.escape(mark))) is not None

    def expect(self, mark: str, otherwise: str) -> None:
        """Read a mark that must come next."""
        if not self.sees(mark):
            self.fail(otherwise)

    def sequence(self, end: str) -> list[Ply]:
        """Read plies and groups up to a closing bracket."""
        opening = self.at - 1
        plies = self.item()
        while not self.sees(end):
            if self.at >= len(self.notation):
                self.fail(f"the bracket opened here is not closed by {end}", opening)
            hint = _HINTS.get(self.notation[self.at], "")
            self.expect("/", f"a / or a {end} was expected here{hint and f'; {hint}'}")
            if self.middle is not None:
                self.fail("~ marks the ply on the mid-plane: it must be the last", self.middle)
            plies += self.item()
            if len(plies) > _MOST_PLIES:
                self.fail(f"more than {_MOST_PLIES} plies")
        if end == ")" and self.middle is not None:
            self.fail("~ marks the ply on the mid-plane: it cannot be in a group", self.middle)
        return plies

    def item(self) -> list[Ply]:
        """Read a ply, or a group in parentheses, with its repeat."""
        if self.sees("("):
            self.depth += 1
            if self.depth > _DEEPEST:
                self.fail(f"more than {_DEEPEST} groups within groups", self.at - 1)
            plies = self.sequence(")")
            self.depth -= 1
            self.refuse_fabric()
            return self.whole(plies)
        self.refuse_fabric()
        plies = self.ply()
        self.refuse_fabric()
        plies = self.repeated(plies, _PLY_REPEAT)
        if self.sees("~"):
            self.middle = self.at - 1
            if len(plies) > 1:
                self.fail("~ marks a single ply; write the others before it", self.middle)
        return plies

    def repeated(self, plies: list[Ply], pattern: re.Pattern[str]) -> list[Ply]:
        """Plies as often as what follows them says."""
        count = self.repeat(pattern)
        return self.times(plies, count, count, self.at - 1)

    def repeat(self, pattern: re.Pattern[str]) -> int:
        """Read how often something is repeated."""
        match = self.take(pattern)
        if match is None:
            return 1
        return self.number(next(group for group in match.groups() if group), match.start())

    def number(self, text: str, start: int) -> int:
        """A repeat as a number."""
        count = int(text[:9])
        if not 1 <= count <= _MOST_PLIES:
            self.fail(f"a repeat is a number from 1 to {_MOST_PLIES}", start)
        return count

    def ply(self) -> list[Ply]:
        """Read an angle, a material, or a material with its angle."""
        name = self.take(_NAME)
        if name is None:
            return [Ply(angle) for angle in self.angles()]
        if not self.sees(":"):
            return [Ply(0.0, name.group())]
        return [Ply(angle, name.group()) for angle in self.angles()]

    def angles(self) -> list[float]:
        """Read an angle; two for a ±."""
        match = self.take(_ANGLE)
        if match is None:
            self.fail("an angle such as -45, or the name of a material, was expected here")
        digits, size = match["size"], float(match["size"])
        lost = _LOST_SUBSCRIPT.fullmatch(digits)
        if lost and (size > _LARGEST_ANGLE or digits[0] == "0"):
            words = f"{digits} is no angle: {lost[1]}_{lost[2]} for {lost[2]} plies of {lost[1]}?"
            self.fail(f"{words} Or is a / missing?", match.start("size"))
        if size > _LARGEST_ANGLE:
            self.fail(f"{digits} is above 180 degrees: is a / missing?", match.start("size"))
        return [sign * size if size else 0.0 for sign in _SIGNS[match["sign"]]]

    def refuse_fabric(self) -> None:
        """Ask for the material of a fabric, which a ply of another material must not stand for."""
        at = self.at
        if self.take(_FABRIC) is not None:
            self.fail("f, w and # mark a fabric: write its material, as in fabric:45", at)

    def whole(self, plies: list[Ply]) -> list[Ply]:
        """Plies as the words behind their bracket say: repeated, then mirrored."""
        at = self.at
        match = self.take(_TAIL)
        words = "".join(each or "" for each in match.groups()).lower() if match else ""
        mode = words.lstrip("0123456789")
        count = words.removesuffix(mode) if mode else words
        repeat = self.number(count, match.start()) if match and count else 1
        plies = self.times(plies, repeat * (2 if "s" in mode else 1), repeat, at)
        if self.middle is not None and not self.depth and mode != "s":
            rule = "~ marks the ply on the mid-plane: the sequence must end with s"
            self.fail(rule, self.middle)
        if mode == "as":
            return plies + [Ply(-ply.angle or 0.0, ply.material) for ply in reversed(plies)]
        last = plies[:-1] if self.middle is not None and not self.depth else plies
        return plies + last[::-1] if mode == "s" else plies

    def times(self, plies: list[Ply], total: int, count: int, at: int) -> list[Ply]:
        """Plies so often; not more of them than any laminate has."""
        if len(plies) * total > _MOST_PLIES:
            self.fail(f"more than {_MOST_PLIES} plies", at)
        return plies * count


def is_symmetric(plies: tuple[Ply, ...]) -> bool:
    """Whether the sequence is the same from the top down."""
    return plies == plies[::-1]


def is_balanced(plies: tuple[Ply, ...]) -> bool:
    """Whether every angle has its opposite equally often."""
    angles = sorted((_fold(ply.angle), ply.material or "") for ply in plies)
    return angles == sorted((_fold(-ply.angle), ply.material or "") for ply in plies)


def _fold(angle: float) -> float:
    """The same fibre direction between -90 (excluded) and 90 degrees."""
    return 90.0 - (90.0 - angle) % 180.0
