"""The listing of a quasi-static deck has its loading rate: waves, periods, kinetic energy."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from brick_decks import add_bricks, box
from broken import said
from decks import Deck, Ply
from elasticity import Material, isotropic
from meshes import regular
from runs import Results, run, run_stage

NORMAL = 0
DENSITY, YOUNG, LENGTH, WIDTH, THICKNESS = 1.0e-9, 1.0e3, 10.0, 6.0, 0.5
WAVE = float(np.sqrt(YOUNG / DENSITY))
TRANSIT = LENGTH / WAVE
STRAIN = 0.01
SHARE = 0.05
#: The listing has six digits
DIGITS = 1.0e-5
#: A motion is looked at in a thousand instants
INSTANTS = 3.0e-3


def pulled(
    passages: float,
    shape: list[tuple[float, float]],
    *,
    velocity: bool = False,
    rest: float = 0.0,
    axis: int = 1,
    share: float = SHARE,
    scaled: float = 0.0,
) -> Deck:
    """A strip whose end is pulled along a curve, (share of the time, share of the way)."""
    end = passages * TRANSIT
    length, width = (LENGTH, WIDTH) if axis == 1 else (WIDTH, LENGTH)
    mesh = regular(length, width, 5, 3, 4)
    deck = Deck("pulled", end * (1.0 + rest))
    deck.control(linear=True, scaled=scaled)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(DENSITY, YOUNG, 0.0), THICKNESS)], order=1)
    near, far = (mesh.where(x=at) if axis == 1 else mesh.where(y=at) for at in (0.0, LENGTH))
    deck.hold(near, "xyz")
    curve = deck.curve([(end * t, y) for t, y in shape])
    quantity, factor = (0, STRAIN * LENGTH / end) if velocity else (2, STRAIN * LENGTH)
    card = (deck.node_set(far), axis, quantity, curve, factor)
    deck.add("BOUNDARY_PRESCRIBED_MOTION_SET", card)
    deck.add("CONTROL_QUASI_STATIC", (share,))
    return deck


def checked(deck: Deck, folder: Path) -> str:
    """What `plydyn check` says of a deck."""
    code, text = said("check", deck.write(folder / "deck.k"))
    assert code == NORMAL, text
    return text


def number(text: str, label: str) -> float:
    """A number of the section, by the words before it."""
    section = text.split("\nLoading rate\n")[1]
    found = re.search(rf"^{label} +([\d.E+-]+)", section, re.MULTILINE)
    assert found is not None, section
    return float(found[1])


def passages(text: str) -> float:
    """Passages of a wave in the loading time."""
    found = re.search(r"([\d.]+) passages of a wave\n", text)
    assert found is not None, text
    return float(found[1])


STEADY = [(0.0, 0.0), (1.0, 1.0)]
TIMES = np.linspace(0.0, 1.0, 2001)
SMOOTH = [(float(t), float(t**3 * (10.0 - 15.0 * t + 6.0 * t**2))) for t in TIMES]


@pytest.mark.parametrize("axis", [1, 2])
def test_waves_of_a_strip(axis: int, tmp_path: Path) -> None:
    """Speed sqrt(E/rho), time L/c, rho c v, and the period of a simply supported rectangle."""
    text = checked(pulled(40.0, STEADY, axis=axis), tmp_path)
    speed = STRAIN * LENGTH / (40.0 * TRANSIT)
    assert f"along {'xy'[axis - 1]}, " in text
    assert number(text, "largest speed") == pytest.approx(speed, rel=DIGITS)
    assert number(text, "stress behind a wave of it") == pytest.approx(
        DENSITY * WAVE * speed, rel=DIGITS
    )
    assert number(text, "length of the plate") == pytest.approx(LENGTH, rel=DIGITS)
    assert number(text, "speed of a wave along it") == pytest.approx(WAVE, rel=DIGITS)
    assert number(text, "time of a wave along it") == pytest.approx(TRANSIT, rel=DIGITS)
    assert number(text, "loading time") == pytest.approx(40.0 * TRANSIT, rel=DIGITS)
    assert passages(text) == 40.0
    rigidity = YOUNG * THICKNESS**3 / 12.0
    rate = np.pi**2 * (LENGTH**-2 + WIDTH**-2) * np.sqrt(rigidity / (DENSITY * THICKNESS))
    assert number(text, "first period, about") == pytest.approx(2.0 * np.pi / rate, rel=DIGITS)


def test_wave_of_the_coupon_of_compression_after_impact(tmp_path: Path) -> None:
    """T700/M21, 150 x 100 x 4.16 mm at 62.5 mm/s: 27 us, 0.55 MPa, 1371 Hz, by other programs."""
    ply = Material(1.58e-9, (121.0e3, 9.2e3, 9.2e3), (0.3, 0.3, 0.4), (5.1e3, 5.1e3, 3.3e3))
    half = [(0.52, angle) for angle in (0.0, 45.0, 90.0, -45.0)]
    mesh = regular(150.0, 100.0, 6, 4, 4)
    deck = Deck("coupon", 0.016)
    deck.control()
    deck.mesh(mesh)
    deck.laminate([Ply(ply, *one) for one in (*half, *half[::-1])], order=1)
    deck.hold(mesh.where(x=0.0), "xyz")
    deck.move(mesh.where(x=150.0), 1, deck.curve([(0.0, 0.0), (0.016, -1.0)]), 1.0)
    deck.add("CONTROL_QUASI_STATIC", (SHARE,))
    text = checked(deck, tmp_path)
    assert number(text, "largest speed") == pytest.approx(62.5, rel=DIGITS)
    assert number(text, "time of a wave along it") == pytest.approx(27.0e-6, rel=0.02)
    assert number(text, "stress behind a wave of it") == pytest.approx(0.55, rel=0.02)
    assert 1.0 / number(text, "first period, about") == pytest.approx(1371.0, rel=0.05)


@pytest.mark.parametrize(
    ("shape", "velocity"),
    [(STEADY, False), ([(0.0, 1.0), (1.0, 1.0)], True)],
    ids=["displacement", "velocity"],
)
def test_kinetic_energy_of_a_steady_pull(
    shape: list[tuple[float, float]], velocity: bool, tmp_path: Path
) -> None:
    """(transit/t)^2 / 3 at a tenth of the time; above SHARE there is a warning with a time."""
    text = checked(pulled(40.0, shape, velocity=velocity), tmp_path)
    expected = (1.0 / 4.0) ** 2 / 3.0
    found = number(text, "kinetic over internal energy")
    assert found == pytest.approx(expected, rel=INSTANTS)
    assert "warning" not in text
    text = checked(pulled(20.0, shape, velocity=velocity), tmp_path)
    least = 10.0 / np.sqrt(3.0 * SHARE)
    assert f"{least:.0f} passages, at least" in text
    assert "moves within 20.0 passages" in text
    assert "warning" not in checked(pulled(20.0, shape, velocity=velocity, share=0.1), tmp_path)


def test_kinetic_energy_of_a_smooth_pull(tmp_path: Path) -> None:
    """(v L / c d)^2 / 3 of 10 s^3 - 15 s^4 + 6 s^5 at s = 0.1; the limit is 73 passages."""
    way, speed = 0.00856, 30.0 * 0.01 * 0.81
    exact = (speed / way) ** 2 / 3.0
    text = checked(pulled(80.0, SMOOTH), tmp_path)
    assert number(text, "kinetic over internal energy") == pytest.approx(
        exact / 6400.0, rel=INSTANTS
    )
    assert "warning" not in text
    text = checked(pulled(60.0, SMOOTH), tmp_path)
    assert f"{np.sqrt(exact / SHARE):.0f} passages, at least" in text


def test_rest_after_the_pull_is_no_loading(tmp_path: Path) -> None:
    """The loading time ends with the curve's last change."""
    text = checked(pulled(40.0, [*STEADY, (1.5, 1.0)], rest=1.0), tmp_path)
    assert passages(text) == 40.0


