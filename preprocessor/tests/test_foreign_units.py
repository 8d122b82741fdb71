"""One deck in several systems of units: the same run, with the units of each."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from foreign_decks import QUADS, RADIUS, SIDE, Foreign, rim, sphere_profile
from foreign_forms import translated
from programs import plydyn_pre, run_deck
from unit_systems import (
    FORCE,
    INCH,
    METRIC,
    POUND,
    SHARES,
    SLINCH,
    Units,
    check_within_scatter,
    measures,
)

STRESS = POUND / INCH**2  # a psi in MPa


def row(*values: float | str) -> str:
    """A card with commas."""
    return ",".join(value if isinstance(value, str) else f"{value:.12g}" for value in values)


@dataclass(frozen=True)
class Impact:
    """A plate of MAT_054 below a ball."""

    units: Units = METRIC
    ply: float = 0.125  # mm
    speed: float = 4000.0  # mm/s
    end: float = 1.0e-4  # s
    decimals: int = 12  # of coordinates

    def deck(self) -> str:
        """The deck, which does not name its units."""
        deck = Foreign(decimals=self.decimals)
        step = SIDE / QUADS / self.units.length
        plate = deck.nodes(
            (step * i, step * j, 0.0) for j in range(QUADS + 1) for i in range(QUADS + 1)
        )
        deck.quads(1, plate)
        plies = [row(1, self.ply / self.units.length, angle) for angle in (0.0, 90.0, 90.0, 0.0)]
        deck.put("PART_COMPOSITE_LONG", "plate", row(1, 16), *plies)
        self._put_law(deck)
        self._put_ball(deck)
        deck.set_of("SET_NODE_LIST", 1, rim(plate))
        deck.put("BOUNDARY_SPC_SET", row(1, 0, 1, 1, 1))
        deck.put("CONTROL_TERMINATION", row(self.end / self.units.time))
        for name in ("RCFORC", "GLSTAT"):
            deck.put(f"DATABASE_{name}", row(1.0e-6 / self.units.time))
        return deck.text()

    def _put_law(self, deck: Foreign) -> None:
        """Constants and strengths of a ply."""
        stress = self.units.stress
        density = 1.6e-9 * self.units.length**3 / self.units.mass
        moduli = [value / stress for value in (153000.0, 10300.0, 10300.0)]
        shear = [value / stress for value in (6000.0, 3700.0, 6000.0)]
        strengths = [value / stress for value in (1500.0, 2500.0, 230.0, 80.0, 90.0)]
        first = row(1, density, *moduli, 0.0202, 0.0202, 0.4)
        axes = (",,,1,0,0", ",", ",")
        deck.put("MAT_054", first, row(*shear, 0, 2), *axes, row(*strengths, 54))
        deck.put("MAT_RIGID", row(9, density), row(1, 4, 7), ",")

    def _put_ball(self, deck: Foreign) -> None:
        """A ball of 200 g close to the face, with its contact."""
        profile = [
            (r / self.units.length, z / self.units.length)
            for r, z in sphere_profile(2 * self.ply, 0.02)
        ]
        deck.revolved(9, profile, SIDE / 2 / self.units.length)
        deck.put("SECTION_SHELL", row(9, 2), row(*[1.0 / self.units.length] * 4))
        inertia = row(0, 0, 0, 2.0e-4 / self.units.mass), row(1, 0, 0, 1, 0, 1)
        deck.put("PART_INERTIA", "ball", row(9, 9, 9), *inertia)
        deck.put_cards(row(0, 0, -self.speed / self.units.length * self.units.time))
        deck.put("CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", row(1, 9, 3, 3), row(0.2, 0.2), ",")


def run(folder: Path, solver: str, impact: Impact, name: str) -> tuple[str, np.ndarray]:
    """Heading and rows of the history of the impactor."""
    (folder / f"{name}.k").write_text(impact.deck())
    result = plydyn_pre(folder, "translate", f"{name}.k", "--like", "IM7/8552")
    assert result.returncode == 0, result.stdout + result.stderr
    run_deck(solver, folder, f"{name}_plydyn.k")
    path = folder / f"{name}_plydyn.impactor_1.csv"
    return path.read_text().split("\n")[0], np.loadtxt(path, delimiter=",", skiprows=1)


def test_a_deck_in_inches_has_the_run_of_the_same_one_in_mm(solver: str, tmp_path: Path) -> None:
    """Strengths in psi, toughnesses of the library in lbf/in, the force in lbf."""
    assert pytest.approx(POUND / INCH, rel=1e-8) == SLINCH
    assert pytest.approx(0.006894757, rel=1e-6) == STRESS
    metric, mm = run(tmp_path, solver, Impact(), "metric")
    customary, inch = run(tmp_path, solver, Impact(Units(INCH, 1.0, SLINCH)), "customary")
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


#: Ply, speed and end of an impact that breaks fibres, and when its first ply breaks
HARD, WHOLE = {"ply": 0.25, "speed": 12000.0, "end": 2.8e-4}, 1.2e-4


def test_three_systems_of_units_give_one_impact_within_its_scatter(
    solver: str, tmp_path: Path
) -> None:
    """Decks in mm-s-t, mm-ms-kg and m-s-kg; they agree to round-off until the first ply breaks."""
    alike = [Impact(**(HARD | {"speed": HARD["speed"] * (1.0 + share)})) for share in SHARES]
    systems = [Units(), Units(time=1e-3, mass=1e-3), Units(length=1e3, mass=1e-3)]
    impacts = alike + [Impact(units, **HARD) for units in systems]
    rows = [
        run(tmp_path, solver, impact, f"number_{number}")[1]
        for number, impact in enumerate(impacts)
    ]
    found = [measures(each, impact.units) for each, impact in zip(rows, impacts, strict=True)]
    check_within_scatter(found[len(alike) :], found[: len(alike)])
    metric, *others = rows[len(alike) :]
    before = metric[:, 0] < WHOLE
    force = metric[before, FORCE]
    assert force.max() > 500.0
    for each, units in zip(others, systems[1:], strict=True):
        assert each[before, FORCE] * units.force == pytest.approx(force, abs=1e-6 * force.max())


def test_a_ball_of_rounded_nodes_has_round_sizes(tmp_path: Path) -> None:
    """Nodes with eight decimals of a metre hold the centre to some nanometres."""
    deck = Impact(Units(length=1e3, mass=1e-3), ply=0.25, decimals=8).deck()
    ball = translated(tmp_path, deck)[0].split("*IMPACTOR_SPHERE")[1].splitlines()[3].split()
    assert [float(word) for word in ball[1:]] == [0.008, 0.2, 0.02, 0.02, 0.00852]
