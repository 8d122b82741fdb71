"""Levels through the thickness, and degrees of freedom."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

import plydyn_pre as pre


@pytest.mark.parametrize(
    ("name", "levels", "freedoms"),
    [("le1", 17, 10_659), ("le2", 33, 20_691), ("le3", 49, 30_723), ("3le1", 49, 30_723)],
)
def test_elastic_impact_has_the_degrees_of_freedom_of_table_2(
    decks: Path, name: str, levels: int, freedoms: int
) -> None:
    study = pre.load_recipe(decks / "elastic_impact" / f"{name}.toml")
    counts = pre.count(study, pre.make_mesh(study.mesh))
    assert counts == pre.Counts(quads=48, nodes=209, levels=levels, freedoms=freedoms)


def test_bimetal_impact_has_the_degrees_of_freedom_of_table_4(decks: Path) -> None:
    study = pre.load_recipe(decks / "bimetal_impact" / "le1.toml")
    assert pre.count(study, pre.make_mesh(study.mesh)).freedoms == 10_659
    assert len(study.laminate.stack) == 16


#: Recipe of a model of Tables 2 and 4, its bricks and its degrees of freedom
BRICKS = [
    ("elastic_impact/bricks_1", 102_400, 334_611),
    ("elastic_impact/bricks_3", 307_200, 964_467),
    ("elastic_impact/bricks_5", 512_000, 1_594_323),
    ("bimetal_impact/bricks_1", 102_400, 334_611),
    ("bimetal_impact/bricks_2", 270_848, 856_251),
]


@pytest.mark.parametrize(("name", "bricks", "freedoms"), BRICKS)
def test_bricks_are_those_of_tables_2_and_4(
    decks: Path, name: str, bricks: int, freedoms: int
) -> None:
    study = pre.load_recipe(decks / f"{name}.toml")
    counts = pre.count(study, pre.make_mesh(study.mesh))
    assert (counts.quads, counts.freedoms) == (bricks, freedoms)


@pytest.mark.parametrize(
    ("changes", "levels"),
    [
        ({}, 4 * 2 + 1),
        ({"order": 3}, 4 * 3 + 1),
        ({"order": 1, "layers": 3}, 4 * 3 + 1),
        ({"interfaces": "apart"}, 4 * 3),
        ({"interfaces": "apart", "order": 1, "layers": 3}, 4 * 4),
        ({"refine": (pre.PlyRange((2, 3), 4, 2),)}, 2 + 8 + 8 + 2 + 1),
        ({"refine": (pre.PlyRange((2, 3), 4, 2),), "interfaces": "apart"}, 3 + 9 + 9 + 3),
    ],
)
def test_only_tied_plies_share_the_points_of_their_faces(changes: dict, levels: int) -> None:
    laminate = pre.Laminate(layup="[0/90]s", thickness=0.1, material="carbon", **changes)
    assert laminate.levels == levels


#: Recipe of a model of Table 7, its quads and its degrees of freedom
TABLE_7 = [
    ("q132_le2", 132, 39_816),
    ("q192_le1", 192, 38_448),
    ("q192_le2", 192, 57_672),
    ("q192_le3", 192, 76_896),
    ("q260_le2", 260, 77_832),
]


@pytest.mark.parametrize(("name", "quads", "freedoms"), TABLE_7)
def test_damage_impact_has_the_degrees_of_freedom_of_table_7(
    decks: Path, name: str, quads: int, freedoms: int
) -> None:
    study = pre.load_recipe(decks / "damage_impact" / f"{name}.toml")
    counts = pre.count(study, pre.make_mesh(study.mesh))
    assert (counts.quads, counts.freedoms) == (quads, freedoms)


@pytest.mark.parametrize(("name", "quads", "freedoms"), TABLE_7)
def test_the_solver_counts_the_degrees_of_freedom_of_table_7(
    solver: str, decks: Path, tmp_path: Path, name: str, quads: int, freedoms: int
) -> None:
    study = pre.load_recipe(decks / "damage_impact" / f"{name}.toml")
    deck = tmp_path / f"{name}.k"
    pre.write_deck(pre.deck_text(study, pre.make_mesh(study.mesh)), deck)
    command = [solver, "check", str(deck)]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert re.search(rf"^quads +{quads} of 9 nodes$", told, re.MULTILINE)
    assert re.search(rf"^degrees of freedom +{freedoms}$", told, re.MULTILINE)


def test_the_sphere_of_the_damage_impact_carries_the_energy_of_the_paper(decks: Path) -> None:
    impactor = pre.load_recipe(decks / "damage_impact" / "q192_le2.toml").impactor
    assert 0.5 * impactor.mass * impactor.velocity[2] ** 2 == pytest.approx(7350.0, rel=1e-4)
