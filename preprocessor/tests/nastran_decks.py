"""One impact as a file of Nastran's bulk data: parts that a test puts together."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from math import cos, pi, sin
from typing import Literal

from foreign_decks import MASS, PER_SIDE, QUADS, RADIUS, SIDE, rim, sphere_profile

GAP, SPEED, END = 0.02, 4000.0, 1.2e-4
ANGLES = (0.0, 90.0, 90.0, 0.0)
Layout = Literal["fixed", "large", "comma"]


@dataclass
class Nastran:
    """Lines of a file."""

    layout: Layout = "fixed"
    lines: list[str] = field(default_factory=list)
    node: int = 0
    element: int = 0

    def put(self, name: str, *words: float | str) -> None:
        """An entry."""
        texts = [_text(word) for word in words]
        width, columns = (4, 16) if self.layout == "large" else (8, 8)
        for at in range(0, max(len(texts), 1), width):
            row = texts[at : at + width]
            if self.layout == "comma":
                self.lines.append(",".join([name if at == 0 else "", *row]))
                continue
            star = "*" if self.layout == "large" else ""
            head = f"{name}{star}" if at == 0 else star
            line = f"{head:8}" + "".join(f"{word:<{columns}}" for word in row)
            self.lines.append(line.rstrip())

    def nodes(self, places: Iterable[tuple[float, float, float]]) -> list[int]:
        """Nodes."""
        first = self.node + 1
        for place in places:
            self.node += 1
            self.put("GRID", self.node, "", *place)
        return list(range(first, self.node + 1))

    def layer(self, z: float = 0.0) -> list[int]:
        """Nodes of the plate at a height, row by row."""
        step = SIDE / QUADS
        return self.nodes((i * step, j * step, z) for j in range(PER_SIDE) for i in range(PER_SIDE))

    def quad(self, pid: int, *ids: int) -> None:
        """A quad."""
        self.element += 1
        self.put("CQUAD4", self.element, pid, *ids)

    def quads(self, pid: int, ids: list[int], *more: float | str) -> None:
        """The quads of the plate."""
        for j in range(QUADS):
            for i in range(QUADS):
                a = ids[PER_SIDE * j + i]
                self.quad(pid, a, a + 1, a + 1 + PER_SIDE, a + PER_SIDE, *more)

    def ball(self, top: float = 0.25) -> list[int]:
        """A ball of quads tied to its reference node, which is guided."""
        profile, around = sphere_profile(top, GAP), 12
        ids = self.nodes(
            (SIDE / 2 + r * cos(2 * pi * i / around), SIDE / 2 + r * sin(2 * pi * i / around), z)
            for r, z in profile
            for i in range(around)
        )
        for j in range(len(profile) - 1):
            for i in range(around):
                a, b = around * j + i, around * j + (i + 1) % around
                self.quad(9, ids[a], ids[b], ids[b + around], ids[a + around])
        (reference,) = self.nodes([(SIDE / 2, SIDE / 2, top + GAP + RADIUS)])
        self.put("PSHELL", 9, 9, 1.0)
        self.put("MAT1", 9, 210000.0, "", 0.3, 0.0)
        self.put("RBE2", 5001, reference, 123456, *ids)
        self.put("CONM2", 5002, reference, 0, MASS)
        self.put("SPC1", 1, 12456, reference)
        self.put("TIC", 2, reference, 3, 0.0, -SPEED)
        return ids

    def text(self, case: Sequence[str] = ()) -> str:
        """The file."""
        head = ["SOL 700,NLTRAN", "CEND", "TITLE = the same impact", *case]
        commands = ["SPC = 1", "IC = 2", "TSTEPNL = 3", "BCONTACT = ALLBODY"]
        return "\n".join([*head, *commands, "BEGIN BULK", *self.lines, "ENDDATA", ""])


def _text(word: float | str) -> str:
    """A word in at most eight columns."""
    if isinstance(word, float):
        text = f"{word:.6g}"
        if len(text) > 8:
            text = f"{word:.3e}".replace("e-0", "-").replace("e+0", "+").replace("e", "")
        return text if "." in text or "-" in text[1:] or "+" in text[1:] else f"{text}."
    return f"{word}"


def law(deck: Nastran, *strengths: float) -> None:
    """The ply, whose constants across are those of the recipe."""
    elastic = (153000.0, 10300.0, 0.300058, 6000.0, 6000.0, 3700.0, 1.6e-9)
    deck.put("MAT8", 1, *elastic, 0.0, 0.0, 0.0, *strengths)


def standard(layout: Layout = "fixed", *strengths: float) -> str:
    """Shells of four plies below a ball."""
    deck = Nastran(layout)
    plate = deck.layer()
    deck.quads(1, plate)
    plies = [word for angle in ANGLES for word in (1, 0.125, angle, "YES")]
    deck.put("PCOMP", 1, "", "", "", "", "", "", "", *plies)
    law(deck, *strengths)
    deck.ball()
    deck.put("SPC1", 1, 123456, *rim(plate))
    deck.put("BCBODY", 7, "3D", "DEFORM", 7, "", 0.2)
    deck.put("TSTEPNL", 3, 120, END / 120, 1)
    return deck.text()
