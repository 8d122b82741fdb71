"""No layer is folded below the sphere of a damage impact, and no point comes loose there.

Whatever the law of the plies, and with empty fields of its keyword.
"""

from __future__ import annotations

import re
from pathlib import Path

import h5py
import numpy as np
import pytest

from comparison import Comparison
from elasticity import Array
from plydyn_post.hexahedra import lattice
from recipes import make_deck
from runs import ROOT, Results, run_deck

# A quarter of the disc of the paper on a coarse mesh, the second energy of its series, half of
# the mass, which comes to rest sooner
QUARTER = ROOT / "decks/damage_impact/quarter.toml"
MASS, ENERGY, END = 0.5e-3, 11.03e3, 1.15e-3
SPEED = (2.0 * ENERGY / MASS) ** 0.5
THICKNESS = 2.0
CHANGES = (
    f"impactor.mass={MASS}",
    f"impactor.velocity=[0.0, 0.0, {-SPEED}]",
    f"control.end_time={END}",
    "outputs.field_interval=0.7e-4",
)
DEFAULT = '[materials.hts40_9772]\nmodel = "default"\n'
# The ply of the recipe has the choices for the paper; others take its constants, and what they lack
# from its interface. Empty fields have the defaults of recipes.
PLIES = {
    "nagaraj2020": "",
    "empty fields": DEFAULT,
    "planes of fracture": """
[laminate]
material = "planes"
[materials.planes]
kind = "ply_fracture_3d"
like = "HTS40/977-2"
G2S = 0.79
friction = 0.3
""",
}


@pytest.mark.parametrize("plies", list(PLIES))
def test_no_layer_is_folded(plies: str, compare: Comparison, tmp_path: Path) -> None:
    """Ratios of volumes stay above zero at all Gauss points, and in all eighths of cells.

    Gauss points are looked at during the whole run; fields show the cells at some instants. No
    point of these strays by more than the plate is thick.
    """
    recipe, deck = tmp_path / "job.toml", tmp_path / "job.k"
    recipe.write_text(f'base = "{QUARTER}"\n{PLIES[plies]}')
    make_deck(recipe, deck, *CHANGES)
    if plies == "empty fields":
        deck.write_text(without_choices(deck.read_text()))
    results = run_deck(deck, tmp_path, "job")
    energy = results.table("energy")
    # a quarter of the sphere has hit and come to rest; cells are smallest before that
    struck = energy["impactor"][0]
    assert struck == pytest.approx(0.25 * ENERGY, rel=1.0e-6)
    assert energy["impactor"].min() < 0.1 * struck
    volumes = energy["least volume"]
    assert volumes.argmin() < 0.9 * len(volumes)
    assert energy["dissipated"][-1] > 0.1 * struck
    points, cells = volumes.min(), least_eighth(results)
    for name, least in (("Gauss point", points), ("eighth of a cell", cells)):
        assert least > 0.0
        compare.number(f"least volume, {name}", least, 1.0, bounds=(-1.0, 0.0))
    # bending by 45 degrees moves faces sideways by half of the thickness
    share = strayed(results) / THICKNESS
    compare.number("motion sideways or ahead over thickness", share, 0.0, bounds=(0.0, 1.0))


def without_choices(deck: str) -> str:
    """The deck whose ply has elastic constants, strengths and fracture energies alone."""
    found = re.search(r"\*MAT_PLY_CODAM2_TITLE\n.*\n((?:[^*].*\n)+)", deck)
    assert found
    constants = [line for line in found[1].splitlines() if not line.startswith("$")][:4]
    kept = [line[: 10 * fields] for line, fields in zip(constants, (8, 3, 5, 4), strict=True)]
    return deck.replace(found[1], "\n".join(kept) + "\n")


def strayed(results: Results) -> float:
    """Farthest that a point moves along x or y, or down beyond the sphere, in the fields."""
    sphere = float(np.abs(results.table("impactor_1")["displacement"]).max())
    with h5py.File(results.folder / f"{results.job}.vtkhdf") as file:
        moved = np.array(file["VTKHDF/PointData/displacement"])
    return max(float(np.abs(moved[:, :2]).max()), float(-moved[:, 2].min()) - sphere)


def least_eighth(results: Results) -> float:
    """Least ratio of volumes of the eighths of all cells, over all states of the fields."""
    with h5py.File(results.folder / f"{results.job}.vtkhdf") as file:
        root = file["VTKHDF"]
        count, cells = int(root["NumberOfPoints"][0]), int(root["NumberOfCells"][0])
        nodes = lattice(int(root["Types"][0]))
        each = np.array(root["Connectivity"][: cells * nodes.size]).reshape(cells, nodes.size)
        places = np.array(root["Points"][:count], float)
        moved = root["PointData/displacement"]
        starts = root["Steps/PointDataOffsets/displacement"][:]
        assert len(starts) > 10
        before = eighths(places, each, nodes)
        states = [places + moved[start : start + count] for start in starts]
    return min(float((eighths(state, each, nodes) / before).min()) for state in states)


def eighths(places: Array, cells: Array, nodes: Array) -> Array:
    """Volumes of the hexahedra between the nodes of cells, (parts, cells): means over corners."""
    corners = places[cells][:, nodes]
    volumes = []
    for at in np.ndindex(*(np.array(nodes.shape) - 1)):
        part = corners[(slice(None), *(slice(i, i + 2) for i in at))]
        volumes.append(np.mean([at_corner(part, *each) for each in np.ndindex(2, 2, 2)], axis=0))
    return np.array(volumes)


def at_corner(part: Array, a: int, b: int, c: int) -> Array:
    """Triple product of the edges from a corner, above zero if it is not inside out, (cells)."""
    here = part[:, a, b, c]
    ends = part[:, 1 - a, b, c], part[:, a, 1 - b, c], part[:, a, b, 1 - c]
    edges = np.stack([(end - here) * (1 - 2 * i) for end, i in zip(ends, (a, b, c), strict=True)])
    return np.einsum("ci,ci->c", np.cross(edges[0], edges[1]), edges[2])
