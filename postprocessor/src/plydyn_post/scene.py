"""What is in a picture: the deformed plate at an instant, the impactor, and the words."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pyvista as pv
from matplotlib.colors import Colormap

from plydyn_post.body import Body
from plydyn_post.cut import cut_surface
from plydyn_post.errors import ResultsError
from plydyn_post.grid import largest_deflection, nearest, read_times
from plydyn_post.header import Header, read_header
from plydyn_post.maps import middle_of
from plydyn_post.results import Results
from plydyn_post.shown import Shown, shown
from plydyn_post.surface import Surface, blocks_of, extent, surface_of
from plydyn_post.symmetry import read_whole, words_of
from plydyn_post.units import in_brackets, nice, readable

# Shares of the side of what is seen that the automatic factors aim at
DEFLECTION_SHARE, THICKNESS_SHARE = 0.07, 0.15


@dataclass(frozen=True)
class Wish:
    """What the reader asks of a picture; where nothing is asked, it is chosen."""

    quantity: str = "uz"
    time: float | None = None
    factor: float | None = None  # of the displacement
    thickness: float | None = None  # factor of the thickness
    cut: bool = False
    zoom: float = 1.0  # about the point of impact
    mesh: bool = True
    limits: tuple[float, float] | None = None  # of the colours, in units of print


@dataclass(frozen=True)
class Lines:
    """Segments on faces of the plate."""

    ends: np.ndarray  # (segments, 2, 3)
    looks: np.ndarray  # (segments, 3) the direction in which their face looks


@dataclass(frozen=True)
class Scene:
    """All that is drawn, where it is drawn."""

    points: np.ndarray  # (points, 3)
    values: np.ndarray  # (points,) in units of print
    triangles: np.ndarray  # (triangles, 3)
    ply_lines: Lines
    mesh_lines: Lines
    bodies: tuple[Body, ...]
    label: str
    colours: Colormap
    limits: tuple[float, float]
    words: str
    ply_height: float  # as drawn
    middle: np.ndarray  # (3,) where a zoom leads to
    zoom: float
    factor: float  # of the displacement
    thickness: float  # factor of the thickness


@dataclass(frozen=True)
class State:
    """A state of the fields with what is shown of it."""

    time: float
    header: Header
    grid: pv.UnstructuredGrid
    shown: Shown
    points: np.ndarray  # (points, 7) place at time zero, displacement, value


@dataclass(frozen=True)
class Magnified:
    """How places at time zero become places in the picture."""

    thickness: float
    factor: float

    def place(self, points: np.ndarray) -> np.ndarray:
        """Where points of seven numbers are drawn, (..., 7) to (..., 3)."""
        return points[..., :3] * [1.0, 1.0, self.thickness] + self.factor * points[..., 3:6]

    def lines(self, segments: np.ndarray) -> Lines:
        """Where segments of ten numbers at their ends are drawn."""
        return Lines(self.place(segments), segments[:, 0, 7:])


def make_scene(results: Results, wish: Wish) -> Scene:
    """Put together what is drawn of a job."""
    state = _state(results, wish)
    blocks = blocks_of(state.grid)
    if wish.cut:
        surface = cut_surface(blocks, state.points, _middle(state))
    else:
        surface = surface_of(blocks, state.points)
    magnified = Magnified(
        wish.thickness or _auto_thickness(state.points, wish),
        wish.factor or _auto_factor(state.points, wish),
    )
    known = state.points[:, 6]
    scale = readable(state.shown.unit(state.header), float(np.abs(known).max()))
    values = scale.factor * surface.points[:, 6]
    if state.shown.bounded:
        values = values.clip(scale.factor * known.min(), scale.factor * known.max())
    plies = len(np.unique(np.concatenate([block.ply for block in blocks])))
    return Scene(
        points=magnified.place(surface.points),
        values=values,
        triangles=surface.triangles,
        ply_lines=magnified.lines(surface.ply_lines),
        mesh_lines=magnified.lines(surface.mesh_lines if wish.mesh else Surface().mesh_lines),
        bodies=_bodies(results, state, magnified),
        label=in_brackets(state.shown.label, scale.unit),
        colours=state.shown.colours,
        limits=wish.limits or state.shown.limits or _limits(values, state.shown.signed),
        words="   ".join(filter(None, [_words(state, magnified), words_of(results)])),
        ply_height=magnified.thickness * float(np.ptp(state.points[:, 2])) / plies,
        middle=magnified.place(_below(state.points, _middle(state), 1.0)),
        zoom=wish.zoom,
        factor=magnified.factor,
        thickness=magnified.thickness,
    )


def _state(results: Results, wish: Wish) -> State:
    """The state at the time asked for, or at the largest deflection."""
    times = read_times(results.fields)
    chosen = shown(wish.quantity)
    step = (
        largest_deflection(results.fields)
        if wish.time is None
        else nearest(times, wish.time, results.fields)
    )
    grid = read_whole(results, results.fields, step)
    if "displacement" not in grid.point_data:
        raise ResultsError(f"{results.fields} has no field 'displacement' to draw")
    columns = [grid.points, grid.point_data["displacement"], chosen.values(grid, results.fields)]
    points = np.column_stack(columns).astype(float)
    return State(float(times[step]), read_header(results.fields), grid, chosen, points)


def _middle(state: State) -> tuple[float, float]:
    """Below the first impactor; without one, the middle of the plate."""
    x, y = middle_of(state.header, state.points[:, :2])
    return float(x), float(y)


def _auto_factor(points: np.ndarray, wish: Wish) -> float:
    """Factor of the displacement that makes it well visible."""
    moved = float(np.abs(points[:, 3:6]).max())
    return nice(DEFLECTION_SHARE * extent(points) / wish.zoom / moved) if moved > 0.0 else 1.0


def _auto_thickness(points: np.ndarray, wish: Wish) -> float:
    """Factor of the thickness that lets the plies be seen in a cut."""
    thickness = float(np.ptp(points[:, 2]))
    if not wish.cut or thickness == 0.0:
        return 1.0
    return nice(THICKNESS_SHARE * extent(points) / wish.zoom / thickness)


def _limits(values: np.ndarray, signed: bool) -> tuple[float, float]:
    """Ends of the colours: all values, for signed ones with zero in the middle."""
    if values.size == 0:
        raise ResultsError("the fields have no surface to draw")
    low, high = float(values.min()), float(values.max())
    if signed:
        end = max(abs(low), abs(high)) or 1.0
        return -end, end
    return (low, high) if high > low else (low, low + 1.0)


def _bodies(results: Results, state: State, magnified: Magnified) -> tuple[Body, ...]:
    """The impactors that have a history, where they touch the drawn plate as they do the real."""
    bodies = []
    for number, body in state.header.impactors.items():
        if number not in results.impactors:
            continue
        table = results.impactor(number)
        moved = float(np.interp(state.time, table["time"], table["displacement"]))
        bodies.append(_placed(body, moved, state.points, magnified))
    return tuple(bodies)


def _placed(body: Body, moved: float, points: np.ndarray, magnified: Magnified) -> Body:
    """A body in the picture: a gap keeps its size, the way together with the plate is magnified.

    It keeps its shape, so that its tip decides, and never lies inside the drawn plate there.
    """
    x, y, z = body.centre
    bottom, top = float(points[:, 2].min()), float(points[:, 2].max())
    above = 1.0 if z > (bottom + top) / 2 else -1.0
    face, reach = top if above > 0 else bottom, body.reach(-above)
    gap = above * (z + moved - face) - reach
    plate = above * float(magnified.place(_below(points, (x, y), above))[2])
    way = magnified.factor * gap if gap < 0.0 else gap
    tip = max(above * magnified.thickness * face + way, plate)
    return replace(body, centre=(x, y, above * (tip + reach)))


def _below(points: np.ndarray, place: tuple[float, float], above: float) -> np.ndarray:
    """The point of the top (above 1) or bottom (-1) nearest to a place in the plane, (7,)."""
    height = above * points[:, 2]
    on_face = points[height >= height.max() - 1e-6 * extent(points)]
    return on_face[np.argmin(np.hypot(on_face[:, 0] - place[0], on_face[:, 1] - place[1]))]


def _words(state: State, magnified: Magnified) -> str:
    """The instant and the factors."""
    scale = readable(state.header.units.get("time", ""), state.time)
    words = [f"t = {state.time * scale.factor:.3g} {scale.unit}".rstrip()]
    if magnified.factor != 1.0:
        words.append(f"displacement × {magnified.factor:g}")
    if magnified.thickness != 1.0:
        words.append(f"thickness × {magnified.thickness:g}")
    return "   ".join(words)
