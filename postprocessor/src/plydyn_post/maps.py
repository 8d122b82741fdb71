"""Maps of the plate seen from above: their window, the outline of the plate, and their colours."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PathCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.path import Path
from matplotlib.tri import Triangulation

from plydyn_post.header import Header
from plydyn_post.sheets import Sheet, in_window
from plydyn_post.style import DAMAGE_MAP, INK
from plydyn_post.units import readable

#: Damage that the window of a map must hold
SEEN = 0.05
#: Dots between two sides of quads below which they are not drawn: they would only be a grey
CLOSEST = 3.0
#: Free share around it, and the least share of the plate that a window shows
MARGIN, SMALLEST = 0.18, 0.12


def middle_of(header: Header, places: np.ndarray) -> np.ndarray:
    """Below the first impactor; without one the middle of the plate, (2,)."""
    for body in header.impactors.values():
        return np.array(body.centre[:2])
    flat = places.reshape(-1, 2)
    return (flat.min(axis=0) + flat.max(axis=0)) / 2


def hit_from_above(header: Header) -> bool:
    """Whether the first impactor comes from above, as it does without one."""
    bodies = list(header.impactors.values())
    return not bodies or bodies[0].centre[2] >= 0.0


def half_window(
    sheets: Sequence[Sheet],
    middle: np.ndarray,
    whole: bool,
    seen: float = SEEN,
    lines: Sequence[np.ndarray] = (),
) -> float:
    """Half the side of a square around the impact that holds all damage, or the whole plate.

    Damage is what is above `seen`, and lines (n, 2, 2). Where there is none, it is the whole
    plate, too.
    """
    reach = max(float(np.abs(sheet.places - middle).max()) for sheet in sheets)
    damaged = [sheet.places[sheet.values > seen] for sheet in sheets] + list(lines)
    if whole or not any(map(len, damaged)):
        return 1.04 * reach
    far = max(float(np.abs(places - middle).max(initial=0.0)) for places in damaged)
    return float(np.clip((1.0 + MARGIN) * far, SMALLEST * reach, 1.04 * reach))


def look_from_above(axes: Axes, middle: np.ndarray, half: float) -> None:
    """Equal axes without a frame around a place."""
    axes.set_aspect("equal")
    axes.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half))
    axes.grid(False)
    axes.set_axis_off()


def draw_plate(axes: Axes, edges: tuple[np.ndarray, np.ndarray], faint: bool = True) -> None:
    """Sides of quads, faintly where they are not too close, and the rim, in the axes' window."""
    between, rim = (_in_view(axes, lines) for lines in edges)
    across = np.sqrt(0.5 * len(between))
    if faint and axes.bbox.width >= CLOSEST * across:
        _add_lines(axes, between, alpha=0.13, linewidths=0.35)
    _add_lines(axes, rim, linewidths=0.9, zorder=4)


def _in_view(axes: Axes, lines: np.ndarray) -> np.ndarray:
    """Lines that reach into the window of axes, (lines, points, 2)."""
    if axes.get_autoscale_on():
        return lines
    low, high = np.sort([axes.get_xlim(), axes.get_ylim()], axis=1).T
    seen = (lines.min(axis=1) <= high) & (lines.max(axis=1) >= low)
    return lines[np.all(seen, axis=1)]


def _add_lines(axes: Axes, lines: np.ndarray, **look: float) -> None:
    """Lines as one path, which takes less time than a path for each."""
    if len(lines) == 0:
        return
    codes = np.full(lines.shape[:2], Path.LINETO, dtype=Path.code_type)
    codes[:, 0] = Path.MOVETO
    path = Path(lines.reshape(-1, 2), codes.ravel())
    drawn = PathCollection([path], edgecolors=INK, facecolors="none", **look)
    drawn.set_transform(axes.transData)
    axes.add_collection(drawn, autolim=axes.get_autoscale_on())


