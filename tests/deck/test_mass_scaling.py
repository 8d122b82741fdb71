"""DT2MS of *CONTROL_TIMESTEP: mass for elements whose stable step is too small."""

from __future__ import annotations

import re
import shutil
from collections.abc import Sequence
from pathlib import Path

import h5py
import numpy as np
import pytest

from brick_decks import add_bricks, box
from broken import impact, said, unlike
from decks import Deck, Ply, Sphere, ramp
from elasticity import Array, isotropic
from meshes import Mesh, distorted, regular
from ranks import launch
from runs import Results, run

NORMAL, INPUT = 0, 2
#: Without Poisson's ratio the thickness h of a ply of order 1, thin against its quads, has the
#: stable step h/c exactly
DENSITY, YOUNG = 1.0e-9, 1.0e3
SPEED = float(np.sqrt(YOUNG / DENSITY))
MATERIAL = isotropic(DENSITY, YOUNG, 0.0)
#: Share by which the proof of an eigenvalue lies above it
PROOF = 1.002
#: Numbers of the table of masses have seven digits behind the point, steps five
MASS_DIGITS, STEP_DIGITS = 1.0e-7, 1.0e-5
SIDE = 10.0
#: Round-off of a run, as a share
ROUND_OFF = 1.0e-9


def rows(listing: str) -> dict[str, Array]:
    """Table of the masses: mass, added mass, per cent, elements, those with more, largest ratio."""
    table = listing.split("\nMass scaling\n")[-1].split("\npart")[1].split("\n\n")[0]
    lines = [line.split() for line in table.splitlines()[2:]]
    return {line[0]: np.array(line[1:], float) for line in lines}


def number(listing: str, label: str) -> float:
    """A number of the listing, by the words before it."""
    found = re.search(rf"^{label} +([\d.Ee+-]+)", listing, re.MULTILINE)
    assert found is not None, listing
    return float(found[1])


def plate(mesh: Mesh, plies: Sequence[float], scaled: float, **options: float) -> Deck:
    """Plies of some thicknesses."""
    deck = Deck("scaled", 1.0e-4)
    deck.control(linear=True, scaled=scaled, **options)
    deck.mesh(mesh)
    deck.laminate([Ply(MATERIAL, thickness) for thickness in plies], order=1)
    return deck


def checked(deck: Deck, folder: Path) -> str:
    """What `plydyn check` says of a deck."""
    code, text = said("check", deck.write(folder / "deck.k"))
    assert code == NORMAL, text
    return text


def test_step_and_added_mass_of_a_plate(tmp_path: Path) -> None:
    """Each ply gets DT2MS^2 over h^2/c^2 of its mass, and the step is TSSFAC |DT2MS|.

    The eigenvalue that is proved is at most 0.2 % above the exact one.
    """
    thin, thick, wanted, share = 0.5, 1.0, 2.0e-6, 0.9
    deck = plate(regular(SIDE, SIDE, 5, 5, 4), (thin, thick, thin), wanted, share=share)
    text = checked(deck, tmp_path)
    assert number(text, "largest step taken") == pytest.approx(share * wanted, rel=STEP_DIGITS)
    ratio = {h: (wanted * SPEED / h) ** 2 for h in (thin, thick)}
    own, added, per_cent, elements, raised, largest = rows(text)["1"]
    per_area = DENSITY * SIDE**2
    exact = per_area * (2.0 * thin * (ratio[thin] - 1.0) + thick * (ratio[thick] - 1.0))
    above = per_area * (2.0 * thin * ratio[thin] + thick * ratio[thick]) * (PROOF - 1.0)
    assert own == pytest.approx(per_area * (2.0 * thin + thick), rel=MASS_DIGITS)
    assert exact <= added <= (exact + above) * (1.0 + MASS_DIGITS)
    assert per_cent == pytest.approx(100.0 * added / own, rel=1e-5)
    assert (elements, raised) == (75, 75)
    # four digits behind the point are printed
    assert ratio[thin] <= largest + 1e-4 <= PROOF * ratio[thin] + 2e-4
    total = number(text, "mass of the plate")
    assert total == pytest.approx(own + added, rel=2.0 * MASS_DIGITS)


