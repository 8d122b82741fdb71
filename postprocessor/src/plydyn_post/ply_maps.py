"""Maps of the damage of every ply, a row for each mechanism."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from plydyn_post.cracks import cracks_of, draw_cracks
from plydyn_post.errors import ResultsError
from plydyn_post.header import read_header
from plydyn_post.maps import (
    damage_bar,
    draw_damage,
    draw_plate,
    half_window,
    instant,
    look_from_above,
    mark_impact,
    middle_of,
    scale_bar,
)
from plydyn_post.plies import PlyCells, Stack, read_stack
from plydyn_post.ply_fields import MECHANISMS
from plydyn_post.results import Results
from plydyn_post.sheets import Sheet, edges_of, sheets_of
from plydyn_post.style import INK, WIDE, figure, finish, literal
from plydyn_post.symmetry import words_of

#: Most plies in a row, and width of a figure of many, inches
COLUMNS, WIDEST = 8, 9.0
#: Finer parts of the sides of quads: maps are small. Of more quads than so many there are fewer
PARTS, MANY, FEWEST = 6, 500, 2


def draw_ply_maps(
    results: Results,
    path: Path | None = None,
    time: float | None = None,
    mechanisms: tuple[str, ...] = (),
    whole: bool = False,
) -> Figure:
    """Draw the largest damage through the thickness of every ply, plies from the bottom up."""
    stack, header = read_stack(results, time), read_header(results.fields)
    names = mechanisms or tuple(name for name in MECHANISMS if name in stack.grid.point_data)
    for name in names or ("damage_matrix",):
        if name not in MECHANISMS:
            raise ResultsError(f"{name!r} is no damage; right would be {', '.join(MECHANISMS)}")
        if name not in stack.grid.point_data:
            raise ResultsError(
                f"{results.fields} has no field {name!r}; damage is written where a material of a"
                " ply can be damaged"
            )
    sheets = [_sheets(stack, name) for name in names]
    middle = middle_of(header, stack.places)
    cracks = cracks_of(results, stack.time) if "damage_matrix" in names else {}
    lines = [one.pieces for one in cracks.values()]
    half = half_window([sheet for row in sheets for sheet in row], middle, whole, lines=lines)
    columns = min(COLUMNS, len(stack.plies))
    blocks = -(-len(stack.plies) // columns)
    wide = max(WIDE, WIDEST * columns / COLUMNS)
    side = (wide - 1.1) / columns
    size = (wide, 0.35 + len(names) * blocks * (side + 0.12) + 0.28 * blocks)
    with figure(len(names) * blocks, columns, size=size, squeeze=False) as (made, grid):
        for axes in grid.flat:
            axes.set_axis_off()
        for row, (name, maps) in enumerate(zip(names, sheets, strict=True)):
            panels = grid[row * blocks : (row + 1) * blocks].ravel()
            _draw_row(panels, stack, maps, (middle, half), row == 0 or blocks > 1)
            for axes, ply in zip(panels, stack.plies, strict=False):
                if name == "damage_matrix":
                    draw_cracks(axes, cracks.get(ply.number))
            _name_row(panels[0], MECHANISMS.get(name, name))
        scale_bar(grid[0, 0], middle, half, header.units.get("length", ""))
        damage_bar(made, grid.ravel().tolist())
        words = f"{literal(results.job)}: damage of the plies from the bottom up,"
        words += f" {instant(header, stack.time)}   {words_of(results)}"
        words += "   lines: cracks of the matrix" if cracks else ""
        made.suptitle(words, fontsize=8.5, x=0.01, ha="left", color=INK)
        return finish(made, path)


def _draw_row(
    panels: np.ndarray,
    stack: Stack,
    maps: tuple[Sheet, ...],
    window: tuple[np.ndarray, float],
    titled: bool,
) -> None:
    """Draw a mechanism in all plies."""
    edges = edges_of(stack.places)
    for axes, ply, sheet in zip(panels, stack.plies, maps, strict=False):
        look_from_above(axes, *window)
        draw_damage(axes, sheet)
        draw_plate(axes, edges)
        mark_impact(axes, window[0])
        if titled:
            axes.set_title(_ply_words(ply), fontsize=7.5, pad=2)


def _sheets(stack: Stack, name: str) -> tuple[Sheet, ...]:
    """The largest values through the thickness of every ply."""
    parts = round(PARTS * np.sqrt(MANY / max(MANY, len(stack.places))))
    values = (np.clip(stack.values(ply, name), 0.0, 1.0) for ply in stack.plies)
    each = ((stack.places, one.max(axis=(1, 4))) for one in values)
    return sheets_of(each, max(FEWEST, parts))


def _ply_words(ply: PlyCells) -> str:
    angle = "" if np.isnan(ply.angle) else f":  {ply.angle:g}°".replace("-", "−")
    return f"ply {ply.number}{angle}"


def _name_row(axes: Axes, words: str) -> None:
    """Write the mechanism at the left of its row."""
    axes.text(
        -0.06,
        0.5,
        words,
        rotation=90,
        va="center",
        ha="right",
        transform=axes.transAxes,
        fontsize=9,
    )
