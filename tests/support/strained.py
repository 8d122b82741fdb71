"""A cube of one element whose strain is prescribed, and what its material answers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from decks import BOTTOM, TOP, Deck
from elasticity import Array
from meshes import regular
from runs import Table, run

# Strain and stress in this order, with engineering shear
COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")
# Direction that moves with a component of strain, and the coordinate that it grows with
_SLOPES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


@dataclass(frozen=True)
class Answer:
    """The cube over time; plastic strain and dissipation at the end."""

    time: Array
    strain: Array  # (times, 6)
    stress: Array  # (times, 6)
    plastic_strain: float
    energy: Table


def strain_cube(
    material: Callable[[Deck], None], times: Array, strains: Array, outputs: int, folder: Path
) -> Answer:
    """Lead a cube along a path of strain, (times, 6), straight in between, from no strain on."""
    deck = Deck("a cube along a path of strain", float(times[-1]))
    deck.control(linear=True)
    material(deck)
    mesh = regular(1.0, 1.0, 1, 1, 4)
    deck.mesh(mesh)
    deck.add("PART_COMPOSITE_LONG", "cube", (1, 0), (1, 1.0, 0.0, 0, 1))
    deck.add("SECTION_LAYERWISE", (1, 0, 1))
    for node, (x, y) in enumerate(mesh.points):
        for face, z in ((BOTTOM, -0.5), (TOP, 0.5)):
            moved = np.zeros((len(times), 3))
            for component, (direction, along) in enumerate(_SLOPES):
                moved[:, direction] += strains[:, component] * (x, y, z)[along]
            for direction in range(3):
                points = zip(times.tolist(), moved[:, direction].tolist(), strict=True)
                deck.move_face([node], face, direction + 1, deck.curve(points), 1.0)
    deck.profile(1, 0.5, 0.5, times[-1] / outputs, points=2)
    deck.intervals(glstat=times[-1] / outputs, binary_d3plot=times[-1])
    deck.add("DATABASE_FIELD", "plastic_strain")
    results = run(deck, folder)
    profile = results.table("profile_1")
    rows = profile["z"] < 0.0
    shear = ["e", "e", "e", "g", "g", "g"]
    return Answer(
        profile["time"][rows],
        np.stack([profile[s + c][rows] for s, c in zip(shear, COMPONENTS, strict=True)], axis=1),
        np.stack([profile["s" + c][rows] for c in COMPONENTS], axis=1),
        float(results.field("plastic_strain").max()),
        results.table("energy"),
    )
