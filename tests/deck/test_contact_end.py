"""*CONTROL_END_OF_CONTACT ends a run some time after the last contact, which is estimated."""

from __future__ import annotations

import re
from copy import deepcopy
from pathlib import Path

import numpy as np
import pytest

from broken import said
from decks import Deck, Ply, Sphere
from elasticity import isotropic
from meshes import regular
from ranks import launch
from runs import Results, run, run_stage

SIDE, THICKNESS, RADIUS = 20.0, 1.0, 6.0
DENSITY, YOUNG, POISSON = 2.7e-9, 70.0e3, 0.3
#: Ten times the mass of the plate
MASS = 10.0 * DENSITY * SIDE**2 * THICKNESS
SPEED = 1.0e3
#: Displacement of the middle of a simply supported square under a force there, over F a^2 / D, and
#: of one with sides of 2 to 1, over F b^2 / D (Timoshenko and Woinowsky-Krieger, table 23)
SQUARE, TWO_TO_ONE = 0.01160, 0.01651
STIFFNESS = YOUNG * THICKNESS**3 / (12.0 * (1.0 - POISSON**2)) / (SQUARE * SIDE**2)
#: Half a period of the mass on this plate
DURATION = np.pi * np.sqrt(MASS / STIFFNESS)
#: Weight that brings a ball back which leaves at the speed at which it came
GRAVITY = -2.0 * SPEED / (0.5 * DURATION)
HEAD = "*KEYWORD\n*CONTROL_STAGE\n1\n*CONTROL_TERMINATION\n"


def impact(
    end: float,
    pause: float | None = None,
    gravity: float = 0.0,
    gap: float = 0.01,
    *,
    held: str = "z",
    mass: float = MASS,
    speed: float = SPEED,
    linear: bool = True,
    quads: int = 2,
) -> Deck:
    """A ball on a simply supported plate, or on one that is held otherwise.

    What the plate of the tables does wants 6 quads along a side.
    """
    mesh = regular(SIDE, SIDE, quads, quads, 9)
    deck = Deck("contact that ends", end)
    deck.control(linear=linear)
    if pause is not None:
        deck.add("CONTROL_END_OF_CONTACT", (pause,))
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(DENSITY, YOUNG, POISSON), THICKNESS)], order=1)
    deck.hold(mesh.boundary(), held)
    if held == "z":
        deck.hold([mesh.at(0.5 * SIDE, 0.5 * SIDE)], "xy")
    centre = (0.5 * SIDE, 0.5 * SIDE, RADIUS + 0.5 * THICKNESS + gap)
    deck.sphere(Sphere(RADIUS, mass, centre, (0.0, 0.0, -speed), guided=True, gravity=gravity))
    deck.intervals(impactor=0.0, glstat=DURATION)
    return deck


def contact_times(results: Results) -> tuple[np.ndarray, np.ndarray]:
    """Times of all steps, and of those with a force of contact."""
    table = results.table("impactor_1")
    return table["time"], table["time"][table["force"] > 0.0]


def test_run_ends_when_the_time_has_passed(tmp_path: Path) -> None:
    """With the step behind the first one that late, as the run without the card went up to it."""
    pause = 0.2 * DURATION
    whole = run(impact(2.0 * DURATION), tmp_path / "whole")
    times, touches = contact_times(whole)
    assert touches[-1] < 1.5 * DURATION
    ended = run(impact(2.0 * DURATION, pause), tmp_path / "ended")
    step = int(np.argmax(times >= touches[-1] + pause)) + 1
    assert np.array_equal(
        ended.table("impactor_1").values, whole.table("impactor_1").values[: step + 1]
    )
    assert "end after the contact: no impactor has touched the plate since" in ended.listing()
    assert "normal end" in ended.listing()


def test_contact_lasts_about_as_long_as_estimated(tmp_path: Path) -> None:
    """The listing has half a period of the ball on the plate of the tables; the run agrees."""
    results = run(impact(2.0 * DURATION, 0.2 * DURATION, quads=6), tmp_path)
    line = re.search(
        r"duration, about +([\d.E+-]+) s, half a period on a simply", results.listing()
    )
    assert line is not None, results.listing()
    # the tables have four digits, the series of the listing ends
    assert float(line[1]) == pytest.approx(DURATION, rel=2e-3)
    _, touches = contact_times(results)
    # a tenth of the ball moves with it, and its surface gives way
    assert touches[-1] - touches[0] == pytest.approx(DURATION, rel=0.1)


def test_large_displacement_makes_the_contact_shorter(tmp_path: Path) -> None:
    """Half a period of Duffing's oscillator, step by step; the run is shorter by a tenth or two.

    One half wave along each side is less than the peak below a point force.
    """
    speed = 40.0 * SPEED
    cubic = np.pi**4 * YOUNG * THICKNESS / (32.0 * SIDE**2)
    step, place, motion, steps = 1.0e-4 * DURATION, 0.0, speed, 0
    while place >= 0.0:
        motion -= step * (STIFFNESS * place + cubic * place**3) / MASS
        place += step * motion
        steps += 1
    half = step * steps
    assert half < 0.65 * DURATION
    deck = impact(DURATION, 0.2 * DURATION, speed=speed, linear=False, quads=6)
    results = run(deck, tmp_path)
    line = re.search(r"duration, about +([\d.E+-]+) s", results.listing())
    assert line is not None, results.listing()
    assert float(line[1]) == pytest.approx(half, rel=2e-3)
    _, touches = contact_times(results)
    assert touches[-1] - touches[0] == pytest.approx(half, rel=0.2)


