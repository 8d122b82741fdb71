"""One impact in the decks of three programs and as a recipe: the same force."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import abaqus_decks
import nastran_decks
import numpy as np
import pytest
from programs import plydyn_pre, run_deck
from test_abaqus import stacked, thick
from test_foreign_runs import BASE, RECIPE, STACK, workbench

CASES: dict[str, tuple[str, str, dict[str, object]]] = {
    "LS-DYNA": ("user.k", workbench(), {}),
    "Abaqus": ("user.inp", abaqus_decks.standard(), {}),
    "Abaqus, a meshed ball": ("user.inp", abaqus_decks.standard(meshed=True), {}),
    "Abaqus, bricks": ("user.inp", thick("C3D8R"), {}),
    "Abaqus, a cohesive contact": ("user.inp", stacked("contact"), STACK),
    "Abaqus, cohesive elements": ("user.inp", stacked("elements"), STACK),
    "Nastran": ("user.bdf", nastran_decks.standard(), {}),
}
#: What MAT8, which has no nu23, makes of its G2Z
_NU23 = 10300.0 / (2.0 * 3700.0) - 1.0


@pytest.mark.parametrize("name", CASES)
def test_every_dialect_has_the_force_of_the_recipe(
    name: str,
    solver: str,
    force_of: Callable[[str], tuple[np.ndarray, np.ndarray]],
    tmp_path: Path,
) -> None:
    file, text, changes = CASES[name]
    (tmp_path / file).write_text(text)
    recipe = RECIPE.format(**(BASE | changes))
    if name == "Nastran":
        recipe = recipe.replace("nu23 = 0.4", f"nu23 = {_NU23}")
    result = plydyn_pre(tmp_path, "translate", file)
    assert result.returncode == 0, result.stdout + result.stderr
    run_deck(solver, tmp_path, "user_plydyn.k")
    moments, theirs = np.loadtxt(
        tmp_path / "user_plydyn.impactor_1.csv", delimiter=",", skiprows=1
    ).T[:2]
    times, own = force_of(recipe)
    assert own.max() > 50.0 and moments == pytest.approx(times)
    assert theirs == pytest.approx(own, abs=0.02 * own.max())
