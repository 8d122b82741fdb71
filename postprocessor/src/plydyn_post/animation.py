"""An impact as moving pictures: the plate cut open, delamination as it grows, and the force."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from plydyn_post import offscreen
from plydyn_post.camera import Camera, camera_for
from plydyn_post.cscan import draw_map
from plydyn_post.errors import ResultsError
from plydyn_post.grid import has_point_field, largest_deflection, read_times
from plydyn_post.maps import area_words
from plydyn_post.picture import compose
from plydyn_post.results import Results
from plydyn_post.scan import read_scan
from plydyn_post.scene import Wish, make_scene
from plydyn_post.style import COLOURS, QUIET, WIDE, save
from plydyn_post.symmetry import part_of
from plydyn_post.table import Table
from plydyn_post.units import in_brackets, readable

# Files that can be made of the frames
ENDINGS = (".gif", ".mp4")
# Seconds that an animation takes where nothing is asked for, within these frames a second
LASTS, SLOWEST, FASTEST = 6.0, 2.0, 25.0
# Height of the maps and curves below the plate, inches, and width of a GIF, pixels
BELOW, GIF_WIDTH = 2.3, 900


@dataclass(frozen=True)
class Film:
    """What stays the same in all frames."""

    results: Results
    wish: Wish
    camera: Camera
    window: str | None  # of VTK; nothing to draw by matplotlib
    history: Table | None  # of the impactor
    half: float | None  # half the side of the map of interfaces; nothing without them


def draw_animation(
    results: Results,
    path: Path,
    wish: Wish,
    plain: bool = False,
    rate: float | None = None,
    tick: Callable[[str], None] = lambda _: None,
) -> Path:
    """Draw a frame for every state, as PNG in a folder beside, and make a GIF or an MP4 of them."""
    if path.suffix.lower() not in ENDINGS:
        raise ResultsError(f"{path}: no animation ends so; right would be {', '.join(ENDINGS)}")
    if path.suffix.lower() == ".mp4" and shutil.which("ffmpeg") is None:
        raise ResultsError(f"{path}: an MP4 needs the program ffmpeg; a GIF needs none")
    times = read_times(results.fields)
    film = make_film(results, wish, plain)
    folder = path.with_name(f"{path.stem}_frames")
    for old in folder.glob("frame_*.png"):
        old.unlink()
    frames = []
    for number, time in enumerate(times):
        tick(f"frame {number + 1} of {len(times)}")
        frames.append(draw_frame(film, float(time), folder / f"frame_{number:04d}.png"))
    chosen = rate or float(np.clip(len(times) / LASTS, SLOWEST, FASTEST))
    return (write_gif if path.suffix.lower() == ".gif" else write_mp4)(frames, path, chosen)


def quantity_of(results: Results) -> str:
    """What is shown where nothing is asked for: matrix damage where there is some."""
    return "damage_matrix" if has_point_field(results.fields, "damage_matrix") else "uz"


def make_film(results: Results, wish: Wish, plain: bool) -> Film:
    """Choose view, factors and colours that suit all states."""
    times = read_times(results.fields)
    deepest = float(times[largest_deflection(results.fields)])
    scene = make_scene(results, replace(wish, time=deepest))
    limits = wish.limits or scene.limits
    fixed = replace(wish, factor=scene.factor, thickness=scene.thickness, limits=limits)
    between = results.interface_fields.is_file()
    return Film(
        results,
        fixed,
        camera_for(scene),
        None if plain else offscreen.window(),
        results.impactor() if results.impactors else None,
        read_scan(results).near if between else None,
    )


def draw_frame(film: Film, time: float, path: Path) -> Path:
    """Draw an instant."""
    scene = make_scene(film.results, replace(film.wish, time=time))
    below = BELOW if film.half is not None or film.history is not None else 0.0
    with compose(film.results, scene, film.camera, film.window, below) as made:
        if film.half is not None:
            _draw_map(made, film.results, film.half, time)
        if film.history is not None:
            left = 0.55 if film.half is not None else 0.12
            _draw_force(made, film.history, time, left, part_of(film.results))
        return save(made, path)


def _axes(made: Figure, left: float, width: float, low: float, high: float) -> Axes:
    """Axes below the plate: shares of the width, and heights in inches."""
    tall = made.get_size_inches()[1]
    return made.add_axes((left, low / tall, width, (high - low) / tall))


def _draw_map(made: Figure, results: Results, half: float, time: float) -> None:
    """Delaminated interfaces, as large as they become at the end."""
    scan = read_scan(results, time)
    axes = _axes(made, 0.02, (BELOW - 0.45) / WIDE, 0.4, BELOW - 0.05)
    draw_map(axes, replace(scan, near=half))
    words = f"delaminated: {area_words(scan.areas.projected, scan.areas.unit)}"
    made.text(0.02, 0.06 / made.get_size_inches()[1], words, fontsize=8, va="bottom")


def _draw_force(made: Figure, table: Table, time: float, left: float, part: str) -> None:
    """The force so far, with what is to come faintly."""
    axes = _axes(made, left, 0.95 - left, 0.55, BELOW - 0.15)
    across = readable(table.unit("time"), float(np.max(table["time"])))
    upwards = readable(table.unit("force"), float(np.max(np.abs(table["force"]))))
    x, y = table["time"] * across.factor, table["force"] * upwards.factor
    past = table["time"] <= time
    axes.plot(x, y, color=QUIET, linewidth=0.6)
    axes.plot(x[past], y[past], color=COLOURS[0], linewidth=1.2)
    now = float(np.interp(time, table["time"], y))
    axes.plot(time * across.factor, now, "o", color=COLOURS[1], markersize=4)
    axes.set_xlabel(in_brackets("Time", across.unit))
    axes.set_ylabel("\n".join(filter(None, [in_brackets("Contact force", upwards.unit), part])))


def write_gif(frames: Sequence[Path], path: Path, rate: float) -> Path:
    """Write frames as a GIF that repeats."""
    images = []
    for frame in frames:
        with Image.open(frame) as image:
            size = (GIF_WIDTH, round(image.height * GIF_WIDTH / image.width))
            images.append(image.convert("RGB").resize(size, Image.Resampling.LANCZOS))
    pause = round(1000.0 / rate)
    path.parent.mkdir(parents=True, exist_ok=True)
    images[0].save(path, save_all=True, append_images=images[1:], duration=pause, loop=0)
    return path


def write_mp4(frames: Sequence[Path], path: Path, rate: float) -> Path:
    """Write frames as an MP4 by ffmpeg."""
    pattern = frames[0].parent / "frame_%04d.png"
    command = [
        "ffmpeg", "-y", "-loglevel", "error", "-framerate", f"{rate:g}", "-i", str(pattern),
        "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-pix_fmt", "yuv420p", str(path),
    ]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise OSError(f"{path}: ffmpeg failed: {' '.join(done.stderr.split())}")
    return path
