"""Damping that stages change: the first mode of a plate decays by the rate of each stage.

A force -a m v brakes every point. An oscillation of the angular frequency w then is
exp(-a t / 2) times a sine of the frequency (w^2 - a^2 / 4)^1/2.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.optimize import curve_fit

from comparison import Comparison
from decks import Deck, Ply
from elasticity import STEEL, Array
from meshes import regular
from runs import Results, run, run_stage
from swings import add_first_mode, deflection

SIDE, THICKNESS = 50.0, 2.0
YOUNG, POISSON = STEEL.young[0], STEEL.poisson[0]
RIGIDITY = YOUNG * THICKNESS**3 / 12.0 / (1.0 - POISSON**2)
#: First angular frequency of the thin plate, simply supported
RATE = 2.0 * np.pi**2 / SIDE**2 * np.sqrt(RIGIDITY / (STEEL.density * THICKNESS))
#: Shares of it that the stages have as damping, and time of each
SHARES, TIME = (0.02, 0.2, 0.0), 8.0 * np.pi / RATE


def first_stage(folder: Path) -> Results:
    """The plate in its first mode, with the damping of the first stage."""
    deck = Deck("damped plate", TIME)
    deck.control(linear=True, damping=SHARES[0] * RATE)
    mesh = regular(0.5 * SIDE, 0.5 * SIDE, 2, 2, 9)
    add_first_mode(deck, mesh, [Ply(STEEL, THICKNESS)], 2, TIME / 1000.0)
    deck.add("DATABASE_BINARY_D3DUMP", (999999999,))
    return run(deck, folder, "stage_0")


def decaying(time: Array, damping: float, rate: float, cosine: float, sine: float) -> Array:
    """An oscillation, damping and angular frequency over `RATE`."""
    own = RATE * np.sqrt(rate**2 - 0.25 * damping**2) * time
    return np.exp(-0.5 * damping * RATE * time) * (cosine * np.cos(own) + sine * np.sin(own))


def test_stages_change_the_damping(compare: Comparison, tmp_path: Path) -> None:
    """Weakly damped, strongly damped, not at all; the frequency of all is that of the plate."""
    results = [first_stage(tmp_path)]
    for number, share in enumerate(SHARES[1:], start=1):
        body = (
            f"*CONTROL_TERMINATION\n{float(TIME)!r},\n*DAMPING_GLOBAL\n0,{float(share * RATE)!r}\n"
        )
        results.append(run_stage(results[-1], body, f"stage_{number}"))
    drawn, exact, start = {}, {}, 0.0
    for number, (stage, share) in enumerate(zip(results, SHARES, strict=True), start=1):
        time, values = deflection(stage)
        time = time - time[0]
        guess = (0.1, 1.0, values[0], np.ptp(values) / 2.0)
        found, _ = curve_fit(decaying, time, values, guess)
        name = f"damping over frequency, stage {number}"
        compare.number(name, found[0], share, rel=2.0e-3 if share else 0.0, abs=2.0e-5)
        # the solid beside the thin plate: shear and inertia of rotation, (pi h/a)^2, 1 %
        compare.number(
            f"frequency beside the thin plate's, stage {number}", found[1], 1.0, rel=0.02
        )
        line = decaying(time, share, found[1], *found[2:])
        drawn[f"stage {number}"] = ((start + time) * RATE, values)
        exact[f"exp(-{0.5 * share:g} $\\omega$ t)"] = ((start + time) * RATE, line)
        start += time[-1]
    compare.curves(
        "damping of three stages", ("time [1/$\\omega$]", "deflection [mm]"), drawn, exact
    )
