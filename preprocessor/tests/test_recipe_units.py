"""One recipe with damage and delamination in four systems of units: one impact."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from programs import plydyn_pre, run_deck
from unit_systems import INCH, SHARES, SLINCH, Units, check_within_scatter, measures

SYSTEMS = {
    "mm s t": Units(),
    "m s kg": Units(length=1e3, mass=1e-3),
    "cm us g": Units(length=10.0, time=1e-6, mass=1e-6),
    "in s slinch": Units(length=INCH, mass=SLINCH),
}
SPEED, END = 12000.0, 1.2e-4
#: Columns of the history of energies
DISSIPATED, DELAMINATION = 6, 16
#: Constants in mm, s and t by their powers of length, time and mass
CONSTANTS = {
    "materials.ply": {
        (-3, 0, 1): {"density": 1.6e-9},
        (-1, -2, 1): {
            **{"E1": 153000.0, "E2": 10300.0, "E3": 10300.0},
            **{"G12": 6000.0, "G13": 6000.0, "G23": 3700.0},
            **{"XT": 2537.0, "XC": 1580.0, "YT": 82.0, "YC": 236.0, "SL": 90.0},
        },
        (0, -2, 1): {"G1T": 91.6, "G1C": 79.9, "G2T": 0.22, "G2C": 1.1},
        (0, 0, 0): {"nu12": 0.3, "nu13": 0.3, "nu23": 0.4},
    },
    "materials.bond": {
        (-2, -2, 1): {"normal": 2.0e5, "shear": 1.0e5},
        (-1, -2, 1): {"N": 62.3, "S": 92.3},
        (0, -2, 1): {"GIC": 0.28, "GIIC": 0.79},
        (0, 0, 0): {"exponent": 1.6},
    },
    "laminate": {(1, 0, 0): {"thickness": 0.25}},
    "mesh": {(1, 0, 0): {"side": 16.0, "core": 8.0}},
    "impactor": {(1, 0, 0): {"radius": 4.0, "gap": 0.01}, (0, 0, 1): {"mass": 1.0e-4}},
    "control": {(0, 1, 0): {"end_time": END}},
    "outputs": {
        (0, 1, 0): {f"{name}_interval": 1.0e-6 for name in ("impactor", "energy", "delamination")}
    },
}
WORDS = {
    "materials.ply": 'kind = "ply_codam2"',
    "materials.bond": 'kind = "cohesive"',
    "laminate": 'layup = "[0/90]"\nmaterial = "ply"\ninterfaces = "bond"',
    "mesh": 'kind = "ogrid_square"\nn = 4\nrings = 1',
    "impactor": "guided = true",
}


def recipe(names: str, speed: float = SPEED) -> str:
    """The recipe with numbers in some units."""
    units = SYSTEMS[names]
    kinds = zip(("length", "time", "mass"), names.split(), strict=True)
    rows = ['title = "one impact"', "[units]", *(f'{kind} = "{name}"' for kind, name in kinds)]
    for table, numbers in CONSTANTS.items():
        rows += [f"[{table}]", *WORDS.get(table, "").splitlines()]
        for (length, time, mass), values in numbers.items():
            unit = units.length**length * units.time**time * units.mass**mass
            rows += [f"{key} = {value / unit!r}" for key, value in values.items()]
        if table == "impactor":
            rows.append(f"velocity = [0.0, 0.0, {-speed / units.length * units.time!r}]")
    more = '[[supports]]\nset = "boundary"\nhold = "xyz"\n[contact]\nmethod = "points_on_plate"'
    return "\n".join([*rows, more, "friction = 0.2", ""])


def run(folder: Path, solver: str, name: str, text: str) -> tuple[np.ndarray, np.ndarray]:
    """Rows of the impactor, and energies at the end, in the units of the recipe."""
    (folder / f"{name}.toml").write_text(text)
    result = plydyn_pre(folder, "deck", f"{name}.toml", "-o", f"{name}.k")
    assert result.returncode == 0, result.stdout + result.stderr
    run_deck(solver, folder, f"{name}.k")
    read = [
        np.loadtxt(folder / f"{name}.{kind}.csv", delimiter=",", skiprows=1)
        for kind in ("impactor_1", "energy")
    ]
    return read[0], read[1][-1]


def test_four_systems_of_units_give_one_impact_within_its_scatter(
    solver: str, tmp_path: Path
) -> None:
    """Force, speed, absorbed energy, and the energy that plies and the interface have spent."""
    found = {}
    runs = [(name, 0.0) for name in SYSTEMS] + [("mm s t", share) for share in SHARES]
    for number, (name, share) in enumerate(runs):
        text = recipe(name, SPEED * (1.0 + share))
        rows, energies = run(tmp_path, solver, f"number_{number}", text)
        units = SYSTEMS[name]
        spent = energies[DISSIPATED] * units.force * units.length
        found[name, share] = np.array((*measures(rows, units), spent))
        assert energies[DELAMINATION] > 0.0
    own = [found[name, 0.0] for name in SYSTEMS]
    check_within_scatter(own, [found["mm s t", share] for share in SHARES])
