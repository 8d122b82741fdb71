"""The house look of every figure."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps, rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

from plydyn_post.errors import ResultsError

# Colours that stay apart for colour-blind eyes (Okabe and Ito), and dashes that do so in grey
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)))
MEASURED = "#000000"
QUIET = "#9a9a9a"
INK = "#262626"
# Widths of figures, inches, and dots per inch
WIDE, NARROW, DPI = 6.3, 4.6, 200
# Lines of a legend over the axes that figures have room for; the height of another one, inches
FEW_ROWS, LEGEND_ROW = 2, 0.17
# What stays free beside it on both sides together, inches
LEGEND_MARGIN = 0.12
# Colour maps of quantities with and without a meaning of zero
SIGNED_MAP, PLAIN_MAP = colormaps["RdBu_r"], colormaps["viridis"]
# Damage from nothing to all: paper, straw, orange, red, nearly black
DAMAGE_MAP = LinearSegmentedColormap.from_list(
    "damage", ["#f6f5f2", "#fbe3a1", "#f7ad4c", "#dd5a2a", "#9c1c27", "#3b0a1c"]
)

LOOK: dict[Any, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "mathtext.fontset": "dejavusans",
    "font.size": 8.5,
    "axes.labelsize": 9,
    "legend.fontsize": 8,
    "legend.title_fontsize": 8,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "axes.linewidth": 0.7,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e6e6e6",
    "grid.linewidth": 0.5,
    "axes.axisbelow": True,
    "axes.unicode_minus": True,
    "lines.linewidth": 1.3,
    "lines.solid_capstyle": "round",
    "legend.frameon": False,
    "legend.handlelength": 2.2,
    "legend.columnspacing": 1.4,
    "figure.dpi": DPI,
    "savefig.dpi": DPI,
    "figure.constrained_layout.use": True,
}


class Drawing(Figure):
    """A figure that notebooks show, whatever backend is chosen."""

    def _repr_png_(self) -> bytes:
        """The figure as a PNG."""
        stream = BytesIO()
        self.savefig(stream, format="png")
        return stream.getvalue()


#: What of a figure is that of its grid of axes
_OF_AXES = (
    *("sharex", "sharey", "squeeze", "width_ratios", "height_ratios", "subplot_kw"),
    "gridspec_kw",
)


@contextmanager
def figure(
    rows: int = 1,
    columns: int = 1,
    size: tuple[float, float] = (NARROW, 3.2),
    **more: Any,  # noqa: ANN401 - options of matplotlib
) -> Iterator[tuple[Figure, Any]]:
    """A figure in the house look; it needs no display, whatever backend others have chosen."""
    grid = {key: more.pop(key) for key in _OF_AXES if key in more}
    with rc_context(LOOK):
        made = Drawing(figsize=size, **more)
        FigureCanvasAgg(made)
        yield made, made.subplots(rows, columns, **grid)


def save(made: Figure, path: Path) -> Path:
    """Write a figure; the folder is made where it is missing."""
    known = made.canvas.get_supported_filetypes()
    if path.suffix[1:].lower() not in known:
        raise ResultsError(f"{path}: no picture ends so; right would be {', '.join(sorted(known))}")
    path.parent.mkdir(parents=True, exist_ok=True)
    made.savefig(path)
    return path


def finish(made: Figure, path: Path | None) -> Figure:
    """Lay a figure out in the house look, and write it where there is a path."""
    if path is None:
        made.draw_without_rendering()
    else:
        save(made, path)
    return made


def literal(text: str) -> str:
    """A name in print as it is: matplotlib would take dollars for signs of formulae."""
    return text.replace("$", r"\$")


def name_job(made: Figure, job: str, part: str = "") -> None:
    """Write the name of the job below a figure, and of which part of the plate its numbers are."""
    words = f"{literal(job)}, {part}" if part else literal(job)
    made.supxlabel(words, x=0.995, ha="right", fontsize=7, color=QUIET)


def span(axes: Axes, x: np.ndarray) -> None:
    """Let an axis of times begin and end with them; a single instant gets room around it."""
    if x[-1] > x[0]:
        axes.set_xlim(x[0], x[-1])


def legend_above(made: Figure, axes: Axes, title: str | None = None) -> None:
    """A legend over the axes, where it covers no curve, in as few lines as the width has room for.

    A figure with a legend of many lines becomes higher: the axes keep their size.
    """
    handles, names = axes.get_legend_handles_labels()
    room = made.bbox.width - LEGEND_MARGIN * made.dpi
    columns = max(1, len(names))
    while True:
        rows = -(-len(names) // columns)
        legend = made.legend(
            handles,
            names,
            loc="outside upper left",
            ncols=-(-len(names) // max(1, rows)),
            borderpad=0.2,
            title=title,
            alignment="left",
        )
        if columns <= 1 or legend.get_window_extent().width <= room:
            break
        legend.remove()
        columns -= 1
    made.set_figheight(made.get_figheight() + LEGEND_ROW * max(0, rows - FEW_ROWS))


def look_of(place: int) -> dict[str, Any]:
    """Colour and dashes of a curve by its place."""
    return {
        "color": COLOURS[place % len(COLOURS)],
        "linestyle": DASHES[place % len(DASHES)],
    }
