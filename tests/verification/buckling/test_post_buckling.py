"""A square plate far beyond buckling, against von Karman's equations.

Thin, isotropic, simply supported on all edges, which stay straight and free of shear; the sides do
not move towards each other. With one half-wave w = A sin(pi x/a) sin(pi y/a), q = (pi A / a)^2 / 8
and the end shortening e per length, c that of buckling,

    q = (e - c) / (3 - nu),              c = pi^2 h^2 / 3 a^2 (1 + nu),
    stress = E / (1 - nu^2) (e - (1 + nu) q):

the plate has 2 (1 - nu)/(3 - nu) = 0.519 of its stiffness left. More half-waves (Levy, NACA Report
737, 1942) lower that as the plate bends on.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.fft import dctn
from scipy.optimize import minimize

from comparison import Comparison
from decks import PLANE, Deck, Ply, ramp
from elasticity import STEEL, Array
from meshes import consistent_forces, regular
from runs import run

SIDE, THICKNESS = 100.0, 2.0
YOUNG, POISSON = STEEL.young[0], STEEL.poisson[0]
ONSET = np.pi**2 * THICKNESS**2 / (3.0 * SIDE**2 * (1.0 + POISSON))
RIGIDITY = YOUNG * THICKNESS**3 / 12.0 / (1.0 - POISSON**2)
RATE = 2.0 * np.pi**2 / SIDE**2 * np.sqrt(RIGIDITY / (STEEL.density * THICKNESS))
#: End shortening over that of buckling: first quickly, then slowly; part of the time for the first
FIRST, LAST, SHARE = 0.8, 2.5, 0.2
#: Deflection over the thickness by the pressure alone
PUSHED = 1.0e-2
#: Half-waves along each side
WAVES = (1, 3)


def energy(amplitudes: Array, shortening: float) -> float:
    """Energy over E h a^2 of a plate with sin(m pi x/a) sin(n pi y/a), its amplitudes over a.

    Airy's function of each bend is a series of cosines, on 24 x 24 points, with Fourier's orders up
    to twice the largest half-wave.
    """
    points = (np.arange(24) + 0.5) / 24.0
    slopes = np.zeros((5, 24, 24))
    for number, amplitude in enumerate(amplitudes):
        m, n = (np.pi * WAVES[place] for place in divmod(number, len(WAVES)))
        (sx, cx), (sy, cy) = (
            (np.sin(k * points)[axis], np.cos(k * points)[axis])
            for k, axis in ((m, np.s_[:, None]), (n, np.s_[None, :]))
        )
        slopes += amplitude * np.array(
            [m * cx * sy, n * sx * cy, -m * m * sx * sy, -n * n * sx * sy, m * n * cx * cy]
        )
    wx, wy, wxx, wyy, wxy = slopes
    bent = (THICKNESS / SIDE) ** 2 / 24.0 / (1.0 - POISSON**2) * np.mean((wxx + wyy) ** 2)
    series = dctn(wxy**2 - wxx * wyy, norm="ortho") / 24.0
    orders = (np.pi * np.arange(24)) ** 2
    squares = orders[:, None] + orders[None, :]
    squares[0, 0] = np.inf
    membrane = 0.5 * np.sum((series / squares) ** 2)
    ex, ey = 0.5 * np.mean(wx**2) - shortening, 0.5 * np.mean(wy**2)
    mean = 0.5 * (ex**2 + ey**2 + 2.0 * POISSON * ex * ey) / (1.0 - POISSON**2)
    return float(bent + membrane + mean)


def karman(shortening: float) -> float:
    """Mean stress at an end shortening: the slope of the least energy."""
    q = max(shortening - ONSET, 0.0) / (3.0 - POISSON)
    guess = np.array([np.sqrt(8.0 * q) / np.pi, 0.0, 0.0, 0.0])
    scale = 1.0e-8

    def scaled(amplitudes: Array) -> float:
        return energy(amplitudes, shortening) / scale

    bent = minimize(scaled, guess, method="Nelder-Mead", options={"xatol": 1e-8, "fatol": 1e-9}).x
    step = 1.0e-6
    slope = (energy(bent, shortening + step) - energy(bent, shortening - step)) / (2.0 * step)
    return YOUNG * slope


def one_wave(shortening: Array) -> Array:
    """Mean stress with one half-wave each way."""
    q = np.maximum(shortening - ONSET, 0.0) / (3.0 - POISSON)
    return YOUNG / (1.0 - POISSON**2) * (shortening - (1.0 + POISSON) * q)


def pressed(folder: Path) -> tuple[Array, Array]:
    """End shortening over that of buckling, and mean stress.

    The mesh reaches from the middle of the plate to that of its neighbour in a row of plates that
    bend up and down in turns, over half of the width: its ends are planes of symmetry.
    """
    half = 0.5 * SIDE
    mesh = regular(SIDE, half, 12, 6, 9)
    time = 12.0 * 2.0 * np.pi / RATE
    deck = Deck("plate beyond buckling", time)
    deck.control(damping=RATE)
    deck.mesh(mesh)
    deck.laminate([Ply(STEEL, THICKNESS)], order=2)
    side = mesh.where(y=0.0)
    deck.hold(side, "z")
    deck.hold_face(side, PLANE, "y")
    deck.hold(mesh.where(x=0.0), "x")
    deck.hold(mesh.where(y=half), "y")
    rise = [(SHARE * time * t, FIRST * share) for t, share in ramp(1.0, 100)]
    curve = deck.curve([*rise, (time, LAST)])
    deck.move(mesh.where(x=SIDE), 1, curve, -ONSET * SIDE)
    push = PUSHED * THICKNESS * RIGIDITY * 4.0 * (np.pi / SIDE) ** 4

    def pressure(x: float, y: float) -> float:
        return float(push * np.cos(np.pi * x / SIDE) * np.sin(np.pi * y / SIDE))

    forces = consistent_forces(mesh, pressure)
    deck.face_forces(forces, 3, deck.curve(ramp(SHARE * time)))
    deck.intervals(spcforc=time / 400.0, glstat=time)
    table = run(deck, folder).table("supports")
    pushing = next(name for name in table.names if name.startswith("motion") and "fx" in name)
    later = (table["time"] / time - SHARE) / (1.0 - SHARE)
    slow = later >= 0.0
    stress = -table[pushing] / (half * THICKNESS)
    return FIRST + (LAST - FIRST) * later[slow], stress[slow]


def test_karman_begins_as_one_wave() -> None:
    """Just beyond buckling, the slope is that of one half-wave."""
    for over in (1.0005, 1.01):
        assert karman(over * ONSET) == pytest.approx(float(one_wave(over * ONSET)), rel=1e-4)


def test_stiffness_left(compare: Comparison, tmp_path: Path) -> None:
    """Stress from 1.4 to 2.4 times the shortening of buckling, and its slope.

    The pressure adds 1 % / w, w in thicknesses, to the shortening at which the plate has bent by w.
    Transverse shear, (h/a)^2 times 5, lowers the load by 0.2 %.
    """
    shortening, stress = pressed(tmp_path)
    places = np.linspace(1.4, 2.4, 6)
    exact = np.array([karman(place * ONSET) for place in places])
    found = np.interp(places, shortening, stress)
    compare.values("mean stress beyond buckling", found, exact, unit="MPa", rel=0.01)
    before = YOUNG / (1.0 - POISSON**2)
    slopes = [np.polyfit(places * ONSET, each, 1)[0] / before for each in (found, exact)]
    compare.number("stiffness left beyond buckling", slopes[0], slopes[1], rel=0.01)
    drawn = np.linspace(0.0, 2.4, 25)
    compare.curves(
        "square plate beyond buckling",
        ("end shortening / that of buckling", "mean stress [MPa]"),
        {"run": (shortening, stress)},
        {
            "one half-wave": (drawn, one_wave(drawn * ONSET)),
            "von Karman": (places, exact),
        },
    )
