"""Every interface in a panel of its own: how much of its fracture energy is spent."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from plydyn_post.cracks import draw_cracks
from plydyn_post.interfaces import DELAMINATED, ENERGY, Interface
from plydyn_post.maps import (
    SEEN,
    area_words,
    damage_bar,
    draw_damage,
    draw_plate,
    instant,
    look_from_above,
    mark_impact,
    outline_beyond,
    scale_bar,
)
from plydyn_post.results import Results
from plydyn_post.scan import Scan, panels_of, read_scan
from plydyn_post.sheets import Sheet, edges_of
from plydyn_post.style import INK, WIDE, figure, finish, literal
from plydyn_post.symmetry import words_of

#: Colours of the cracks of the plies below and above an interface
BELOW, ABOVE = "#1b9e4b", "#2b6cd9"
#: Columns of few panels, inches of the bar, and words over a panel and over all
FEW_COLUMNS, BAR, WORDS, HEAD = 4, 1.0, 0.34, 0.5
#: Largest size of the words over a panel, and what leaves them room in one of many columns
LARGEST, ACROSS = 7.0, 43.0


def draw_delamination(
    results: Results, path: Path | None = None, time: float | None = None, whole: bool = False
) -> Figure:
    """The share of the fracture energy spent, from the bottom up; delaminated inside white lines.

    Results without that share show the damage, with white lines around where it is complete.
    """
    scan = read_scan(results, time, whole)
    rows, columns = panels_of(len(scan.sheets))
    columns = max(columns, min(FEW_COLUMNS, len(scan.sheets)))
    rows = -(-len(scan.sheets) // columns)
    wide = WIDE if columns > 1 else 0.6 * WIDE
    high = HEAD + rows * (WORDS + (wide - BAR) / columns)
    engine = ConstrainedLayoutEngine(h_pad=0.01, hspace=0.01)
    with figure(rows, columns, size=(wide, high), squeeze=False, layout=engine) as (made, grid):
        edges = edges_of(scan.state.each[0].places)
        for axes in grid.flat:
            axes.set_axis_off()
        each = zip(grid.flat, scan.state.each, shown_of(scan), scan.sheets, strict=False)
        size = min(LARGEST, ACROSS / columns)
        for axes, one, shown, sheet in each:
            _draw_panel(axes, scan, one, (shown, sheet), edges)
            area = area_words(scan.areas.each.get(one.number, 0.0), scan.areas.unit)
            words = f"{one.number}:  {one.words}\n{area}"
            axes.set_title(words, fontsize=size, pad=2.5, linespacing=1.1)
        scale_bar(grid[0, 0], scan.middle, scan.near, scan.state.header.units.get("length", ""))
        damage_bar(made, grid.ravel().tolist(), _words_of_bar(scan))
        made.suptitle(_title(results, scan), fontsize=8.5, x=0.01, ha="left", color=INK)
        return finish(made, path)


def shown_of(scan: Scan) -> tuple[Sheet, ...]:
    """What the colours show: the field that the white lines bound."""
    return scan.sheets if _has_energy(scan) else scan.damage


def _has_energy(scan: Scan) -> bool:
    return ENERGY in scan.state.each[0].fields


def _draw_panel(
    axes: Axes,
    scan: Scan,
    one: Interface,
    sheets: tuple[Sheet, Sheet],
    edges: tuple[np.ndarray, np.ndarray],
) -> None:
    """An interface and its border of delamination."""
    look_from_above(axes, scan.middle, scan.near)
    draw_damage(axes, sheets[0])
    outline_beyond(axes, sheets[1], DELAMINATED, "white", 0.8)
    draw_plate(axes, edges, faint=not scan.cracks)
    draw_cracks(axes, scan.cracks.get(one.number), BELOW)
    draw_cracks(axes, scan.cracks.get(one.number + 1), ABOVE)
    mark_impact(axes, scan.middle)


def _words_of_bar(scan: Scan) -> str:
    """What the colours mean."""
    return "Share of the energy spent" if _has_energy(scan) else "Damage"


def _title(results: Results, scan: Scan) -> str:
    """Job, instant, and what the panels are."""
    words = f"{literal(results.job)}   {instant(scan.state.header, scan.state.time)}"
    words += f"   {words_of(results)}\ninterfaces from the bottom up, plies below / above;"
    words += f" {scan.state.criterion} inside white lines"
    words += "\ncracks of the ply below green, above blue" if scan.cracks else ""
    if scan.near < scan.half and any(_is_beyond(scan, sheet) for sheet in shown_of(scan)):
        words += "\nmore lies outside of the window; --whole shows the whole plate"
    return words


def _is_beyond(scan: Scan, sheet: Sheet) -> bool:
    """Whether something is shown outside of the window."""
    outside = abs(sheet.places - scan.middle).max(axis=1) > scan.near
    return bool((sheet.values[outside] > SEEN).any())
