"""Interfaces at an instant with all that their maps need: sheets, areas and windows."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from matplotlib import colormaps

from plydyn_post.cracks import PlyCracks, cracks_of
from plydyn_post.interfaces import (
    DELAMINATED,
    ENERGY,
    Areas,
    Interface,
    Interfaces,
    read_areas,
    read_interfaces,
)
from plydyn_post.maps import half_window, hit_from_above, middle_of
from plydyn_post.region import Region
from plydyn_post.results import Results
from plydyn_post.sheets import Sheet, area_beyond, sheet_of_points, sheets_of
from plydyn_post.units import readable

#: Ends of the colours of depth that are used, near to far from the impacted face
DEPTHS, NEAR, FAR = "turbo", 0.90, 0.10
#: Window of a map over the one that just holds what is delaminated
AROUND = 1.15
#: Most panels side by side, and panels in a row over the square root of their number
MOST_COLUMNS, WIDE_SHARE = 8, 1.3


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
    fields = [(one.places, one.spent) for one in state.each]
    both = sheets_of(fields + [(one.places, one.damage) for one in state.each])
    sheets, damage = both[: len(fields)], both[len(fields) :]
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
        complete = sheets_of((one.places, one.failed) for one in state.each)
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


def near_first(scan: Scan) -> list[int]:
    """Places of the interfaces, from the near one to the far one as seen from the impactor."""
    order = list(range(len(scan.state.each)))
    return order[::-1] if hit_from_above(scan.state.header) else order


def depth_colours(count: int) -> list[Colour]:
    """Colours of depth, from the near interface to the far one."""
    return [colormaps[DEPTHS](share) for share in np.linspace(NEAR, FAR, max(count, 2))[:count]]


def depth_of(scan: Scan, one: Interface) -> str:
    """How deep an interface lies below the impacted face, where the plies are known."""
    header = scan.state.header
    faces = [row[name] for row in header.plies for name in ("bottom", "top") if name in row]
    if not faces:
        return f"{one.number}:"
    face = max(faces) if hit_from_above(header) else min(faces)
    scale = readable(header.units.get("length", ""), abs(face - one.height))
    return f"{abs(face - one.height) * scale.factor:.3g} {scale.unit},"


def panels_of(count: int) -> tuple[int, int]:
    """Rows and columns of panels, wider than high."""
    columns = min(MOST_COLUMNS, count, int(np.ceil(WIDE_SHARE * np.sqrt(count))))
    return -(-count // columns), columns