def test_rebound_that_hits_again_begins_the_time_anew(tmp_path: Path) -> None:
    """The weight brings the ball back before a long time has passed, and after a short one."""
    end = 4.0 * DURATION
    times, touches = contact_times(run(impact(end, gravity=GRAVITY), tmp_path / "whole"))
    flights = np.diff(touches)
    first = int(np.argmax(flights > 0.1 * DURATION))
    assert flights[first] > 0.1 * DURATION
    for share, last in ((0.5, touches[first]), (1.1, None)):
        pause = share * flights[first]
        job = f"ended{share}"
        found, _ = contact_times(run(impact(end, pause, GRAVITY), tmp_path / job))
        if last is None:
            assert found[-1] > touches[first + 1] + pause or found[-1] == times[-1]
            assert found[-1] > touches[first] + pause
        else:
            assert last + pause < found[-1] < touches[first + 1]


def test_impactor_that_stays_ends_at_the_end(tmp_path: Path) -> None:
    """A contact that lasts until the end is not over, however short the time."""
    end = 0.5 * DURATION
    times, touches = contact_times(run(impact(end, 0.05 * DURATION), tmp_path))
    assert times[-1] == pytest.approx(end, rel=1e-9)
    assert touches[-1] == times[-1]


def test_impactor_that_never_comes_ends_at_the_end(tmp_path: Path) -> None:
    """Before the first contact no time counts."""
    end = 0.2 * DURATION
    times, touches = contact_times(run(impact(end, 1.0e-9, gap=2.0 * SPEED * end), tmp_path))
    assert touches.size == 0
    assert times[-1] == pytest.approx(end, rel=1e-9)


def test_all_impactors_must_have_touched(tmp_path: Path) -> None:
    """A second ball that comes later is waited for."""
    pause, late = 0.1 * DURATION, 1.5 * DURATION
    deck = impact(4.0 * DURATION, pause)
    centre = (0.5 * SIDE, 0.5 * SIDE, -RADIUS - 0.5 * THICKNESS - SPEED * late)
    deck.sphere(Sphere(RADIUS, MASS, centre, (0.0, 0.0, SPEED), guided=True, face=-1), number=2)
    results = run(deck, tmp_path)
    other = results.table("impactor_2")
    touches = other["time"][other["contacts"] > 0]
    _, first = contact_times(results)
    gone = max(touches[-1], first[-1])
    assert touches[0] > 0.95 * late
    assert gone + pause < other["time"][-1] < gone + 1.1 * pause


def test_restart_ends_at_the_same_step(tmp_path: Path) -> None:
    """The time of the last contact is in the restart files: before, in and after the contact."""
    written = impact(2.0 * DURATION, 0.2 * DURATION, gap=0.4 * SPEED * DURATION)
    table = run(written, tmp_path / "whole").table("impactor_1")
    steps = len(table["time"]) - 1
    touches = np.flatnonzero(table["force"] > 0.0)
    cycles = steps // 10, steps // 2, int(touches[-1] + steps) // 2
    assert cycles[0] < touches[0] < cycles[1] < touches[-1] < cycles[2]
    for cycle in cycles:
        folder = tmp_path / str(cycle)
        folder.mkdir()
        deck = deepcopy(written)
        deck.add("DATABASE_BINARY_D3DUMP", (cycle,))
        code, text = said("run", deck.write(folder / "job.k"), "-o", folder)
        assert code == 0, text
        code, text = said("restart", folder / "job.dump01")
        assert code == 0, text
        gone_on = Results(folder, "job").table("impactor_1").values
        assert np.array_equal(gone_on, table.values)


