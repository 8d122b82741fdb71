"""Commands of plydyn-post about damage and delamination."""

from __future__ import annotations

from typing import Annotated

import typer

from plydyn_post.commands import (
    Folder,
    Job,
    Jobs,
    Limits,
    Mirror,
    Output,
    Time,
    Whole,
    app,
    beside,
    note,
    progress,
    tell,
    tell_of,
    tells_errors,
)
from plydyn_post.errors import ResultsError
from plydyn_post.ply_fields import MECHANISMS
from plydyn_post.results import open_results

Mechanisms = Annotated[
    list[str] | None,
    typer.Option("--show", help=f"One of {', '.join(MECHANISMS)}; may be given again."),
]

Within = Annotated[
    str | None,
    typer.Option(
        help="Count areas within this radius around the impact only, or in a box x1,x2,y1,y2."
    ),
]


@app.command()
@tells_errors
def cscan(
    job: Job,
    output: Output = None,
    time: Time = None,
    whole: Whole = False,
    within: Within = None,
    mirror: Mirror = "auto",
) -> None:
    """C-scan: delaminated interfaces over each other, coloured by depth, with areas."""
    from plydyn_post.cscan import draw_cscan
    from plydyn_post.region import region_of

    found = open_results(job, mirror)
    region = region_of(within) if within else None
    path = output or beside(found, "cscan.png")
    draw_cscan(found, path, time, whole, region)
    tell_of(path, found)


@app.command()
@tells_errors
def ensemble(jobs: Jobs, output: Folder = None) -> None:
    """Mean and range of the force, numbers with scatter, probability of delamination."""
    from plydyn_post.ensemble import (
        draw_force_band,
        draw_probability,
        read_scans,
        spreads,
        write_spreads,
    )
    from plydyn_post.numbers import compare

    found = [open_results(job) for job in jobs]
    if len(found) < 2:
        raise ResultsError("an ensemble has two jobs or more")
    folder, scans = output or beside(found[0], "ensemble"), read_scans(found)
    unit = scans[0].areas.unit if scans else ""
    areas = [scan.areas.projected for scan in scans]
    comparison = compare(found)
    made = [
        write_spreads(spreads(comparison, areas, unit), folder / "numbers.csv"),
        draw_force_band(found, folder / "force.png"),
    ]
    if scans:
        made.append(draw_probability(scans, folder / "probability.png"))
    note(comparison.notes)
    for path in made:
        tell(path)


@app.command()
@tells_errors
def delamination(
    job: Job,
    output: Output = None,
    time: Time = None,
    whole: Whole = False,
    mirror: Mirror = "auto",
    over_time: Annotated[
        bool, typer.Option("--over-time", help="Draw areas over time, not a map.")
    ] = False,
) -> None:
    """Fracture energy spent in every interface, a panel each, or areas over time."""
    from plydyn_post.delamination import draw_delamination
    from plydyn_post.dissipation import draw_areas

    found = open_results(job, mirror)
    path = output or beside(found, "areas.png" if over_time else "delamination.png")
    if over_time:
        draw_areas(found, path)
    else:
        draw_delamination(found, path, time, whole)
    tell_of(path, found)


@app.command()
@tells_errors
def damage(
    job: Job,
    output: Output = None,
    time: Time = None,
    show: Mechanisms = None,
    whole: Whole = False,
    mirror: Mirror = "auto",
) -> None:
    """Damage of every ply in a separate panel, with a row for each mechanism."""
    from plydyn_post.ply_maps import draw_ply_maps

    found = open_results(job, mirror)
    path = output or beside(found, "damage.png")
    draw_ply_maps(found, path, time, tuple(show or ()), whole)
    tell_of(path, found)


@app.command()
@tells_errors
def section(
    job: Job,
    output: Output = None,
    time: Time = None,
    show: Annotated[str, typer.Option("--show", help="Damage to show.")] = "damage_matrix",
    angle: Annotated[
        list[float] | None, typer.Option("--angle", help="Direction of a cut, degrees from x.")
    ] = None,
    whole: Whole = False,
    mirror: Mirror = "auto",
) -> None:
    """Cross-sections through the point of impact: damage, cracks, delaminated interfaces."""
    from plydyn_post.section import draw_section

    found = open_results(job, mirror)
    path = output or beside(found, "section.png")
    draw_section(found, path, time, show, tuple(angle or (0.0, 90.0)), whole)
    tell_of(path, found)


@app.command()
@tells_errors
def dissipation(job: Job, output: Output = None) -> None:
    """Energy dissipated by each mechanism, over time."""
    from plydyn_post.dissipation import draw_dissipation

    found = open_results(job)
    path = output or beside(found, "dissipation.png")
    draw_dissipation(found, path)
    tell_of(path, found)


@app.command()
@tells_errors
def animate(
    job: Job,
    output: Output = None,
    show: Annotated[
        str | None, typer.Option("--show", help="Field to colour, as in picture.")
    ] = None,
    cut: Annotated[bool, typer.Option(help="Remove a quarter to show the inside.")] = True,
    zoom: Annotated[float, typer.Option("--zoom", help="Zoom to the impact.")] = 2.0,
    limits: Limits = None,
    rate: Annotated[float | None, typer.Option("--rate", help="Frames per second.")] = None,
    mirror: Mirror = "auto",
    plain: Annotated[bool, typer.Option("--plain", help="Draw with matplotlib, not VTK.")] = False,
) -> None:
    """The impact as a GIF or MP4 with its frames as PNG: plate, delamination and force."""
    from plydyn_post.animation import draw_animation, quantity_of
    from plydyn_post.grid import read_times
    from plydyn_post.scene import Wish

    found = open_results(job, mirror)
    wish = Wish(show or quantity_of(found), cut=cut, zoom=zoom, mesh=False, limits=limits)
    with progress(len(read_times(found.fields))) as tick:
        path = output or beside(found, "impact.gif")
        made = draw_animation(found, path, wish, plain, rate, tick)
    tell_of(made, found)
