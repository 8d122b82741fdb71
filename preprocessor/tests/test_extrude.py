"""Plates of bricks: nodes, parts, sets and what they do not take."""

from __future__ import annotations

import dataclasses
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import CARBON

import plydyn_pre as pre
from plydyn_pre.extrude import extrude

METAL = pre.PlasticKinematic(density=7.8e-9, young=210e3, poisson=0.3, yield_stress=210.0)

DAMAGED = pre.PlyCodam2(
    **dataclasses.asdict(CARBON)
    | {"XT": 2500.0, "XC": 1500.0, "YT": 80.0, "YC": 230.0, "SL": 90.0}
    | {"G1T": 90.0, "G1C": 80.0, "G2T": 0.2, "G2C": 1.1}
)


def plate(**changes: object) -> pre.Study:
    """A small plate of bricks."""
    given: dict = {
        "title": "bricks",
        "materials": {"carbon": CARBON},
        "laminate": pre.Laminate(layup="[0/45/0]", thickness=0.5, material="carbon"),
        "mesh": pre.Rectangle(sides=(4.0, 2.0), quads=(4, 2), order=1),
        "control": pre.Control(end_time=1e-6),
        "supports": (pre.Support("left"), pre.Support("right", hold="z", face="bottom")),
        "impactor": pre.Impactor(radius=1.0, mass=1e-6, velocity=(0.0, 0.0, -1000.0)),
        "bricks": pre.Bricks(per_ply=2),
    }
    return pre.Study(**{**given, **changes})


def text(made: pre.Study) -> str:
    """The deck of a study."""
    return "\n".join(pre.deck_text(made, pre.make_mesh(made.mesh)))


def test_bricks_fill_the_plate() -> None:
    """Every ply has its bricks, from the bottom up, with the volume of the plate."""
    made = plate(mesh=pre.Rectangle(sides=(4.0, 2.0), quads=(2, 1), order=2))
    drawn = extrude(made, pre.make_mesh(made.mesh))
    assert (drawn.bricks, drawn.nodes) == (8 * 6, 15 * 7)
    assert drawn.heights == pytest.approx(np.linspace(-0.75, 0.75, 7))
    assert drawn.plies.tolist() == [0, 0, 1, 1, 2, 2]
    corners = drawn.plane.nodes[drawn.plane.quads]
    x, y = np.moveaxis(corners, 2, 0)
    area = 0.5 * ((x[:, 2] - x[:, 0]) * (y[:, 3] - y[:, 1]))
    area -= 0.5 * ((x[:, 3] - x[:, 1]) * (y[:, 2] - y[:, 0]))
    assert area == pytest.approx(1.0)
    assert drawn.brick_nodes(5).max() == drawn.nodes


def test_plies_of_one_direction_are_one_part() -> None:
    """Two parts with axes of their own; the sphere touches that of the top ply."""
    deck = text(plate())
    assert deck.count("*PART\n") == 2
    assert deck.count("*MAT_ORTHOTROPIC_ELASTIC") == 2
    assert re.search(r"cid +iid +pid.*\n +1 +1 +1 ", deck)
    rows = deck[deck.index("*ELEMENT_SOLID") :].splitlines()[2:-1]
    assert [int(row[8:16]) for row in rows] == [1] * 16 + [2] * 16 + [1] * 16


def test_bricks_of_damaged_plies_tell_their_axes() -> None:
    """Along the fibres, and to the left of them."""
    deck = text(plate(materials={"carbon": DAMAGED}))
    assert deck.count("*MAT_PLY_CODAM2") == 2
    rows = deck[deck.index("*ELEMENT_SOLID_ORTHO") :].splitlines()[2:-1]
    assert len(rows) == 3 * 48
    assert [int(row[8:16]) for row in rows[::3]] == [1] * 16 + [2] * 16 + [1] * 16
    turned = [
        [float(row[i : i + 16]) for i in (0, 16, 32)] for row in rows[16 * 3 + 1 : 16 * 3 + 3]
    ]
    half = np.sqrt(0.5)
    assert turned[0] == pytest.approx([half, half, 0.0])
    assert turned[1] == pytest.approx([-half, half, 0.0])


def test_sets_stand_on_all_levels_or_on_one() -> None:
    """Three nodes on seven levels, and on the lowest."""
    deck = text(plate())
    sets = deck.split("*SET_NODE_LIST_TITLE\n")[1:]
    counts = [len(" ".join(each.splitlines()[3:]).split("*")[0].split()) for each in sets]
    assert counts == [21, 3]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"outputs": pre.Outputs(profiles=(pre.Profile((1.0, 1.0)),))}, "bricks have none"),
        ({"loads": (pre.Pressure(1.0),)}, "bricks take motions"),
        ({"supports": (pre.Support("left", face="plane"),)}, "held on a face"),
    ],
)
def test_what_bricks_do_not_take_is_refused(changes: dict, words: str) -> None:
    """Before a deck is written."""
    with pytest.raises(pre.RecipeError, match=words):
        text(plate(**changes))


def test_the_solver_takes_the_deck(solver: str, tmp_path: Path) -> None:
    """As bricks of a metal, with the degrees of freedom counted here."""
    made = plate(
        materials={"steel": METAL},
        laminate=pre.Laminate(layup="[0]2", thickness=0.5, material="steel"),
        loads=(pre.InitialVelocity((0.0, 0.0, 1.0)),),
    )
    mesh = pre.make_mesh(made.mesh)
    pre.write_deck(pre.deck_text(made, mesh), tmp_path / "deck.k")
    checked = subprocess.run([solver, "check", tmp_path / "deck.k"], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    told = int(re.search(r"degrees of freedom +(\d+)", checked.stdout)[1])
    assert told == pre.count(made, mesh).freedoms == 3 * 15 * 5
