"""Contact of a coupon takes energy, whatever is implicit; it gave some with the whole thickness."""

from __future__ import annotations

import csv
import subprocess
from pathlib import Path

import numpy as np
import pytest

import plydyn_pre as pre
from plydyn_pre.deck import deck_text, write_deck
from plydyn_pre.recipe import example_recipe, load_recipe

#: Thin plies on coarse quads, with a step three times that of explicit time integration
VALUES = [
    "laminate.layup=[45/0/-45/90]2s",
    "laminate.thickness=0.125",
    "cracks=false",
    "mesh.order=2",
    "mesh.core=40",
    "mesh.quad=20",
    "mesh.largest=25",
    "control.end_time=3.0e-4",
]
ENERGY = 30.0e3


def columns(scheme: str, folder: Path, solver: str) -> dict[str, np.ndarray]:
    """The history of energies of the coupon of the template."""
    recipe = folder / "coupon.toml"
    recipe.write_text(example_recipe("astm-d7136"))
    study = load_recipe(recipe, [*VALUES, f"control.scheme={scheme}"])
    deck = folder / f"{scheme}.k"
    write_deck(deck_text(study, pre.make_mesh(study.mesh)), deck)
    subprocess.run([solver, "run", deck, "-o", folder], check=True, capture_output=True)
    with (folder / f"{scheme}.energy.csv").open() as stream:
        rows = list(csv.reader(stream))
    names = [name.partition(" [")[0] for name in rows[0]]
    values = np.array(rows[1:], dtype=float)
    return {name: values[:, k] for k, name in enumerate(names)}


def test_contact_loses_what_it_loses_when_all_is_explicit(solver: str, tmp_path: Path) -> None:
    """To a ten thousandth of the energy of the impact, and no more is given on the way."""
    exact = columns("explicit", tmp_path, solver)["contact"]
    assert np.all(np.diff(exact) >= 0.0)
    for scheme in ("implicit_interfaces", "implicit_thickness"):
        found = columns(scheme, tmp_path, solver)["contact"]
        assert found[-1] == pytest.approx(exact[-1], abs=1.0e-4 * ENERGY)
        assert np.max(np.maximum.accumulate(found) - found) < 1.0e-4 * ENERGY
