"""A note of cross-ply plates whose matrix cracks early in shear in wide quads."""

from __future__ import annotations

import re
from math import sqrt
from pathlib import Path

import numpy as np
import pytest

import plydyn_pre as pre
from plydyn_pre.deck.shearing import early_shear
from plydyn_pre.mesh import make_mesh

G12, SL, TOUGHNESS, RATIO = 4000.0, 100.0, 0.5, 1.05
RECIPE = """
base = "coupon.toml"
cracks = false
[materials.ply]
G12 = 4000.0
SL = 100.0
G2T = 0.5
G2S = {sheared}
{more}
[laminate]
layup = "{layup}"
[mesh]
order = {order}
"""


def noted(folder: Path, **changes: object) -> tuple[list[str], float]:
    """What is noted of a coupon that is struck, and the length of its longest quad."""
    words = {"sheared": 0.0, "more": "", "layup": "[0/90]2s", "order": 1}
    (folder / "coupon.toml").write_text(pre.example_recipe("aitm-1-0010"))
    (folder / "mine.toml").write_text(RECIPE.format(**words | changes))
    study = pre.load_recipe(folder / "mine.toml")
    mesh = make_mesh(study.mesh)
    return list(early_shear(study, mesh)), float(np.ptp(mesh.nodes[mesh.quads], axis=1).max())


@pytest.mark.parametrize(
    ("changes", "toughness", "band"),
    [
        ({}, TOUGHNESS, 1.0),
        ({"order": 2}, TOUGHNESS, 13.0 / 18.0),
        ({"sheared": 0.8}, 0.8, 1.0),
        ({"layup": "[45/-45]2s"}, TOUGHNESS, 1.0),
        ({"layup": "[0]4"}, TOUGHNESS, 1.0),
    ],
)
def test_shear_below_the_strength_is_noted(
    changes: dict[str, object], toughness: float, band: float, tmp_path: Path
) -> None:
    """It starts where the strain of the band at onset holds all of the fracture energy."""
    (note,), long = noted(tmp_path, **changes)
    start = sqrt(2.0 * G12 * toughness / (RATIO * band * long))
    found = re.search(r"cracks in shear at ([\d.]+) of 100,", note)
    assert found is not None
    assert float(found[1]) == pytest.approx(start, rel=1.0e-3)
    assert note.startswith(f"materials.ply.SL: in quads {long:.3g} mm long")


@pytest.mark.parametrize(
    "changes",
    [
        {"more": 'snap_back = "drop"'},
        {"more": "width = 0.3"},
        {"layup": "[0/45/90/-45]s"},
        {"layup": "[0/30]2s"},
        {"sheared": 50.0},
    ],
)
def test_others_are_not(changes: dict[str, object], tmp_path: Path) -> None:
    """Nothing of a stress that drops, narrow bands, plies that bear shear, a tough matrix."""
    assert noted(tmp_path, **changes)[0] == []


PULLED = """
title = "A strip of cross plies"
[materials.ply]
like = "T700GC/M21"
[laminate]
layup = "[0/90]s"
thickness = 0.25
material = "ply"
[mesh]
kind = "rectangle"
sides = [40.0, 30.0]
quads = [8, 6]
[[supports]]
set = "left"
[[loads]]
kind = "motion"
set = "right"
direction = "x"
quantity = "displacement"
value = 1.0
[control]
end_time = 1.0e-3
"""
STRUCK = """
[impactor]
radius = 8.0
mass = 1.0e-3
velocity = [0.0, 0.0, -1000.0]
"""


@pytest.mark.parametrize(("more", "notes"), [("", 0), (STRUCK, 1)])
def test_plates_that_nothing_strikes_are_not(more: str, notes: int, tmp_path: Path) -> None:
    (tmp_path / "pulled.toml").write_text(PULLED + more)
    study = pre.load_recipe(tmp_path / "pulled.toml")
    assert len(list(early_shear(study, make_mesh(study.mesh)))) == notes