def test_only_elements_below_the_step_get_mass(tmp_path: Path) -> None:
    """Of two parts side by side only the stiff one, of plies only the thin one."""
    mesh = regular(SIDE, SIDE, 4, 4, 4)
    wanted, times = 0.75e-6, 4.0
    deck = Deck("two parts", 1.0e-4)
    deck.control(linear=True, scaled=wanted)
    deck.mesh(mesh, (1, 1, 2, 2))
    deck.laminate([Ply(MATERIAL, 1.0)] * 2, order=1)
    deck.laminate([Ply(isotropic(DENSITY, times * YOUNG, 0.0), 1.0)] * 2, order=1, part=2)
    table = rows(checked(deck, tmp_path))
    assert table["1"][1:].tolist() == [0.0, 0.0, 16.0, 0.0, 1.0]
    own = SIDE**2 * DENSITY
    added = own * (times * (wanted * SPEED) ** 2 - 1.0)
    assert added <= table["2"][1] <= PROOF * (added + own)
    assert table["2"][4] == 16.0
    np.testing.assert_allclose(table["all"][:2], table["1"][:2] + table["2"][:2], rtol=1e-6)
    deck = plate(mesh, (0.5, 2.0), 1.0e-6)
    own, added, _, elements, raised, _ = rows(checked(deck, tmp_path))["1"]
    assert (elements, raised) == (32.0, 16.0)
    exact = SIDE**2 * DENSITY * 0.5 * 3.0
    assert exact <= added <= exact + own * 4.0 * (PROOF - 1.0)


@pytest.mark.parametrize("plies", [1, 2])
def test_quads_with_cracks_keep_mass_and_step(plies: int, tmp_path: Path) -> None:
    """Quads that may crack take no mass: the step stays theirs, whatever the deck asks for.

    So does that of their springs. Other elements of the same size and material are as fast, and
    need no mass for that step.
    """
    mesh = regular(6.0, 6.0, 6, 6, 4)
    steps, texts = [], []
    for scaled in (0.0, 1.0e-6):
        deck = Deck("cracks", 1.0e-4)
        deck.control(linear=True, scaled=scaled)
        deck.mesh(mesh, [1] * 18 + [2] * 18)
        for part in (1, 2):
            deck.laminate([Ply(MATERIAL, 0.25)] * plies, order=1, part=part)
        if plies > 1:
            deck.add("MAT_COHESIVE_ELASTIC", (100, 0.0, 0, 0, 2.0e4, 2.0e4))
            deck.add("INTERFACE_COHESIVE", (1, 0, 0, 100), (2, 0, 0, 100))
        deck.add("CRACK_LINES", (2, 1.0, 0.3), (60.0, 110.0, 75.0))
        texts.append(checked(deck, tmp_path))
        steps.append(number(texts[-1], "stable step"))
    assert 0.0 < steps[0] < 1.0e-6
    assert steps[1] == steps[0]
    assert number(texts[1], "no more than") == pytest.approx(steps[0], rel=STEP_DIGITS)
    assert rows(texts[1])["1"][1] == 0.0


def test_no_mass_where_no_element_needs_any(tmp_path: Path) -> None:
    """The run is that without the field, to the last bit."""
    mesh = regular(SIDE, SIDE, 3, 3, 4)
    for name, scaled in (("without", 0.0), ("with", 1.0e-7)):
        deck = plate(mesh, (1.0,), scaled)
        deck.hold(mesh.where(x=0.0), "xyz")
        deck.velocity(mesh.where(x=SIDE), (10.0, 0.0, 10.0))
        (tmp_path / name).mkdir()
        code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path / name)
        assert code == NORMAL, text
        assert "warning" not in text
    listing = (tmp_path / "with" / "job.out").read_text()
    assert "no mass is added: no element has a smaller step" in listing
    assert unlike(tmp_path / "without", tmp_path / "with") == []


def vibrating(folder: Path, scheme: int, times: float, step: float) -> Results:
    """A strip of plies joined by springs, or tied, that swings; times as slowly."""
    mesh = regular(4.0 * SIDE, SIDE, 8, 2, 4)
    deck = Deck("swings", 2.0e-4 * times)
    deck.control(linear=True, scheme=scheme, damping=500.0 / times, scaled=step, share=0.5)
    deck.mesh(mesh)
    deck.laminate([Ply(MATERIAL, 1.0)] * 4, order=2)
    if scheme < 2:
        deck.interfaces(1.0e4, 5.0e3)
    deck.hold(mesh.where(x=0.0), "xyz")
    deck.velocity(mesh.where(x=4.0 * SIDE), (40.0 / times, 0.0, 100.0 / times))
    curve = deck.curve([(0.0, 0.0), (2.0e-4 * times, 1.0)])
    deck.add("LOAD_FACE_PRESSURE", (0, -1, curve, 0.01))
    deck.histories([mesh.at(4.0 * SIDE, 0.0)], 0.0)
    return run(deck, folder)


