"""One deck in SI's and in US customary units: the same run, with the units of each."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from foreign_decks import QUADS, RADIUS, SIDE, Foreign, rim, sphere_profile
from programs import plydyn_pre, run_deck

#: An inch in mm, a slinch (lbf s2/in) in t, and a pound-force in N
INCH, SLINCH, POUND = 25.4, 0.1751268352, 4.448221615
STRESS = POUND / INCH**2  # a psi in MPa
END = 1.0e-4


def row(*values: float | str) -> str:
    """A card with commas."""
    return ",".join(value if isinstance(value, str) else f"{value:.12g}" for value in values)


def impact(length: float, mass: float) -> str:
    """A plate of MAT_054 below a ball, in units of so many mm and t, and s."""
    stress = mass / length  # a psi is a slinch/(in s2)
    deck = Foreign()
    step = SIDE / QUADS / length
    plate = deck.nodes(
        (step * i, step * j, 0.0) for j in range(QUADS + 1) for i in range(QUADS + 1)
    )
    deck.quads(1, plate)
    plies = [row(1, 0.125 / length, angle) for angle in (0.0, 90.0, 90.0, 0.0)]
    deck.put("PART_COMPOSITE_LONG", "plate", row(1, 16), *plies)
    density = 1.6e-9 * length**3 / mass
    moduli = [value / stress for value in (153000.0, 10300.0, 10300.0)]
    shear = [value / stress for value in (6000.0, 3700.0, 6000.0)]
    strengths = [value / stress for value in (1500.0, 2500.0, 230.0, 80.0, 90.0)]
    first = row(1, density, *moduli, 0.0202, 0.0202, 0.4)
    axes = (",,,1,0,0", ",", ",")
    deck.put("MAT_054", first, row(*shear, 0, 2), *axes, row(*strengths, 54))
    profile = [(r / length, z / length) for r, z in sphere_profile(0.25, 0.02)]
    middle = SIDE / 2 / length
    ball = deck.revolved(9, profile)
    first_line = next(
        n for n, line in enumerate(deck.lines) if line.startswith(f"{ball[0]:8d}{' ':3}")
    )
    for at in range(first_line, first_line + len(ball)):
        x, y, z = (float(deck.lines[at][k : k + 16]) for k in (8, 24, 40))
        x, y = (c - SIDE / 2 + middle for c in (x, y))
        deck.lines[at] = f"{deck.lines[at][:8]}{x:16.10f}{y:16.10f}{z:16.10f}"
    deck.put("MAT_RIGID", row(9, density), row(1, 4, 7), ",")
    deck.put("SECTION_SHELL", row(9, 2), row(*[1.0 / length] * 4))
    deck.put(
        "PART_INERTIA", "ball", row(9, 9, 9), row(0, 0, 0, 2.0e-4 / mass), row(1, 0, 0, 1, 0, 1)
    )
    deck.put_cards(row(0, 0, -4000.0 / length))
    deck.put("CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", row(1, 9, 3, 3), row(0.2, 0.2), ",")
    deck.set_of("SET_NODE_LIST", 1, rim(plate))
    deck.put("BOUNDARY_SPC_SET", row(1, 0, 1, 1, 1))
    deck.put("CONTROL_TERMINATION", row(END))
    deck.put("DATABASE_RCFORC", row(1.0e-6))
    return deck.text()


def run(folder: Path, solver: str, text: str, name: str) -> tuple[str, np.ndarray]:
    """Heading and rows of the history of the impactor."""
    (folder / f"{name}.k").write_text(text)
    result = plydyn_pre(folder, "translate", f"{name}.k", "--like", "IM7/8552")
    assert result.returncode == 0, result.stdout + result.stderr
    run_deck(solver, folder, f"{name}_plydyn.k")
    path = folder / f"{name}_plydyn.impactor_1.csv"
    return path.read_text().split("\n")[0], np.loadtxt(path, delimiter=",", skiprows=1)


def test_a_deck_in_inches_has_the_run_of_the_same_one_in_mm(solver: str, tmp_path: Path) -> None:
    """Strengths in psi, toughnesses of the library in lbf/in, the force in lbf."""
    assert pytest.approx(POUND / INCH, rel=1e-8) == SLINCH
    assert pytest.approx(0.006894757, rel=1e-6) == STRESS
    metric, mm = run(tmp_path, solver, impact(1.0, 1.0), "metric")
    customary, inch = run(tmp_path, solver, impact(INCH, SLINCH), "customary")
    assert "N" in metric and "lbf" in customary and "in" in customary
    assert RADIUS == 8.0 and mm[:, 1].max() > 50.0
    assert inch[:, 0] == pytest.approx(mm[:, 0], rel=1e-6)
    # rows of the force are moments of a contact that chatters: its mean and impulse are compared
    assert inch[:, 1].mean() * POUND == pytest.approx(mm[:, 1].mean(), rel=0.02)
    lost, lost_there = (each[:, 3] - each[0, 3] for each in (mm, inch))
    assert lost.max() > 10.0
    assert lost_there * INCH == pytest.approx(lost, abs=1e-3 * lost.max())
    assert inch[:, 2] * INCH == pytest.approx(mm[:, 2], rel=1e-3, abs=1e-6)
    assert inch[:, 3] * INCH == pytest.approx(mm[:, 3], rel=1e-3)
