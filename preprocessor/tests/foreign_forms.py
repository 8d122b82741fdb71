"""Decks of LS-DYNA in many forms, and what is said of them."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from foreign_decks import (
    SPEED,
    Foreign,
    ball,
    composite,
    contact,
    control,
    ply_law,
    rigid,
    rim,
    sphere_profile,
    standard,
    translate,
)

from plydyn_pre.errors import PreError
from plydyn_pre.translate import Choices

LIKE = "IM7/8552"
ANGLES = (0.0, 90.0, 90.0, 0.0)


def translated(folder: Path, text: str | bytes, **choices: object) -> tuple[str, list[str]]:
    """The new deck and the notes."""
    path = folder / "user.k"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    lines, _, notes = translate(path, folder / "job.k", Choices(**({"like": LIKE} | choices)))
    return "\n".join(lines), notes


def plain(deck: str) -> str:
    """A deck without the titles of its sets."""
    return re.sub(r"(?m)^(set \d+|single nodes)$", "held", deck)


def same(folder: Path, text: str | bytes, other: str) -> None:
    """Check that two decks become the same one."""
    assert plain(translated(folder, text)[0]) == plain(translated(folder, other)[0])


def refused(folder: Path, text: str, *words: str, **choices: object) -> str:
    """What is said of a deck that is not translated."""
    with pytest.raises(PreError) as caught:
        translated(folder, text, **choices)
    for each in words:
        assert each in str(caught.value)
    return str(caught.value)


def stacked(
    joint: Callable[[Foreign, list[int], list[int]], None], gap: float = 0.25
) -> tuple[str, list[int], list[int]]:
    """Two parts of two plies each, one over the other, and what joins them."""
    deck = Foreign()
    lower, upper = deck.layer(0.125), deck.layer(0.125 + gap)
    deck.quads(1, lower)
    deck.quads(2, upper)
    composite(deck, 1, (0.0, 90.0))
    composite(deck, 2, (90.0, 0.0))
    ply_law(deck)
    deck.revolved(9, sphere_profile(0.5))
    rigid(deck)
    deck.set_of("SET_NODE_LIST", 1, [*rim(lower), *rim(upper)])
    deck.put("BOUNDARY_SPC_SET", (1, 0, 1, 1, 1))
    deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0, 0, -SPEED))
    contact(deck, 2, 9)
    joint(deck, lower, upper)
    control(deck)
    return deck.text(), lower, upper


def segments(deck: Foreign, sid: int, ids: list[int]) -> None:
    """A set of the segments of a layer."""
    rows = []
    for j in range(8):
        for i in range(8):
            a = 9 * j + i
            rows.append(tuple(ids[k] for k in (a, a + 1, a + 10, a + 9)))
    deck.put("SET_SEGMENT", (sid,), *rows)


def sides(kind: str) -> Callable[[Foreign, list[int], list[int]], tuple[int, int, int, int]]:
    """What a contact names its two sides by."""

    def make(deck: Foreign, lower: list[int], upper: list[int]) -> tuple[int, int, int, int]:
        match kind:
            case "segments":
                segments(deck, 11, lower)
                segments(deck, 12, upper)
                return 11, 12, 0, 0
            case "part sets":
                deck.put("SET_PART_LIST", (11,), (1,))
                deck.put("SET_PART", (12,), (2,))
                return 11, 12, 2, 2
            case "nodes":
                deck.set_of("SET_NODE_LIST", 11, lower)
                return 11, 2, 4, 3
            case "shells":
                deck.set_of("SET_SHELL_LIST", 11, list(range(1, 65)))
                return 11, 2, 1, 3
            case "general":
                deck.put("SET_SEGMENT_GENERAL", (11,), ("PART", 1))
                return 11, 2, 0, 3
        return 1, 2, 3, 3

    return make


NINE = (9, 60.0, 90.0, -1.5, 0.3, 0.8, 0.4, 1.0e5)


TIEBREAK = "CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE_TIEBREAK"


SIDES = ("parts", "segments", "part sets", "nodes", "shells", "general")


def tiebreak(kind: str, name: str = TIEBREAK, *last: tuple[float, ...]) -> str:
    """A deck with a tiebreak contact between its two parts."""

    def joint(deck: Foreign, lower: list[int], upper: list[int]) -> None:
        pair = sides(kind)(deck, lower, upper)
        deck.put(name, pair, (0.0, 0.0), (None,), *(last or (NINE,)))

    return stacked(joint)[0]


def tied(kind: str, name: str = "CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET") -> str:
    """A deck with a tied contact between its two parts."""

    def joint(deck: Foreign, lower: list[int], upper: list[int]) -> None:
        deck.put(name, sides(kind)(deck, lower, upper), (None,), (None,))

    return stacked(joint)[0]


def layups() -> dict[str, str]:
    """One layup in several forms: a deck for each."""

    def with_part(write: Callable[[Foreign, list[int]], None]) -> str:
        deck = Foreign()
        plate = deck.layer()
        write(deck, plate)
        ball(deck)
        deck.set_of("SET_NODE_LIST", 1, rim(plate))
        deck.put("BOUNDARY_SPC_SET", (1, 0, 1, 1, 1))
        deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0, 0, -SPEED))
        control(deck)
        return deck.text()

    def cards(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate)
        composite(deck)
        ply_law(deck)

    def icomp(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate)
        ply_law(deck)
        deck.put("SECTION_SHELL", (1, 2, 0.833, 4, 0, 1.0, 1), (0.5,) * 4, (0.0, 90.0, 90.0, 0.0))
        deck.put("PART", "plate", (1, 1, 1))

    def rule(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate)
        ply_law(deck)
        deck.put("SECTION_SHELL", (1, 2, 0.833, 4, 0, -7.0, 1), (0.5,) * 4, (0.0, 90.0, 90.0, 0.0))
        deck.put(
            "INTEGRATION_SHELL", (7, 4), (-0.75, 0.25), (-0.25, 0.25), (0.25, 0.25), (0.75, 0.25)
        )
        deck.put("PART", "plate", (1, 1, 1))

    def beta(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate, name="ELEMENT_SHELL_BETA", extra=f"{'':>64}{90.0:>16}")
        composite(deck, 1, (-90.0, 0.0, 0.0, -90.0))
        ply_law(deck)

    def thickness(deck: Foreign, plate: list[int]) -> None:
        deck.quads(
            1, plate, name="ELEMENT_SHELL_THICKNESS", extra="".join(f"{0.5:>16}" for _ in range(4))
        )
        deck.put(
            "PART_COMPOSITE",
            "plate",
            (1, 16),
            (1, 0.25, 0.0, 0, 1, 0.25, 90.0),
            (1, 0.25, 90.0, 0, 1, 0.25, 0.0),
        )
        ply_law(deck)

    def offset(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate, name="ELEMENT_SHELL_OFFSET", extra=f"{0.25:>16}")
        deck.put(
            "PART_COMPOSITE_LONG",
            "plate",
            (1, 16, None, 1.0),
            *[(1, 0.125, a) for a in (0.0, 90.0, 90.0, 0.0)],
        )
        ply_law(deck)

    def by_element(deck: Foreign, plate: list[int]) -> None:
        plies = "         1     0.125       0.0                   1     0.125      90.0"
        more = "         1     0.125      90.0                   1     0.125       0.0"
        deck.quads(1, plate, name="ELEMENT_SHELL_COMPOSITE", extra=f"{plies}\n{more}")
        deck.put("PART", "plate", (1, 1, 1))
        deck.put("SECTION_SHELL", (1, 2), (1.0,) * 4)
        ply_law(deck)

    def by_element_long(deck: Foreign, plate: list[int]) -> None:
        plies = [f"{1:>10}{0.125:>10}{angle:>10}{'':10}{n:>10}" for n, angle in enumerate(ANGLES)]
        deck.quads(1, plate, name="ELEMENT_SHELL_COMPOSITE_LONG", extra="\n".join(plies))
        deck.put("PART", "plate", (1, 1, 1))
        deck.put("SECTION_SHELL", (1, 2), (1.0,) * 4)
        ply_law(deck)

    def turned(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate, turned=True)
        composite(deck)
        ply_law(deck)

    def long_card(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate)
        deck.put(
            "PART_COMPOSITE_LONG",
            "plate",
            (1, 16),
            *[(1, 0.125, a) for a in (0.0, 90.0, 90.0, 0.0)],
        )
        ply_law(deck, name="MAT_054")

    forms = (cards, icomp, rule, beta, thickness, offset, by_element, by_element_long, turned)
    return {form.__name__: with_part(form) for form in (*forms, long_card)}


LAYUPS = layups()


def angles(deck: str) -> list[float]:
    """The angles of the plies, from the bottom up."""
    part = deck.split("*PART_COMPOSITE_LONG")[1].split("*")[0].splitlines()[5:]
    return [float(line.split()[2]) for line in part]


def with_more(text: str) -> str:
    """The plain deck with more keywords."""
    return standard()[0].text().replace("*END", f"{text}*END")
