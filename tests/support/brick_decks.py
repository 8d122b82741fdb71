"""Decks of bricks: boxes divided along the axes, straight or distorted."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from decks import Deck
from elasticity import Array
from meshes import Integers


@dataclass(frozen=True)
class Bricks:
    """Points (n, 3) and bricks (m, 8), nodes from 0; layers of bricks from the bottom up."""

    points: Array
    bricks: Integers
    layer: Integers  # (m,)

    def where(self, **place: float) -> list[int]:
        """Nodes whose x, y or z have a value."""
        chosen = np.ones(len(self.points), bool)
        for name, value in place.items():
            chosen &= np.abs(self.points[:, "xyz".index(name)] - value) < 1e-9
        return [int(node) for node in np.flatnonzero(chosen)]

    def outside(self) -> list[int]:
        """Nodes on the faces of the box that the mesh fills."""
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        outer = (np.abs(self.points - low) < 1e-9) | (np.abs(self.points - high) < 1e-9)
        return [int(node) for node in np.flatnonzero(outer.any(axis=1))]


def box(size: Sequence[float], counts: Sequence[int]) -> Bricks:
    """A box from the origin with equal bricks."""
    lines = [np.linspace(0.0, s, n + 1) for s, n in zip(size, counts, strict=True)]
    z, y, x = np.meshgrid(lines[2], lines[1], lines[0], indexing="ij")
    points = np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)
    row, plane = counts[0] + 1, (counts[0] + 1) * (counts[1] + 1)
    corner = [0, 1, row + 1, row, plane, plane + 1, plane + row + 1, plane + row]
    first = [
        k * plane + j * row + i
        for k in range(counts[2])
        for j in range(counts[1])
        for i in range(counts[0])
    ]
    bricks = np.array(first)[:, None] + np.array(corner)
    layer = np.repeat(np.arange(counts[2]), counts[0] * counts[1])
    return Bricks(points, bricks, layer)


def shaken(bricks: Bricks, shift: float, seed: int = 1) -> Bricks:
    """Shift every node inside by up to `shift` in all directions."""
    random = np.random.default_rng(seed)
    points = bricks.points + random.uniform(-shift, shift, bricks.points.shape)
    outer = bricks.outside()
    points[outer] = bricks.points[outer]
    return Bricks(points, bricks.bricks, bricks.layer)


def add_bricks(
    deck: Deck,
    mesh: Bricks,
    material: Callable[[Deck], None],
    *,
    points: int = 1,
    hourglass: tuple[int, float] | None = None,
    angles: Sequence[float] = (),
    parts: Sequence[int] = (1,),
) -> None:
    """Nodes, bricks and their parts, each of the material of its number.

    With an angle for each layer, in degrees, the bricks tell the directions of their fibres.
    """
    material(deck)
    deck.add("NODE", *[(i + 1, *point) for i, point in enumerate(mesh.points)])
    cards = [(i + 1, parts[i % len(parts)], *(b + 1)) for i, b in enumerate(mesh.bricks)]
    if angles:
        c, s = np.cos(np.radians(angles))[mesh.layer], np.sin(np.radians(angles))[mesh.layer]
        axes = [((c[i], s[i], 0.0), (-s[i], c[i], 0.0)) for i in range(len(cards))]
        deck.add(
            "ELEMENT_SOLID_ORTHO",
            *[one for card, own in zip(cards, axes, strict=True) for one in (card, *own)],
        )
    else:
        deck.add("ELEMENT_SOLID", *cards)
    deck.add("SECTION_SOLID", (1, 1 if points == 1 else 2))
    for part in sorted(set(parts)):
        deck.add("PART", "bricks", (part, 1, part))
    if hourglass is not None:
        deck.add("CONTROL_HOURGLASS", hourglass)
