"""What an ultrasonic scan would show: delaminated interfaces over each other, coloured by depth."""

from __future__ import annotations

from pathlib import Path

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from plydyn_post.cracks import draw_cracks
from plydyn_post.interfaces import DELAMINATED
from plydyn_post.maps import (
    area_words,
    draw_plate,
    fill_beyond,
    hit_from_above,
    instant,
    look_from_above,
    mark_impact,
    outline_beyond,
    scale_bar,
)
from plydyn_post.region import Region
from plydyn_post.results import Results
from plydyn_post.scan import Scan, depth_colours, depth_of, near_first, panels_of, read_scan
from plydyn_post.sheets import edges_of
from plydyn_post.style import INK, QUIET, WIDE, figure, finish, literal
from plydyn_post.symmetry import words_of

#: Interfaces whose outlines are drawn through those above them; more have a panel each
FEW = 8
#: Height of a map, and what a panel is higher than wide, inches
MAP, WORDS = 3.7, 0.46


def draw_cscan(
    results: Results,
    path: Path | None = None,
    time: float | None = None,
    whole: bool = False,
    region: Region | None = None,
) -> Figure:
    """Delaminated interfaces over each other, coloured by depth, as seen from the impactor.

    Of many interfaces the map shows the nearest at each place, and panels below show each.
    """
    scan = read_scan(results, time, whole, region)
    count = len(scan.sheets)
    if count <= FEW:
        with figure(1, 2, size=(WIDE, 4.15), width_ratios=[1.72, 1]) as (made, (axes, side)):
            draw_map(axes, scan)
            _legend(results, side, scan)
            return finish(made, path)
    rows, columns = panels_of(count)
    below = rows * (WIDE / columns + WORDS)
    with figure(size=(WIDE, MAP + below)) as (made, first):
        first.remove()
        parts = made.subfigures(2, 1, squeeze=False, height_ratios=[MAP, below])
        upper, lower = parts.ravel()
        axes, side = upper.subplots(1, 2, width_ratios=[1.45, 1])
        draw_map(axes, scan)
        _legend(results, side, scan)
        _draw_panels(lower.subplots(rows, columns, squeeze=False).ravel().tolist(), scan)
        return finish(made, path)


def draw_map(axes: Axes, scan: Scan) -> None:
    """Delaminated interfaces over each other, the near ones on top.

    Outlines of a few go through those above them; those of many end where they are hidden.
    """
    order = near_first(scan)[::-1]
    colours = depth_colours(len(order))[::-1]
    few = len(order) <= FEW
    width = 1.5 if few else 0.8
    look_from_above(axes, scan.middle, scan.near)
    draw_plate(axes, edges_of(scan.state.each[0].places))
    for number, (place, colour) in enumerate(zip(order, colours, strict=True)):
        sheet, level = scan.sheets[place], 1.0 + number / len(order)
        fill_beyond(axes, sheet, DELAMINATED, colour, zorder=level)
        outline_beyond(axes, sheet, DELAMINATED, "white", width, zorder=3.0 if few else level)
        if few:
            outline_beyond(axes, sheet, DELAMINATED, colour, 1.0, zorder=3.0)
    for cracks in scan.cracks.values():
        draw_cracks(axes, cracks, INK, 0.5)
    mark_impact(axes, scan.middle)
    if scan.region is not None:
        scan.region.draw(axes, scan.middle)
    scale_bar(axes, scan.middle, scan.near, scan.state.header.units.get("length", ""))


def _draw_panels(panels: list[Axes], scan: Scan) -> None:
    """Each interface by itself in the colour of its depth, the near ones first."""
    order = near_first(scan)
    edges = edges_of(scan.state.each[0].places)
    for axes in panels:
        axes.set_axis_off()
    for axes, place, colour in zip(panels, order, depth_colours(len(order)), strict=False):
        one = scan.state.each[place]
        look_from_above(axes, scan.middle, scan.near)
        fill_beyond(axes, scan.sheets[place], DELAMINATED, colour)
        outline_beyond(axes, scan.sheets[place], DELAMINATED, INK, 0.5)
        draw_plate(axes, edges, faint=False)
        mark_impact(axes, scan.middle)
        axes.set_axis_on()
        axes.set(xticks=[], yticks=[])
        for spine in axes.spines.values():
            spine.set(visible=True, color=QUIET, linewidth=0.4)
        words = f"{depth_of(scan, one)} {one.words}\n{_area(scan, one.number)}"
        axes.set_title(words.replace(", ", "\n"), fontsize=6.3, pad=2.5, linespacing=1.1)


def _area(scan: Scan, number: int) -> str:
    """The area of an interface in print."""
    return area_words(scan.areas.each.get(number, 0.0), scan.areas.unit)


def _legend(results: Results, side: Axes, scan: Scan) -> None:
    """Depth, angles and area of each of a few interfaces, and the areas together."""
    side.set_axis_off()
    header, unit = scan.state.header, scan.areas.unit
    order, rows = near_first(scan), list[tuple[Artist, str]]()
    if len(order) <= FEW:
        for place, colour in zip(order, depth_colours(len(order)), strict=True):
            one = scan.state.each[place]
            words = f"{depth_of(scan, one)}  {one.words}\n{_area(scan, one.number)}"
            rows.append((Patch(facecolor=colour), words))
    words = f"projected {area_words(scan.areas.projected, unit)}"
    if scan.areas.failed is not None:
        words += f"\n    completely failed {area_words(scan.areas.failed, unit)}"
    words += f"\nall together {area_words(scan.areas.total, unit)}"
    rows.append((Line2D([], [], linestyle="none"), words))
    more = [words_of(results), "black lines: cracks of the plies" if scan.cracks else ""]
    if scan.region is not None:
        more.insert(0, "areas " + scan.region.words(header.units.get("length", "")))
    face = "top" if hit_from_above(header) else "bottom"
    side.legend(
        [row[0] for row in rows],
        [row[1] for row in rows],
        loc="center left",
        bbox_to_anchor=(-0.12, 0.5),
        title=f"{literal(results.job)}   {instant(header, scan.state.time)}\n"
        f"delaminated: {scan.state.criterion}\n"
        + ("" if len(order) <= FEW else "above: the nearest at each place; below: each\n")
        + f"depth below the {face},  ply below / above"
        + "".join(f"\n{line}" for line in more if line),
        alignment="left",
        fontsize=8,
        labelspacing=0.75,
        handleheight=1.6,
        handlelength=1.6 if len(order) <= FEW else 0.0,
    )
