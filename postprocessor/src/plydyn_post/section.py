"""A cut through the point of impact: damage and cracks of the plies, and interfaces apart."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from plydyn_post.cracks import PlyCracks, cracks_of
from plydyn_post.errors import ResultsError
from plydyn_post.header import Header, read_header
from plydyn_post.hexahedra import finer
from plydyn_post.interfaces import DELAMINATED, Interface, Interfaces, read_interfaces
from plydyn_post.maps import (
    MARGIN,
    SEEN,
    SMALLEST,
    damage_bar,
    instant,
    middle_of,
)
from plydyn_post.plies import PlyCells, Stack, read_stack
from plydyn_post.ply_fields import MECHANISMS
from plydyn_post.results import Results
from plydyn_post.sheets import Found, find
from plydyn_post.style import DAMAGE_MAP, INK, QUIET, WIDE, figure, finish, literal
from plydyn_post.units import in_brackets, readable

#: Places along a cut, and finer parts of each layer through the thickness
PLACES, PARTS = 1201, 6
#: Colour of delaminated interfaces
APART = "#0050a8"


@dataclass(frozen=True)
class Cut:
    """Plies along a line, from the bottom up."""

    along: np.ndarray  # (places,) distance from the point of impact at time zero
    places: np.ndarray  # (places, 2) in the plane
    far: list[np.ndarray]  # (places, levels) the distance now, one for each ply
    heights: list[np.ndarray]  # (places, levels) now
    values: list[np.ndarray]  # (places, levels)


def draw_section(
    results: Results,
    path: Path | None = None,
    time: float | None = None,
    mechanism: str = "damage_matrix",
    angles: tuple[float, ...] = (0.0, 90.0),
    whole: bool = False,
) -> Figure:
    """Draw cuts along some directions, degrees from x, deformed as the plate is.

    Heights are drawn larger than lengths along the plate, by a factor that is told.
    """
    stack, header = read_stack(results, time), read_header(results.fields)
    if mechanism not in stack.grid.point_data:
        raise ResultsError(f"{results.fields} has no field {mechanism!r} to draw")
    between, cracks = interfaces_of(results, stack.time), cracks_of(results, stack.time)
    middle = middle_of(header, stack.places)
    cuts = [cut_plies(stack, middle, angle, mechanism) for angle in angles]
    half = max(half_of(cut, between, cracks, whole) for cut in cuts)
    size = (WIDE, 0.5 + 1.75 * len(cuts))
    with figure(len(cuts), 1, size=size, squeeze=False, sharey=True) as (made, grid):
        for axes, cut, angle in zip(grid[:, 0], cuts, angles, strict=True):
            draw_plies(axes, cut, half, header)
            if between:
                draw_apart(axes, cut, between, header)
            draw_across(axes, cut, cracks, header)
            axes.set_title(f"cut along {angle:g}°", fontsize=8.5, loc="left")
        words = f"{MECHANISMS.get(mechanism, mechanism)} damage".capitalize()
        damage_bar(made, grid[:, 0].tolist(), words)
        told = f"{literal(results.job)}   {instant(header, stack.time)}"
        told += f"   $z$ × {steepness(made, grid[0, 0]):.2g}"
        lines = [f"blue: {between.criterion}"] if between else []
        lines += ["lines: cracks of the matrix"] if cracks else []
        told += "\n" + "   ".join(lines) if lines else ""
        grid[0, 0].set_title(told, fontsize=8, loc="right")
        return finish(made, path)


def steepness(made: Figure, axes: Axes) -> float:
    """How many times larger heights are drawn than lengths along the plate."""
    made.draw_without_rendering()
    box, (left, right), (low, high) = axes.get_window_extent(), axes.get_xlim(), axes.get_ylim()
    return (box.height / (high - low)) / (box.width / (right - left))


def interfaces_of(results: Results, time: float) -> Interfaces | None:
    """The interfaces at a time, where the job has a file of them."""
    return read_interfaces(results, time) if results.interface_fields.is_file() else None


def cut_plies(stack: Stack, middle: np.ndarray, angle: float, mechanism: str) -> Cut:
    """Sample the plies along a line through the point of impact."""
    way = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    reach = float(np.abs(stack.places - middle).max())
    along = np.linspace(-reach, reach, PLACES)
    places = middle + along[:, None] * way
    found = find(stack.places, places)
    inside = found.quad >= 0
    found = Found(found.quad[inside], found.weights[inside])
    cut = Cut(along[inside], places[inside], [], [], [])
    for ply in stack.plies:
        moved = _moved(stack, ply)
        across = _sampled(moved[..., :2] @ way, ply, found)
        cut.far.append(cut.along[:, None] + across)
        cut.heights.append(_sampled(moved[..., 2] + _height(stack, ply), ply, found))
        cut.values.append(np.clip(_sampled(stack.values(ply, mechanism), ply, found), 0.0, 1.0))
    return cut


def _height(stack: Stack, ply: PlyCells) -> np.ndarray:
    """Height of the nodes of a ply at time zero."""
    return np.asarray(stack.grid.points)[..., 2][ply.nodes].astype(float)


def _moved(stack: Stack, ply: PlyCells) -> np.ndarray:
    """Displacement of the nodes of a ply, nothing where the file has none."""
    if "displacement" in stack.grid.point_data:
        return stack.values(ply, "displacement")
    return np.zeros((*ply.nodes.shape, 3))


def _sampled(values: np.ndarray, ply: PlyCells, found: Found) -> np.ndarray:
    """Values at the nodes of a ply at places of a cut and at heights, (places, levels)."""
    at = np.einsum("pab,plabk->plk", found.weights, values[found.quad])
    fine = np.einsum("hk,plk->plh", finer(ply.nodes.shape[4], PARTS), at)
    return fine.reshape(len(fine), -1)


def half_of(
    cut: Cut, between: Interfaces | None, cracks: Mapping[int, PlyCracks], whole: bool
) -> float:
    """Half the length of a cut that is shown: all damage of plies and interfaces, or the plate."""
    reach = float(np.abs(cut.along).max())
    if whole:
        return reach
    damaged = np.max([values.max(axis=1) for values in cut.values], axis=0) > SEEN
    for one in between.each if between else ():
        damaged |= apart_along(cut, one)
    for own in cracks.values():
        damaged[places_across(cut, own)] = True
    far = float(np.abs(cut.along[damaged]).max(initial=0.0))
    return float(np.clip((1.0 + MARGIN) * far, SMALLEST * reach, reach))


def draw_plies(axes: Axes, cut: Cut, half: float, header: Header) -> None:
    """Plies with their faces."""
    length = readable(header.units.get("length", ""), half)
    seen = np.abs(cut.along) <= 1.05 * half
    look: dict[str, Any] = {"shading": "gouraud", "cmap": DAMAGE_MAP, "vmin": 0.0, "vmax": 1.0}
    for far, height, values in zip(cut.far, cut.heights, cut.values, strict=True):
        x, z = far[seen] * length.factor, height[seen] * length.factor
        axes.pcolormesh(x, z, values[seen], rasterized=True, **look)
        for face in (0, -1):
            axes.plot(x[:, face], z[:, face], color=QUIET, linewidth=0.5)
    low = min(float(height[seen].min()) for height in cut.heights) * length.factor
    high = max(float(height[seen].max()) for height in cut.heights) * length.factor
    free = 0.08 * (high - low)
    axes.set(xlim=(-half * length.factor, half * length.factor), ylim=(low - free, high + free))
    axes.grid(False)
    axes.set_xlabel(in_brackets("Distance from the impact", length.unit))
    axes.set_ylabel(in_brackets("$z$", length.unit))


def apart_along(cut: Cut, one: Interface) -> np.ndarray:
    """Whether an interface is delaminated at the places of a cut, (places,)."""
    found = find(one.places, cut.places)
    spent = np.einsum("pab,pab->p", found.weights, one.spent[found.quad])
    apart: np.ndarray = (spent >= DELAMINATED) & (found.quad >= 0)
    return apart


def draw_apart(axes: Axes, cut: Cut, between: Interfaces, header: Header) -> None:
    """Both faces of interfaces that are delaminated, where they are."""
    length = readable(header.units.get("length", ""), 1.0)
    for one in between.each:
        if one.number not in range(1, len(cut.heights)):
            continue
        apart = apart_along(cut, one)
        for ply, face in ((one.number - 1, -1), (one.number, 0)):
            x, z = cut.far[ply][:, face], cut.heights[ply][:, face]
            ends = np.column_stack([x, z]) * length.factor
            pieces = np.stack([ends[:-1], ends[1:]], axis=1)[apart[:-1] & apart[1:]]
            axes.add_collection(LineCollection(pieces, colors=APART, linewidths=1.1, zorder=3))
    axes.axvline(0.0, color=INK, linewidth=0.4, linestyle=(0, (4, 4)), zorder=0.5)


def places_across(cut: Cut, cracks: PlyCracks) -> np.ndarray:
    """Numbers of the places of a cut that are nearest to where cracks cross it."""
    at = cut.along[0] + cracks.crossings(cut.places[0], cut.places[-1])
    nearest: np.ndarray = np.abs(cut.along[:, None] - at).argmin(axis=0)
    return np.unique(nearest)


def draw_across(axes: Axes, cut: Cut, cracks: Mapping[int, PlyCracks], header: Header) -> None:
    """Cracks of the plies from face to face, where they cross the cut."""
    length = readable(header.units.get("length", ""), 1.0)
    for own in cracks.values():
        at, ply = places_across(cut, own), own.ply - 1
        ends = np.stack([cut.far[ply][at], cut.heights[ply][at]], axis=2)[:, [0, -1]]
        pieces = LineCollection(list(ends * length.factor), colors=INK, linewidths=0.7, zorder=2)
        axes.add_collection(pieces)
