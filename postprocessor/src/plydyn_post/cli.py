"""The command plydyn-post."""

from __future__ import annotations

from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from plydyn_post import compression_commands, damage_commands, paraview_macro
from plydyn_post.commands import (
    Folder,
    Impactor,
    Job,
    Jobs,
    Limits,
    Measured,
    Mirror,
    Output,
    Plain,
    Time,
    Window,
    app,
    beside,
    console,
    note,
    print_table,
    progress,
    tell,
    tell_of,
    tells_errors,
)
from plydyn_post.results import notes_of_runs, open_results

if TYPE_CHECKING:
    from plydyn_post.numbers import Comparison

__all__ = ["app", "compression_commands", "damage_commands", "main"]


@app.callback(invoke_without_command=True)
def common(
    version_: Annotated[bool, typer.Option("--version", help="Print the version.")] = False,
) -> None:
    """Draw curves, profiles and pictures of plydyn results."""
    if version_:
        console.print(f"plydyn-post {version('plydyn-post')}", markup=False)
        raise typer.Exit


@app.command()
@tells_errors
def study(
    folder: Annotated[Path, typer.Argument(help="Folder that plydyn-pre study wrote.")],
    show: Annotated[
        str, typer.Option("--show", help="Number to draw, such as 'absorbed energy'.")
    ] = "peak force",
) -> None:
    """One table and one figure of the cases of a parameter study that have ended."""
    from plydyn_post.series import draw_series, read_series, write_series

    table = read_series(folder)
    path = folder / f"{show.replace(' ', '_').replace('/', '_')}.png"
    tell(write_series(table, folder / "table.csv"))
    draw_series(table, show, path)
    tell(path)
    note(table.notes)


@app.command()
@tells_errors
def report(
    jobs: Jobs,
    output: Folder = None,
    measured: Measured = None,
    mean: Window = None,
    time: Time = None,
    mirror: Mirror = "auto",
    plain: Plain = False,
) -> None:
    """Draw all figures, and write the numbers as a CSV and a page report.html."""
    from plydyn_post.plan import Plan
    from plydyn_post.report import make_report, tasks_of

    found = tuple(open_results(job, mirror) for job in jobs)
    folder = output or beside(found[0], "report")
    plan = Plan(found, folder, tuple(measured or ()), mean, time, plain)
    tasks = tasks_of(plan)
    with progress(len(tasks)) as tick:
        made = make_report(plan, tasks, tick)
    if made.comparison:
        _print_numbers(made.comparison)
    note(made.notes)
    for path in (*made.files, made.page):
        tell(path)


@app.command()
@tells_errors
def force(
    jobs: Jobs,
    output: Output = None,
    measured: Measured = None,
    mean: Window = None,
    over: Annotated[str, typer.Option("--over", help="Draw over time or displacement.")] = "time",
    impactor: Impactor = None,
) -> None:
    """Contact force over time or displacement."""
    _draw_history(jobs, (over, "force"), output, measured, mean, impactor)


@app.command()
@tells_errors
def velocity(
    jobs: Jobs, output: Output = None, measured: Measured = None, impactor: Impactor = None
) -> None:
    """Velocity of the impactor over time."""
    _draw_history(jobs, ("time", "velocity"), output, measured, None, impactor)


def _draw_history(
    jobs: list[str],
    columns: tuple[str, str],
    output: Path | None,
    measured: list[Path] | None,
    mean: float | None,
    impactor: int | None,
) -> None:
    from plydyn_post.figures import curves_of, draw_history

    found = [open_results(job) for job in jobs]
    curves = curves_of(found, measured or (), impactor)
    name = columns[1] if columns[0] == "time" else f"{columns[1]}_{columns[0]}"
    path = output or beside(found[0], f"{name}.png")
    draw_history(curves, *columns, path, mean)
    tell_of(path, *found)


@app.command()
@tells_errors
def dent(job: Job, output: Output = None, impactor: Impactor = None) -> None:
    """Depth of the dent in both faces, and indentation by the impactor."""
    from plydyn_post.dent import draw_dent

    found = open_results(job)
    path = output or beside(found, "dent.png")
    draw_dent(found, path, impactor)
    tell_of(path, found)


@app.command()
@tells_errors
def energy(
    job: Job,
    output: Output = None,
    stacked: Annotated[bool, typer.Option("--stacked", help="Stack the energies.")] = False,
) -> None:
    """Energies over time, and the error of the energy balance."""
    from plydyn_post.figures import draw_energy

    found = open_results(job)
    path = output or beside(found, "energy.png")
    draw_energy(found, path, stacked)
    tell_of(path, found)


