"""A job from Python: histories, fields, interfaces, areas, stresses, numbers and figures."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import pyvista as pv
from matplotlib.figure import Figure

from plydyn_post.areas import area_history
from plydyn_post.cracks import PlyCracks, cracks_of
from plydyn_post.grid import nearest, read_times
from plydyn_post.header import read_header
from plydyn_post.interfaces import Interface, read_interfaces
from plydyn_post.job_figures import draw
from plydyn_post.numbers import compare
from plydyn_post.plies import PlyStress, read_ply_stress
from plydyn_post.results import Results, open_results
from plydyn_post.symmetry import read_whole
from plydyn_post.table import Table
from plydyn_post.vtkhdf import layout_of, read_point_field


class HasResults(Protocol):
    """What plydyn_pre.run gives: the results of a deck and of its stages."""

    @property
    def results(self) -> tuple[Path, ...]:
        """Paths of the results of each stage without their endings."""


@dataclass(frozen=True)
class Job:
    """Results of a run, read when asked for; numbers are in the units of its deck.

    A time is that of a state of the fields, or near one; without it the last state is taken.
    """

    results: Results

    @property
    def name(self) -> str:
        """The name of the job."""
        return self.results.job

    @property
    def listing(self) -> str:
        """The text of the listing; empty without one."""
        path = self.results.folder / f"{self.name}.out"
        return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""

    @property
    def units(self) -> dict[str, str]:
        """Units of length, time, mass, force, stress and energy, where the deck names them."""
        return read_header(self.results.fields).units

    @property
    def plies(self) -> tuple[dict[str, float], ...]:
        """The plies from the bottom up: part, ply, ply_id, angle [deg], bottom and top [length]."""
        return read_header(self.results.fields).plies

    @property
    def histories(self) -> tuple[str, ...]:
        """Names of the tables over time, such as energy, impactor_1 and delamination."""
        return self.results.tables

    def history(self, name: str = "impactor_1") -> Table:
        """A table over time: `table["force"]` is a column, (rows,); `table.frame()` is of pandas.

        Forces, energies and areas of a half or a quarter are those of the whole plate.
        """
        return self.results.table(name)

    @property
    def times(self) -> np.ndarray:
        """Times of the states of the fields, (states,)."""
        return read_times(self.results.fields)

    @property
    def fields(self) -> tuple[str, ...]:
        """Names of the fields at the points."""
        return layout_of(self.results.fields).point_fields

    def field(self, name: str, time: float | None = None) -> np.ndarray:
        """A field at the points of the model, (points,), (points, 3) or (points, 6).

        Tensors are xx, yy, zz, xy, yz, xz, or 11, 22, 33, 12, 23, 13 where the name ends in _ply.
        """
        return read_point_field(self.results.fields, name, self._state(self.results.fields, time))

    def grid(self, time: float | None = None, whole: bool = True) -> pv.UnstructuredGrid:
        """The plate with all its fields at a state, mirrored where the model is a part of it."""
        return self._grid(self.results.fields, time, whole)

    def interface_grid(self, time: float | None = None, whole: bool = True) -> pv.UnstructuredGrid:
        """The interfaces with all their fields at a state."""
        return self._grid(self.results.interface_fields, time, whole)

    def interfaces(self, time: float | None = None) -> tuple[Interface, ...]:
        """The interfaces of the whole plate from the bottom up, with fields (quads, n, n)."""
        return read_interfaces(self.results, time).each

    def cracks(self, time: float | None = None) -> tuple[PlyCracks, ...]:
        """Cracks along lines of each ply that has some: pieces (pieces, 2, 2), damage, opening."""
        return tuple(cracks_of(self.results, time).values())

    def ply_stress(self, ply: int, x: float, y: float, time: float | None = None) -> PlyStress:
        """Stress through the thickness of ply 1, 2, ... from the bottom, over a point."""
        return read_ply_stress(self.results, ply, x, y, time)

    def areas(self, measure: str = "energy") -> Table:
        """Delaminated areas over time of each interface, their sum, and projected.

        By measure "energy" where half of the fracture energy is spent, at the interval of the
        history; by "damage" where the damage is 0.99 or more, at the states.
        """
        return area_history(self.results, measure)

    def numbers(self, impactor: int = 1) -> dict[str, tuple[float | None, str]]:
        """What the impact came to: name, with value and unit; None where it is not known."""
        found = compare([self.results])
        place = self.results.impactors.index(self.results.known("impactor", impactor))
        return {row.name: (row.values[place], row.unit) for row in found.rows}

    def figure(self, name: str, path: str | Path | None = None, **options: Any) -> Figure:  # noqa: ANN401
        """A figure by its name, such as force or cscan, written to a path where one is given.

        Options are those of the function of that name in plydyn_post.job_figures.
        """
        if path is not None:
            self.results.spare(Path(path))
        return draw(name, self.results, None if path is None else Path(path), options)

    def _grid(self, path: Path, time: float | None, whole: bool) -> pv.UnstructuredGrid:
        results = self.results if whole else replace(self.results, mirror="none")
        return read_whole(results, path, self._state(path, time))

    def _state(self, path: Path, time: float | None) -> int:
        times = read_times(path)
        return len(times) - 1 if time is None else nearest(times, time, path)


def open_job(job: HasResults | str | Path, stage: int = 0) -> Job:
    """Open a job of plydyn_pre.run, or one by its name, one of its files or its folder.

    Of a job with stages it is the first one, or that of a number: 0, 1, ... or -1 for the last.
    """
    return Job(open_results(job if isinstance(job, str | Path) else job.results[stage]))