@pytest.mark.parametrize("scheme", [0, 1, 2])
def test_scaled_motion_is_the_slower_one(scheme: int, tmp_path: Path) -> None:
    """The same displacements k times as late: loads k times as slow, velocities, damping 1/k.

    The strip is alike everywhere, so that all elements have the same eigenvalue: all masses grow by
    k^2, and so does the inertia of implicit operators, as steps grow by k.
    """
    plain = vibrating(tmp_path / "plain", scheme, 1.0, 0.0)
    steps = plain.table("energy")["step"]
    times = 3.0
    # the step taken is half of the stable one
    scaled = vibrating(tmp_path / "scaled", scheme, times, 2.0 * times * steps[2])
    one, other = (each.table("nodes") for each in (plain, scaled))
    assert len(one.values) == len(other.values)
    np.testing.assert_allclose(other["time"], times * one["time"], rtol=1e-8)
    for name in [name for name in one.names if "displacement" in name or name.startswith("u")]:
        # ten digits of steps, over hundreds of them
        np.testing.assert_allclose(other[name], one[name], atol=1e-6 * np.abs(one[name]).max())
    energy, slow = plain.table("energy"), scaled.table("energy")
    np.testing.assert_allclose(slow["internal"][1:], energy["internal"][1:], rtol=1e-5, atol=1e-9)
    np.testing.assert_allclose(slow["kinetic"], energy["kinetic"], rtol=1e-5, atol=1e-9)
    # the last steps are shorter, and where damping acts the balance is of first order in that
    assert np.abs(slow["error"][:-2]).max() < ROUND_OFF


def test_free_flight_has_the_momentum_of_all_mass(tmp_path: Path) -> None:
    """Momentum, kinetic energy and weight are those of the mass of the listing.

    A plate of unlike elements falls freely without strain: added mass has weight.
    """
    mesh = distorted(regular(SIDE, SIDE, 4, 4, 9), 0.3)
    gravity, speed = 1.0e6, 50.0
    deck = plate(mesh, (0.5, 1.0), 2.0e-6)
    curve = deck.curve([(0.0, 1.0), (1.0, 1.0)])
    deck.add("LOAD_BODY_Z", (curve, gravity))
    deck.velocity(range(len(mesh.points)), (speed, 0.0, 0.0))
    results = run(deck, tmp_path)
    text = results.listing()
    own, added = rows(text)["all"][:2]
    assert added > own
    energy = results.table("energy")
    moved = energy["momentum x"]
    np.testing.assert_allclose(moved, (own + added) * speed, rtol=5.0 * MASS_DIGITS)
    fallen = (own + added) * gravity * energy["time"]
    np.testing.assert_allclose(energy["momentum z"], -fallen, rtol=1e-6)
    assert np.abs(energy["internal"]).max() < 1e-15 * energy["kinetic"].max()
    assert np.abs(energy["error"]).max() < ROUND_OFF


@pytest.mark.parametrize("scheme", [0, 1, 2])
def test_impact_on_unlike_elements(scheme: int, tmp_path: Path) -> None:
    """Momentum goes from the ball to a free plate, with its added mass, and the balance closes.

    The step is 0.99 of what is proved: an unstable one would show within the steps of the run.
    """
    mesh = distorted(regular(SIDE, SIDE, 5, 5, 4), 0.3)
    deck = Deck("hit", 3.0e-4)
    deck.control(linear=True, scaled=2.5e-6, share=0.99, scheme=scheme)
    deck.mesh(mesh)
    deck.laminate([Ply(MATERIAL, h) for h in (0.5, 1.0, 0.7)], order=1)
    deck.interfaces(2.0e3, 1.0e3)
    mass, speed, radius = 5.0e-6, 2.0e3, 8.0
    deck.sphere(Sphere(radius, mass, (5.0, 4.0, radius + 1.11), (0.0, 0.0, -speed)))
    deck.intervals(glstat=0.0, impactor=0.0)
    results = run(deck, tmp_path)
    energy = results.table("energy")
    assert results.table("impactor_1")["force"].max() > 0.0
    np.testing.assert_allclose(energy["momentum z"], -mass * speed, rtol=1e-8)
    assert np.abs(energy["error"]).max() < ROUND_OFF
    ratio = np.abs(energy["half-step correction"]) / energy["total"]
    assert ratio.max() < 0.5, ratio.max()


