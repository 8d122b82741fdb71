"""One impact as a deck of LS-DYNA in many forms: parts that a test puts together."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from math import cos, pi, sin
from pathlib import Path

from plydyn_pre.translate import Choices, translation

SIDE, QUADS, RADIUS, MASS, SPEED = 40.0, 8, 8.0, 2.0e-4, 2000.0
PER_SIDE = QUADS + 1
Field = float | int | str | None
Cards = Sequence[Sequence[Field] | str]


@dataclass
class Foreign:
    """Lines of a deck."""

    lines: list[str] = field(default_factory=lambda: ["*KEYWORD"])
    node: int = 0
    element: int = 0
    decimals: int = 8  # of coordinates

    def put(self, name: str, *cards: Sequence[Field] | str) -> None:
        """A keyword with cards of ten columns; text is a line as it stands."""
        self.lines.append(f"*{name}")
        self.put_cards(*cards)

    def put_cards(self, *cards: Sequence[Field] | str) -> None:
        """More cards of the last keyword."""
        for card in cards:
            words = ["" if value is None else f"{value}" for value in card]
            text = card if isinstance(card, str) else "".join(f"{word:>10}" for word in words)
            self.lines.append(text)

    def nodes(self, places: Iterable[tuple[float, float, float]], tail: str = "") -> list[int]:
        """Nodes, each with the same text behind it."""
        self.lines.append("*NODE")
        first = self.node + 1
        for x, y, z in places:
            self.node += 1
            place = "".join(f"{c:16.{self.decimals}f}" for c in (x, y, z))
            self.lines.append(f"{self.node:8d}{place}{tail}")
        return list(range(first, self.node + 1))

    def layer(self, z: float = 0.0) -> list[int]:
        """Nodes of the plate at a height, row by row."""
        step = SIDE / QUADS
        return self.nodes((i * step, j * step, z) for j in range(PER_SIDE) for i in range(PER_SIDE))

    def quads(
        self,
        pid: int,
        *layers: list[int],
        name: str = "ELEMENT_SHELL",
        extra: str = "",
        turned: bool = False,
    ) -> list[int]:
        """Quads of a layer, or bricks between two; `extra` follows each."""
        self.lines.append(f"*{name}")
        found = []
        for j in range(QUADS):
            for i in range(QUADS):
                at = [PER_SIDE * j + i, PER_SIDE * j + i + 1]
                at += [at[1] + PER_SIDE, at[0] + PER_SIDE]
                ids = [layer[k] for layer in layers for k in (at[::-1] if turned else at)]
                found.append(self._element(pid, ids))
                self.lines += [extra] if extra else []
        return found

    def _element(self, pid: int, ids: list[int]) -> int:
        """An element."""
        self.element += 1
        self.lines.append(f"{self.element:8d}{pid:8d}" + "".join(f"{n:8d}" for n in ids))
        return self.element

    def revolved(
        self, pid: int, profile: Sequence[tuple[float, float]], middle: float = SIDE / 2
    ) -> list[int]:
        """A body of shells: radius and height of its rings, from the tip up."""
        around = 12
        places = [
            (middle + r * cos(2 * pi * i / around), middle + r * sin(2 * pi * i / around), z)
            for r, z in profile
            for i in range(around)
        ]
        ids = self.nodes(places)
        self.lines.append("*ELEMENT_SHELL")
        for j in range(len(profile) - 1):
            for i in range(around):
                a, b = around * j + i, around * j + (i + 1) % around
                self._element(pid, [ids[a], ids[b], ids[b + around], ids[a + around]])
        return ids

    def set_of(self, name: str, sid: int, ids: Sequence[int]) -> None:
        """A set."""
        rows = [tuple(ids[i : i + 8]) for i in range(0, len(ids), 8)]
        self.put(name, (sid,), *rows)

    def text(self) -> str:
        """The deck."""
        return "\n".join([*self.lines, "*END", ""])


def rim(ids: list[int]) -> list[int]:
    """The nodes at the edges of a layer."""
    inner = range(1, QUADS)
    return [n for k, n in enumerate(ids) if k % PER_SIDE not in inner or k // PER_SIDE not in inner]


def ply_law(deck: Foreign, mid: int = 1, axis: Cards = ((1.0, 0.0, 0.0),), name: str = "") -> None:
    """A ply of MAT_054 with its axis a along a vector."""
    deck.put(
        name or "MAT_ENHANCED_COMPOSITE_DAMAGE",
        (mid, 1.6e-9, 153000.0, 10300.0, 10300.0, 0.0202, 0.0202, 0.4),
        (6000.0, 3700.0, 6000.0, None, 2.0),
        (None, None, None, *axis[0]),
        (None,),
        (None,),
        (1500.0, 2500.0, 230.0, 80.0, 90.0, 54.0),
    )


def rigid(deck: Foreign, pid: int = 9, law: Cards = ((1.0, 4.0, 7.0),)) -> None:
    """The keywords of a rigid part of shells."""
    deck.put("MAT_RIGID", (pid, 7.8e-9, 210000.0, 0.3), *law, (None,))
    deck.put("SECTION_SHELL", (pid, 2), (1.0, 1.0, 1.0, 1.0))
    inertia = (0, 0, 0, MASS), (1.0, 0, 0, 1.0, 0, 1.0), (0.0, 0.0, 0.0)
    deck.put("PART_INERTIA", "ball", (pid, pid, pid), *inertia)


def sphere_profile(top: float, gap: float = 0.1) -> list[tuple[float, float]]:
    """Rings of the lower half of a ball above a height."""
    polar = [pi * (0.02 + 0.08 * j) for j in range(7)]
    return [(RADIUS * sin(t), top + gap + RADIUS * (1.0 - cos(t))) for t in polar]


def ball(deck: Foreign, top: float = 0.25) -> list[int]:
    """A guided ball above the plate, in contact with part 1."""
    ids = deck.revolved(9, sphere_profile(top))
    rigid(deck)
    contact(deck, 1, 9)
    return ids


def contact(deck: Foreign, one: int, other: int, name: str = "", *last: Sequence[Field]) -> None:
    """A contact of two parts."""
    name = name or "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE"
    deck.put(name, (one, other, 3, 3), (0.2, 0.2), (None,), *last)


def control(deck: Foreign, end: float = 5.0e-4) -> None:
    """The end and the outputs."""
    deck.put("CONTROL_TERMINATION", (end,))
    deck.put("DATABASE_RCFORC", (1.0e-6,))


def composite(
    deck: Foreign, pid: int = 1, angles: Sequence[float] = (0.0, 90.0, 90.0, 0.0)
) -> None:
    """A part of plies of 0.125."""
    pairs = [(1, 0.125, angle, 0) for angle in angles]
    rows = [pairs[i] + pairs[i + 1] for i in range(0, len(pairs), 2)]
    deck.put("PART_COMPOSITE", "plate", (pid, 16, 0.833, 0.0), *rows)


def standard(held: bool = True, moved: bool = True) -> tuple[Foreign, list[int], list[int]]:
    """A deck of one composite part below a ball, with nodes of both."""
    deck = Foreign()
    plate = deck.layer()
    deck.quads(1, plate)
    composite(deck)
    ply_law(deck)
    nodes = ball(deck)
    if held:
        deck.set_of("SET_NODE_LIST", 1, rim(plate))
        deck.put("BOUNDARY_SPC_SET", (1, 0, 1, 1, 1, 1, 1, 1))
    if moved:
        deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0, 0, -SPEED))
    control(deck)
    return deck, plate, nodes


def translate(source: Path, deck: Path, *choices: Choices) -> tuple[list[str], str, list[str]]:
    """The lines of a deck, the page in Markdown, and what to look at first."""
    made = translation(source, deck, *choices)
    return made.lines, made.page, made.notes
