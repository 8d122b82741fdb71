"""A simply supported [0/90/0] plate under q0 sin sin brought to rest by dynamic relaxation."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from broken import said
from comparison import Comparison
from decks import BOTTOM, TOP, Deck, Ply, ramp
from elasticity import Material
from exact_plate import CrossPly, Harmonic, frequency
from meshes import consistent_forces, regular
from runs import DIGITS, Results, run

PLY = Material(1.0e-9, (25.0e3, 1.0e3, 1.0e3), (0.25, 0.25, 0.25), (500.0, 500.0, 200.0))
PULL = 0.01  # MPa
PLATE = CrossPly(10.0, 10.0, tuple((PLY, 1.0 / 3.0, angle) for angle in (0.0, 90.0, 0.0)))
OMEGA = frequency(PLATE, 1, 1, 2.0e6)
# The same LE1 elements solved statically by an independent code are off by this share of w
ELEMENTS = -0.0209


def loaded(share: float, squeeze: float = 0.0) -> Deck:
    """The plate under a load that comes at once, until its kinetic energy is gone.

    A pressure may squeeze both faces at once, too.
    """
    half, quads = PLATE.length / 2.0, 4
    mesh = regular(half, half, quads, quads, 9)
    deck = Deck("settled", 400.0 / OMEGA)
    deck.control(linear=True)
    deck.add("DAMPING_RELAXATION", (share,))
    deck.mesh(mesh)
    deck.laminate([Ply(*ply) for ply in PLATE.plies], 1, 1)
    deck.hold(mesh.where(x=0.0), "yz")
    deck.hold(mesh.where(y=0.0), "xz")
    deck.hold(mesh.where(x=half), "x")
    deck.hold(mesh.where(y=half), "y")
    wave = np.pi / PLATE.length
    forces = consistent_forces(mesh, lambda x, y: PULL * np.sin(wave * x) * np.sin(wave * y))
    deck.face_forces(forces, 3, deck.curve(ramp(0.01 / OMEGA)))
    if squeeze > 0.0:
        at_once = deck.curve(ramp(0.001 / OMEGA))
        deck.add("LOAD_FACE_PRESSURE", *[(0, face, at_once, squeeze) for face in (BOTTOM, TOP)])
    deck.profile(1, half, half, 0.1 / OMEGA, 3)
    return deck


def test_rest_is_the_static_solution(compare: Comparison, tmp_path: Path) -> None:
    """What still moves has less than the root of the energy share of the amplitude.

    The frequency is that of the exact plate. The elements are stiffer by 2.1 %, which is 1 % of the
    frequency, and higher modes that still move raise the quotient.
    """
    share = 1.0e-6
    results = run(loaded(share), tmp_path)
    harmonic = Harmonic(PLATE)
    exact = harmonic.fields(harmonic.bottom_under(PULL), 1, 0.5).displacement[2]
    profile = results.profile(1)
    deflection = float(profile["uz"][np.abs(profile["z"]) < 1e-9].mean())
    close = 0.0006 + np.sqrt(share)
    bounds = (ELEMENTS - close, ELEMENTS + close)
    compare.number("deflection at rest", deflection, exact, unit="mm", bounds=bounds)
    energy = results.table("energy")
    assert energy["kinetic"][-1] < share * energy["kinetic"].max()
    assert np.abs(energy["error"]).max() < 1e-9
    assert energy["time"][-1] < 20.0 / OMEGA
    listing = results.listing()
    found = re.search(r"frequency of ([\d.Ee+-]+) per s", listing)
    assert found
    frequency = float(found[1])
    compare.number("frequency", frequency, OMEGA / (2.0 * np.pi), unit="Hz", rel=0.02)


@pytest.mark.parametrize("share", [1.0e-2, 1.0e-4])
def test_plate_that_hardly_moves_is_not_at_rest(
    share: float, compare: Comparison, tmp_path: Path
) -> None:
    """A squeeze at once excites the thickness, whose damping does not let the plate bend at first.

    The squeeze stores 20 times the energy of bending, and bends nothing. What still moves has less
    than the root of the energy share of the amplitude.
    """
    harmonic = Harmonic(PLATE)
    exact = harmonic.fields(harmonic.bottom_under(PULL), 1, 0.5).displacement[2]
    bending = 0.5 * PULL * exact * 0.25
    thickness = sum(height for _, height, _ in PLATE.plies)
    squeeze = float(np.sqrt(20.0 * 2.0 * bending * PLY.young[2] / thickness))
    profile = run(loaded(share, squeeze), tmp_path).profile(1)
    deflection = float(profile["uz"][np.abs(profile["z"]) < 1e-9].mean())
    bounds = (ELEMENTS - np.sqrt(share), ELEMENTS + np.sqrt(share))
    compare.number(
        "deflection of a plate that is squeezed", deflection, exact, unit="mm", bounds=bounds
    )


def test_damping_takes_the_energy_of_the_swing(compare: Comparison, tmp_path: Path) -> None:
    """A load that comes at once does twice the work that is stored at rest."""
    energy = run(loaded(1.0e-6), tmp_path).table("energy")
    half = 0.5 * energy["external"][-1]
    compare.number("energy of the damping", energy["damping"][-1], half, unit="mJ", rel=2e-3)


@pytest.mark.parametrize("squeeze", [0.0, 100.0 * PULL])
def test_restart_gives_the_same_bits(squeeze: float, tmp_path: Path) -> None:
    """A run that goes on amid its relaxation, between two changes of the damping.

    Squeezed, it goes on amid the period over which the damping must have been about critical.
    """
    deck = loaded(1.0e-6, squeeze)
    deck.add("DATABASE_BINARY_D3DUMP", (333,))
    results = run(deck, tmp_path / "whole")
    shutil.copytree(results.folder, tmp_path / "broken")
    code, text = said("restart", tmp_path / "broken" / "job.dump01")
    assert code == 0, text
    for name in ("energy", "profile_1"):
        file = f"job.{name}.csv"
        assert (results.folder / file).read_bytes() == (tmp_path / "broken" / file).read_bytes()


def test_a_restart_ends_the_relaxation(compare: Comparison, tmp_path: Path) -> None:
    """The plate at rest, its load gone, swings freely, and all that was stored comes back.

    Half a period on it passes through zero with the stored energy as its kinetic energy, less what
    higher modes take: the load is the lowest mode alone.
    """
    deck = loaded(1.0e-6)
    deck.add("DATABASE_BINARY_D3DUMP", (100000,))
    at_rest = run(deck, tmp_path).table("energy")
    (tmp_path / "free.k").write_text(
        f"*KEYWORD\n*CONTROL_TERMINATION\n{at_rest['time'][-1] + 4.0 / OMEGA},\n"
        "*DAMPING_RELAXATION\n0.0\n*DEFINE_CURVE\n99\n0.0,0.0\n1.0,0.0\n"
        "*LOAD_FACE_POINT\n1,1,3,99,1.0\n*END\n"
    )
    dump, stage = tmp_path / "job.dump01", tmp_path / "free.k"
    code, text = said("restart", dump, stage, "-j", tmp_path / "free")
    assert code == 0, text
    free = Results(tmp_path, "free").table("energy")
    assert free["damping"][-1] == pytest.approx(at_rest["damping"][-1], rel=DIGITS)
    stored = at_rest["internal"][-1]
    compare.number("energy of the free swing", free["kinetic"].max(), stored, unit="mJ", rel=0.01)
