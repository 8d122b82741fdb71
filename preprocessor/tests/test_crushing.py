"""Before a compression test, a note of fibres that crush early in wide quads."""

from __future__ import annotations

import re
from math import sqrt
from pathlib import Path

import numpy as np
import pytest

import plydyn_pre as pre
from plydyn_pre.deck.crushing import early_crushing
from plydyn_pre.mesh import make_mesh

E1, XC, TOUGHNESS, RATIO = 130.0e3, 1250.0, 10.0, 1.05
RECIPE = """
base = "coupon.toml"
cracks = false
[materials.ply]
E1 = 130.0e3
XC = 1250.0
G1C = {toughness}
FXC = {shares[0]}
FGXC = {shares[1]}
{more}
[mesh]
order = {order}
[sets]
end.box = [75.0, 75.0, -50.0, 50.0]
[[stages]]
name = "press"
end_time = 1.0e-2
quasi_static = 0.05
supports = [{{ set = "end", hold = "z" }}]
[[stages.loads]]
kind = "motion"
set = "{set}"
direction = "x"
quantity = "velocity"
value = {speed}
"""


def noted(folder: Path, **changes: object) -> tuple[list[str], float]:
    """What is noted of a coupon that is pressed, and the length of its longest quad along x."""
    words = {"toughness": TOUGHNESS, "shares": (1.0, 1.0), "more": "", "order": 1, "speed": -60.0}
    words["set"] = "end"
    (folder / "coupon.toml").write_text(pre.example_recipe("aitm-1-0010"))
    (folder / "mine.toml").write_text(RECIPE.format(**words | changes))
    study = pre.load_recipe(folder / "mine.toml")
    mesh = make_mesh(study.mesh)
    along = np.ptp(mesh.nodes[mesh.quads, 0], axis=1)
    return list(early_crushing(study, mesh)), float(along.max())


@pytest.mark.parametrize(
    ("changes", "reach", "band"),
    [
        ({}, 1.0, 1.0),
        ({"order": 2}, 1.0, 13.0 / 18.0),
        # the first of two lines ends at the lesser of 0.4/0.8 and 0.6/0.2 of what one line reaches
        ({"shares": (0.8, 0.4)}, 0.5, 1.0),
        # above a plateau a quarter of the stress is left, which falls over the same opening
        ({"more": "plateau = 0.5", "toughness": 2.5}, 1.0, 1.0),
    ],
)
def test_fibres_that_crush_early_are_noted(
    changes: dict[str, object], reach: float, band: float, tmp_path: Path
) -> None:
    """They start where the strain of the band at onset holds all of the fracture energy."""
    (note,), long = noted(tmp_path, **changes)
    start = sqrt(2.0 * E1 * TOUGHNESS * reach / (RATIO * band * long))
    found = re.search(r"crush at ([\d.]+) of 1250, at a strain of ([\d.]+) %", note)
    assert found is not None
    assert float(found[1]) == pytest.approx(start, rel=1.0e-3)
    assert float(found[2]) == pytest.approx(100.0 * start / E1, rel=0.02)
    assert note.startswith("materials.ply.XC: in quads")


@pytest.mark.parametrize(
    "changes",
    [
        {"speed": 60.0},
        {"more": 'snap_back = "drop"'},
        {"more": "width = 1.0"},
        {"more": 'width_rule = "root_quad"'},
        {"toughness": 200.0},
    ],
)
def test_others_are_not(changes: dict[str, object], tmp_path: Path) -> None:
    """Nothing of tension, a stress that drops, narrow bands, bands by other rules, tough fibres."""
    assert noted(tmp_path, **changes)[0] == []


def test_a_set_that_is_not_there_is_told_with_its_key(tmp_path: Path) -> None:
    """The note comes before the deck, and so does what it finds wrong."""
    with pytest.raises(pre.PreError, match=r"stages\[1\]\.loads\[1\]\.set: 'nowhere' is not a"):
        noted(tmp_path, set="nowhere")
