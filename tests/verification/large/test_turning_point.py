"""A cube that is strained while it turns through more than a right angle about a slanted axis."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparison import Comparison
from damage import HTS40
from decks import BOTTOM, TOP, Deck
from elasticity import Array
from meshes import regular
from runs import Results, run

# A heavy ply takes long steps: some hundred in a path
END, DENSITY, STATES = 2.0e-2, 4.0e-3, 4000
AXIS = np.array([0.3, -0.5, 0.8]) / np.linalg.norm([0.3, -0.5, 0.8])
LAST = 1.9  # angle at the end
COMPONENTS = ("s11", "s22", "s33", "s12", "s13", "s23")


def codam2(deck: Deck) -> None:
    """A ply that is damaged, with a curve of shear."""
    ply = replace(HTS40, density=DENSITY, curve=(1, 0, 0.05), largest=0.999, band=0.2)
    deck.add("MAT_PLY_CODAM2", *replace(ply, cross_strength=0.0).cards(1))


def fracture(deck: Deck) -> None:
    """A ply that cracks on planes of fracture."""
    deck.add(
        "MAT_PLY_FRACTURE_3D",
        (1, DENSITY, 171.42e3, 9.08e3, 9.08e3, 0.32, 0.32, 0.45),
        (5.29e3, 5.29e3, 3.131e3),
        (2326.2, 1200.1, 62.3, 199.8, 92.3),
        (97.8, 106.3, 0.277, 0.788, 0.2, 0.999),
        (4, 0, 0, 66.9, 0.05),
        (0.3, 0.1, 0, 400.0),
    )


def metal(deck: Deck) -> None:
    """A metal that hardens both ways."""
    deck.add("MAT_PLASTIC_KINEMATIC", (1, DENSITY, 210.0e3, 0.3, 250.0, 2.0e3, 0.5))


def stretches() -> Array:
    """A smooth path of symmetric stretches by chance, (states, 3, 3)."""
    corners = 0.01 * np.random.default_rng(3).normal(size=(6, 3, 3))
    corners = 0.5 * (corners + corners.transpose(0, 2, 1))
    corners[0] = 0.0
    place = np.linspace(0.0, 5.0, STATES + 1)
    leg = np.minimum(place.astype(int), 4)
    part = (place - leg) ** 2 * (3.0 - 2.0 * (place - leg))
    part = part[:, None, None]
    return np.eye(3) + corners[leg] * (1.0 - part) + corners[leg + 1] * part


def turns() -> Array:
    """Rotations about the axis, (states, 3, 3), by Rodrigues' formula."""
    x, y, z = AXIS
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    angle = LAST * np.sin(0.5 * np.pi * np.linspace(0.0, 1.0, STATES + 1))[:, None, None]
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross


def led(material: Callable[[Deck], None], motion: Array, folder: Path) -> Results:
    """One quad of one layer, fibres at 30 degrees, all of whose points follow a gradient."""
    deck = Deck("a point that turns", END)
    # the work of such long steps is not that of the strain
    deck.add("CONTROL_LAYERWISE", (1, 1.0e9))
    material(deck)
    mesh = regular(1.0, 1.0, 1, 1, 4)
    deck.mesh(mesh)
    deck.add("PART_COMPOSITE_LONG", "cube", (1, 0), (1, 1.0, 30.0, 0, 1))
    deck.add("SECTION_LAYERWISE", (1, 0, 1))
    times = np.linspace(0.0, END, STATES + 1)
    for node, (x, y) in enumerate(mesh.points):
        for face in (BOTTOM, TOP):
            place = np.array([x, y, 0.5 * face])
            for axis, way in enumerate((motion @ place - place).T):
                curve = deck.curve(zip(times, way, strict=True))
                deck.move_face([node], face, axis + 1, curve, 1.0)
    deck.profile(1, 0.5, 0.5, END / 200.0, points=2)
    deck.intervals(glstat=END / 200.0)
    return run(deck, folder)


@pytest.mark.parametrize("material", [codam2, fracture, metal])
def test_turn_changes_nothing(
    material: Callable[[Deck], None], compare: Comparison, tmp_path: Path
) -> None:
    """Stress in the axes of the ply and losses are those of the same stretch without a turn.

    Between points of its curves, 7e-4 apart in angle, a motion is straight: the chord is shorter
    than the arc by 7e-8, which is 4e-6 of a strain of 2 %, and twice as much of its energy.
    """
    still = led(material, stretches(), tmp_path / "still")
    turned = led(material, turns() @ stretches(), tmp_path / "turned")
    stress, found = (
        np.column_stack([each.table("profile_1")[name] for name in COMPONENTS])
        for each in (still, turned)
    )
    scale = 2.0e-5 * np.abs(stress).max()
    compare.values("stress of a ply that turns", found, stress, unit="MPa", abs=scale)
    lost, taken = (each.table("energy")["dissipated"] for each in (still, turned))
    assert lost[-1] > 1.0
    compare.values("energy that it dissipates", taken, lost, unit="mJ", abs=2.0e-5 * lost[-1])
