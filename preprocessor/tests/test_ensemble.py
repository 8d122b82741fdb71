"""Ensembles: decks of one recipe that differ in their seeds alone."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from test_deck_damage import damaged
from typer.testing import CliRunner

import plydyn_pre as pre
from plydyn_pre.cli import app
from plydyn_pre.deck import deck_text
from plydyn_pre.ensemble import realisations
from plydyn_pre.mesh import make_mesh


def test_realisations_differ_in_seed_and_title_alone(
    study: pre.Study, ply: pre.PlyCodam2, bond: pre.Cohesive
) -> None:
    scattered = damaged(study, ply, replace(bond, scatter=10.0, scatter_length=2.0))
    grid = make_mesh(scattered.mesh)
    found = list(realisations(scattered, 3, 5))
    assert [seed for seed, _ in found] == [5, 6, 7]
    texts = ["\n".join(deck_text(one, grid)).splitlines() for _, one in found]
    for one, other in pairwise(texts):
        assert len([a for a, b in zip(one, other, strict=True) if a != b]) == 2


def test_without_scatter_there_is_no_ensemble(
    study: pre.Study, ply: pre.PlyCodam2, bond: pre.Cohesive
) -> None:
    with pytest.raises(pre.RecipeError, match="no strength in use scatters"):
        list(realisations(damaged(study, ply, bond), 3, 5))


def test_a_material_that_nothing_uses_makes_no_ensemble(
    study: pre.Study, ply: pre.PlyCodam2, bond: pre.Cohesive
) -> None:
    other = {"other": replace(bond, scatter=10.0, scatter_length=2.0)}
    idle = damaged(study, ply, bond)
    with pytest.raises(pre.RecipeError, match="no strength in use scatters"):
        list(realisations(replace(idle, materials=idle.materials | other), 3, 5))


def test_all_seeds_are_numbers_that_a_deck_can_hold(
    study: pre.Study, ply: pre.PlyCodam2, bond: pre.Cohesive
) -> None:
    scattered = damaged(study, ply, replace(bond, scatter=10.0, scatter_length=2.0))
    most = 2**31 - 1
    assert [seed for seed, _ in realisations(scattered, 2, most - 1)] == [most - 1, most]
    with pytest.raises(pre.RecipeError, match="the last seed is 2,147,483,648"):
        list(realisations(scattered, 2, most))


def test_command_writes_a_deck_for_each_seed(tmp_path: Path) -> None:
    recipe = tmp_path / "plate.toml"
    recipe.write_text(pre.example_recipe("impact"))
    done = CliRunner().invoke(app, ["ensemble", str(recipe), "-n", "2", "-o", f"{tmp_path}/"])
    assert done.exit_code != 0
    assert not list(tmp_path.glob("*.k"))
