"""Decks in which bodies are in each other's place, or hold, load or move nothing."""

from __future__ import annotations

import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from decks import BOTTOM, TOP, Deck, Ply, Sphere
from elasticity import CARBON
from meshes import regular
from runs import SOLVER

SIDE, PLY, RADIUS = 10.0, 0.5, 3.0
BALL = Sphere(RADIUS, 1.0e-5, (5.0, 5.0, RADIUS + PLY + 0.01), (0.0, 0.0, -1.0e3), method=1)


def plate(*balls: Sphere, held: bool = True) -> Deck:
    """A square plate, struck by balls."""
    mesh = regular(SIDE, SIDE, 4, 4, 9)
    deck = Deck("sense", 1.0e-5)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, PLY, angle) for angle in (0.0, 90.0)], 1)
    if held:
        deck.hold(mesh.boundary(), "xyz")
    for number, ball in enumerate(balls, 1):
        deck.sphere(ball, number)
    return deck


def said(deck: Deck, folder: Path) -> tuple[int, str]:
    """Exit code of `plydyn check`, and what it says."""
    path = deck.write(folder / "job.k")
    ended = subprocess.run([SOLVER, "check", path], capture_output=True, text=True, check=False)
    return ended.returncode, ended.stdout + ended.stderr


def clamped(*, base: bool, held: bool = False, least: float = 0.0) -> Deck:
    """Two clamps in corners, over a base or over nothing."""
    deck = plate(held=held)
    curve = deck.curve([(0.0, 0.0), (1.0e-5, 1.0), (2.0e-5, least)])
    for number, corner in ((1, 0.0), (2, SIDE)):
        deck.add("FIXTURE_CLAMP", (number, TOP, 100.0, curve), (corner, corner, 0.0, 3.0))
    if base:
        deck.add("FIXTURE_PLANE", (3, BOTTOM), (0,))
    return deck


def led(sign: float) -> Deck:
    """A ball whose curve leads it."""
    deck = plate()
    curve = deck.curve([(0.0, 0.0), (1.0e-5, sign * 0.1)])
    deck.sphere(replace(BALL, velocity=(0.0, 0.0, 0.0), curves=(0, 0, curve), quantity=2))
    return deck


def beside_fixture(x: float, face: int, keyword: str) -> Deck:
    """A ball at the middle, and a fixture around a place."""
    deck = plate(BALL)
    if keyword == "FIXTURE_PUNCH":
        deck.add(keyword, (1, face), (2, x, 5.0, 0.0, 0.0, 1.2))
    else:
        deck.add(keyword, (1, face, 100.0), (x, 5.0, 0.0, 1.2))
    return deck


REFUSED = {
    "impactor 2 is in the place of impactor 1": lambda: plate(BALL, BALL),
    "the centre of impactor 1 is over fixture 1": lambda: beside_fixture(5.0, TOP, "FIXTURE_PUNCH"),
    "impactor 1 is over fixture 1, which": lambda: beside_fixture(5.0, TOP, "FIXTURE_CLAMP"),
}
WARNED = {
    "is at rest, and nothing moves it": lambda: plate(replace(BALL, velocity=(0.0, 0.0, 0.0))),
    "along z leads away from the plate": lambda: led(1.0),
    "nothing holds it from the other face": lambda: clamped(base=False),
    "is below zero at times": lambda: clamped(base=True, least=-0.1),
    "the friction coefficient of the contact of impactor 1 is 50": lambda: plate(
        replace(BALL, friction=(50.0,))
    ),
}
SOUND = {
    "balls side by side": lambda: plate(BALL, replace(BALL, centre=(8.5, 5.0, BALL.centre[2]))),
    "punch below": lambda: beside_fixture(5.0, BOTTOM, "FIXTURE_PUNCH"),
    "punch beside": lambda: beside_fixture(8.0, TOP, "FIXTURE_PUNCH"),
    "led to the plate": lambda: led(-1.0),
    "clamps over a base": lambda: clamped(base=True),
    "clamps on a held plate": lambda: clamped(base=False, held=True),
    "rough": lambda: plate(replace(BALL, friction=(2.0,))),
}


@pytest.mark.parametrize("words", REFUSED)
def test_bodies_in_one_place_are_refused(words: str, tmp_path: Path) -> None:
    """Exit code 2, with the line of the impactor."""
    code, text = said(REFUSED[words](), tmp_path)
    assert code == 2
    assert words in text
    assert "job.k:" in text


@pytest.mark.parametrize("words", WARNED)
def test_bodies_that_do_nothing_are_told(words: str, tmp_path: Path) -> None:
    """A warning, and the deck is accepted."""
    code, text = said(WARNED[words](), tmp_path)
    assert code == 0
    assert words in text


@pytest.mark.parametrize("name", SOUND)
def test_sound_decks_are_not_blamed(name: str, tmp_path: Path) -> None:
    """None of the words of the others."""
    code, text = said(SOUND[name](), tmp_path)
    assert code == 0, text
    assert not [words for words in (*REFUSED, *WARNED) if words in text]
