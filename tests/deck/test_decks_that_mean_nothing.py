"""Decks in which bodies are in each other's place, or hold, load or move nothing."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from decks import BOTTOM, TOP, Bond, Deck, Ply, Sphere
from elasticity import CARBON
from meshes import regular
from runs import SOLVER

SIDE, PLY, RADIUS = 10.0, 0.5, 3.0
BALL = Sphere(RADIUS, 1.0e-5, (5.0, 5.0, RADIUS + PLY + 0.01), (0.0, 0.0, -1.0e3), method=1)


REST = replace(BALL, velocity=(0.0, 0.0, 0.0))
BESIDE = replace(BALL, centre=(14.0, 5.0, BALL.centre[2]))


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


def clamped(*, base: bool, held: bool = False, peak: float = 1.0, least: float = 0.0) -> Deck:
    """Two clamps in corners, over a base or over nothing."""
    deck = plate(held=held)
    curve = deck.curve([(0.0, 0.0), (1.0e-5, peak), (2.0e-5, least)])
    for number, corner in ((1, 0.0), (2, SIDE)):
        deck.add("FIXTURE_CLAMP", (number, TOP, 100.0, curve), (corner, corner, 0.0, 3.0))
    if base:
        deck.add("FIXTURE_PLANE", (3, BOTTOM), (0,))
    return deck


def led(*values: float, moved: bool = False) -> Deck:
    """A ball whose curve leads it, before a plate at rest or one that something moves."""
    deck = loaded() if moved else plate()
    curve = deck.curve([(number * 1.0e-5, value) for number, value in enumerate((0.0, *values))])
    deck.sphere(replace(REST, curves=(0, 0, curve), quantity=2))
    return deck


def loaded(*balls: Sphere, factor: float = 1.0) -> Deck:
    """A plate under its weight, times a factor."""
    deck = plate(*balls)
    deck.add("LOAD_BODY_Z", (deck.curve([(0.0, 1.0), (1.0, 1.0)]), 9810.0 * factor))
    return deck


def flying(x: float, y: float, z: float) -> Sphere:
    """The ball with another velocity, m/s."""
    return replace(BALL, velocity=(1.0e3 * x, 1.0e3 * y, 1.0e3 * z))


def pinched(*balls: Sphere, face: int) -> Deck:
    """A plate that a clamp presses from a face."""
    deck = plate(*balls)
    deck.add("FIXTURE_CLAMP", (1, face, 100.0), (9.9, 9.9, 0.0, 1.2))
    return deck


def beside_fixture(x: float, face: int, keyword: str) -> Deck:
    """A ball at the middle, and a fixture around a place."""
    deck = plate(BALL)
    if keyword == "FIXTURE_PUNCH":
        deck.add(keyword, (1, face), (2, x, 5.0, 0.0, 0.0, 1.2))
    else:
        deck.add(keyword, (1, face, 100.0), (x, 5.0, 0.0, 1.2))
    return deck


def on_fixtures(*fixtures: tuple[object, ...], ball: bool = True) -> Deck:
    """A plate on fixtures: keyword, face, card of the shape, card of the curves."""
    deck = plate(*([BALL] if ball else []), held=False)
    moving = any("up" in card for fixture in fixtures for card in fixture[3:])
    up = deck.curve([(0.0, 0.0), (1.0e-5, 0.1)]) if moving else 0
    for number, (keyword, face, shape, *moves) in enumerate(fixtures, 1):
        cards = [[up if field == "up" else field for field in card] for card in moves]
        force = (100.0,) if keyword == "FIXTURE_CLAMP" else (0.0,)
        deck.add(str(keyword), (number, face, *force), shape, *cards)
    return deck


def window(x: float, side: float) -> tuple[object, ...]:
    """A base with a square window."""
    return "FIXTURE_PLANE", BOTTOM, (1, x, 5.0, side, side, 0.0)


def tip(x: float, y: float) -> tuple[object, ...]:
    """A clamp on the top face."""
    return "FIXTURE_CLAMP", TOP, (x, y, 0.0, 1.5)


def bonded(length: float = 0.0, friction: float = 0.3) -> Deck:
    """Plies whose bond scatters over a length."""
    deck = plate(BALL)
    scatter = (1, 12.0, length) if length else None
    bond = Bond((1e5, 5e4), (60.0, 90.0), (0.3, 0.8), 1.0, friction=friction, scatter=scatter)
    deck.cohesive(bond)
    return deck


def relaxed(share: float, *balls: Sphere) -> Deck:
    """A plate that is to come to rest under its weight."""
    deck = loaded(*balls)
    deck.add("DAMPING_RELAXATION", (share,))
    return deck


def pushed(speed: float, *, share: float = 0.0) -> Deck:
    """A plate whose side moves inwards."""
    deck = plate(held=False)
    mesh = regular(SIDE, SIDE, 4, 4, 9)
    deck.hold(mesh.where(x=0.0), "xyz")
    curve = deck.curve([(0.0, 1.0), (1.0, 1.0)])
    card = (deck.node_set(mesh.where(x=SIDE)), 1, 0, curve, -speed)
    deck.add("BOUNDARY_PRESCRIBED_MOTION_SET", card)
    deck.add("CONTROL_QUASI_STATIC", (share,))
    return deck


#: Speed of the wave of a cross-ply along x: the mean modulus of the plies, without the little that
#: their contraction adds
WAVE = ((CARBON.young[0] + CARBON.young[1]) / 2.0 / CARBON.density) ** 0.5

REFUSED = {
    "fixture 2 is in the place of fixture 1": lambda: on_fixtures(
        window(5.0, 8.0), window(5.0, 8.0)
    ),
    "every motion has this share of the largest": lambda: relaxed(1.0),
    "impactor 2 is in the place of impactor 1": lambda: plate(BALL, BALL),
    "the centre of impactor 1 is over fixture 1": lambda: beside_fixture(5.0, TOP, "FIXTURE_PUNCH"),
    "impactor 1 is over fixture 1, which": lambda: beside_fixture(5.0, TOP, "FIXTURE_CLAMP"),
    # what never comes to a plate that nothing moves
    "impactor 1 is at rest; nothing moves": lambda: plate(REST),
    "impactor 1 is at rest; nothing moves the plate, either": lambda: plate(REST, held=False),
    "impactor 2 is at rest; nothing": lambda: plate(
        REST, replace(REST, centre=(5.0, 5.0, -BALL.centre[2]), face=BOTTOM)
    ),
    "impactor 1 is at rest; nothing moves the": lambda: loaded(REST, factor=0.0),
    "impactor 1 is at rest; nothing moves the plate": lambda: led(0.0, 0.0),
    "impactor 1 moves away from the plate: its curve along z leads away; nothing": lambda: led(0.1),
    "its curve along z leads away; nothing moves the plate, either": lambda: led(0.1, 0.0),
    "impactor 1 moves away from the plate; nothing": lambda: plate(flying(0.0, 0.0, 1.0)),
    "moves away from the plate; nothing moves the plate, either": lambda: pinched(
        flying(0.0, 0.0, 1.0), face=TOP
    ),
    "impactor 1 moves along the plate alone, and does not touch it; nothing": lambda: plate(
        flying(1.0, 1.0, 0.0)
    ),
    "impactor 1 passes by: its centre lies 4 beside the plate; nothing": lambda: plate(BESIDE),
    "the curve of fixture 1 along z leads away from the plate; nothing else": lambda: on_fixtures(
        ("FIXTURE_PUNCH", TOP, (2, 5.0, 5.0, 0.0, 0.0, 1.2), (0, 0, "up")), ball=False
    ),
    "impactor 2 is in the place of impactor 1, 5 apart": lambda: plate(
        BALL, replace(BALL, centre=(10.0, 5.0, BALL.centre[2]))
    ),
}
WARNED = {
    "the deck has no impactor, no load and no motion: nothing will happen": plate,
    "no impactor, no load and no motion: nothing": lambda: loaded(factor=0.0),
    "has no impactor, no load and no motion": lambda: on_fixtures(window(5.0, 8.0), ball=False),
    "clamp 3 is in the place of clamp 2, and adds its force": lambda: on_fixtures(
        window(5.0, 8.0), tip(0.0, 0.0), tip(0.0, 0.0), ball=False
    ),
    "impactor 1 moves away from the plate: its curve along z leads": lambda: led(0.1, moved=True),
    "impactor 1 moves away from the plate": lambda: loaded(flying(0.0, 0.0, 1.0)),
    "impactor 1 passes by": lambda: loaded(BESIDE),
    "impactor 2 moves away from the plate": lambda: plate(
        BALL, replace(flying(0.0, 0.0, -1.0), centre=(5.0, 5.0, -BALL.centre[2]), face=BOTTOM)
    ),
    "fixture 1 begins 1.8 beside the axis of impactor 1, inside of": lambda: beside_fixture(
        8.0, TOP, "FIXTURE_PUNCH"
    ),
    "fixture 1 begins 2.8 beside the axis of impactor 1, inside of": lambda: beside_fixture(
        9.0, TOP, "FIXTURE_CLAMP"
    ),
    "clamp 1 never presses": lambda: clamped(base=True, peak=0.0, least=-0.1),
    "clamp 2 never presses": lambda: clamped(base=True, peak=0.0),
    "nothing holds it from the other face": lambda: clamped(base=False),
    "is below zero at times": lambda: clamped(base=True, least=-0.1),
    "the friction coefficient of the contact of impactor 1 is 50": lambda: plate(
        replace(BALL, friction=(50.0,))
    ),
    "the friction coefficient of the faces is 50": lambda: bonded(friction=50.0),
    # the quads are 2.5 wide, the plate is 10
    "over 1e-6, below the sides of all quads": lambda: bonded(1.0e-6),
    "over 2.4, below the sides of all quads": lambda: bonded(2.4),
    "over 10.1, above the sides of the plate": lambda: bonded(10.1),
    # a side of 5.9 begins 2.95 from the axis
    "begins 2.95 beside the axis of impactor 1, inside of its radius of 3": lambda: on_fixtures(
        window(5.0, 5.9)
    ),
    "is open under no node of the plate": lambda: on_fixtures(window(30.0, 8.0)),
    "the curve of fixture 1 along z leads away": lambda: on_fixtures(
        ("FIXTURE_PUNCH", TOP, (2, 8.0, 8.0, 0.0, 0.0, 1.2), (0, 0, "up"))
    ),
    "presses the plate where no fixture of the other face": lambda: on_fixtures(
        window(5.0, 8.0), tip(0.0, 0.0), tip(5.0, 8.0), ball=False
    ),
    "impactor 1 is not damped": lambda: relaxed(1.0e-4, BALL),
    "with 0.2 of its largest kinetic energy is not at rest": lambda: relaxed(0.2),
    "the front of its wave alone strains the plate by 0.1": lambda: pushed(1.1e-3 * WAVE),
}
SOUND = {
    "balls side by side": lambda: plate(
        replace(BALL, centre=(2.0, 5.0, BALL.centre[2])),
        replace(BALL, centre=(8.0, 5.0, BALL.centre[2])),
    ),
    "balls on both sides": lambda: plate(
        BALL, replace(flying(0.0, 0.0, 1.0), centre=(5.0, 5.0, -BALL.centre[2]), face=BOTTOM)
    ),
    "a ball at rest on the other side": lambda: plate(
        BALL, replace(REST, centre=(5.0, 5.0, -BALL.centre[2]), face=BOTTOM)
    ),
    "a ball at rest under a plate that is pressed onto it": lambda: pinched(
        replace(REST, centre=(5.0, 5.0, -BALL.centre[2]), face=BOTTOM), face=TOP
    ),
    "a ball at rest and a plate that falls": lambda: loaded(REST),
    "a ball that falls by its weight": lambda: plate(
        replace(flying(0.0, 0.0, 1.0), gravity=-9810.0)
    ),
    "a ball that comes from the side": lambda: plate(
        replace(flying(-400.0, 0.0, -1.0), centre=(14.0, 5.0, BALL.centre[2] + 0.001))
    ),
    "punch below": lambda: beside_fixture(5.0, BOTTOM, "FIXTURE_PUNCH"),
    "punch beside": lambda: beside_fixture(9.3, TOP, "FIXTURE_PUNCH"),
    "led to the plate": lambda: led(-0.1),
    "led away and back to the plate": lambda: led(0.1, -0.1),
    "clamps over a base": lambda: clamped(base=True),
    "clamps on a held plate": lambda: clamped(base=False, held=True),
    "clamp over a side of the window": lambda: on_fixtures(window(5.0, 8.0), tip(5.0, 9.5)),
    "bond that scatters": lambda: bonded(2.5),
    "over the whole plate": lambda: bonded(10.0),
    "wide window": lambda: on_fixtures(window(5.0, 6.1)),
    "window of a quarter": lambda: on_fixtures(window(0.0, 8.0), tip(9.9, 9.9), ball=False),
    "fixture that comes": lambda: on_fixtures(
        ("FIXTURE_PLANE", BOTTOM, (0,), (0, 0, "up")), ball=False
    ),
    "equal fixtures of two faces": lambda: on_fixtures(
        ("FIXTURE_RING", BOTTOM, (5.0, 5.0, 3.1, 4.0)), ("FIXTURE_RING", TOP, (5.0, 5.0, 3.1, 4.0))
    ),
    "to rest": lambda: relaxed(0.1),
    "slow": lambda: pushed(0.9e-3 * WAVE),
    "fast, and the limit of energy looks at it": lambda: pushed(1.1e-3 * WAVE, share=0.05),
    "rough": lambda: plate(replace(BALL, friction=(2.0,))),
}


@pytest.mark.parametrize("words", REFUSED)
def test_impossible_decks_are_refused(words: str, tmp_path: Path) -> None:
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


@pytest.mark.parametrize(
    ("deck", "words"),
    [
        (lambda: beside_fixture(5.0, TOP, "FIXTURE_PUNCH"), "which is on the same face"),
        (lambda: beside_fixture(8.0, TOP, "FIXTURE_PUNCH"), "pass through each other"),
        (lambda: plate(BALL, BALL), "apart"),
    ],
)
def test_both_bodies_are_shown(deck: Callable[[], Deck], words: str, tmp_path: Path) -> None:
    """The line of the other one, too: it may be in the deck of a restart."""
    _, text = said(deck(), tmp_path)
    assert re.search(rf"job.k:\d+: .*{words} \(see .*job.k:\d+\)\n", text), text


#: Cards with an error, as what follows one is not told
ERRORS = {
    "*CONTROL_TERMINATION: card 1 is missing": "",
    "*FIXTURE_BAR: card 2 is missing": "*FIXTURE_BAR\n1,-1,0.0,1.0\n",
    "RADIUS: 'wide' is not a number": "*IMPACTOR_CONE\n7,wide,1.0e-5,5.0,5.0,9.0\n45.0,1.0\n"
    "0.0,0.0,-1.0e3\n*CONTACT_IMPACTOR\n7,7,0,1\n",
    "RADIUS: 'round' is not": "*IMPACTOR_CYLINDER\n7,round,1.0e-5,5.0,5.0,9.0\n4.0,1.0\n"
    "0.0,0.0,-1.0e3\n*CONTACT_IMPACTOR\n7,7,0,1\n",
}


@pytest.mark.parametrize("words", ERRORS)
def test_no_error_follows_from_another(words: str, tmp_path: Path) -> None:
    """A field that is wrong or missing is compared with no other."""
    text = plate().text()
    if ERRORS[words]:
        text = text.replace("*END", ERRORS[words] + "*END")
    else:
        text = re.sub(r"(\*CONTROL_TERMINATION\n).*\n", r"\1", text)
    path = tmp_path / "job.k"
    path.write_text(text)
    ended = subprocess.run([SOLVER, "check", path], capture_output=True, text=True, check=False)
    assert ended.returncode == 2
    assert words in ended.stderr
    assert ended.stderr.endswith("\n1 error\n"), ended.stderr


def test_nothing_is_told_that_follows_from_an_error(tmp_path: Path) -> None:
    """A ball whose radius is wrong is not said to come too late."""
    code, text = said(plate(replace(BALL, radius=0.0)), tmp_path)
    assert code == 2
    assert "RADIUS cannot be 0" in text
    assert text.endswith("\n1 error\n")
