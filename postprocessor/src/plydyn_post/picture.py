"""A picture of the deformed plate with its colour bar, directions and words."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from plydyn_post import offscreen
from plydyn_post.camera import AZIMUTH, ELEVATION, Camera, camera_for
from plydyn_post.render import draw_plain, render_vtk
from plydyn_post.results import Results
from plydyn_post.scene import Scene, Wish, make_scene
from plydyn_post.style import DPI, INK, WIDE, figure, finish, literal

# Inches: colour bar with its numbers, and the line of words
BAR, WORDS = 0.95, 0.32


def draw_picture(
    results: Results,
    path: Path | None = None,
    wish: Wish | None = None,
    plain: bool = False,
    view: tuple[float, float] = (AZIMUTH, ELEVATION),
) -> Figure:
    """Draw a job; by matplotlib if asked for, or where VTK cannot draw."""
    scene = make_scene(results, wish or Wish())
    camera = camera_for(scene, *view)
    with compose(results, scene, camera, None if plain else offscreen.window()) as made:
        return finish(made, path)


@contextmanager
def compose(
    results: Results, scene: Scene, camera: Camera, window: str | None, below: float = 0.0
) -> Iterator[Figure]:
    """A figure with a scene, its colour bar, directions and words, and room below, inches."""
    wide = WIDE - BAR
    high = wide * camera.aspect
    whole = high + WORDS + below
    with figure(size=(WIDE, whole), layout="none") as (made, axes):
        share, lowest = wide / WIDE, (WORDS + below) / whole
        axes.set_position([0, lowest, share, 1 - lowest])
        _draw_scene(axes, scene, camera, window)
        _draw_directions(made, camera, share, lowest)
        _draw_bar(made, scene, share, lowest)
        words = (below + 0.3 * WORDS) / whole
        made.text(0.015, words, scene.words, fontsize=8.5, va="bottom")
        made.text(0.015, 0.985, literal(results.job), fontsize=8.5, va="top")
        yield made


def _draw_scene(axes: Axes, scene: Scene, camera: Camera, window: str | None) -> None:
    axes.set_axis_off()
    left, right, low, high = camera.window
    pixels = round((WIDE - BAR) * DPI)
    if window:
        image = render_vtk(scene, camera, pixels, window)
        axes.imshow(image, extent=(left, right, low, high), aspect="auto")
    else:
        draw_plain(axes, scene, camera, pixels)
    axes.set(xlim=(left, right), ylim=(low, high))


def _draw_directions(made: Figure, camera: Camera, share: float, lowest: float) -> None:
    """Arrows along x, y and z below the colour bar."""
    wide, high = made.get_size_inches()
    side = 0.62
    axes = made.add_axes((share + 0.005, lowest, side / wide, side / high))
    axes.set(xlim=(-1.35, 1.35), ylim=(-1.35, 1.35))
    axes.set_axis_off()
    directions = camera.seen(np.eye(3))
    for place in np.argsort(directions[:, 2]):
        way = directions[place, :2]
        axes.annotate(
            "",
            xy=tuple(way),
            xytext=(0, 0),
            arrowprops={"arrowstyle": "-|>", "lw": 0.8, "color": INK, "shrinkA": 0, "shrinkB": 0},
        )
        x, y = 1.25 * way + 0.08 * way / max(float(np.hypot(*way)), 1e-6)
        axes.text(x, y, "xyz"[place], ha="center", va="center", style="italic", fontsize=8)


def _draw_bar(made: Figure, scene: Scene, share: float, lowest: float) -> None:
    """The colour bar; its ends are pointed where values lie beyond them."""
    low, high = scene.limits
    tolerance = 1e-6 * (high - low)
    below = scene.values.min() < low - tolerance
    above = scene.values.max() > high + tolerance
    ends = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}
    inch = 1.0 / made.get_size_inches()[1]
    start = lowest + 0.8 * inch
    head = (0.38 + 0.16 * scene.label.count("\n")) * inch
    box = made.add_axes((share + 0.012, start, 0.018, 1 - start - head))
    bar = made.colorbar(
        ScalarMappable(Normalize(low, high), scene.colours),
        cax=box,
        extend=ends[(int(below), int(above))],
        extendfrac=0.04,
    )
    bar.outline.set_linewidth(0.5)
    bar.ax.tick_params(width=0.5, length=2.5, direction="out")
    bar.ax.set_title(scene.label, fontsize=9, pad=8 if above else 6, loc="left")
