"""The dent below an impactor: both faces against the plate around, and how deep the impactor sank.

The plate around is the plane through the points of a face that are farther from the impact than
half of the farthest: what the plate as a whole does, in bending or vibrating, is mostly in it once
the contact has ended. While it lasts, the deflection of the plate is in the depths, and only the
indentation, which is measured against the opposite face, tells what is local.

In the dent that is left at rest the struck face is as deep below the plate around as the opposite
face bulges, less the gaps that are left between plies, plus what the plies below the impact have
lost of their thickness. Crushing and shear across the thickness thin the plies; debris and slip
hold gaps open.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from plydyn_post.body import Body
from plydyn_post.contact import touching
from plydyn_post.errors import ResultsError
from plydyn_post.grid import has_point_field, read_displacement, read_state, read_times
from plydyn_post.header import read_header
from plydyn_post.interfaces import read_interfaces
from plydyn_post.results import Results
from plydyn_post.sheets import find
from plydyn_post.style import NARROW, figure, finish, look_of, name_job
from plydyn_post.surface import blocks_of, extent
from plydyn_post.symmetry import Plane, part_of, planes_of
from plydyn_post.units import factor, in_brackets, readable

# Share of the distance to the farthest point from which on points are around the dent
AROUND = 0.5
# Share of the time at the end of a run in which the plate must be still, and of its largest kinetic
# energy that it may have there: displacements go with the root
LATE, STILL = 0.2, 1e-4


@dataclass(frozen=True)
class Dent:
    """Depths at the states in the direction of the push, in the unit of the fields."""

    times: np.ndarray  # (states,)
    struck: np.ndarray  # (states,) of the face that is hit, below the plate around
    opposite: np.ndarray  # (states,) of the other face
    indentation: np.ndarray  # (states,) of the impactor against the other face, nan off contact
    length: str
    time: str


@dataclass(frozen=True)
class Face:
    """A face of the plate with what is needed to measure it."""

    nodes: np.ndarray  # (n, n) of the quad below the impactor
    weights: np.ndarray  # (n, n) shape functions at the point of impact
    around: np.ndarray  # (points,) far from it
    plane: np.ndarray  # (points,) weights whose sum with displacements is their plane there

    def depth(self, moved: np.ndarray) -> float:
        """How far the point of impact lies below the plane around, from displacements."""
        return self.at_impact(moved) - float(self.plane @ moved[self.around])

    def at_impact(self, moved: np.ndarray) -> float:
        """Displacement of the point of impact."""
        return float(np.sum(self.weights * moved[self.nodes]))


def read_dent(results: Results, number: int | None = None) -> Dent | None:
    """Depths below an impactor; nothing where the fields do not tell them."""
    path = results.fields
    if not has_point_field(path, "displacement"):
        return None
    header = read_header(path)
    chosen = number if number is not None else min(header.impactors, default=0)
    if chosen not in header.impactors:
        return None
    body = header.impactors[chosen]
    times = read_times(path)
    points, above, faces = faces_below(results, body)
    heights = [above * float(points[face.nodes, 2].mean()) for face in faces]
    rows = []
    for step in range(len(times)):
        moved = -above * read_displacement(path, step)[:, 2]
        rows.append([faces[0].depth(moved), faces[1].depth(moved), faces[1].at_impact(moved)])
    struck, opposite, back = np.array(rows).T
    length, time = (header.units.get(kind, "") for kind in ("length", "time"))
    gap = above * body.centre[2] - body.reach(-above) - heights[0]
    sunk = _travel(results, chosen, times, above, length) - gap - back
    return Dent(times, struck, opposite, sunk, length, time)


@dataclass(frozen=True)
class PermanentDent:
    """Depths at the last state below a body, away from where it came; in the unit of the fields."""

    struck: float  # of the face that was hit, below the plate around
    bulge: float  # of the opposite face
    gaps: float | None  # between the plies, all together; nothing where the results do not tell
    length: str

    @property
    def thinner(self) -> float | None:
        """What the plies have lost of their thickness."""
        return None if self.gaps is None else self.struck - self.bulge + self.gaps


def read_permanent_dent(results: Results, body: Body) -> PermanentDent | None:
    """The dent below a body that struck in this stage or an earlier one, at the last state."""
    path = results.fields
    if not has_point_field(path, "displacement"):
        return None
    _, above, faces = faces_below(results, body)
    moved = -above * read_displacement(path, len(read_times(path)) - 1)[:, 2]
    struck, bulge = (face.depth(moved) for face in faces)
    gaps = _gaps(results, np.array(body.centre[:2]))
    return PermanentDent(struck, bulge, gaps, read_header(path).units.get("length", ""))


def _gaps(results: Results, place: np.ndarray) -> float | None:
    """Sum of the gaps at a place at the last state; 0 where all plies are tied."""
    path = results.interface_fields
    if not path.is_file():
        return 0.0
    if not has_point_field(path, "opening"):
        return None
    total = 0.0
    for one in read_interfaces(results).each:
        found = find(one.places, place[None, :])
        if found.quad[0] >= 0 and one.gap is not None:
            total += float(np.sum(found.weights[0] * one.gap[found.quad[0]]))
    return total


def is_moving(results: Results, impact: Results) -> bool:
    """Whether a plate still vibrates at the end of a job: what is left of its motion is a dent.

    Its kinetic energy in the last fifth of the time is compared with the largest in the impact.
    """
    if not (results.has("energy") and impact.has("energy")):
        return False
    energy = results.energy()
    late = energy["time"] >= energy["time"][-1] - LATE * np.ptp(energy["time"])
    return float(energy["kinetic"][late].max()) > STILL * float(impact.energy()["kinetic"].max())


def struck_by(results: Results) -> Body | None:
    """The first impactor of a job; nothing where its fields tell none."""
    bodies = read_header(results.fields).impactors
    return bodies[min(bodies)] if bodies else None


def faces_below(results: Results, body: Body) -> tuple[np.ndarray, float, list[Face]]:
    """Points, the side from which the impactor comes (1 or -1), the struck and the other face."""
    grid = read_state(results.fields, 0)
    points = np.asarray(grid.points, dtype=float)
    low, high = float(points[:, 2].min()), float(points[:, 2].max())
    above = 1.0 if body.centre[2] > (low + high) / 2 else -1.0
    planes = planes_of(results)
    blocks = blocks_of(grid)
    faces = []
    for height, level in ((high, -1), (low, 0))[:: int(above)]:
        quads = [block.nodes[:, :, :, level] for block in blocks]
        faces.append(_face(results.fields, points, quads, height, body, planes))
    return points, above, faces


def _face(
    path: Path,
    points: np.ndarray,
    quads: list[np.ndarray],
    height: float,
    body: Body,
    planes: tuple[Plane, ...],
) -> Face:
    """The face at a height."""
    near = 1e-6 * extent(points)
    impact = np.array(body.centre[:2])
    for nodes in quads:
        own = nodes[np.all(np.abs(points[nodes, 2] - height) <= near, axis=(1, 2))]
        found = find(points[own, :2], impact[None, :])
        if found.quad[0] >= 0:
            break
    else:
        raise ResultsError(f"{path}: the impactor is beside the plate")
    on_face = np.flatnonzero(np.abs(points[:, 2] - height) <= near)
    distance = np.hypot(*(points[on_face, :2] - impact).T)
    around = on_face[distance > AROUND * distance.max()]
    places = points[around, :2] - impact
    columns = [np.ones(len(around)), *places.T]
    # displacements are the same in the images: a plane through all is level across a symmetry
    kept = [0, *(1 + axis for axis in (0, 1) if axis not in {plane.axis for plane in planes})]
    plane = np.linalg.pinv(np.column_stack([columns[place] for place in kept]))[0]
    return Face(own[found.quad[0]], found.weights[0], around, plane)


def _travel(
    results: Results, number: int, times: np.ndarray, above: float, length: str
) -> np.ndarray:
    """How far the impactor moved towards the plate at some times, nan while it does not touch."""
    if number not in results.impactors:
        return np.full(len(times), np.nan)
    table = results.impactor(number)
    inside = touching(table["force"])
    if len(inside) == 0:
        return np.full(len(times), np.nan)
    scale = -above * factor(table.unit("displacement"), length or table.unit("displacement"))
    moved = scale * np.interp(times, table["time"], table["displacement"])
    start, end = table["time"][inside[[0, -1]]]
    return np.where((times >= start) & (times <= end), moved, np.nan)


def draw_dent(results: Results, path: Path | None = None, number: int | None = None) -> Figure:
    """Draw the depth of both faces and the indentation over time."""
    dent = read_dent(results, number)
    if dent is None:
        raise ResultsError(f"{results.fields} tells no impactor, or no displacement to measure")
    deep = {"struck face": dent.struck, "opposite face": dent.opposite}
    local = {
        "impactor, towards the opposite face": dent.indentation,
        "faces, towards each other": dent.struck - dent.opposite,
    }
    largest = float(np.max(np.abs([dent.struck, dent.opposite])))
    length, time = readable(dent.length, largest), readable(dent.time, float(dent.times[-1]))
    with figure(2, size=(NARROW, 4.4), sharex=True, height_ratios=[3, 2]) as (made, panels):
        looks = iter(look_of(place) for place in range(4))
        for axes, curves in zip(panels, (deep, local), strict=True):
            for name, values in curves.items():
                x, y = dent.times * time.factor, values * length.factor
                axes.plot(x, y, marker=".", label=name, **next(looks))
        panels[0].set_ylabel(in_brackets("Below the plate around", length.unit))
        panels[1].set_ylabel(in_brackets("Pressed in", length.unit))
        panels[1].set_xlabel(in_brackets("Time", time.unit))
        for axes in panels:
            axes.legend(loc="best", fontsize=7.5)
        made.align_ylabels(panels)
        name_job(made, results.job, part_of(results))
        return finish(made, path)
