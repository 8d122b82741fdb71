"""Figures of a job by name; their options."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from plydyn_post.camera import AZIMUTH, ELEVATION
from plydyn_post.cscan import draw_cscan
from plydyn_post.delamination import draw_delamination
from plydyn_post.dent import draw_dent
from plydyn_post.dissipation import draw_areas, draw_dissipation
from plydyn_post.errors import ResultsError
from plydyn_post.figures import curves_of, draw_energy, draw_history
from plydyn_post.fixtures import draw_fixtures
from plydyn_post.picture import draw_picture
from plydyn_post.ply_maps import draw_ply_maps
from plydyn_post.profile import INTERLAMINAR, draw_profiles, read_profiles
from plydyn_post.results import Results
from plydyn_post.scene import Wish
from plydyn_post.section import draw_section


def force(
    job: Results,
    path: Path | None = None,
    over: str = "time",
    measured: Sequence[str | Path] = (),
    mean: float | None = None,
    impactor: int | None = None,
) -> Figure:
    """Contact force over "time" or "displacement", with CSV of tests laid over.

    A noisy force has its running mean over a span of time; 0 is none.
    """
    curves = curves_of([job], [Path(one) for one in measured], impactor)
    return draw_history(curves, over, "force", path, mean)


def velocity(job: Results, path: Path | None = None, impactor: int | None = None) -> Figure:
    """Velocity of the impactor over time."""
    return draw_history(curves_of([job], (), impactor), "time", "velocity", path)


def profile(
    job: Results,
    path: Path | None = None,
    number: int | None = None,
    components: Sequence[str] = INTERLAMINAR,
    time: float | None = None,
) -> Figure:
    """Stresses through the thickness at the point of a profile."""
    return draw_profiles(read_profiles([job], number, time), components, path)


def picture(
    job: Results,
    path: Path | None = None,
    show: str = "uz",
    plain: bool = False,
    view: tuple[float, float] = (AZIMUTH, ELEVATION),
    **wish: Any,  # noqa: ANN401
) -> Figure:
    """The deformed plate coloured by a field; `wish` are the other fields of scene.Wish."""
    return draw_picture(job, path, Wish(show, **wish), plain, view)


#: Figures by name; those of damage take a time, and whole=True for the whole plate
FIGURES: Mapping[str, Callable[..., Figure]] = {
    "force": force,
    "velocity": velocity,
    "energy": draw_energy,
    "dent": draw_dent,
    "fixtures": draw_fixtures,
    "dissipation": draw_dissipation,
    "areas": draw_areas,
    "cscan": draw_cscan,
    "delamination": draw_delamination,
    "damage": draw_ply_maps,
    "section": draw_section,
    "profile": profile,
    "picture": picture,
}


def draw(name: str, job: Results, path: Path | None, options: Mapping[str, Any]) -> Figure:
    """The figure of a name."""
    if name not in FIGURES:
        raise ResultsError(f"{name!r} is no figure; right would be {', '.join(FIGURES)}")
    return FIGURES[name](job, path, **options)
