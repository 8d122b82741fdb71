"""The template of a double cantilever beam: its stiffness is that of two beams."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from programs import run_deck
from test_chains import SHARES, STEP, curve, history

import plydyn_pre as pre
from plydyn_pre.recipe import example_recipe

LENGTH, WIDTH, ARM, OPENING = 100.0, 4.0, 1.5, 0.2
#: Loaded over a period of an arm of 50 mm, and left to rest for two and a half more
LOADED, END = 1.0e-3, 3.5e-3


def compliance(crack: float, folder: Path, solver: str) -> float:
    """Opening of the ends over their force, from a run of the recipe on a narrow strip."""
    folder.mkdir()
    recipe = folder / "c.toml"
    recipe.write_text(example_recipe("dcb"))
    values: dict[str, object] = {
        "mesh.sides": [LENGTH, WIDTH],
        "mesh.quads": [20, 1],
        "mesh.zones[1].size": [2.5, WIDTH],
        "mesh.zones[1].box": [crack - 10.0, crack + 10.0, 0.0, WIDTH],
        "initial_delamination[1].box": [0.0, crack, 0.0, WIDTH],
        "materials.bond.fit": "none",
        "loads[1].value": OPENING / 2.0,
        "loads[2].value": -OPENING / 2.0,
        "control.end_time": END,
        "control.damping": 1.0e4,
    }
    values |= curve("opening", np.append(LOADED * SHARES, END), np.append(STEP, 1.0))
    study = pre.load_recipe(recipe, [f"{key}={value}" for key, value in values.items()])
    pre.write_deck(pre.deck_text(study, pre.make_mesh(study.mesh)), folder / "c.k")
    run_deck(solver, folder, "c.k")
    table = history(folder, "c.supports")
    upper, lower = (
        table[name][-1] for name in table if name.startswith("face motion") and "fz" in name
    )
    # the arms are mirror images
    assert upper == pytest.approx(-lower, rel=1.0e-3)
    return OPENING / float(upper)


def test_arms_are_beams(solver: str, tmp_path: Path) -> None:
    """The root of third order of the compliance grows with the crack as that of two cantilevers.

    C = 8 (a + c)^3 / E b h^3, where the arms turn at the tip as if they were longer by c (Williams,
    1989). The slope over a holds no c. Shear adds 1.2 a / G b h to each arm, which takes 0.5 % from
    the slope; the strip may be as much stiffer or softer by its width.
    """
    young = 171420.0
    cracks = (30.0, 50.0)
    roots = [compliance(a, tmp_path / f"a{a:g}", solver) ** (1.0 / 3.0) for a in cracks]
    slope = (roots[1] - roots[0]) / (cracks[1] - cracks[0])
    assert slope == pytest.approx((8.0 / (young * WIDTH * ARM**3)) ** (1.0 / 3.0), rel=0.01)
