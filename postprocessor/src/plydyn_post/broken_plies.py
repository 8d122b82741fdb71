"""Plies whose fibres broke while the stress of a test fell: how much, where, and how strained."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plydyn_post.compression import Compression
from plydyn_post.compression_place import BROKEN
from plydyn_post.grid import has_point_field
from plydyn_post.plies import PlyCells, Stack, read_stack
from plydyn_post.sheets import areas_beyond, of_quads, sheet_of
from plydyn_post.sublaminates import states_of


@dataclass(frozen=True)
class BrokenPly:
    """What broke of a ply between the peak and the fall."""

    number: int  # from the bottom, from 1
    angle: float  # degrees
    area: float  # of newly broken fibres, seen from above
    place: tuple[float, float]  # its middle
    strain: float  # along the fibres at the peak, mean over that area; negative where pressed


def broken_plies(test: Compression) -> tuple[BrokenPly, ...]:
    """The plies with newly broken fibres, the largest area first."""
    path = test.job.fields
    if not has_point_field(path, "damage_fibre"):
        return ()
    states = states_of(test, path)
    before, after = (read_stack(test.job, time) for time in (states.peak, states.after))
    each = [
        found
        for old, new in zip(before.plies, after.plies, strict=True)
        if (found := _broken(before, old, after, new)) is not None
    ]
    return tuple(sorted(each, key=lambda one: -one.area))


def _broken(before: Stack, old: PlyCells, after: Stack, new: PlyCells) -> BrokenPly | None:
    """What broke of a ply; nothing where nothing did."""
    grown = after.values(new, "damage_fibre") - before.values(old, "damage_fibre")
    sheet = sheet_of(before.places, np.max(grown, axis=(1, 4)))
    areas = areas_beyond(sheet, BROKEN)
    if areas.sum() <= 0.0:
        return None
    x, y = np.average(sheet.places[sheet.triangles].mean(axis=1), axis=0, weights=areas)
    of_columns = of_quads(areas, len(before.places))
    strain = float(np.average(fibre_strains(before, old), weights=of_columns))
    return BrokenPly(old.number, old.angle, float(areas.sum()), (float(x), float(y)), strain)


def fibre_strains(stack: Stack, ply: PlyCells) -> np.ndarray:
    """Green-Lagrange strain along the fibres in the middle of each column of a ply, (columns,)."""
    points = np.asarray(stack.grid.points, dtype=float)[ply.nodes]
    first, second = _sides(points), _sides(np.swapaxes(points, 2, 3))
    moved = points + stack.values(ply, "displacement")
    sides = np.stack([first[:, :2], second[:, :2]], axis=2)
    angle = np.radians(ply.angle)
    fibre = np.array([np.cos(angle), np.sin(angle)])
    shares = np.linalg.solve(sides, np.broadcast_to(fibre[:, None], (len(sides), 2, 1)))[..., 0]
    line = shares[:, :1] * _sides(moved) + shares[:, 1:] * _sides(np.swapaxes(moved, 2, 3))
    return 0.5 * (np.sum(line**2, axis=1) - 1.0)


def _sides(points: np.ndarray) -> np.ndarray:
    """From the middle of one side of columns to that of the other, (columns, 3)."""
    return np.asarray(np.mean(points[:, :, -1] - points[:, :, 0], axis=(1, 2, 3)))
