"""The runs that the page of the damage impact tells of, and what they are held against."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
from plydyn_post.cscan import draw_cscan, draw_delamination
from plydyn_post.grid import read_point_field, read_times
from plydyn_post.ply_maps import draw_ply_maps
from plydyn_post.results import Results, open_results
from plydyn_post.section import draw_section

from studies.damage import MODELS, RECIPES, answers_text, areas_text, mean_force, read_answer
from studies.jobs import ROOT, Job, StudyError, kept_effort
from studies.markdown import table

#: As in a test: large displacement, and steps that do not take long
LARGE = (
    "control.kinematics=total_lagrangian",
    "control.step_factor=0.9",
    "control.scheme=implicit_interfaces",
    "control.largest_step=3.0e-8",
    "control.end_time=3.0e-3",
)
#: Peak, contact and displacement from elsewhere: the elastic run from an independent program; with
#: linear strain the range from an undamaged plate down; the elastic plate with membrane stiffening
#: as one degree of freedom
BY_HAND = {
    "tied_le1": "4684 N, 2.70 ms, 3.34 mm",
    "q192_le1_linear": "3.5 to 4.7 kN, 2.8 to 4 ms",
    "coarse": "elastic: 7.4 kN, 2.0 ms, 2.6 mm",
}
#: Olsson's force of seven and of two delaminations that grow together
LATE_BY_HAND = "1.05 to 1.6 kN"
#: The last part of a run over which its force is averaged, s
LATE = 1e-3
#: Where the pictures of the pages lie
PICTURES = ROOT / "manual/pictures"
#: Places are told apart down to this, mm
SAME = 1e-6


@dataclass(frozen=True)
class Run:
    """A run, and how the page calls it."""

    name: str
    words: str
    recipe: str
    overrides: tuple[str, ...] = ()

    def job(self, overrides: Sequence[str] = ()) -> Job:
        """Its job; values may be replaced further."""
        path = RECIPES / f"{self.recipe}.toml"
        return Job(self.name, path, (*self.overrides, *overrides))


COARSE = Run("coarse", "128 Q9/LE1, `coarse`", "coarse")
LINEAR = Run("q192_le1_linear", "192 Q9/LE1, the recipe as it stands", "q192_le1")
ELASTIC = Run("tied_le1", "192 Q9/LE1, tied and elastic", "tied_le1")
#: Large displacement resonates near 0.87 of the stable step, 21 ns here (manual/theory.md, 10)
_SHORTER = {3: ("control.largest_step=1.5e-8",)}
_LARGE = {
    model: Run(model.recipe, model.label, model.recipe, (*LARGE, *_SHORTER.get(model.order, ())))
    for model in MODELS
}
RUNS = (COARSE, *_LARGE.values(), LINEAR)
#: Those that the picture of the page lays over each other
ORDERS = tuple(run for model, run in _LARGE.items() if model.quads == 192)


def collect(runs: Sequence[Run], folder: Path) -> list[tuple[Run, Results]]:
    """The runs that have come to their end in a folder."""
    done = [run for run in runs if kept_effort(run.job(), folder) is not None]
    return [(run, open_results(folder / run.name)) for run in done]


def runs_text(found: Sequence[tuple[Run, Results]]) -> str:
    """Answers of all runs, and the areas of their interfaces."""
    named = [(run.words, results) for run, results in found]
    answers = answers_text([(words, read_answer(results)) for words, results in named])
    return f"{answers}\n{areas_text(named)}"


def bounds_text(found: Sequence[tuple[Run, Results]]) -> str:
    """What single runs come to beside what can be reckoned without them."""
    rows = []
    for run, results in found:
        answer = read_answer(results)
        ended = "–" if answer.duration is None else f"{1e3 * answer.duration:.2f} ms"
        told = f"{answer.peak:.0f} N, {ended}, {answer.displacement:.2f} mm"
        rows.append([run.words, "peak, contact, displacement", BY_HAND[run.name], told])
        if answer.duration is None:
            late = f"{late_force(results):.0f} N"
            rows.append([run.words, "mean force of the last ms", LATE_BY_HAND, late])
        off = f"{asymmetry(results):.1g} mm"
        rows.append([run.words, "displacements off symmetry to x and y", "0", off])
    return table(("run", "what", "by hand", "here"), rows)


def draw_quick_start(found: Sequence[tuple[Run, Results]]) -> list[Path]:
    """What is damaged in the quick start, where that has run; the scan is on the first page."""
    pictures = (
        (draw_cscan, "cscan"),
        (draw_ply_maps, "damage_plies"),
        (draw_delamination, "damage_interfaces"),
        (draw_section, "damage_section"),
    )
    return [
        draw(results, PICTURES / f"{name}.png")
        for run, results in found
        if run is COARSE
        for draw, name in pictures
    ]


def late_force(results: Results) -> float:
    """Mean of the contact force over the last part of a run, N."""
    time, force = mean_force(results)
    late = time > time[-1] - LATE
    return float(np.trapezoid(force[late], time[late]) / np.ptp(time[late]))


def asymmetry(results: Results) -> float:
    """How far the last displacements are from symmetry to the planes x = 0 and y = 0, mm."""
    path = results.fields
    with h5py.File(path) as file:
        points = np.array(file["VTKHDF/Points"])
        offsets = np.array(file["VTKHDF/Offsets"])
        cells = np.array(file["VTKHDF/Connectivity"]).reshape(-1, offsets[1] - offsets[0])
    moved = read_point_field(path, "displacement", len(read_times(path)) - 1)
    return off_symmetry(points, cells, moved)


def off_symmetry(points: np.ndarray, cells: np.ndarray, moved: np.ndarray) -> float:
    """The largest difference of displacements from their mirror images, mm.

    points and moved are (points, 3), cells (cells, nodes). Points at one place that belong to
    different layers are told apart by the height of the middle of their cells.
    """
    middle = np.zeros(len(points))
    middle[cells] = points[cells, 2].mean(axis=1)[:, None]
    places = np.column_stack([points - _middle_of(points), middle])
    order = _order(places)
    worst = 0.0
    for axis in (0, 1):
        mirror = np.ones(4)
        mirror[axis] = -1.0
        partner = _order(places * mirror)
        if np.abs(places[order] - (places * mirror)[partner]).max() > 2.0 * SAME:
            raise StudyError("the mesh is not symmetric")
        worst = max(worst, float(np.abs(moved[order] - moved[partner] * mirror[:3]).max()))
    return worst


def _order(places: np.ndarray) -> np.ndarray:
    """The order of places by their coordinates."""
    return np.lexsort(np.round(places / SAME).T)


def _middle_of(points: np.ndarray) -> np.ndarray:
    """The middle of the plate in its plane."""
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    middle[2] = 0.0
    return middle
