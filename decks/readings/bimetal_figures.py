"""The paper's figures 6, 7 and 8: deflection and plastic strain of the bimetallic plate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from plydyn_post.grid import largest_deflection, read_times
from plydyn_post.results import Results
from plydyn_post.style import PLAIN_MAP, WIDE, figure, legend_above, look_of, save
from plydyn_post.vtkhdf import read_point_field

#: Share of the plate's size within which a point lies on a face or on the plane of the section
ON_FACE = 1e-6
#: Half the length of the line of figure 7, and half the width of the pictures of figure 8, mm
LINE, AROUND = 10.0, 3.0


@dataclass(frozen=True)
class Face:
    """Points of the top face."""

    place: np.ndarray  # (points, 2), mm, from the middle
    deflection: np.ndarray  # (points,), mm
    strain: np.ndarray  # (points,), effective plastic strain
    time: float  # s


@dataclass(frozen=True)
class Layer:
    """What a section through x = 0 cuts of a layer."""

    y: np.ndarray  # (2, places), mm, from the middle, on its lower and upper face
    z: np.ndarray  # (2, places), mm, from the middle
    strain: np.ndarray  # (2, places)


def read_face(results: Results, step: int = -1) -> Face:
    """The top face in a state, by default the last, with the values of the ply below it."""
    path = results.fields
    times = read_times(path)
    step %= len(times)
    points = _points(path)
    low, high = points.min(axis=0), points.max(axis=0)
    top = points[:, 2] > high[2] - ON_FACE * (high[2] - low[2])
    return Face(
        points[top, :2] - 0.5 * (low + high)[:2],
        read_point_field(path, "displacement", step)[top, 2],
        read_point_field(path, "plastic_strain", step)[top],
        float(times[step]),
    )


def read_section(results: Results) -> list[Layer]:
    """The layers of plates or bricks, cut by x = 0 in the last state, from the bottom up."""
    path = results.fields
    points = _points(path)
    strain = read_point_field(path, "plastic_strain", len(read_times(path)) - 1)
    with h5py.File(path) as file:
        offsets = np.array(file["VTKHDF/Offsets"])
        cells = np.array(file["VTKHDF/Connectivity"]).reshape(-1, offsets[1] - offsets[0])
    place = points - 0.5 * (points.min(axis=0) + points.max(axis=0))
    close = ON_FACE * np.ptp(place, axis=0)
    bottom, top = place[cells, 2].min(axis=1), place[cells, 2].max(axis=1)
    layers = []
    for number in np.unique(np.round(bottom / close[2])):
        own = np.round(bottom / close[2]) == number
        nodes = np.unique(cells[own])
        nodes = nodes[np.abs(place[nodes, 0]) < close[0]]
        lines = []
        for height in (bottom[own][0], top[own][0]):
            line = nodes[np.abs(place[nodes, 2] - height) < close[2]]
            lines.append(line[np.argsort(place[line, 1])])
        both = np.array(lines)
        layers.append(Layer(place[both, 1], place[both, 2], strain[both]))
    return layers


def asymmetry(face: Face) -> float:
    """Largest difference of deflection between places that mirror each other, over the largest."""
    keys = np.round(face.place / (1e-6 * np.ptp(face.place))).astype(np.int64)
    own = {tuple(key): value for key, value in zip(keys.tolist(), face.deflection, strict=True)}
    mirrors = ((-1, 1, False), (1, -1, False), (1, 1, True))
    worst = 0.0
    for (x, y), value in own.items():
        for a, b, swapped in mirrors:
            place = (b * y, a * x) if swapped else (a * x, b * y)
            if place in own:
                worst = max(worst, abs(own[place] - value))
    return float(worst / np.abs(face.deflection).max())


def lost_momentum(results: Results) -> float:
    """Impulse of the force less the momentum of the ball, over that it came with."""
    ball, energy = results.impactor(), results.energy()
    mass = 2.0 * energy["impactor"][0] / ball["velocity"][0] ** 2
    gained = mass * (ball["velocity"][-1] - ball["velocity"][0])
    pushed = np.trapezoid(ball["force"], ball["time"])
    return float(abs(gained - pushed) / (mass * abs(ball["velocity"][0])))


def _points(path: Path) -> np.ndarray:
    """Where the points are before the impact, mm."""
    with h5py.File(path) as file:
        return np.array(file["VTKHDF/Points"])


def draw_bimetal(jobs: Sequence[tuple[str, Results]], folder: Path) -> list[Path]:
    """All three figures, layers and bricks in one picture each."""
    faces = [(name, read_face(results)) for name, results in jobs]
    deepest = largest_deflection(jobs[0][1].fields)
    early = [(name, read_face(results, deepest)) for name, results in jobs]
    sections = [read_section(results) for _, results in jobs]
    return [
        _draw_deflections((early, faces), folder / "figure6.png"),
        _draw_strain(faces, folder / "figure7.png"),
        _draw_zone(faces, sections, folder / "figure8.png"),
    ]


def along_y(face: Face, what: str) -> tuple[np.ndarray, np.ndarray]:
    """Places along the middle line x = 0 of the face, and the values there."""
    column = np.abs(face.place[:, 0])
    line = column < column.min() + 1e-6 * np.ptp(face.place[:, 0])
    order = np.argsort(face.place[line, 1])
    return face.place[line, 1][order], getattr(face, what)[line][order]


def _draw_deflections(states: Sequence[Sequence[tuple[str, Face]]], path: Path) -> Path:
    """Deflection along the middle line when it is largest, and at the end."""
    with figure(1, 2, (WIDE, 3.3)) as (drawn, panels):
        for axes, faces in zip(panels, states, strict=True):
            for k, (name, face) in enumerate(faces):
                axes.plot(*along_y(face, "deflection"), label=name, **look_of(k))
            time = f"at {1e3 * faces[0][1].time:.2g} ms"
            axes.set_xlabel(f"y from the middle [mm], {time}")
        panels[0].set_ylabel("Deflection $u_z$ of the face [mm]")
        legend_above(drawn, panels[0])
        return save(drawn, path)


def _draw_strain(faces: Sequence[tuple[str, Face]], path: Path) -> Path:
    """Plastic strain along the middle line."""
    with figure() as (drawn, axes):
        for k, (name, face) in enumerate(faces):
            place, strain = along_y(face, "strain")
            axes.plot(place, 100.0 * strain, label=name, **look_of(k))
        axes.set_xlabel("y from the middle of the impacted face [mm]")
        axes.set_ylabel("Effective plastic strain [%]")
        axes.set_xlim(-LINE, LINE)
        legend_above(drawn, axes)
        return save(drawn, path)


def _draw_zone(
    faces: Sequence[tuple[str, Face]], sections: Sequence[Sequence[Layer]], path: Path
) -> Path:
    """Plastic strain around the middle, on the face and in a section, in one scale."""
    most = max(
        [100.0 * face.strain.max() for _, face in faces]
        + [100.0 * layer.strain.max() for layers in sections for layer in layers]
    )
    levels = MaxNLocator(12).tick_values(0.0, most if most > 0.0 else 1.0)
    size = (WIDE, 1.35 * WIDE / max(len(faces), 2) + 0.7)
    shares = {"sharex": True, "sharey": "row", "gridspec_kw": {"height_ratios": (3.0, 2.0)}}
    with figure(2, len(faces), size, squeeze=False, **shares) as (drawn, rows):
        for axes, (name, face) in zip(rows[0], faces, strict=True):
            close = np.abs(face.place).max(axis=1) < 2.0 * AROUND
            x, y = face.place[close].T
            strain = 100.0 * face.strain[close]
            shown = axes.tricontourf(x, y, strain, levels, cmap=PLAIN_MAP)
            axes.set_title(name, fontsize=8.0)
            axes.set(xlim=(-AROUND, AROUND), ylim=(-AROUND, AROUND))
        for axes, layers in zip(rows[1], sections, strict=True):
            _draw_section(axes, layers, levels)
        rows[0][0].set_ylabel("Face: y [mm]")
        rows[1][0].set_ylabel("Section: z [mm]")
        drawn.colorbar(shown, ax=list(rows.flat), label="Effective plastic strain [%]")
        return save(drawn, path)


def _draw_section(axes: Axes, layers: Sequence[Layer], levels: Sequence[float]) -> None:
    """Plastic strain through the thickness."""
    for layer in layers:
        axes.contourf(layer.y, layer.z, 100.0 * layer.strain, levels, cmap=PLAIN_MAP)
    axes.set_xlabel("x; section: y [mm]", fontsize=7.5)
    axes.grid(visible=False)
