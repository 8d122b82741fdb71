"""The paper's figures 6, 7 and 8: deflection and plastic strain of the bimetallic plate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
from plydyn_post.results import Results
from plydyn_post.style import PLAIN_MAP, WIDE, figure, legend_above, look_of, save

#: Share of the plate's thickness within which a point lies on its top face
ON_FACE = 1e-6
#: Half the length of the line of figure 7, and half the width of the pictures of figure 8, mm
LINE, AROUND = 10.0, 3.0


@dataclass(frozen=True)
class Face:
    """Points of the top face at the end of a run."""

    place: np.ndarray  # (points, 2), mm, from the middle
    deflection: np.ndarray  # (points,), mm
    strain: np.ndarray  # (points,), effective plastic strain
    time: float  # s


def read_face(results: Results) -> Face:
    """The top face of the last state, with the values of the ply below it."""
    with h5py.File(results.fields) as file:
        grid = file["VTKHDF"]
        points = np.array(grid["Points"])
        fields = {
            name: np.array(grid["PointData"][name][-len(points) :])
            for name in ("displacement", "plastic_strain")
        }
        time = float(grid["Steps/Values"][-1])
    low, high = points.min(axis=0), points.max(axis=0)
    top = points[:, 2] > high[2] - ON_FACE * (high[2] - low[2])
    place = points[top, :2] - 0.5 * (low + high)[:2]
    return Face(place, fields["displacement"][top, 2], fields["plastic_strain"][top], time)


def draw_bimetal(jobs: Sequence[tuple[str, Results]], folder: Path) -> list[Path]:
    """All three figures, layers and bricks in one picture each."""
    faces = [(name, read_face(results)) for name, results in jobs]
    return [
        _draw_line(faces, "deflection", "Deflection u_z [mm]", folder / "figure6.png"),
        _draw_line(faces, "strain", "Effective plastic strain [-]", folder / "figure7.png"),
        _draw_faces(faces, folder / "figure8.png"),
    ]


def along_y(face: Face, what: str) -> tuple[np.ndarray, np.ndarray]:
    """Places along the middle line x = 0 of the face, and the values there."""
    column = np.abs(face.place[:, 0])
    line = column < column.min() + 1e-6 * np.ptp(face.place[:, 0])
    order = np.argsort(face.place[line, 1])
    return face.place[line, 1][order], getattr(face, what)[line][order]


def _draw_line(faces: Sequence[tuple[str, Face]], what: str, words: str, path: Path) -> Path:
    """Values along the middle line."""
    with figure() as (drawn, axes):
        for k, (name, face) in enumerate(faces):
            axes.plot(*along_y(face, what), label=name, **look_of(k))
        axes.set_xlabel("y from the middle of the impacted face [mm]")
        axes.set_ylabel(words)
        if what == "strain":
            axes.set_xlim(-LINE, LINE)
        legend_above(drawn, axes)
        return save(drawn, path)


def _draw_faces(faces: Sequence[tuple[str, Face]], path: Path) -> Path:
    """Plastic strain around the middle, face beside face, in one scale."""
    near = [(name, face, np.abs(face.place).max(axis=1) < 2.0 * AROUND) for name, face in faces]
    most = max(float(face.strain[close].max()) for _, face, close in near)
    levels = np.linspace(0.0, most if most > 0.0 else 1.0, 13)
    size = (WIDE, 0.6 + WIDE / max(len(faces), 2))
    with figure(1, len(faces), size, sharey=True, squeeze=False) as (drawn, rows):
        for axes, (name, face, close) in zip(rows[0], near, strict=True):
            x, y = face.place[close].T
            shown = axes.tricontourf(x, y, face.strain[close], levels, cmap=PLAIN_MAP)
            axes.set(title=name, aspect="equal", xlabel="x [mm]")
            axes.set(xlim=(-AROUND, AROUND), ylim=(-AROUND, AROUND))
        rows[0][0].set_ylabel("y [mm]")
        drawn.colorbar(shown, ax=list(rows[0]), label="Effective plastic strain [-]")
        return save(drawn, path)
