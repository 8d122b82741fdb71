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


def noted(folder: Path, **changes: object) -> tuple[list[str], np.ndarray]:
    """What is noted of a coupon that is struck, and the sides of its quads, (quads, 2)."""
    words = {"sheared": 0.0, "more": "", "layup": "[0/90]2s", "order": 1}
    (folder / "coupon.toml").write_text(pre.example_recipe("aitm-1-0010"))
    (folder / "mine.toml").write_text(RECIPE.format(**words | changes))
    study = pre.load_recipe(folder / "mine.toml")
    mesh = make_mesh(study.mesh)
    return list(early_shear(study, mesh)), np.ptp(mesh.nodes[mesh.quads], axis=1)


@pytest.mark.parametrize(
    ("changes", "toughness", "band"),
    [
        ({}, TOUGHNESS, 1.0),
        ({"order": 2}, TOUGHNESS, 13.0 / 18.0),
        ({"sheared": 0.8}, 0.8, 1.0),
        ({"layup": "[0]4"}, TOUGHNESS, 1.0),
        ({"layup": "[45/-45]2s"}, TOUGHNESS, 1.0),
        ({"layup": "[10/-10/0]s"}, TOUGHNESS, 1.0),
    ],
)
def test_shear_below_the_strength_is_noted(
    changes: dict[str, object], toughness: float, band: float, tmp_path: Path
) -> None:
    """It starts where the strain of the band at onset holds all of the fracture energy."""
    (note,), sides = noted(tmp_path, **changes)
    layup = changes.get("layup")
    if layup is None:
        wide = sides.max()
    elif layup == "[45/-45]2s":  # along the diagonal of the largest square within a quad
        wide = sqrt(2.0) * sides.min(axis=1).max()
    else:  # the fibres lie along x, or nearly
        turned = np.deg2rad(10.0 if layup != "[0]4" else 0.0)
        wide = (sides[:, 1] / np.cos(turned)).max()
    start = sqrt(2.0 * G12 * toughness / (RATIO * band * wide))
    found = re.search(r"cracks in shear at ([\d.]+) of 100,", note)
    assert found is not None
    assert float(found[1]) == pytest.approx(start, rel=1.0e-3)
    assert note.startswith(f"materials.ply.SL: in quads {wide:.3g} mm wide across the fibres")


@pytest.mark.parametrize(
    "changes",
    [
        {"more": 'snap_back = "drop"'},
        {"more": "width = 0.3"},
        {"layup": "[0/45/90/-45]s"},
        {"layup": "[0/30]2s"},
        {"layup": "[12/-12]s"},
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


def test_parts_and_strengths_in_situ_are_seen(tmp_path: Path) -> None:
    """A patch of cross plies in another plate, and plies whose strengths are those of thin ones."""
    text = PULLED + STRUCK
    whole = text.replace('"[0/90]s"', '"[0/45/90/-45]s"').replace("0.25", "0.125")
    patch = "\n[parts.patch]\nbox = [10, 20, 10, 20]\n[laminates.patch]\nlayup = '[0_2/90_2]s'\n"
    more = "thickness = 0.125\nmaterial = 'ply'\n"
    path = tmp_path / "parts.toml"
    path.write_text(whole + patch + more)
    study = pre.load_recipe(path)
    (note,) = early_shear(study, make_mesh(study.mesh))
    given = study.materials["ply"].SL
    assert f" of {given:g}, and no ply" in note
    path.write_text(text.replace('layup = "[0/90]s"', 'layup = "[0/90]s"\nstrengths = "in-situ"'))
    study = pre.load_recipe(path)
    notes = list(early_shear(study, make_mesh(study.mesh)))
    assert notes
    assert all(f" of {given:g}, and no ply" not in note for note in notes)


def test_a_metal_bears_the_shear(tmp_path: Path) -> None:
    text = (PULLED + STRUCK).replace("[0/90]s", "[metal/0/90/metal]")
    (tmp_path / "metal.toml").write_text(text + '[materials.metal]\nlike = "aluminium"\n')
    study = pre.load_recipe(tmp_path / "metal.toml")
    assert list(early_shear(study, make_mesh(study.mesh))) == []
