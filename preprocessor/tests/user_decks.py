"""Decks as users of LS-DYNA write them, in three layouts."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, pi, sin
from typing import Literal

Layout = Literal["fixed", "comma", "long"]
Field = float | int | str | None
NODE, ELEMENT = (8, 16, 16, 16, 8, 8), (8,) * 10
SIDE, QUADS, RADIUS = 20.0, 4, 6.0
DENSITY = 7.8e-9
PER_SIDE = QUADS + 1


@dataclass
class UserDeck:
    """Lines of a deck; None is a field that is left blank."""

    layout: Layout
    lines: list[str] = field(default_factory=list)
    next_node: int = 1
    next_element: int = 1

    def __post_init__(self) -> None:
        """Begin the deck."""
        self.lines.append("*KEYWORD LONG=Y" if self.layout == "long" else "*KEYWORD")

    def keyword(self, name: str, *cards: tuple[Field, ...] | str) -> None:
        """A keyword with its cards; text is a line as it stands."""
        self.lines += [f"*{name}", "$ as written by hand"]
        widths = {"NODE": NODE}.get(name, ELEMENT if name.startswith("ELEMENT") else (10,) * 8)
        self.lines += [
            card if isinstance(card, str) else self._line(card, widths) for card in cards
        ]

    def _line(self, card: tuple[Field, ...], widths: tuple[int, ...]) -> str:
        """A card in the layout of the deck."""
        words = ["" if value is None else f"{value}" for value in card]
        if self.layout == "comma":
            return ",".join(words)
        if self.layout == "long":
            widths = (20,) * len(words)
        return "".join(f"{word:>{width}}" for word, width in zip(words, widths, strict=False))

    def layer(self, z: float) -> list[int]:
        """Nodes of a square plate at a height, row by row."""
        first = self.next_node
        step = SIDE / QUADS
        rows = [
            (first + PER_SIDE * j + i, step * i, step * j, z)
            for j in range(PER_SIDE)
            for i in range(PER_SIDE)
        ]
        self.keyword("NODE", *rows)
        self.next_node += len(rows)
        return [row[0] for row in rows]

    def elements(self, kind: str, pid: int, *layers: list[int]) -> None:
        """Quads of a layer, or bricks between two."""
        rows = []
        for j in range(QUADS):
            for i in range(QUADS):
                at = [PER_SIDE * j + i, PER_SIDE * j + i + 1]
                at += [at[1] + PER_SIDE, at[0] + PER_SIDE]
                nodes = [layer[k] for layer in layers for k in at]
                rows.append((self.next_element, pid, *nodes))
                self.next_element += 1
        self.keyword(f"ELEMENT_{kind}", *rows)

    def ball(self, pid: int, gap: float, top: float, bricks: bool) -> None:
        """A meshed cap of a rigid sphere over the middle of the plate."""
        centre = (SIDE / 2, SIDE / 2, top + gap + RADIUS)
        radii = (RADIUS, 0.5 * RADIUS) if bricks else (RADIUS,)
        rows, first = [], self.next_node
        for radius in radii:
            for j in range(4):
                for i in range(8):
                    polar, turn = pi * (0.02 + 0.16 * j), 2 * pi * i / 8
                    x, y = (radius * sin(polar) * f(turn) for f in (cos, sin))
                    z = centre[2] - radius * cos(polar)
                    rows.append(
                        (self.next_node, *(round(c, 9) for c in (centre[0] + x, centre[1] + y, z)))
                    )
                    self.next_node += 1
        self.keyword("NODE", *rows)
        elements = []
        for j in range(3):
            for i in range(8):
                face = [first + 8 * j + i, first + 8 * j + (i + 1) % 8]
                face += [face[1] + 8, face[0] + 8]
                nodes = face + [n + 32 for n in face] if bricks else face
                elements.append((self.next_element, pid, *nodes))
                self.next_element += 1
        self.keyword("ELEMENT_SOLID" if bricks else "ELEMENT_SHELL", *elements)

    def rigid(self, pid: int, secid: int, mid: int) -> None:
        """The keywords of the rigid part, which is guided."""
        self.keyword("MAT_RIGID", (mid, DENSITY, 210000.0, 0.3), (1.0, 4.0, 7.0), (None,))
        inertia = (0.0, 0.0, 0.0, 2.0e-4), (1.0, 0.0, 0.0, 1.0, 0.0, 1.0), (0.0, 0.0, -2000.0)
        self.keyword("PART_INERTIA", "tup", (pid, secid, mid), *inertia)
        self.keyword("INITIAL_VELOCITY_RIGID_BODY", (pid, 0.0, 0.0, -2000.0))

    def edges(self, *layers: list[int]) -> None:
        """Hold the edges of all layers."""
        rim = [
            k
            for k in range(PER_SIDE**2)
            if k % PER_SIDE in (0, QUADS) or not 0 < k // PER_SIDE < QUADS
        ]
        ids = [layer[k] for layer in layers for k in rim]
        rows = [tuple(ids[i : i + 8]) for i in range(0, len(ids), 8)]
        self.keyword("SET_NODE_LIST_TITLE", "rim", (7,), *rows)
        self.keyword("BOUNDARY_SPC_SET_ID", (1, "rim"), (7, 0, 1, 1, 1, 1, 1, 1))

    def control(self) -> None:
        """The end, the step and the outputs, as most decks have them."""
        self.keyword("CONTROL_TERMINATION", (2.0e-5, None, None, None, None))
        self.keyword("CONTROL_TIMESTEP", (None, 0.9, None, None, -1.0e-7))
        self.keyword("CONTROL_ACCURACY", (1, 4))
        self.keyword("DATABASE_GLSTAT", (1.0e-6,))
        self.keyword("DATABASE_RCFORC", (1.0e-6, 1))
        self.keyword("DATABASE_BINARY_D3PLOT", (1.0e-5,))

    def text(self) -> str:
        """The deck."""
        return "\n".join([*self.lines, "*END"]) + "\n"


def contact(deck: UserDeck, name: str, *last: tuple[Field, ...], parts: tuple[int, int]) -> None:
    """A contact between two parts."""
    first = ((1, "tup on plate"),) if name.endswith("_ID") else ()
    cards = (*first, (*parts, 3, 3), (0.3, 0.3, None, None, 20.0), (None, None))
    deck.keyword(name, *cards, *last)


def composite(layout: Layout = "fixed") -> str:
    """A plate of one *PART_COMPOSITE of MAT_054 under a ball of rigid shells."""
    deck = UserDeck(layout)
    deck.keyword("TITLE", "Low velocity impact")
    plate = deck.layer(0.0)
    deck.elements("SHELL", 1, plate)
    plies = ((1, 0.25, 45.0, None, 1, 0.25, -45.0), (1, 0.25, 90.0, None, 1, 0.25, 0.0))
    deck.keyword("PART_COMPOSITE", "laminate", (1, 16, 0.833, 0.0), *plies)
    deck.keyword(
        "MAT_054",
        (1, 1.6e-9, 153000.0, 10300.0, 10300.0, 0.0202, 0.0202, 0.4),
        (6000.0, 3700.0, 6000.0, None, 2.0),
        (None, None, None, 0.0, 1.0, 0.0),
        (None, None, None, -1.0, 0.0, 0.0, 0.05),
        (None, 0.1, 0.7, 1.0, 2.0, 0.02, -0.02),
        (1580.0, 2537.0, 236.0, 82.0, 90.0, 54.0),
    )
    deck.ball(2, 0.01, 0.5, bricks=False)
    deck.keyword("SECTION_SHELL", (2, 2), (1.0, 1.0, 1.0, 1.0))
    deck.rigid(2, 2, 2)
    deck.edges(plate)
    contact(deck, "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", parts=(2, 1))
    deck.control()
    return deck.text()


def cohesive(layout: Layout = "comma") -> str:
    """Three stacked shells of MAT_262 with bricks of MAT_138 between them."""
    deck = UserDeck(layout)
    deck.keyword("CONTROL_UNITS", ("mm", "s", "mtrc_ton"))
    layers = [deck.layer(0.5 * n) for n in range(3)]
    for n, layer in enumerate(layers):
        deck.elements("SHELL", n + 1, layer)
        deck.keyword("PART_COMPOSITE", f"ply {n}", (n + 1, 2), (1, 0.5, 90.0 * n))
    deck.elements("SOLID", 11, layers[0], layers[1])
    deck.elements("SOLID", 11, layers[1], layers[2])
    deck.keyword("PART", "glue", (11, 11, 11))
    deck.keyword("SECTION_SOLID", (11, 20))
    deck.keyword(
        "MAT_COHESIVE_MIXED_MODE",
        (11, 1.0e-9, 0, 1.0, 1.0e6, 5.0e5, 0.28, 0.79),
        (-1.634, 62.3, 92.3),
    )
    deck.keyword(
        "MAT_262",
        (1, 1.6e-9, 153000.0, 10300.0, 10300.0, 0.0202, 0.0202, 0.4),
        (6000.0, 3700.0, 6000.0, 0.0),
        (None, None, None),
        (None, None, None),
        (79.9, 91.6, 1.1, 0.22, 0.8),
        (1580.0, 2537.0, 236.0, 82.0, 90.0),
        (53.0, 60.0),
    )
    deck.ball(20, 0.01, 1.25, bricks=True)
    deck.keyword("SECTION_SOLID", (20, 1))
    deck.rigid(20, 20, 20)
    deck.edges(*layers)
    contact(deck, "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID", parts=(20, 3))
    deck.control()
    return deck.text()


def thick(layout: Layout = "long") -> str:
    """Two stacked thick shells of MAT_058 with a tiebreak between them."""
    deck = UserDeck(layout)
    pairs = [(deck.layer(0.5 * n), deck.layer(0.5 * n + 0.5)) for n in range(2)]
    for n, (low, high) in enumerate(pairs):
        deck.elements("TSHELL", n + 1, low, high)
        plies = (1, 0.25, 0.0, None, 1, 0.25, 90.0)
        deck.keyword("PART_COMPOSITE_TSHELL", f"half {n}", (n + 1, 1), plies)
    deck.keyword(
        "MAT_LAMINATED_COMPOSITE_FABRIC_TITLE",
        "tape",
        (1, 1.6e-9, 153000.0, 10300.0, 10300.0, 0.0202),
        (6000.0, 3700.0, 6000.0, 0.01, 1.0, 0.1, 1.0, 1.0),
        (2.0, None, None, None, -1.0),
        (None, None, None, 1.0, 0.0, 0.0, 0.0202, 0.4),
        (None, None, None, 0.0, 1.0, 0.0),
        (0.0103, 0.0166, 0.023, 0.008, 0.03),
        (1580.0, 2537.0, 236.0, 82.0, 90.0),
    )
    last = (9, 62.3, 92.3, -1.634, 0.28, 0.79, 0.5, 1.0e6)
    name = "CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE_TIEBREAK"
    contact(deck, name, last, parts=(1, 2))
    deck.ball(20, 0.01, 1.0, bricks=True)
    deck.keyword("SECTION_SOLID", (20, 1))
    deck.rigid(20, 20, 20)
    deck.edges(*(layer for pair in pairs for layer in pair))
    contact(deck, "CONTACT_AUTOMATIC_NODES_TO_SURFACE", parts=(20, 2))
    deck.control()
    return deck.text()
