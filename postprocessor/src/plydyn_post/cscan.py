"""What an ultrasonic scan would show: delaminated interfaces, over each other and one by one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from plydyn_post.cracks import PlyCracks, cracks_of, draw_cracks
from plydyn_post.interfaces import (
    DELAMINATED,
    ENERGY,
    Areas,
    Interface,
    Interfaces,
    read_areas,
    read_interfaces,
)
from plydyn_post.maps import (
    area_words,
    damage_bar,
    draw_damage,
    draw_plate,
    fill_beyond,
    half_window,
    hit_from_above,
    instant,
    look_from_above,
    mark_impact,
    middle_of,
    outline_beyond,
    scale_bar,
)
from plydyn_post.region import Region
from plydyn_post.results import Results
from plydyn_post.sheets import Sheet, area_beyond, edges_of, sheet_of, sheet_of_points
from plydyn_post.style import INK, WIDE, figure, finish, literal
from plydyn_post.symmetry import words_of
from plydyn_post.units import readable

#: Ends of the colours of depth that are used, near to far from the impacted face
DEPTHS, NEAR, FAR = "turbo", 0.90, 0.10
#: Interfaces whose areas get a line of their own in the legend; height of the other rows, inches
FEW, ROW = 8, 0.128
#: Window of a C-scan over the one that just holds what is delaminated
AROUND = 1.4
#: Most panels side by side
COLUMNS = 4
#: Colours of the cracks of the plies below and above an interface
BELOW, ABOVE = "#1b9e4b", "#2b6cd9"


Colour = tuple[float, float, float, float]


@dataclass(frozen=True)
class Scan:
    """Interfaces at an instant with all that their maps need."""

    state: Interfaces
    sheets: tuple[Sheet, ...]  # of the share of the fracture energy that is spent
    damage: tuple[Sheet, ...]
    areas: Areas
    middle: np.ndarray  # (2,) below the impactor
    half: float  # half the side of the window that holds all damage
    near: float  # that of the window that holds what is delaminated
    region: Region | None = None  # in which areas are counted; the whole plate without one
    cracks: Mapping[int, PlyCracks] = field(default_factory=dict)  # along lines, by their plies


def read_scan(
    results: Results, time: float | None = None, whole: bool = False, region: Region | None = None
) -> Scan:
    """The interfaces at an instant, the last one without a time; areas within a region."""
    state = read_interfaces(results, time)
    sheets = tuple(sheet_of(one.places, one.spent) for one in state.each)
    damage = tuple(sheet_of(one.places, one.damage) for one in state.each)
    middle = middle_of(state.header, state.each[0].places)
    if region is not None:
        areas = drawn_areas(state, sheets, lambda sheet: region.cut(sheet, middle))
    elif results.has("delamination"):
        areas = read_areas(results, state.time)
    else:
        areas = drawn_areas(state, sheets)
    half = half_window(damage, middle, whole)
    # damage at clamps, where little of the fracture energy is spent, is not delaminated
    some = any(sheet.values.max() > DELAMINATED for sheet in sheets)
    around = AROUND * half_window(sheets, middle, whole, DELAMINATED)
    near = min(half, around) if some else half
    cracks = cracks_of(results, state.time)
    return Scan(state, sheets, damage, areas, middle, half, near, region, cracks)


def drawn_areas(
    state: Interfaces,
    sheets: tuple[Sheet, ...],
    part: Callable[[Sheet], Sheet] = lambda sheet: sheet,
) -> Areas:
    """Areas measured on a part of the maps, for results without a history of them."""
    each = {
        one.number: area_beyond(part(sheet), DELAMINATED)
        for one, sheet in zip(state.each, sheets, strict=True)
    }
    projected = area_beyond(part(worst_of(state, sheets)), DELAMINATED)
    failed = None
    if ENERGY in state.each[0].fields:
        complete = tuple(sheet_of(one.places, one.failed) for one in state.each)
        failed = area_beyond(part(worst_of(state, complete)), DELAMINATED)
    unit = f"{state.header.units['length']}2" if "length" in state.header.units else ""
    return Areas(each, projected, unit, failed)


def worst_of(state: Interfaces, sheets: tuple[Sheet, ...]) -> Sheet:
    """The largest value of all interfaces over each quad, where some may lack an interface."""
    quads, first = np.unique(
        np.concatenate([one.elements for one in state.each]), return_index=True
    )
    each = [
        sheet.values.reshape(len(one.elements), -1)
        for one, sheet in zip(state.each, sheets, strict=True)
    ]
    places = [
        sheet.places.reshape(*values.shape, 2) for sheet, values in zip(sheets, each, strict=True)
    ]
    worst = np.zeros((len(quads), each[0].shape[1]))
    for one, values in zip(state.each, each, strict=True):
        np.maximum.at(worst, np.searchsorted(quads, one.elements), values)
    return sheet_of_points(np.concatenate(places)[first], worst)


def draw_cscan(
    results: Results,
    path: Path | None = None,
    time: float | None = None,
    whole: bool = False,
    region: Region | None = None,
) -> Figure:
    """Delaminated interfaces over each other, coloured by depth, as seen from the impactor."""
    scan = read_scan(results, time, whole, region)
    order = _order(scan)
    size = (WIDE, max(4.15, 1.2 + ROW * len(order)))
    with figure(1, 2, size=size, width_ratios=[1.72, 1]) as (made, (axes, side)):
        draw_map(axes, scan)
        side.set_axis_off()
        near_first = [scan.state.each[place] for place in order[::-1]]
        _legend(results, side, scan, near_first, _colours(len(order))[::-1])
        return finish(made, path)


def _order(scan: Scan) -> list[int]:
    """Places of the interfaces, from the far one to the near one as seen from the impactor."""
    order = list(range(len(scan.state.each)))
    return order if hit_from_above(scan.state.header) else order[::-1]


def draw_map(axes: Axes, scan: Scan) -> None:
    """Delaminated interfaces over each other, the near ones on top."""
    order = _order(scan)
    colours = _colours(len(order))
    draw_plate(axes, edges_of(scan.state.each[0].places))
    for place, colour in zip(order, colours, strict=True):
        fill_beyond(axes, scan.sheets[place], DELAMINATED, colour)
    for place, colour in zip(order, colours, strict=True):
        outline_beyond(axes, scan.sheets[place], DELAMINATED, "white", 1.5)
        outline_beyond(axes, scan.sheets[place], DELAMINATED, colour, 1.0)
    for cracks in scan.cracks.values():
        draw_cracks(axes, cracks, INK, 0.5)
    mark_impact(axes, scan.middle)
    if scan.region is not None:
        scan.region.draw(axes, scan.middle)
    look_from_above(axes, scan.middle, scan.near)
    scale_bar(axes, scan.middle, scan.near, scan.state.header.units.get("length", ""))


def _colours(count: int) -> list[Colour]:
    """Colours of depth, from the far interface to the near one."""
    return [colormaps[DEPTHS](share) for share in np.linspace(FAR, NEAR, max(count, 2))[:count]]


def _legend(
    results: Results, side: Axes, scan: Scan, near_first: list[Interface], colours: list[Colour]
) -> None:
    """Depth, angles and area of each interface, and the areas together; many in one line each."""
    header, unit = scan.state.header, scan.areas.unit
    between = "\n" if len(near_first) <= FEW else ",  "
    rows: list[tuple[Artist, str]] = []
    for one, colour in zip(near_first, colours, strict=True):
        area = area_words(scan.areas.each.get(one.number, 0.0), unit)
        rows.append((Patch(facecolor=colour), f"{_depth(scan, one)}{one.words}{between}{area}"))
    words = f"projected {area_words(scan.areas.projected, unit)}"
    if scan.areas.failed is not None:
        words += f"\n    completely failed {area_words(scan.areas.failed, unit)}"
    words += f"\nall together {area_words(scan.areas.total, unit)}"
    rows.append((Line2D([], [], linestyle="none"), words))
    more = [words_of(results), "black lines: cracks of the plies" if scan.cracks else ""]
    if scan.region is not None:
        more.insert(0, "areas " + scan.region.words(header.units.get("length", "")))
    side.legend(
        [row[0] for row in rows],
        [row[1] for row in rows],
        loc="center left",
        bbox_to_anchor=(-0.12, 0.5),
        title=f"{literal(results.job)}   {instant(header, scan.state.time)}\n"
        f"delaminated: {scan.state.criterion}\n"
        f"depth below the {'top' if hit_from_above(header) else 'bottom'},  ply below / above"
        + "".join(f"\n{line}" for line in more if line),
        alignment="left",
        fontsize=8 if between == "\n" else 7,
        labelspacing=0.75 if between == "\n" else 0.3,
        handleheight=1.6 if between == "\n" else 0.9,
        handlelength=1.6,
    )


def _depth(scan: Scan, one: Interface) -> str:
    """How deep an interface lies below the impacted face, where the plies are known."""
    header = scan.state.header
    faces = [row[name] for row in header.plies for name in ("bottom", "top") if name in row]
    if not faces:
        return f"{one.number}:  "
    face = max(faces) if hit_from_above(header) else min(faces)
    scale = readable(header.units.get("length", ""), abs(face - one.height))
    return f"{abs(face - one.height) * scale.factor:.3g} {scale.unit},  "


def draw_delamination(
    results: Results, path: Path | None = None, time: float | None = None, whole: bool = False
) -> Figure:
    """Damage of every interface in a panel of its own, from the bottom up."""
    scan = read_scan(results, time, whole)
    columns = min(COLUMNS, len(scan.sheets))
    rows = -(-len(scan.sheets) // columns)
    wide = WIDE if columns > 1 else 0.6 * WIDE
    high = 0.6 + rows * (0.36 + 0.92 * wide / columns)
    with figure(rows, columns, size=(wide, high), squeeze=False) as (made, grid):
        edges = edges_of(scan.state.each[0].places)
        each = zip(grid.flat, scan.state.each, scan.sheets, scan.damage, strict=False)
        for axes, one, sheet, damage in each:
            draw_damage(axes, damage)
            outline_beyond(axes, sheet, DELAMINATED, "white", 0.8)
            draw_plate(axes, edges, faint=not scan.cracks)
            draw_cracks(axes, scan.cracks.get(one.number), BELOW)
            draw_cracks(axes, scan.cracks.get(one.number + 1), ABOVE)
            mark_impact(axes, scan.middle)
            look_from_above(axes, scan.middle, scan.half)
            area = area_words(scan.areas.each.get(one.number, 0.0), scan.areas.unit)
            axes.set_title(f"{one.number}:  {one.words}\n{area}", fontsize=7.5, pad=3)
        for axes in grid.flat[len(scan.sheets) :]:
            axes.set_axis_off()
        scale_bar(grid[0, 0], scan.middle, scan.half, scan.state.header.units.get("length", ""))
        damage_bar(made, grid.ravel().tolist())
        words = f"{literal(results.job)}   {instant(scan.state.header, scan.state.time)}"
        words += f"   {words_of(results)}\ninterfaces from the bottom up, plies below / above;"
        words += f" {scan.state.criterion} inside white lines"
        words += "\ncracks of the ply below green, above blue" if scan.cracks else ""
        made.suptitle(words, fontsize=8.5, x=0.01, ha="left", color=INK)
        return finish(made, path)