def test_bricks_get_mass(tmp_path: Path) -> None:
    """Bars of bricks whose cross-section is free: each by the ratio of its eigenvalues."""
    size, wanted = (8.0, 2.0, 1.0), 2.0e-6
    speed = 30.0
    deck = Deck("bricks", 2.0e-5)
    deck.control(linear=True, scaled=wanted)
    mesh = box(size, (4, 2, 2))
    add_bricks(deck, mesh, lambda deck: deck.add("MAT_ELASTIC", (1, DENSITY, YOUNG, 0.0)))
    deck.velocity(range(len(mesh.points)), (speed, 0.0, 0.0))
    results = run(deck, tmp_path)
    text = results.listing()
    assert number(text, "largest step taken") == pytest.approx(0.9 * wanted, rel=STEP_DIGITS)
    own, added, _, elements, raised, largest = rows(text)["1"]
    assert own == pytest.approx(DENSITY * np.prod(size), rel=MASS_DIGITS)
    assert (elements, raised) == (16.0, 16.0)
    before = number(text, "stable step without it")
    assert largest == pytest.approx((wanted / before) ** 2, abs=1e-3)
    assert added == pytest.approx(own * (largest - 1.0), rel=1e-4)
    momentum = results.table("energy")["momentum x"]
    np.testing.assert_allclose(momentum, (own + added) * speed, rtol=5.0 * MASS_DIGITS)


def test_slow_tension_does_not_feel_the_mass(tmp_path: Path) -> None:
    """The reaction of a strip that is pulled slowly is E A u/L, as closely as it is at rest."""
    length, width, thickness, stretch = 40.0, 10.0, 1.0, 0.01
    mesh = regular(length, width, 8, 2, 4)
    end = 400.0 * length / SPEED
    wanted = 4.0 * thickness / SPEED
    deck = Deck("pulled", end)
    deck.control(linear=True, scaled=wanted)
    deck.add("CONTROL_QUASI_STATIC", (0.05,))
    deck.mesh(mesh)
    deck.laminate([Ply(MATERIAL, thickness)], order=1)
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(range(len(mesh.points)), "yz")
    deck.move(mesh.where(x=length), 1, deck.curve(ramp(end, 100)), stretch)
    deck.intervals(spcforc=0.0)
    results = run(deck, tmp_path)
    text = results.listing()
    assert rows(text)["all"][2] > 1000.0
    assert "warning" not in text, "the kinetic energy is watched"
    largest = re.search(r"at most ([\d.Ee+-]+) of the internal one", text)
    assert largest is not None
    assert float(largest[1]) < 0.05
    supports = results.table("supports")
    name = next(name for name in supports.names if name.endswith("x") and "1" in name)
    force = abs(supports[name][-1])
    energy = results.table("energy")
    swing = np.sqrt(energy["kinetic"][-1] / energy["internal"][-1])
    exact = YOUNG * width * thickness * stretch / length
    assert force == pytest.approx(exact, rel=max(4.0 * swing, 1e-6))
    assert swing < 0.02


def test_much_mass_is_warned_of(tmp_path: Path) -> None:
    """Above 5 % of the mass, unless the deck asks for a watch on the kinetic energy."""
    mesh = regular(SIDE, SIDE, 3, 3, 4)
    for ratio, is_told in ((1.04, False), (1.06, True)):
        text = checked(plate(mesh, (1.0,), np.sqrt(ratio) / SPEED), tmp_path)
        assert ("warning: mass scaling (DT2MS of *CONTROL_TIMESTEP) adds" in text) == is_told, text
    deck = plate(mesh, (1.0,), 2.0 / SPEED)
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == NORMAL, text
    assert text.count("warning: mass scaling") == 1
    assert Results(tmp_path, "job").listing().count("warning: mass scaling") == 1


STAGE = "*KEYWORD\n*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,{scaled}\n{body}*END\n"


def first_stage(folder: Path, scaled: float = 0.0) -> Path:
    """Restart file of a strip that swings."""
    mesh = regular(4.0 * SIDE, SIDE, 8, 2, 4)
    deck = Deck("swings", 2.0e-4)
    deck.control(linear=True, scaled=scaled)
    deck.mesh(mesh)
    deck.laminate([Ply(MATERIAL, 1.0)] * 2, order=1)
    deck.hold(mesh.where(x=0.0), "xyz")
    deck.velocity(mesh.where(x=4.0 * SIDE), (40.0, 0.0, 100.0))
    deck.add("DATABASE_BINARY_D3DUMP", (60,))
    deck.intervals(glstat=0.0)
    code, text = said("run", deck.write(folder / "job.k"), "-o", folder)
    assert code == NORMAL, text
    return folder / "job.dump01"


