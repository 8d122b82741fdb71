"""Meshed rigid bodies as the bodies of plydyn, however many elements they have."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from itertools import pairwise
from math import cos, pi, sin
from pathlib import Path

import pytest
from foreign_decks import (
    SPEED,
    Foreign,
    composite,
    contact,
    control,
    ply_law,
    rigid,
    sphere_profile,
    standard,
)
from foreign_forms import refused, translated

Grid = list[list[int]]


def deck_of(mesh: Callable[[Foreign], object], held: bool) -> str:
    """A plate, of 0.5, and a rigid body."""
    deck = Foreign()
    plate = deck.layer()
    deck.quads(1, plate)
    composite(deck)
    ply_law(deck)
    mesh(deck)
    rigid(deck, law=((1.0, 7.0, 7.0) if held else (1.0, 4.0, 7.0),))
    contact(deck, 1, 9)
    if not held:
        deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0, 0, -SPEED))
    control(deck)
    return deck.text()


def cells(deck: Foreign, rows: Grid, without: Sequence[tuple[int, int]] = ()) -> None:
    """Quads between rows of nodes."""
    deck.lines.append("*ELEMENT_SHELL")
    number = 500
    for j, (low, high) in enumerate(pairwise(rows)):
        for i, corners in enumerate(zip(low, low[1:], high[1:], high, strict=False)):
            number += 1
            if (i, j) not in without:
                deck.lines.append(f"{number},9," + ",".join(map(str, corners)))


def numbers(folder: Path, text: str, name: str) -> list[list[float]]:
    """The cards of a keyword of the new deck."""
    made, _ = translated(folder, text)
    found = re.search(rf"\*{name}(?:_TITLE)?\+?\n((?:[^*].*\n)+)", made)
    assert found, made
    rows = [row for row in found[1].splitlines() if row[0] == " "]
    return [[float(word) for word in row.split()] for row in rows]


def bar(count: int) -> Callable[[Foreign], object]:
    """The upper half of a bar along y, of some rows of nodes, its top 0.25 below the plate."""

    def mesh(deck: Foreign) -> None:
        arc = [pi * n / 8 for n in range(9)]
        ends = [-5.0 + 50.0 * n / (count - 1) for n in range(count)]
        rows = [deck.nodes((20.0 + 3.0 * cos(a), y, 3.0 * sin(a) - 3.5) for a in arc) for y in ends]
        cells(deck, rows)

    return mesh


@pytest.mark.parametrize("count", [2, 3, 4, 9])
def test_a_bar_of_any_number_of_elements_along_it(count: int, tmp_path: Path) -> None:
    """Two rings of nodes lie on a sphere, too, and four of the lowest nodes on a line."""
    head, ends = numbers(tmp_path, deck_of(bar(count), held=True), "FIXTURE_BAR")
    assert head[1:4] == pytest.approx([-1.0, 0.25, 3.0])
    assert ends[:4] == pytest.approx([20.0, -5.0, 20.0, 45.0])


def frame(*without: tuple[int, int]) -> Callable[[Foreign], object]:
    """Quads of 5 to 15 mm below the plate, without some; the middle one is from 5 to 35."""
    ticks = (-5.0, 0.0, 5.0, 35.0, 40.0, 45.0)

    def mesh(deck: Foreign) -> None:
        cells(deck, [deck.nodes((x, y, -0.35) for x in ticks) for y in ticks], without)

    return mesh


def test_a_window_is_what_elements_leave_open(tmp_path: Path) -> None:
    """Its edges have no nodes near the middle of the window."""
    head, window = numbers(tmp_path, deck_of(frame((2, 2)), held=True), "FIXTURE_PLANE")
    assert head[1:3] == pytest.approx([-1.0, 0.1])
    assert window[:5] == pytest.approx([1.0, 20.0, 20.0, 30.0, 30.0])
    aside = numbers(tmp_path, deck_of(frame((3, 2)), held=True), "FIXTURE_PLANE")[1]
    assert aside[:5] == pytest.approx([1.0, 37.5, 20.0, 5.0, 30.0])


def test_a_face_without_a_window_is_a_punch(tmp_path: Path) -> None:
    place = numbers(tmp_path, deck_of(frame(), held=True), "FIXTURE_PUNCH")[1]
    assert place[:5] == pytest.approx([1.0, 20.0, 20.0, 50.0, 50.0])


@pytest.mark.parametrize("without", [[(1, 1), (3, 3)], [(1, 1), (2, 1), (1, 2)], [(0, 2)]])
def test_a_face_with_other_openings_is_refused(
    without: list[tuple[int, int]], tmp_path: Path
) -> None:
    refused(tmp_path, deck_of(frame(*without), held=True), "the nodes of rigid part 9 lie on no")


def test_a_tube_has_no_face(tmp_path: Path) -> None:
    tube = deck_of(lambda deck: deck.revolved(9, [(12.0, -0.35), (12.0, -5.0)]), held=True)
    assert "user.k:" in refused(tmp_path, tube, "the nodes of rigid part 9 lie on no")


def noted(folder: Path, mesh: Callable[[Foreign], object], words: str) -> bool:
    """Whether something is said of a fixture, or of an impactor whose CON2 is 0."""
    return any(words in note for note in translated(folder, deck_of(mesh, held=True))[1])


def test_a_round_edge_of_a_ring_or_a_frame_is_told(tmp_path: Path) -> None:
    words = "part 9 is wider above its face: its edges are taken as sharp"
    face = [(10.0, -0.35), (15.0, -0.35)]
    outer, inner = [(15.7, -0.65), (16.0, -1.35)], [(9.0, -1.35), (9.3, -0.65)]
    ticks = (-5.0, 5.0, 35.0, 45.0)

    def frame_with(wall: float) -> Callable[[Foreign], object]:
        def mesh(deck: Foreign) -> None:
            cells(deck, [deck.nodes((x, y, -0.35) for x in ticks) for y in ticks], [(1, 1)])
            places = [(x, y, z) for z in (-0.65, -2.0) for x, y in ((wall, 9.0), (wall, 31.0))]
            a, b, c, d = deck.nodes(places)
            deck.lines += ["*ELEMENT_SHELL", f"800,9,{a},{b},{d},{c}"]

        return mesh

    for mesh, wider in (
        (lambda deck: deck.revolved(9, [(10.0, -5.0), *face, (15.0, -5.0)]), False),
        (lambda deck: deck.revolved(9, [(10.0, -5.0), *face, *outer]), True),
        (lambda deck: deck.revolved(9, [*inner, *face, (15.0, -5.0)]), True),
        (frame_with(5.0), False),
        (frame_with(5.5), True),
        (frame_with(45.5), True),
    ):
        assert noted(tmp_path, mesh, words) == wider


def test_a_guided_ball_that_may_rotate_is_told(tmp_path: Path) -> None:
    words = "part 9 does not rotate: of plydyn's impactors guided ones do not"
    held = standard()[0].text()
    free = held.replace("       1.0       4.0       7.0", "       1.0       4.0       0.0")
    assert held != free
    assert [words in translated(tmp_path, text)[1] for text in (held, free)] == [False, True]


FLAT = [(0.01, 0.35), (3.0, 0.35), (5.0, 0.35)]
ROUND = [(5.0 + sin(a), 1.35 - cos(a)) for a in (0.4, 0.8, 1.2, pi / 2)]


def test_a_cylinder_has_the_edge_of_its_nodes(tmp_path: Path) -> None:
    punch = deck_of(lambda deck: deck.revolved(9, [*FLAT, *ROUND, (6.0, 10.35)]), held=False)
    place, sizes, _ = numbers(tmp_path, punch, "IMPACTOR_CYLINDER")
    assert place[1] == pytest.approx(6.0)
    assert place[5] == pytest.approx(0.35 + 5.0) and sizes[:2] == pytest.approx([10.0, 1.0])
    sharp = deck_of(lambda deck: deck.revolved(9, [*FLAT, (5.0, 10.35)]), held=False)
    place, sizes, _ = numbers(tmp_path, sharp, "IMPACTOR_CYLINDER")
    assert place[1] == pytest.approx(5.0) and sizes[:2] == pytest.approx([10.0, 0.0])
    bevel = deck_of(lambda deck: deck.revolved(9, [*FLAT, (5.5, 0.85), (6.0, 1.35)]), held=False)
    refused(tmp_path, bevel, "the nodes of rigid part 9 lie on no")


@pytest.mark.parametrize("decimals", [3, 4, 6])
def test_a_ball_is_that_of_which_its_nodes_were_written(decimals: int, tmp_path: Path) -> None:
    """Of the spheres that its rounded nodes bear it is the one of the fewest digits."""

    def mesh(deck: Foreign) -> None:
        deck.decimals = decimals
        deck.revolved(9, sphere_profile(0.25))

    place, _ = numbers(tmp_path, deck_of(mesh, held=False), "IMPACTOR_SPHERE")
    assert (place[1], place[5]) == (8.0, 8.35)


@pytest.mark.parametrize("edge", [0.05, 0.1, 0.2, 0.3, 0.5, 1.0])
def test_a_punch_with_a_small_edge_is_no_cone(edge: float, tmp_path: Path) -> None:
    """A line through its face and edge leaves nodes off by less than they are for a ball."""
    arc = [(10.0 - edge + edge * sin(a), edge - edge * cos(a)) for a in (0.0, 0.5, 1.0, pi / 2)]
    profile = [(r, 0.35 + z) for r, z in [(0.01, 0.0), (3.0, 0.0), (6.0, 0.0), *arc, (10.0, 10.0)]]
    made = deck_of(lambda deck: deck.revolved(9, profile), held=False)
    place, sizes, _ = numbers(tmp_path, made, "IMPACTOR_CYLINDER")
    assert place[1] == pytest.approx(10.0) and sizes[:2] == pytest.approx([10.0, edge])


def test_a_rod_does_not_widen_the_ball_at_its_end(tmp_path: Path) -> None:
    """Nodes of the rod just above the ball are none of its own."""
    polar = [pi * 0.0625 * n + 0.001 for n in range(8)]
    ball = [(8.0 * sin(t), 0.35 + 8.0 * (1.0 - cos(t))) for t in polar]
    rod = [(8.0, 8.35 + z) for z in (1.0, 10.0, 30.0)]
    tup = deck_of(lambda deck: deck.revolved(9, [*ball, *rod]), held=False)
    place, sizes, _ = numbers(tmp_path, tup, "IMPACTOR_TUP")
    assert place[1] == pytest.approx(8.0, rel=1e-6)
    assert place[5] == pytest.approx(8.35, rel=1e-6) and sizes[0] == pytest.approx(30.0)
