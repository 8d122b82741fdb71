"""A cube of one element whose strain is prescribed, and what its material answers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from brick_decks import add_bricks, box
from decks import BOTTOM, TOP, Deck
from elasticity import Array
from meshes import regular
from runs import Results, Table, run

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


#: What a cube may be made of
BODIES = ("plate", "one point", "eight points")


def strain_body(
    body: str, material: Callable[[Deck], None], times: Array, strains: Array, folder: Path
) -> Results:
    """Lead a cube of one of `BODIES` along a path of strain; stress as a field at the end."""
    if body == "plate":
        deck = cube(material, times, strains)
    else:
        deck = Deck("a brick along a path of strain", float(times[-1]))
        deck.control(linear=True)
        mesh = box((1.0, 1.0, 1.0), (1, 1, 1))
        add_bricks(deck, mesh, material, points=1 if body == "one point" else 8)
        for node, place in enumerate(mesh.points):
            for direction, points in enumerate(_paths(times, strains, place)):
                deck.move([node], direction + 1, deck.curve(points), 1.0)
    deck.intervals(glstat=times[-1] / 100, binary_d3plot=times[-1])
    deck.add("DATABASE_FIELD", "stress")
    return run(deck, folder)


def cube(material: Callable[[Deck], None], times: Array, strains: Array) -> Deck:
    """A quad of one layer whose points follow a path of strain."""
    deck = Deck("a cube along a path of strain", float(times[-1]))
    deck.control(linear=True)
    material(deck)
    mesh = regular(1.0, 1.0, 1, 1, 4)
    deck.mesh(mesh)
    deck.add("PART_COMPOSITE_LONG", "cube", (1, 0), (1, 1.0, 0.0, 0, 1))
    deck.add("SECTION_LAYERWISE", (1, 0, 1))
    for node, (x, y) in enumerate(mesh.points):
        for face, z in ((BOTTOM, -0.5), (TOP, 0.5)):
            for direction, points in enumerate(_paths(times, strains, (x, y, z))):
                deck.move_face([node], face, direction + 1, deck.curve(points), 1.0)
    return deck


def _paths(times: Array, strains: Array, place: Sequence[float]) -> list[list[tuple[float, float]]]:
    """Displacement of a place over time, direction by direction."""
    moved = np.zeros((len(times), 3))
    for component, (direction, along) in enumerate(_SLOPES):
        moved[:, direction] += strains[:, component] * place[along]
    return [list(zip(times.tolist(), one.tolist(), strict=True)) for one in moved.T]


def strain_cube(
    material: Callable[[Deck], None], times: Array, strains: Array, outputs: int, folder: Path
) -> Answer:
    """Lead a cube along a path of strain, (times, 6), straight in between, from no strain on."""
    deck = cube(material, times, strains)
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