@pytest.mark.parametrize("scaled", [(0.0, 4.0e-6), (4.0e-6, 0.0)])
def test_restart_changes_the_mass(scaled: tuple[float, float], tmp_path: Path) -> None:
    """Velocities stay, and the kinetic energy of the change is external work, told as such."""
    dump = first_stage(tmp_path, scaled[0])
    with h5py.File(dump) as file:
        time = float(file["state/time"][0])
    (tmp_path / "stage.k").write_text(STAGE.format(scaled=-scaled[1], body=""))
    code, text = said("restart", dump, tmp_path / "stage.k", "-j", tmp_path / "stage")
    assert code == NORMAL, text
    before, after = (Results(tmp_path, job).table("energy") for job in ("job", "stage"))
    at = int(np.argmin(np.abs(before["time"] - time)))
    ratio = PROOF * (4.0e-6 * SPEED) ** 2
    ratio = ratio if scaled[1] else 1.0 / ratio
    kinetic = after["kinetic"][0], before["kinetic"][at]
    assert kinetic[0] == pytest.approx(ratio * kinetic[1], rel=1e-6)
    work = after["external"][0] - before["external"][at]
    correction = after["half-step correction"][0] - before["half-step correction"][at]
    assert work == pytest.approx(kinetic[0] - kinetic[1] - correction, rel=1e-6)
    assert np.abs(after["error"]).max() < ROUND_OFF
    steps = after["step"][2:-2]
    expected = 0.9 * (scaled[1] or 1.0 / SPEED / np.sqrt(PROOF))
    np.testing.assert_allclose(steps, expected, rtol=1e-6)
    listing = Results(tmp_path, "stage").listing()
    words = re.search(r"changes from ([\d.Ee+-]+) to ([\d.Ee+-]+) mJ with its mass", listing)
    assert words is not None, listing
    assert [float(words[1]), float(words[2])] == pytest.approx([kinetic[1], kinetic[0]], rel=1e-4)
    assert ("Mass scaling" in listing) == (scaled[1] > 0.0)
    assert after["internal"][-1] > 0.0


def test_scaled_stage_is_continued_with_the_same_bits(tmp_path: Path) -> None:
    """A restart within a stage with more mass, on other ranks too, ends as in one piece."""
    dump = first_stage(tmp_path)
    body = "*DATABASE_BINARY_D3DUMP\n7\n*DATABASE_GLSTAT\n0.0,\n"
    (tmp_path / "stage.k").write_text(STAGE.format(scaled=-2.5e-6, body=body))
    for job in ("whole", "broken"):
        (tmp_path / job).mkdir()
    code, text = said("restart", dump, tmp_path / "stage.k", "-j", tmp_path / "whole" / "job")
    assert code == NORMAL, text
    for path in (tmp_path / "whole").iterdir():
        shutil.copy(path, tmp_path / "broken")
    done = launch(2, "restart", tmp_path / "broken" / "job.dump01")
    assert done.returncode == NORMAL, done.stderr
    assert unlike(tmp_path / "whole", tmp_path / "broken") == []


def test_restart_makes_no_first_step(tmp_path: Path) -> None:
    """DTINIT in the deck of a restart is refused."""
    dump = first_stage(tmp_path)
    (tmp_path / "stage.k").write_text("*KEYWORD\n*CONTROL_TIMESTEP\n1.0e-9,0.9\n*END\n")
    code, text = said("restart", dump, tmp_path / "stage.k", "-j", tmp_path / "stage")
    assert code == INPUT
    assert "stage.k:3: *CONTROL_TIMESTEP card 1 DTINIT: the first step of the run has been" in text


def test_damaged_plies_run_with_more_mass(tmp_path: Path) -> None:
    """The ball that breaks plies: the balance closes, and a restart ends with the same bits."""
    deck = impact(1, "springs", failing=True, implicit=1)
    deck.add("CONTROL_TIMESTEP", (0.0, 0.8, 0, 0.0, -1.5e-7))
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == NORMAL, text
    results = Results(tmp_path, "job")
    assert rows(results.listing())["all"][1] > 0.0
    assert np.abs(results.table("energy")["error"]).max() < 1e-6
