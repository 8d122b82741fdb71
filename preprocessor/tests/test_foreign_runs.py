"""Decks in the layouts of their authors run to their end with the force of the same recipe."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from foreign_decks import RADIUS, Foreign, contact, rigid, rim, sphere_profile
from programs import plydyn_pre, run_deck

SPEED, END, GAP = 4000.0, 1.2e-4, 0.02
ANGLES = (0.0, 90.0, 90.0, 0.0)
RECIPE = """
title = "the same impact"
{units}
[materials.ply]
kind = "ply_elastic"
density = 1.6e-9
E1 = 153000.0
E2 = 10300.0
E3 = 10300.0
nu12 = 0.300058252427184
nu13 = 0.300058252427184
nu23 = 0.4
G12 = 6000.0
G13 = 6000.0
G23 = 3700.0
[laminate]
layup = "{layup}"
material = "ply"
thickness = {thickness}
{interfaces}
[mesh]
kind = "rectangle"
sides = [40.0, 40.0]
quads = [8, 8]
[[supports]]
set = "boundary"
hold = "xyz"
[impactor]
kind = "{kind}"
radius = 8.0
mass = 2.0e-4
guided = true
gap = {gap}
{motion}
[contact]
method = "points_on_plate"
friction = 0.2
dynamic_friction = 0.2
[control]
end_time = 1.2e-4
[outputs]
impactor_interval = 1.0e-6
{more}
"""
BASE = {
    "units": "",
    "layup": "[0/90/90/0]",
    "thickness": 0.125,
    "interfaces": "",
    "kind": "sphere",
    "gap": GAP,
    "motion": "velocity = [0.0, 0.0, -4000.0]",
    "more": "",
}


def law(deck: Foreign, mid: int = 1, axis: tuple[float, float] = (1.0, 0.0)) -> None:
    """An elastic ply: MAT_054 without strengths."""
    deck.put("MAT_054", (mid, 1.6e-9, 153000.0, 10300.0, 10300.0, 0.0202, 0.0202, 0.4))
    deck.put_cards((6000.0, 3700.0, 6000.0, None, 2.0), (None, None, None, *axis, 0.0))
    deck.put_cards((None,), (None,), (None,))


def shells(deck: Foreign, angles: tuple[float, ...] = ANGLES) -> list[int]:
    """A plate of composite shells."""
    plate = deck.layer()
    deck.quads(1, plate)
    rows = [(1, 0.125, angle) for angle in angles]
    deck.put("PART_COMPOSITE_LONG", "coupon", (1, 16, 0.833), *rows)
    return plate


def held(deck: Foreign, *layers: list[int]) -> None:
    """Hold the edges."""
    deck.set_of("SET_NODE_LIST_TITLE\nedges", 1, [n for layer in layers for n in rim(layer)])
    deck.put("BOUNDARY_SPC_SET", (1, 0, 1, 1, 1, 1, 1, 1))


def end(deck: Foreign) -> str:
    """The end of a deck, and its text."""
    deck.put("CONTROL_TERMINATION", (END,))
    deck.put("DATABASE_RCFORC", (1.0e-6,))
    return deck.text()


def workbench() -> str:
    """An export of a workbench: sections with angles, sets and many controls."""
    deck = Foreign()
    plate = deck.layer()
    deck.quads(1, plate)
    law(deck)
    deck.put("SECTION_SHELL", (1, 16, 0.833, 4, 0, 1.0, 1), (0.5,) * 4, ANGLES)
    deck.put("PART", "Surface Body", (1, 1, 1))
    deck.revolved(9, sphere_profile(0.25, GAP))
    rigid(deck)
    held(deck, plate)
    deck.put("SET_PART_LIST", (3,), (9,))
    deck.put("INITIAL_VELOCITY_GENERATION", (3, 1, 0.0, 0, 0, -SPEED), (None,))
    contact(deck, 9, 1)
    for name in ("CONTROL_ACCURACY", "CONTROL_BULK_VISCOSITY", "CONTROL_ENERGY", "CONTROL_OUTPUT"):
        deck.put(name, (2, 2, 2, 2))
    deck.put("DATABASE_FORMAT", (0,))
    return end(deck)


def prepost() -> str:
    """A deck that LS-PrePost has saved: comments over each card, zeros in all fields."""
    deck = Foreign()
    plate = shells(deck)
    law(deck)
    ball_of(deck)
    held(deck, plate)
    deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0.0, 0.0, -SPEED, 0.0, 0.0, 0.0, 0))
    deck.put("DATABASE_BINARY_D3PLOT", (1.0e-4, 0, 0, 0, 0), (0, 0.0, 0.0, 0.0, 0, 0))
    deck.put("CONTROL_HOURGLASS", (4, 0.1))
    text = end(deck).replace(
        "edges\n         1\n", f"edges\n         1{0.0:>10}{0.0:>10}{0.0:>10}{0.0:>10}MECH      1\n"
    )
    return text.replace("\n*", "\n$#  a comment over the card\n*")


def ball_of(deck: Foreign, top: float = 0.25) -> None:
    """A guided ball with the gap of the recipe."""
    deck.revolved(9, sphere_profile(top, GAP))
    rigid(deck)
    contact(deck, 1, 9, "CONTACT_AUTOMATIC_NODES_TO_SURFACE")


def drop_tower() -> str:
    """The deck of a script for drop towers: parameters, and a hemisphere on a rod."""
    deck = Foreign()
    deck.lines += [
        "*PARAMETER_EXPRESSION",
        "R height  4000.0**2/(2*9810.0)",
        "R speed   -sqrt(2*9810.0*height)",
    ]
    plate = shells(deck)
    law(deck)
    profile = [
        *sphere_profile(0.25, GAP),
        *((RADIUS, 0.25 + GAP + RADIUS + 5.0 * k) for k in (1, 2, 6)),
    ]
    deck.revolved(9, profile)
    rigid(deck)
    contact(deck, 9, 1)
    held(deck, plate)
    deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0.0, 0.0, "&speed"))
    return end(deck)


def open_source() -> str:
    """An example of an open-source code: MAT_002, velocities of nodes, generated sets."""
    deck = Foreign()
    shells(deck)
    deck.put(
        "MAT_ORTHOTROPIC_ELASTIC", (1, 1.6e-9, 153000.0, 10300.0, 10300.0, 0.0202, 0.0202, 0.4)
    )
    deck.put_cards((6000.0, 3700.0, 6000.0, 0.0), (None,), (None,))
    nodes = deck.revolved(9, sphere_profile(0.25, GAP))
    rigid(deck)
    contact(deck, 9, 1)
    deck.put(
        "SET_NODE_LIST_GENERATE",
        (2,),
        (1, 10, 18, 19, 27, 28, 36, 37),
        (45, 46, 54, 55, 63, 64, 72, 81),
    )
    deck.put("BOUNDARY_SPC_SET", (2, 0, 1, 1, 1, 1, 1, 1))
    deck.put("INITIAL_VELOCITY_NODE", *[(n, 0, 0, -SPEED) for n in nodes])
    return end(deck)


def hard_ball() -> str:
    """A hard ball on a flat panel, from a deck of a bird strike without its bird."""
    deck = Foreign()
    plate = shells(deck)
    law(deck)
    nodes = deck.revolved(9, sphere_profile(0.25, GAP))
    rigid(deck)
    deck.put("CONTACT_AUTOMATIC_SINGLE_SURFACE", (0,), (0.2, 0.2), (None,))
    held(deck, plate)
    deck.set_of("SET_NODE_LIST", 7, nodes)
    deck.put("INITIAL_VELOCITY", (7,), (0.0, 0.0, -SPEED))
    deck.put("CONTROL_SPH", (1, 0, 1.0e20))
    return end(deck)


def stack() -> str:
    """Two parts with a tiebreak contact between them, by segments."""
    deck = Foreign()
    lower, upper = deck.layer(0.125), deck.layer(0.375)
    for pid, layer in enumerate((lower, upper), start=1):
        deck.quads(pid, layer)
        deck.put("PART_COMPOSITE", f"half {pid}", (pid, 16), (1, 0.25, 90.0 * (pid - 1)))
    law(deck)
    deck.revolved(9, sphere_profile(0.5, GAP))
    rigid(deck)
    contact(deck, 2, 9)
    held(deck, lower, upper)
    deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0, 0, -SPEED))
    nine = (9, 60.0, 90.0, -1.5, 0.3, 0.8, 0.4, 1.0e5)
    name = "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK"
    deck.put(name, (1, 2, 3, 3), (None,), (None,), nine)
    return end(deck)


def bricks() -> str:
    """One layer of bricks for each ply."""
    deck = Foreign()
    layers = [deck.layer(0.125 * k) for k in range(5)]
    for k in range(4):
        deck.quads(k + 1, layers[k], layers[k + 1], name="ELEMENT_SOLID")
        deck.put("PART", f"ply {k}", (k + 1, 1, 1 + (k in (1, 2))))
    deck.put("SECTION_SOLID", (1, 1))
    law(deck, 1)
    law(deck, 2, (0.0, 1.0))
    deck.revolved(9, sphere_profile(0.5, GAP))
    rigid(deck)
    contact(deck, 4, 9)
    held(deck, *layers)
    deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0, 0, -SPEED))
    return end(deck)


def thick_shells() -> str:
    """Thick shells, one for the laminate."""
    deck = Foreign()
    low, high = deck.layer(0.0), deck.layer(0.5)
    deck.quads(1, low, high, name="ELEMENT_TSHELL")
    pairs = (1, 0.125, 0.0, 0, 1, 0.125, 90.0), (1, 0.125, 90.0, 0, 1, 0.125, 0.0)
    deck.put("PART_COMPOSITE_TSHELL", "laminate", (1, 1), *pairs)
    law(deck)
    deck.revolved(9, sphere_profile(0.5, GAP))
    rigid(deck)
    contact(deck, 1, 9)
    held(deck, low, high)
    deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0, 0, -SPEED))
    return end(deck)


def wall() -> str:
    """A rigid wall in the shape of a sphere that moves along a curve."""
    deck = Foreign()
    plate = shells(deck)
    law(deck)
    held(deck, plate)
    z = 0.25 + GAP + RADIUS
    deck.put("RIGIDWALL_GEOMETRIC_SPHERE_MOTION_ID", (1, "ball"), (0,))
    deck.put_cards((20.0, 20.0, z, 20.0, 20.0, z + 1.0, 0.2), (RADIUS,), (7, 0, 0.0, 0.0, -1.0))
    deck.put("DEFINE_CURVE", (7,), f"{0.0:>20}{SPEED:>20}", f"{1.0:>20}{SPEED:>20}")
    return end(deck)


def held_by_nodes() -> str:
    """Clockwise quads, edges held by TC of *NODE, and a body that follows a curve."""
    deck = Foreign()
    plate = deck.layer()
    edge = {f"{n:8d}" for n in rim(plate)}
    deck.lines = [line + ("       7       7" if line[:8] in edge else "") for line in deck.lines]
    deck.quads(1, plate, turned=True)
    deck.put("PART_COMPOSITE_LONG", "coupon", (1, 16), *[(1, 0.125, angle) for angle in ANGLES])
    law(deck)
    deck.revolved(9, sphere_profile(0.25, GAP))
    rigid(deck)
    contact(deck, 9, 1)
    deck.put("BOUNDARY_PRESCRIBED_MOTION_RIGID", (9, 3, 0, 7, -1.0))
    deck.put("DEFINE_CURVE", (7,), f"{0.0:>20}{SPEED:>20}", f"{1.0:>20}{SPEED:>20}")
    return end(deck)


STILL = {
    "motion": 'motion_z = "push"',
    "more": "[curves.push]\ntime = [0.0, 1.0]\nvalue = [-4000.0, -4000.0]",
}
BOND = """
[materials.bond]
kind = "cohesive"
normal = 1.0e5
shear = 4.0e4
N = 60.0
S = 90.0
GIC = 0.3
GIIC = 0.8
exponent = 1.5
"""
STACK = {"layup": "[0/90]", "thickness": 0.25, "interfaces": 'interfaces = "bond"', "more": BOND}
CASES: dict[str, tuple[Callable[[], str], dict[str, object]]] = {
    "workbench": (workbench, {}),
    "prepost": (prepost, {}),
    "drop tower": (drop_tower, {"kind": "tup"}),
    "open source": (open_source, {}),
    "hard ball": (hard_ball, {}),
    "stack": (stack, STACK),
    "bricks": (bricks, {}),
    "thick shells": (thick_shells, {}),
    "wall": (wall, STILL),
    "held by nodes": (held_by_nodes, STILL),
}


@pytest.mark.parametrize("name", CASES)
def test_a_deck_of_others_has_the_force_of_the_same_recipe(
    name: str,
    solver: str,
    force_of: Callable[[str], tuple[np.ndarray, np.ndarray]],
    tmp_path: Path,
) -> None:
    make, changes = CASES[name]
    (tmp_path / "user.k").write_text(make())
    result = plydyn_pre(tmp_path, "translate", "user.k")
    assert result.returncode == 0, result.stdout + result.stderr
    run_deck(solver, tmp_path, "user_plydyn.k")
    path = tmp_path / "user_plydyn.impactor_1.csv"
    theirs = np.loadtxt(path, delimiter=",", skiprows=1)[:, 1]
    own = force_of(RECIPE.format(**(BASE | changes)))[1]
    assert len(theirs) == len(own) and own.max() > 50.0
    assert theirs == pytest.approx(own, abs=0.02 * own.max())


def test_a_soft_bird_is_refused_by_its_cause(tmp_path: Path) -> None:
    text = hard_ball().replace("*END", "*ELEMENT_SPH\n9001,5,1.0e-6\n*SECTION_SPH\n5\n*END")
    (tmp_path / "user.k").write_text(text)
    result = plydyn_pre(tmp_path, "translate", "user.k")
    assert result.returncode == 2
    assert "*ELEMENT_SPH: these elements are not translated" in result.stderr
