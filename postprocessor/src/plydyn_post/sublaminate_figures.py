"""Pictures of the sublaminates of a test of strength at its peak: sections, and a map of a gap."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from plydyn_post.broken_plies import BROKEN, FIBRES
from plydyn_post.compression import Compression
from plydyn_post.ending import Ending
from plydyn_post.errors import ResultsError
from plydyn_post.header import read_header
from plydyn_post.interfaces import DELAMINATED, read_interfaces
from plydyn_post.maps import damage_bar, draw_plate, mark_impact, outline_beyond, scale_bar
from plydyn_post.plies import read_stack
from plydyn_post.section import (
    APART,
    Cut,
    cut_plies,
    draw_apart,
    draw_plies,
    interfaces_of,
    steepness,
)
from plydyn_post.sheets import edges_of, sheet_of
from plydyn_post.style import DAMAGE_MAP, INK, WIDE, figure, literal, save
from plydyn_post.sublaminates import states_of, widest
from plydyn_post.units import in_brackets, nice

#: The widest gap is drawn as this share of the thickness, and no gap so many times as wide
DRAWN, MOST = 0.5, 50.0
#: Colour of what breaks in the fall
FALL = "#1b9e4b"


def state_words(test: Compression, time: float) -> str:
    """Which state a picture shows, by the stress."""
    share = float(np.interp(time, test.time, test.stress)) / test.strength
    return f"state at {share:.0%} of the strength"


def draw_sublaminates(test: Compression, middle: np.ndarray, path: Path) -> Path:
    """Draw cuts through a place across the load and along it at the peak, with widened gaps."""
    job = test.job
    stack, header = read_stack(job, states_of(test, job.fields).peak), read_header(job.fields)
    if FIBRES not in stack.grid.point_data:
        raise ResultsError(f"{job.fields} has no field {FIBRES!r} to draw sublaminates with")
    between = interfaces_of(job, stack.time)
    gap = max((widest(one) for one in between.each), default=0.0) if between else 0.0
    times = nice(min(MOST, DRAWN * test.thickness / gap)) if gap > 0.0 else 1.0
    angles = (90.0, 0.0) if test.axis == 0 else (0.0, 90.0)
    cuts = [widened(cut_plies(stack, middle, angle, FIBRES), times) for angle in angles]
    with figure(2, 1, size=(WIDE, 4.4), squeeze=False) as (made, grid):
        ways = ("across the load", "along the load")
        for axes, cut, way in zip(grid[:, 0], cuts, ways, strict=True):
            draw_plies(axes, cut, float(np.abs(cut.along).max()), header)
            if between:
                draw_apart(axes, cut, between, header)
            axes.set_title(f"cut {way}", fontsize=8.5, loc="left")
        damage_bar(made, grid[:, 0].tolist(), "Fibre damage")
        told = f"{literal(job.job)}   {state_words(test, stack.time)}"
        told += f"   gaps × {times:g}   $z$ × {steepness(made, grid[0, 0]):.2g}"
        told += f"\nblue: {between.criterion}" if between else ""
        grid[0, 0].set_title(told, fontsize=7.5, loc="right")
        return save(made, path)


def widened(cut: Cut, times: float) -> Cut:
    """A cut whose gaps between plies are so many times as wide; the ply in the middle stays."""
    lifted = np.zeros_like(cut.along)
    lifts = [lifted]
    for below, above in zip(cut.heights[:-1], cut.heights[1:], strict=True):
        lifted = lifted + (times - 1.0) * np.maximum(above[:, 0] - below[:, -1], 0.0)
        lifts.append(lifted)
    kept = lifts[len(lifts) // 2]
    heights = [
        height + (lift - kept)[:, None] for height, lift in zip(cut.heights, lifts, strict=True)
    ]
    return replace(cut, heights=heights)


def draw_gap(test: Compression, ending: Ending, middle: np.ndarray, path: Path) -> Path:
    """Draw the gap of the interface that had opened next to the peak, else of the one that grew."""
    shown = ending.shown
    if shown is None:
        raise ResultsError(f"{test.job.interface_fields} tells no openings to draw")
    state = read_interfaces(test.job, states_of(test, test.job.interface_fields).peak)
    one = next(one for one in state.each if one.number == shown.number)
    length = test.units.get("length", "")
    gap = np.zeros_like(one.spent) if one.gap is None else np.maximum(one.gap, 0.0)
    sheet = sheet_of(one.places, gap)
    with figure(size=(WIDE, 4.2)) as (made, axes):
        most = max(float(gap.max()), 1.0e-6 * test.thickness)
        drawn = axes.tripcolor(
            *sheet.places.T, sheet.triangles, sheet.values,
            shading="gouraud", cmap=DAMAGE_MAP, vmin=0.0, vmax=most, rasterized=True,
        )  # fmt: skip
        spent = sheet_of(one.places, one.spent)
        outline_beyond(axes, spent, DELAMINATED, APART, 1.1)
        draw_plate(axes, edges_of(one.places))
        mark_impact(axes, middle)
        if ending.plies:
            outline_beyond(axes, ending.plies[0].grown, BROKEN, FALL, 0.9, zorder=3.0)
        _mark_load(axes, test, one.places)
        axes.set_aspect("equal")
        axes.set_axis_off()
        bar = made.colorbar(drawn, ax=axes, fraction=0.03, pad=0.02)
        bar.set_label(in_brackets("Gap", length))
        low = one.places.reshape(-1, 2)
        scale_bar(
            axes,
            (low.min(axis=0) + low.max(axis=0)) / 2,
            0.5 * float(np.ptp(low, axis=0).min()),
            length,
        )
        told = f"{literal(test.job.job)}   {state_words(test, state.time)}   interface"
        told += f" {one.number}: {one.words}\nblue: {state.criterion}"
        if ending.plies:
            told += f"; green: fibres of ply {ending.plies[0].number} that break in the fall"
        axes.set_title(told, fontsize=8, loc="left")
        return save(made, path)


def _mark_load(axes: Axes, test: Compression, places: np.ndarray) -> None:
    """Arrows of the load at both ends of the plate."""
    low, high = places.reshape(-1, 2).min(axis=0), places.reshape(-1, 2).max(axis=0)
    way = np.eye(2)[test.axis]
    length = 0.07 * float(np.ptp(places.reshape(-1, 2), axis=0).max())
    for end, out in ((low, -1.0), (high, 1.0)):
        near = 0.5 * (low + high) * (1.0 - way) + end * way + 0.2 * out * length * way
        far = near + out * length * way
        start, tip = (near, far) if test.pulled else (far, near)
        style = {"arrowstyle": "-|>", "color": INK, "linewidth": 1.0}
        axes.annotate("", tip, start, arrowprops=style, annotation_clip=False)
        axes.plot(*far, ".", markersize=0.1)  # the axes reach that far