def test_ranks_end_at_the_same_step(tmp_path: Path) -> None:
    """Two ranks agree, and have the bits of one."""
    deck = impact(2.0 * DURATION, 0.2 * DURATION)
    one = run(deck, tmp_path / "one").table("impactor_1").values
    done = launch(2, "run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert done.returncode == 0, done.stderr
    assert np.array_equal(Results(tmp_path, "job").table("impactor_1").values, one)


def second_ball(first: Results, pause: str, job: str) -> Results:
    """A stage that removes the ball and brings another one."""
    lines = impact(DURATION).text().split("*")
    sphere = next(line for line in lines if line.startswith("IMPACTOR"))
    contact = next(line for line in lines if line.startswith("CONTACT_I"))
    sphere, contact = sphere.replace("\n1,", "\n2,", 1), contact.replace("\n1,1,", "\n2,2,", 1)
    end = f"*CONTROL_TERMINATION\n{3.0 * DURATION},\n"
    return run_stage(first, f"{end}*DELETE_IMPACTOR\n1\n*{sphere}*{contact}{pause}", job)


def test_stage_waits_for_its_own_impactor(tmp_path: Path) -> None:
    """The ball of the stage has not touched yet; DUR 0 takes the end back."""
    pause = 0.2 * DURATION
    deck = impact(2.0 * DURATION, pause)
    deck.add("DATABASE_BINARY_D3DUMP", (1_000_000,))
    first = run(deck, tmp_path)
    start = first.table("impactor_1")["time"][-1]
    again = second_ball(first, "", "again").table("impactor_2")
    touches = again["time"][again["force"] > 0.0]
    assert touches.size > 0
    assert touches[-1] + pause < again["time"][-1] < touches[-1] + 1.1 * pause
    free = second_ball(first, "*CONTROL_END_OF_CONTACT\n0.0,\n", "free").table("impactor_2")
    assert free["time"][-1] == pytest.approx(start + 3.0 * DURATION, rel=1e-9)


def test_card_without_an_impactor_is_told(tmp_path: Path) -> None:
    """It would be without effect."""
    text = re.sub(
        r"\*IMPACTOR_SPHERE\n.*\n.*\n\*CONTACT_IMPACTOR\n.*\n", "", impact(1.0, 1.0).text()
    )
    path = tmp_path / "job.k"
    path.write_text(text.replace("*DATABASE_IMPACTOR\n0.0,\n", ""))
    code, said_words = said("check", path)
    assert code == 0, said_words
    assert "DUR is without effect" in said_words


def quarter(end: float) -> Deck:
    """A quarter of the plate and of the ball."""
    half = 0.5 * SIDE
    mesh = regular(half, half, 3, 3, 9)
    deck = Deck("a quarter", end)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(DENSITY, YOUNG, POISSON), THICKNESS)], order=1)
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(mesh.where(y=0.0), "y")
    deck.hold({*mesh.where(x=half), *mesh.where(y=half)}, "z")
    centre = (0.0, 0.0, RADIUS + 0.5 * THICKNESS + 0.01)
    deck.sphere(Sphere(RADIUS, 0.25 * MASS, centre, (0.0, 0.0, -SPEED), guided=True))
    return deck


def based(end: float, window: tuple[float, float]) -> Deck:
    """The ball on a plate that lies on a base with a window."""
    mesh = regular(2.0 * SIDE, 2.0 * SIDE, 12, 12, 9)
    deck = Deck("on a base", end)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(isotropic(DENSITY, YOUNG, POISSON), THICKNESS)], order=1)
    deck.add("FIXTURE_PLANE", (1, -1), (1, SIDE, SIDE, *window))
    centre = (SIDE, SIDE, RADIUS + 0.5 * THICKNESS + 0.01)
    deck.sphere(Sphere(RADIUS, MASS, centre, (0.0, 0.0, -SPEED), guided=True))
    return deck


def estimate(deck: Deck, folder: Path) -> tuple[float, str]:
    """The duration that a check prints, and all that it prints."""
    code, text = said("check", deck.write(folder / "job.k"))
    assert code == 0, text
    found = re.search(r"duration, about +([\d.E+-]+) s", text)
    assert found is not None, text
    return float(found[1]), text


def test_estimate_is_that_of_the_whole_plate(tmp_path: Path) -> None:
    """A quarter has a quarter of the mass and of the force."""
    found, _ = estimate(quarter(2.0 * DURATION), tmp_path)
    assert found == pytest.approx(DURATION, rel=2e-3)


def test_estimate_takes_the_window_of_a_base(tmp_path: Path) -> None:
    """The next nodes on the base are the edge of the window, a square and one of two to one."""
    found, text = estimate(based(2.0 * DURATION, (SIDE, SIDE)), tmp_path)
    assert found == pytest.approx(DURATION, rel=2e-3)
    assert "plate of 20.0 x 20.0 mm" in text
    found, _ = estimate(based(2.0 * DURATION, (0.5 * SIDE, SIDE)), tmp_path)
    ratio = np.sqrt(TWO_TO_ONE * 0.5**2 / SQUARE)
    assert found == pytest.approx(ratio * DURATION, rel=2e-3)


def test_short_run_is_told(tmp_path: Path) -> None:
    """An end before that of the contact is a warning, a later one is none."""
    way = 0.01 / SPEED
    _, text = estimate(impact(0.9 * (DURATION + way)), tmp_path)
    assert "warning: impactor 1 will touch the plate for about" in text
    assert "right would be ENDTIM of *CONTROL_TERMINATION above" in text
    _, text = estimate(impact(1.1 * (DURATION + way)), tmp_path)
    assert "will touch the plate" not in text


def test_nothing_is_estimated_where_the_formula_is_none(tmp_path: Path) -> None:
    """A plate that flies freely, and a ball that is lighter than the plate."""
    for name, deck in (
        ("free", impact(DURATION, held="x")),
        ("light", impact(DURATION, mass=0.05 * MASS)),
    ):
        code, words = said("check", deck.write(tmp_path / f"{name}.k"))
        assert code == 0, words
        assert "duration, about" not in words