def mark_impact(axes: Axes, middle: np.ndarray) -> None:
    """A small cross below the impactor."""
    axes.plot(*middle, marker="+", markersize=5, color=INK, markeredgewidth=0.7, zorder=5)


def draw_damage(axes: Axes, sheet: Sheet) -> None:
    """Damage from 0 to 1 in the colours of damage, in the axes' window."""
    sheet = _seen(axes, sheet)
    axes.tripcolor(
        _triangulation(sheet),
        sheet.values,
        shading="gouraud",
        cmap=DAMAGE_MAP,
        vmin=0.0,
        vmax=1.0,
        rasterized=True,
    )


def fill_beyond(
    axes: Axes, sheet: Sheet, level: float, colour: object, zorder: float = 1.0
) -> None:
    """Fill where a field is at or above a level."""
    sheet = _seen(axes, sheet)
    if sheet.values.max() > level:
        most = max(2.0, 2.0 * float(sheet.values.max()))
        axes.tricontourf(
            _triangulation(sheet),
            sheet.values,
            levels=[level, most],
            colors=[colour],
            alpha=1.0,
            zorder=zorder,
        )


def outline_beyond(
    axes: Axes, sheet: Sheet, level: float, colour: object, width: float, zorder: float = 2.0
) -> None:
    """Draw the border of where a field is at or above a level."""
    sheet = _seen(axes, sheet)
    if sheet.values.max() > level > sheet.values.min():
        axes.tricontour(
            _triangulation(sheet),
            sheet.values,
            levels=[level],
            colors=[colour],
            linewidths=width,
            zorder=zorder,
        )


def _seen(axes: Axes, sheet: Sheet) -> Sheet:
    """What the window of axes shows of a sheet."""
    return sheet if axes.get_autoscale_on() else in_window(sheet, axes.get_xlim(), axes.get_ylim())


def _triangulation(sheet: Sheet) -> Triangulation:
    x, y = sheet.places.T
    return Triangulation(x, y, sheet.triangles)


def scale_bar(axes: Axes, middle: np.ndarray, half: float, unit: str) -> None:
    """A bar of a round length at the lower edge of a map, its words below the map."""
    length = _round(0.5 * half)
    scale = readable(unit, length)
    x, y = middle[0] - 0.98 * half, middle[1] - half
    axes.plot([x, x + length], [y, y], color=INK, linewidth=1.6, clip_on=False, zorder=6)
    words = f"{length * scale.factor:g} {scale.unit}".rstrip()
    axes.annotate(words, (x, y), (0, -3), textcoords="offset points", fontsize=7.5, va="top")


def _round(length: float) -> float:
    """The largest of 1, 2, 5, 10, … times a power of ten that is not above a length."""
    power = 10.0 ** np.floor(np.log10(length))
    return float(max(step for step in (1, 2, 5) if step * power <= length * 1.0001) * power)


def damage_bar(made: Figure, axes: Sequence[Axes], words: str = "Damage") -> None:
    """The bar of the colours of damage beside some maps."""
    mappable = ScalarMappable(Normalize(0.0, 1.0), DAMAGE_MAP)
    bar = made.colorbar(
        mappable, ax=list(axes), fraction=0.025, pad=0.015, aspect=28, ticks=[0, 0.25, 0.5, 0.75, 1]
    )
    bar.outline.set_linewidth(0.5)
    bar.ax.tick_params(width=0.5, length=2.5, direction="out")
    bar.set_label(words)


def instant(header: Header, time: float) -> str:
    """A time in print."""
    scale = readable(header.units.get("time", ""), time)
    return f"t = {time * scale.factor:.3g} {scale.unit}".rstrip()


def area_words(area: float, unit: str) -> str:
    """An area in print; none where there is none."""
    if area <= 0.0:
        return "none"
    digits = 0 if area >= 100.0 else 1
    return f"{area:.{digits}f} {unit.replace('2', '²')}".rstrip()
