"""Cracks along lines: states of JOB.cracks.vtkhdf, and their lines over maps of the plate."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from plydyn_post.errors import ResultsError
from plydyn_post.grid import nearest, read_times
from plydyn_post.results import Results
from plydyn_post.style import INK
from plydyn_post.vtkhdf import nodes_of, read_grid

_LINE = 3  # VTK's type of a line of two points
_FIELDS = ("damage", "start", "opening", "mode")
#: Slope against a line of pieces that do not cross it
ALONG = 1.0e-6


@dataclass(frozen=True)
class PlyCracks:
    """Pieces of the cracks of a ply that have started, seen from above."""

    ply: int  # from the bottom, from 1
    angle: float  # of the fibres, degrees
    pieces: np.ndarray  # (pieces, 2, 2) ends at time zero
    damage: np.ndarray  # (pieces,) mean of both ends
    opening: np.ndarray  # (pieces,) length of the mean opening

    @property
    def length(self) -> float:
        """Length of all pieces."""
        return float(np.linalg.norm(self.pieces[:, 1] - self.pieces[:, 0], axis=1).sum())

    def crossings(self, start: np.ndarray, end: np.ndarray) -> np.ndarray:
        """Distances from the start of a line at which the cracks cross it."""
        length = float(np.linalg.norm(end - start))
        way = (end - start) / length
        apart = self.pieces - start
        along, beside = apart @ way, apart @ np.array([-way[1], way[0]])
        turned = beside[:, 1] - beside[:, 0]
        # not those along the line, whose side of it is round-off
        met = (beside.prod(axis=1) <= 0.0) & (np.abs(turned) > ALONG * np.ptp(along, axis=1))
        share = -beside[met, 0] / turned[met]
        at = along[met, 0] + share * (along[met, 1] - along[met, 0])
        found: np.ndarray = at[(at >= 0.0) & (at <= length)]
        return found


def read_cracks(results: Results, time: float | None = None) -> tuple[PlyCracks, ...]:
    """Cracks of the plies with lines at the state nearest to a time, of the last one without."""
    path = results.crack_fields
    times = read_times(path)
    grid = read_grid(path, len(times) - 1 if time is None else nearest(times, time, path))
    for name, data in (*((one, grid.point_data) for one in _FIELDS), ("ply", grid.cell_data)):
        if name not in data:
            raise ResultsError(f"{path} has no field {name!r}")
    if set(map(int, grid.celltypes)) != {_LINE}:
        raise ResultsError(f"{path} holds no lines of two points")
    ends = nodes_of(grid, _LINE)
    plies = np.asarray(grid.cell_data["ply"]).astype(int)
    angles = np.asarray(grid.cell_data["angle"], dtype=float)
    started = (np.asarray(grid.point_data["start"])[ends] > 0.0).all(axis=1)
    damage = np.asarray(grid.point_data["damage"])[ends].mean(axis=1)
    opening = np.linalg.norm(np.asarray(grid.point_data["opening"])[ends].mean(axis=1), axis=1)
    places = np.asarray(grid.points, dtype=float)[ends][..., :2]
    found = []
    for ply in np.unique(plies):
        own = (plies == ply) & started
        angle = float(angles[plies == ply][0])
        found.append(PlyCracks(int(ply), angle, places[own], damage[own], opening[own]))
    return tuple(found)


def cracks_of(results: Results, time: float | None = None) -> dict[int, PlyCracks]:
    """The cracks by their plies; none where a job has no crack lines."""
    if not results.crack_fields.is_file():
        return {}
    return {one.ply: one for one in read_cracks(results, time)}


def draw_cracks(
    axes: Axes, cracks: PlyCracks | None, colour: str = INK, width: float = 0.7
) -> None:
    """The cracks of a ply as lines."""
    if cracks is not None and len(cracks.pieces):
        axes.add_collection(
            LineCollection(list(cracks.pieces), colors=colour, linewidths=width, zorder=3)
        )
