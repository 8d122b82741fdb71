"""Figures of the ladder: forces laid over each other, and differences over the mesh."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from plydyn_post.profile import draw_profiles, read_profiles
from plydyn_post.style import COLOURS, WIDE, figure, legend_above, look_of, save

from studies.differences import force_difference, mean_force, peak_time
from studies.ladder import MS
from studies.rungs import CONTACTS, Found, cases, pick

FORCE = "Contact force, 20 µs mean [N]"
WORDS = {"nodes": "nodes on the impactor", "points": "points of the plate"}


def draw_ladder(found: Sequence[Found], orders: Sequence[int], folder: Path) -> list[Path]:
    """All figures of the ladder."""
    return [
        _draw_meshes(found, folder / "force_meshes.png"),
        _draw_contacts(found, folder / "force_contacts.png"),
        _draw_orders(found, orders, folder / "force_orders.png"),
        _draw_differences(found, folder / "differences.png"),
        _draw_shear(found, orders, folder / "shear_orders.png"),
    ]


def _plot(axes: Axes, one: Found, label: str, place: int) -> None:
    """A mean force over time."""
    time, force = mean_force(one.results)
    axes.plot(time * MS, force, label=label, **(look_of(place) | {"linewidth": 1.1}))
    axes.set_xlabel("Time [ms]")
    axes.margins(x=0.0)


def _cores(found: Sequence[Found]) -> list[float]:
    """Sides of the cores, large ones first."""
    return sorted({one.rung.core for one in found}, reverse=True)


def _draw_meshes(found: Sequence[Found], path: Path) -> Path:
    """Meshes over each other: a row for each core, a column for each contact."""
    cores = _cores(found)
    size = (WIDE, 2.9 * len(cores))
    with figure(len(cores), 2, size=size, sharex=True, sharey=True, squeeze=False) as (made, grid):
        for row, core in zip(grid, cores, strict=True):
            for axes, contact in zip(row, CONTACTS, strict=True):
                family = [one for one in pick(found, contact=contact) if one.rung.core == core]
                for place, one in enumerate(family):
                    _plot(axes, one, one.rung.case, place)
                axes.set_title(f"{WORDS[contact]}, core {core:g} mm", fontsize=8.5, loc="left")
                axes.legend(fontsize=7, loc="upper right")
                axes.label_outer()
        made.supylabel(FORCE, fontsize=9)
        return save(made, path)


def _draw_contacts(found: Sequence[Found], path: Path) -> Path:
    """Both contact discretisations over each other, a panel for each mesh."""
    meshes = cases(found)
    rows = -(-len(meshes) // 3)
    size = (WIDE, 0.6 + 1.6 * rows)
    with figure(rows, 3, size=size, sharex=True, sharey=True, squeeze=False) as (made, grid):
        for axes, case in zip(grid.flat, meshes, strict=False):
            for place, contact in enumerate(CONTACTS):
                _plot(axes, pick(found, case, contact)[0], WORDS[contact], place)
            spacing = pick(found, case)[0].rung.spacing
            axes.set_title(f"{case}, points {spacing:.2g} mm apart", fontsize=7.5, loc="left")
            axes.label_outer()
        for axes in grid.flat[len(meshes) :]:
            axes.set_visible(False)
        made.supylabel(FORCE, fontsize=9)
        legend_above(made, grid[0, 0], longest=80)
        return save(made, path)


def _draw_orders(found: Sequence[Found], orders: Sequence[int], path: Path) -> Path:
    """Orders over each other on the coarsest and on the finest mesh that has them all."""
    meshes = cases(found, max(orders))
    with figure(1, 2, size=(WIDE, 3.0), sharey=True) as (made, panels):
        for axes, case in zip(panels, (meshes[0], meshes[-1]), strict=True):
            for place, order in enumerate(orders):
                _plot(axes, pick(found, case, "nodes", order)[0], f"LE{order}", place)
            axes.set_title(f"{case}, {WORDS['nodes']}", fontsize=8.5, loc="left")
        panels[0].set_ylabel(FORCE)
        legend_above(made, panels[0])
        return save(made, path)


def _draw_differences(found: Sequence[Found], path: Path) -> Path:
    """Differences of the mean force over the distance of points, a panel for each core."""
    cores, finest = _cores(found), pick(found)[-1]
    with figure(1, len(cores), size=(WIDE, 3.2), sharey=True, squeeze=False) as (made, grid):
        for axes, core in zip(grid[0], cores, strict=True):
            own = [one for one in pick(found) if one.rung.core == core]
            for place, contact in enumerate(CONTACTS):
                family = [one for one in pick(own, contact=contact) if one is not finest]
                pairs = [(one, finest) for one in family]
                _plot_differences(axes, pairs, f"{WORDS[contact]}, to the finest", place)
            pairs = [tuple(pick(own, case)[:2]) for case in cases(own)]
            _plot_differences(axes, pairs, "one to the other on the same mesh", 2)
            axes.set(xlabel="Distance of points in the core [mm]", ylim=(0.0, None))
            axes.set_title(f"core {core:g} mm", fontsize=8.5, loc="left")
            axes.set_xlim(left=0.0)
        grid[0][0].set_ylabel("Force, relative L2 [%]")
        legend_above(made, grid[0][0], longest=80)
        return save(made, path)


def _plot_differences(
    axes: Axes, pairs: Sequence[tuple[Found, Found]], label: str, place: int
) -> None:
    shares = [100.0 * force_difference(one.results, its.results) for one, its in pairs]
    spacing = [one.rung.spacing for one, _ in pairs]
    axes.plot(spacing, shares, "os^"[place] + "-", label=label, color=COLOURS[place], markersize=4)


def _draw_shear(found: Sequence[Found], orders: Sequence[int], path: Path) -> Path:
    """Interlaminar shear of the orders at (40, 40) on the finest mesh that has them all."""
    case = cases(found, max(orders))[-1]
    jobs = [pick(found, case, "nodes", order)[0].results for order in orders]
    return draw_profiles(read_profiles(jobs, 2, peak_time(jobs[-1])), ("sxz", "syz"), path)
