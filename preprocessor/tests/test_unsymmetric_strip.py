"""A strip of [0/90] that its inertia stretches bends as classical lamination theory has it."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest
from programs import plydyn_pre, solve

E1, E2, PLY, LENGTH, DENSITY, PUSH = 150.0e3, 10.0e3, 0.5, 40.0, 1.6e-9, 1.0e9
WHERE = 10.0  # of the profile
RECIPE = f"""
title = "an unsymmetric strip"
[materials.ply]
kind = "ply_elastic"
density = {DENSITY}
E1 = {E1}
E2 = {E2}
E3 = {E2}
nu12 = 0.0
nu13 = 0.0
nu23 = 0.0
G12 = 5.0e3
G13 = 5.0e3
G23 = 5.0e3
[laminate]
layup = "[0/90]"
material = "ply"
thickness = {PLY}
[mesh]
kind = "rectangle"
sides = [{LENGTH}, 4.0]
quads = [10, 1]
[[supports]]
set = "left"
hold = "xz"
[[supports]]
set = "corner"
hold = "y"
[sets.corner]
at = [0.0, 0.0]
[sets.tip]
at = [{LENGTH}, 2.0]
[[loads]]
kind = "frame_acceleration"
direction = "x"
value = {-PUSH}
curve = "ramp"
[curves.ramp]
time = [0.0, 0.5e-3, 1.0e-3, 1.5e-3, 2.0e-3]
value = [0.0, 0.1464, 0.5, 0.8536, 1.0]
[control]
end_time = 5.0e-3
kinematics = "linear"
damping = 7.0e3
scheme = "implicit_thickness"
[outputs]
nodes = ["tip"]
node_interval = 1.0e-3
[[outputs.profiles]]
at = [{WHERE}, 2.0]
interval = 5.0e-3
"""


def last(path: Path, count: int) -> list[dict[str, str]]:
    """The last rows of a history."""
    with path.open() as lines:
        return list(csv.DictReader(lines))[-count:]


def test_a_strip_without_symmetry_bends_to_its_stiff_side(solver: str, tmp_path: Path) -> None:
    """Without a moment the curvature is -B/D times the strain of the middle, and Poisson's ratio 0.

    Shear and the root, which is held over its thickness, are not in the theory: 1 %.
    """
    (tmp_path / "strip.toml").write_text(RECIPE)
    assert plydyn_pre(tmp_path, "deck", "strip.toml").returncode == 0
    solve(solver, tmp_path, "run", "strip.k")
    a, b, d = (E1 + E2) * PLY, (E2 - E1) * PLY**2 / 2.0, (E1 + E2) * PLY**3 / 3.0
    strain = DENSITY * 2.0 * PLY * PUSH * LENGTH / (a - b * b / d)  # at the root
    bend = -b / d * strain
    (tip,) = last(tmp_path / "strip.nodes.csv", 1)
    (sink,) = (float(value) for name, value in tip.items() if name.endswith("bottom uz [mm]"))
    assert sink == pytest.approx(-bend * LENGTH**2 / 3.0, rel=0.01)
    share = 1.0 - WHERE / LENGTH
    rows = last(tmp_path / "strip.profile_1.csv", 10)
    lower = {float(row["z [mm]"]): float(row["s11 [MPa]"]) for row in rows if row["ply [-]"] == "1"}
    for height in (-PLY, 0.0):
        assert lower[height] == pytest.approx(E1 * share * (strain + bend * height), rel=0.01)
