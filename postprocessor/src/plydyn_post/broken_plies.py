"""Plies whose fibres broke while the stress of a test fell: how much, where, and how strained."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plydyn_post.compression import Compression
from plydyn_post.grid import has_point_field, read_times
from plydyn_post.interfaces import DELAMINATED, read_interfaces
from plydyn_post.plies import PlyCells, Stack, read_stack
from plydyn_post.sheets import Sheet, areas_beyond, find, of_quads, sheet_of
from plydyn_post.sublaminates import states_of
from plydyn_post.vtkhdf import layout_of, read_point_field

FIBRES = "damage_fibre"
#: Growth of damage that counts as broken
BROKEN = 0.5
#: Share of the length at either end that counts as the end
END = 0.1


@dataclass(frozen=True)
class BrokenPly:
    """What broke of a ply between the peak and the fall."""

    number: int  # from the bottom, from 1
    angle: float  # degrees
    area: float  # of newly broken fibres, seen from above
    along: tuple[float, float]  # its ends along the load
    over: float | None  # share of it over quads that were delaminated; nothing where none were
    strain: float  # along the fibres at the peak, mean over that area; negative where pressed
    grown: Sheet  # damage of the fibres, by how much it has grown


def broken_plies(test: Compression) -> tuple[BrokenPly, ...]:
    """The plies with newly broken fibres, the largest area first."""
    path = test.job.fields
    if not has_point_field(path, FIBRES):
        return ()
    states = states_of(test, path)
    before, after = (read_stack(test.job, time) for time in (states.peak, states.after))
    mask = delaminated_columns(test, before)
    each = [
        found
        for old, new in zip(before.plies, after.plies, strict=True)
        if (found := _broken(test.axis, mask, (before, old), (after, new))) is not None
    ]
    return tuple(sorted(each, key=lambda one: -one.area))


def _broken(
    axis: int, mask: np.ndarray, before: tuple[Stack, PlyCells], after: tuple[Stack, PlyCells]
) -> BrokenPly | None:
    """What broke of a ply, with the columns that were delaminated; nothing where nothing did."""
    (old, ply), (new, later) = before, after
    grown = new.values(later, FIBRES) - old.values(ply, FIBRES)
    sheet = sheet_of(old.places, np.max(grown, axis=(1, 4)))
    areas = areas_beyond(sheet, BROKEN)
    if areas.sum() <= 0.0:
        return None
    ways = sheet.places[sheet.triangles][areas > 0.0][..., axis]
    of_columns = of_quads(areas, len(old.places))
    return BrokenPly(
        ply.number,
        ply.angle,
        float(areas.sum()),
        (float(ways.min()), float(ways.max())),
        float(of_columns[mask].sum() / areas.sum()) if mask.any() else None,
        float(np.average(fibre_strains(old, ply), weights=of_columns)),
        sheet,
    )


def delaminated_columns(test: Compression, stack: Stack) -> np.ndarray:
    """Whether some interface over a quad was delaminated at a state, (columns,)."""
    if not test.job.interface_fields.is_file():
        return np.zeros(len(stack.places), bool)
    own = [
        one.places[np.max(one.spent, axis=(1, 2)) >= DELAMINATED].mean(axis=(1, 2))
        for one in read_interfaces(test.job, stack.time).each
    ]
    found = find(stack.places, np.concatenate(own)).quad
    mask = np.zeros(len(stack.places), bool)
    mask[found[found >= 0]] = True
    return mask


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


def broken_places(test: Compression) -> np.ndarray:
    """Places of the points whose fibres broke in the stage, (points,).

    Along the load, 0 at one end of the plate and 1 at the other; from the first state to the one
    after the fall of the stress, or to the last one.
    """
    path = test.job.fields
    if not has_point_field(path, FIBRES):
        return np.empty(0)
    times, points = read_times(path), layout_of(path).points
    ended = test.time[-1] if test.fallen is None else test.time[test.fallen]
    step = int(min(np.searchsorted(times, ended), len(times) - 1))
    first, last = (read_point_field(path, FIBRES, k) for k in (0, step))
    along = points[:, test.axis]
    share = (along - along.min()) / np.ptp(along)
    return share[last - first > BROKEN]


def place_words(test: Compression) -> str:
    """A sentence on where fibres broke; empty where none did."""
    places = broken_places(test)
    if len(places) == 0:
        return ""
    near = float(np.mean((places < END) | (places > 1.0 - END)))
    ends = "the plate broke at its ends" if test.pulled else "the ends were crushed"
    verdict = ends if near > 0.5 else "the plate failed between its ends"
    return f"{near:.0%} of the points with broken fibres lie within a tenth of an end: {verdict}."
