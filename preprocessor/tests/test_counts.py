"""Levels through the thickness, and degrees of freedom."""

from __future__ import annotations

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


def test_separate_plies_have_the_degrees_of_freedom_of_table_7() -> None:
    for core, order, freedoms in ((6, 2, 39_816), (8, 1, 38_448), (8, 3, 76_896), (10, 2, 77_832)):
        mesh = pre.make_mesh(pre.OgridDisc(diameter=75.0, core=15.0, n=core, rings=4))
        laminate = pre.Laminate(
            layup="[0/90]2s", thickness=0.25, material="m", order=order, interfaces="apart"
        )
        assert 3 * len(mesh.nodes) * laminate.levels == freedoms