def test_added_mass_slows_the_wave(tmp_path: Path) -> None:
    """By the root of the ratio of masses."""
    deck = pulled(40.0, STEADY, scaled=1.0e-6)
    text = checked(deck, tmp_path)
    row = next(line for line in text.splitlines() if line.split()[:1] == ["all"]).split()
    ratio = 1.0 + float(row[2]) / float(row[1])
    assert ratio > 2.0
    assert number(text, "speed of a wave along it") == pytest.approx(WAVE / ratio**0.5, rel=DIGITS)


def test_bricks_have_waves_and_no_period(tmp_path: Path) -> None:
    """The speed is that of their material."""
    deck = Deck("bricks", 40.0 * TRANSIT)
    deck.control(linear=True)
    mesh = box((LENGTH, WIDTH, 2.0), (5, 3, 1))
    add_bricks(deck, mesh, lambda deck: deck.add("MAT_ELASTIC", (1, DENSITY, YOUNG, 0.0)))
    ends = [np.flatnonzero(np.abs(mesh.points[:, 0] - x) < 1.0e-9) for x in (0.0, LENGTH)]
    deck.hold(ends[0], "xyz")
    deck.move(ends[1], 1, deck.curve([(0.0, 0.0), (40.0 * TRANSIT, 1.0)]), STRAIN * LENGTH)
    deck.add("CONTROL_QUASI_STATIC", (SHARE,))
    text = checked(deck, tmp_path)
    assert number(text, "speed of a wave along it") == pytest.approx(WAVE, rel=DIGITS)
    assert "first period" not in text


def test_only_quasi_static_decks_have_the_section(tmp_path: Path) -> None:
    """Neither one without the keyword, nor one that is loaded through its thickness."""
    without = pulled(40.0, STEADY, share=0.0)
    assert "Loading rate" not in checked(without, tmp_path)
    deck = Deck("pressed", 1.0e-3)
    mesh = regular(LENGTH, WIDTH, 5, 3, 4)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(DENSITY, YOUNG, 0.0), THICKNESS)], order=1)
    deck.hold(mesh.where(x=0.0), "xyz")
    deck.move(mesh.where(x=LENGTH), 3, deck.curve([(0.0, 0.0), (1.0e-3, 1.0)]), 1.0)
    deck.add("CONTROL_QUASI_STATIC", (SHARE,))
    assert "Loading rate" not in checked(deck, tmp_path)


def test_stage_has_its_own_rate(tmp_path: Path) -> None:
    """The curve of a stage begins with it; the monitor of the run agrees with what was expected."""
    deck = pulled(40.0, [(0.0, 0.0), (1.0, 0.0)])
    deck.add("DATABASE_BINARY_D3DUMP", (999999999,))
    before: Results = run(deck, tmp_path, "still")
    end = 30.0 * TRANSIT
    body = (
        f"*CONTROL_TERMINATION\n{end!r},\n*DEFINE_CURVE\n90\n0.0,0.0\n{end!r},1.0\n"
        f"*BOUNDARY_SPC_SET\n1,0,1,1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n2,1,2,90,{0.1!r}\n"
    )
    text = run_stage(before, body, "pulled").listing()
    assert passages(text) == 30.0
    assert number(text, "kinetic over internal energy") == pytest.approx(1.0 / 27.0, rel=INSTANTS)
