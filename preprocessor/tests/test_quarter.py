"""Quarters of discs: their meshes, what studies of them must be, and that they are a quarter."""

from __future__ import annotations

import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from conftest import BOND, CARBON
from deck_cards import cards_of, fields_of, text_of

import plydyn_pre as pre

CENTRE = (3.0, -2.0)
DISC = pre.OgridDisc(diameter=20.0, core=8.0, n=4, rings=2, centre=CENTRE)


LAMINATE = pre.Laminate("[0/90]s", 0.25, "carbon", order=1, interfaces="bond")


def study_of(mesh: pre.OgridDisc) -> pre.Study:
    """A disc of four plies on bonds, hit in the middle."""
    return pre.Study(
        title="Disc",
        materials={"carbon": CARBON, "bond": BOND},
        laminate=LAMINATE,
        mesh=mesh,
        supports=(pre.Support("boundary"),),
        impactor=pre.Impactor(5.0, 4.0e-5, (0.0, 0.0, -2.0e4), gap=0.001, guided=True),
        contact=pre.Contact(method="points_on_plate"),
        control=pre.Control(end_time=4.0e-5),
        outputs=pre.Outputs(impactor_interval=1.0e-6, delamination_interval=1.0e-6),
    )


@pytest.mark.parametrize("order", [1, 2])
def test_a_quarter_has_the_nodes_and_quads_of_the_whole_there(order: int) -> None:
    whole = pre.make_mesh(replace(DISC, order=order))
    quarter = pre.make_mesh(replace(DISC, order=order, quarter=True))
    n, rings, per_quad = DISC.n, DISC.rings, order
    steps = n // 2 * per_quad
    assert len(quarter.quads) == len(whole.quads) // 4
    assert len(quarter.nodes) == (steps + 1) ** 2 + rings * per_quad * (2 * steps + 1)
    off = whole.nodes - CENTRE
    there = whole.nodes[np.all(off >= -1e-12, axis=1)]
    assert sorted(map(tuple, quarter.nodes.round(9))) == sorted(map(tuple, there.round(9)))
    area = pre.quality(quarter).area
    assert area == pytest.approx(pre.quality(whole).area / 4, rel=1e-12)
    assert quarter.node_ids.tolist() == list(range(1, len(quarter.nodes) + 1))


def test_a_quarter_has_planes_of_symmetry_and_what_is_left_of_other_sets() -> None:
    mesh = pre.make_mesh(replace(DISC, quarter=True))
    for name, axis in (("symmetry_x", 0), ("symmetry_y", 1)):
        on = np.flatnonzero(mesh.nodes[:, axis] == CENTRE[axis])
        assert mesh.node_sets[name].tolist() == on.tolist()
        assert len(on) == DISC.n + 1 + 2 * DISC.rings
    rim = np.flatnonzero(np.hypot(*(mesh.nodes - CENTRE).T) > 10.0 - 1e-9)
    assert sorted(mesh.node_sets["boundary"]) == rim.tolist()
    assert mesh.nodes[mesh.node_sets["centre"]].tolist() == [list(CENTRE)]
    assert (mesh.middle, len(mesh.quad_sets["core"])) == (CENTRE, DISC.n**2 // 4)


def test_a_quarter_is_cut_between_quads() -> None:
    with pytest.raises(pre.RecipeError, match="n: 3 must be even"):
        replace(DISC, n=3, quarter=True)


def test_the_deck_of_a_quarter_is_held_and_hit_as_a_quarter() -> None:
    cards = cards_of(text_of(study_of(replace(DISC, quarter=True))))
    sphere = fields_of("IMPACTOR_SPHERE", cards["IMPACTOR_SPHERE"][0])
    assert [float(one) for one in sphere[2:5]] == [1.0e-5, *CENTRE]
    held = [fields_of("", line)[2:5] for line in cards["BOUNDARY_SPC_SET"]]
    assert held == [["1", "1", "1"], ["1", "0", "0"], ["0", "1", "0"]]
    whole = cards_of(text_of(study_of(DISC)))
    assert len(whole["BOUNDARY_SPC_SET"]) == 1


@pytest.mark.parametrize(
    ("words", "changes"),
    [
        ("0 and 90 only", {"laminate": replace(LAMINATE, layup="[45/90]s")}),
        ("hit along z", {"impactor": pre.Impactor(5.0, 4.0e-5, (1.0, 0.0, -2000.0))}),
        ("in the middle", {"impactor": pre.Impactor(5.0, 1e-5, (0.0, 0.0, -1.0), (4.0, -2.0))}),
        ("pressures", {"loads": (pre.FrameAcceleration(direction="x", value=1.0),)}),
    ],
)
def test_what_has_no_quarter_is_refused(words: str, changes: dict[str, object]) -> None:
    with pytest.raises(pre.RecipeError, match=words):
        replace(study_of(replace(DISC, quarter=True)), **changes)
    replace(study_of(DISC), **changes)


@pytest.mark.parametrize("method", ["points_on_plate", "nodes_on_impactor"])
def test_a_quarter_comes_to_a_quarter_of_the_whole(
    solver: str, tmp_path: Path, method: str
) -> None:
    force, area = [], []
    for name in ("whole", "quarter"):
        study = study_of(replace(DISC, quarter=name == "quarter"))
        study = replace(study, contact=pre.Contact(method=method))
        deck = tmp_path / f"{name}.k"
        pre.write_deck(pre.deck_text(study, pre.make_mesh(study.mesh)), deck)
        subprocess.run([solver, "run", deck, "-o", tmp_path], check=True, capture_output=True)
        history = np.loadtxt(tmp_path / f"{name}.impactor_1.csv", delimiter=",", skiprows=1)
        failed = np.loadtxt(tmp_path / f"{name}.delamination.csv", delimiter=",", skiprows=1)
        force.append(history[:, 1])
        area.append(failed[:, 5])
    assert force[0].max() > 100.0
    assert 4.0 * force[1] == pytest.approx(force[0], abs=1e-6 * force[0].max())
    assert area[0][-1] > 0.0
    assert 4.0 * area[1] == pytest.approx(area[0], rel=1e-6)