@app.command()
@tells_errors
def profile(
    jobs: Jobs,
    output: Output = None,
    number: Annotated[int | None, typer.Option("--id", help="Number of the profile.")] = None,
    component: Annotated[
        list[str] | None, typer.Option("--component", help="Such as syz; may be given again.")
    ] = None,
    time: Time = None,
) -> None:
    """Stress through the thickness at a point, at the peak force or at a time."""
    from plydyn_post.profile import IN_PLANE, INTERLAMINAR, draw_profiles, read_profiles

    found = [open_results(job) for job in jobs]
    profiles = read_profiles(found, number, time)
    groups = (
        {"": component} if component else {"_in_plane": IN_PLANE, "_interlaminar": INTERLAMINAR}
    )
    note(notes_of_runs(found))
    for name, components in groups.items():
        path = output or beside(found[0], "profile.png")
        path = path.with_name(f"{path.stem}{name}{path.suffix or '.png'}")
        draw_profiles(profiles, components, path)
        tell(path)


@app.command()
@tells_errors
def picture(
    job: Job,
    output: Output = None,
    show: Annotated[
        str, typer.Option("--show", help="Field to colour: uz, sxx, s13, plastic_strain, ...")
    ] = "uz",
    time: Time = None,
    factor: Annotated[
        float | None, typer.Option("--factor", help="Scale factor of displacements.")
    ] = None,
    thickness: Annotated[
        float | None, typer.Option("--thickness", help="Scale factor of the thickness.")
    ] = None,
    cut: Annotated[
        bool, typer.Option("--cut", help="Remove a quarter to show the inside.")
    ] = False,
    mirror: Mirror = "auto",
    zoom: Annotated[float, typer.Option("--zoom", help="Zoom to the impact.")] = 1.0,
    mesh: Annotated[bool, typer.Option(help="Draw lines between elements.")] = True,
    limits: Limits = None,
    view: Annotated[
        tuple[float, float] | None, typer.Option("--view", help="Azimuth and elevation, degrees.")
    ] = None,
    plain: Annotated[bool, typer.Option("--plain", help="Draw with matplotlib, not VTK.")] = False,
) -> None:
    """The deformed plate at a time, by default that of the largest deflection."""
    from plydyn_post.camera import AZIMUTH, ELEVATION
    from plydyn_post.picture import draw_picture
    from plydyn_post.scene import Wish

    found = open_results(job, mirror)
    wish = Wish(show, time, factor, thickness, cut, zoom, mesh, limits)
    path = output or beside(found, f"{show}_cut.png" if cut else f"{show}.png")
    draw_picture(found, path, wish, plain, view or (AZIMUTH, ELEVATION))
    tell_of(path, found)


@app.command()
@tells_errors
def numbers(
    jobs: Jobs,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="CSV to write.")] = None,
    as_text: Annotated[bool, typer.Option("--json", help="Print JSON, for programs.")] = False,
) -> None:
    """Forces, duration, impulse, indentation, dent, delaminated areas, energies."""
    from plydyn_post.numbers import as_json, compare, write_numbers

    found = [open_results(job) for job in jobs]
    if output:
        for job in found:
            job.spare(output)
    comparison = compare(found)
    if as_text:
        console.print(as_json(comparison), markup=False)
    else:
        _print_numbers(comparison)
        note(comparison.notes)
    if output:
        written = write_numbers(comparison, output)
        if not as_text:
            tell(written)


@app.command()
@tells_errors
def pvd(job: Job, output: Folder = None) -> None:
    """Write states as single files with a .pvd, for ParaView 5.11 and older."""
    from plydyn_post.export import write_pvd
    from plydyn_post.grid import read_times

    found = open_results(job)
    with progress(len(read_times(found.fields))) as tick:
        path = write_pvd(found, output or beside(found, "pvd"), tick)
    tell(path)


@app.command()
@tells_errors
def paraview(
    output: Annotated[Path, typer.Option("-o", "--output", help="File to write.")] = Path(
        "plydyn_macro.py"
    ),
) -> None:
    """Write a macro for ParaView that sets up damage, delaminations and cracks of a job."""
    output.write_text(Path(paraview_macro.__file__).read_text(encoding="utf-8"), encoding="utf-8")
    tell(output)


def _print_numbers(comparison: Comparison) -> None:
    rows = [(row.name, *row.texts(), row.unit.replace(".", " ")) for row in comparison.rows]
    print_table(("", *comparison.labels, ""), rows)


def main() -> None:
    """Entry point."""
    app()
