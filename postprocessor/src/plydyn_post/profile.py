"""Stress through the thickness at a point of the plate: the paper's figures 4 and 5."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from plydyn_post.errors import ResultsError
from plydyn_post.grid import nearest
from plydyn_post.header import Header, read_header
from plydyn_post.results import Results, labelled
from plydyn_post.style import QUIET, WIDE, figure, finish, legend_above, literal, look_of
from plydyn_post.table import Table, split_header
from plydyn_post.units import Scale, factor, in_brackets, readable

IN_PLANE = ("sxx", "syy", "sxy")
INTERLAMINAR = ("sxz", "syz", "szz")
SYMBOLS = {"s": r"\sigma", "e": r"\varepsilon", "g": r"\gamma"}
# Most plies whose angles are written beside the figure
MOST_ANGLES = 40


@dataclass(frozen=True)
class Profile:
    """Values through the thickness at an instant, from the bottom up; faces have two rows."""

    label: str
    time: float
    time_unit: str
    table: Table  # the rows of the instant
    angles: tuple[float, ...] = ()  # of the plies, where known

    @property
    def z(self) -> np.ndarray:
        """Heights, (rows,)."""
        return self.table["z"]

    def faces(self) -> np.ndarray:
        """Heights of the faces between plies, and of the bottom and the top, (faces,)."""
        ply, z = self.table["ply"], self.z
        between = np.flatnonzero(np.diff(ply)) + 1
        return np.concatenate([z[:1], z[between], z[-1:]])


def instants(table: Table) -> tuple[np.ndarray, np.ndarray]:
    """Times of the blocks of a profile, and where each begins and the last ends."""
    time = table["time"]
    starts = np.concatenate([[0], np.flatnonzero(np.diff(time)) + 1, [len(time)]])
    lengths = np.diff(starts)
    if len(lengths) > 1 and lengths[-1] < lengths[0]:  # cut short by a kill
        starts = starts[:-1]
    return time[starts[:-1]], starts


def peak_time(job: Results) -> float:
    """The time of the largest force on the first impactor."""
    table = job.impactor()
    return float(table["time"][np.argmax(np.abs(table["force"]))])


def read_profile(
    job: Results, label: str, number: int | None = None, time: float | None = None
) -> Profile:
    """The profile at the instant nearest to a time, or to the peak of the force.

    Without an impactor it is the last one.
    """
    table = job.profile(number)
    times, starts = instants(table)
    if time is None:
        peak = peak_time(job) if job.impactors else times[-1]
        block = int(np.argmin(np.abs(times - peak)))
    else:
        block = nearest(times, time, table.path)
    rows = table.values[starts[block] : starts[block + 1]]
    cut = Table(table.path, table.names, table.units, rows, table.notes)
    for name in ("ply", "z"):
        if np.any(np.diff(cut[name]) < 0.0):
            raise ResultsError(f"{table.path}: {name} falls within the instant {times[block]:g}")
    angles = _angles(read_header(job.fields), len(np.unique(cut["ply"])))
    return Profile(label, float(times[block]), table.unit("time"), cut, angles)


def _angles(header: Header, plies: int) -> tuple[float, ...]:
    """Angles of the plies from the bottom up, if the ply table is that of the profile."""
    rows = [{split_header(name)[0]: one for name, one in row.items()} for row in header.plies]
    angles = tuple(row["angle"] for row in rows if "angle" in row)
    return angles if len(angles) == plies else ()


def read_profiles(
    jobs: Sequence[Results], number: int | None = None, time: float | None = None
) -> list[Profile]:
    """The same profile of several jobs, each at its own peak force unless a time is given."""
    return [read_profile(job, name, number, time) for name, job in labelled(jobs)]


def symbol(name: str) -> str:
    """A component such as ``sxz`` in print."""
    if name[:1] in SYMBOLS and len(name) == 3:
        return rf"${SYMBOLS[name[0]]}_{{{name[1:]}}}$"
    return rf"${name[0]}_{{{name[1:]}}}$" if len(name) > 1 else f"${name}$"


def draw_profiles(
    profiles: Sequence[Profile], components: Sequence[str], path: Path | None = None
) -> Figure:
    """Draw components through the thickness, one panel each, jobs laid over each other."""
    if not components:
        raise ResultsError("no component of stress to draw")
    first = profiles[0].table
    height = readable(first.unit("z"), float(np.ptp(first["z"])))
    width = min(WIDE, 1.0 + 2.0 * len(components) + (0.8 if len(components) == 1 else 0.0))
    with figure(1, len(components), size=(width, 3.5), sharey=True, squeeze=False) as (made, grid):
        panels = list(grid[0])
        made.set_layout_engine("constrained", w_pad=0.08)
        times = [_instant(profile) for profile in profiles]
        common = times[0] if len(set(times)) == 1 else None
        names = [
            profile.label if common else f"{profile.label}, {instant}"
            for profile, instant in zip(profiles, times, strict=True)
        ]
        for axes, name in zip(panels, components, strict=True):
            _draw_panel(axes, profiles, name, height, names)
        panels[0].set_ylabel(in_brackets("$z$", height.unit))
        _write_angles(panels[-1], profiles[0], height)
        legend_above(made, panels[0], title=common)
        return finish(made, path)


def _draw_panel(
    axes: Axes, profiles: Sequence[Profile], name: str, height: Scale, names: Sequence[str]
) -> None:
    unit = profiles[0].table.unit(name)
    largest = max(float(np.max(np.abs(profile.table[name]))) for profile in profiles)
    scale = readable(unit, largest)
    for face in profiles[0].faces() * height.factor:
        axes.axhline(face, color="#c4c4c4", linewidth=0.45, zorder=0.5)
    axes.axvline(0.0, color="#c4c4c4", linewidth=0.7, zorder=0.5)
    for place, profile in enumerate(profiles):
        values = profile.table[name] * factor(profile.table.unit(name), scale.unit)
        z = profile.z * factor(profile.table.unit("z"), height.unit)
        axes.plot(values, z, label=literal(names[place]), **look_of(place))
    axes.grid(False)
    axes.margins(y=0.0)
    axes.locator_params(axis="x", nbins=4, min_n_ticks=3)
    axes.set_xlabel(in_brackets(symbol(name), scale.unit))


def _instant(profile: Profile) -> str:
    """The time of a profile in print."""
    scale = readable(profile.time_unit, profile.time)
    return f"t = {profile.time * scale.factor:.4g} {scale.unit}".rstrip()


def _write_angles(axes: Axes, profile: Profile, height: Scale) -> None:
    """Angles of the plies at the right edge."""
    faces = profile.faces() * height.factor
    if not profile.angles or len(profile.angles) > MOST_ANGLES:
        return
    size = min(7.0, 130.0 / len(profile.angles))
    for angle, low, high in zip(profile.angles, faces[:-1], faces[1:], strict=True):
        axes.annotate(
            f"{angle:g}°".replace("-", "−"),
            (1.0, (low + high) / 2),
            xycoords=("axes fraction", "data"),
            xytext=(4, 0),
            textcoords="offset points",
            va="center",
            fontsize=size,
            color=QUIET,
        )
