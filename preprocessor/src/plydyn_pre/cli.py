"""The command plydyn-pre."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Annotated, NoReturn

import typer
from rich.progress import track
from rich.text import Text

from plydyn_pre.command_line import Overrides, Recipe, err, note, out, tell
from plydyn_pre.counts import count
from plydyn_pre.deck import deck_text, write_deck, write_stages
from plydyn_pre.deck.crushing import early_crushing
from plydyn_pre.deck.shearing import early_shear
from plydyn_pre.ensemble import realisations
from plydyn_pre.errors import OutputError, PreError
from plydyn_pre.files import is_folder
from plydyn_pre.list_commands import keys, layup, materials, models, strengths
from plydyn_pre.mesh import Mesh, Quality, make_mesh, quality
from plydyn_pre.mesh_picture import picture_lines
from plydyn_pre.overrides import title_with
from plydyn_pre.recipe import blaming, example_recipe, is_given, load_recipe, templates
from plydyn_pre.runs.chain import make_report, print_line, without_blow
from plydyn_pre.runs.chain import run as run_study
from plydyn_pre.series_command import study as study_command
from plydyn_pre.study import Study, doubts, unused
from plydyn_pre.study_text import contact_lines, early_ends, set_lines, told
from plydyn_pre.translate_command import foreign, translate
from plydyn_pre.version import VERSION

#: Exit codes of errors in what the user wrote and of files that cannot be written, as the solver's
INPUT_ERROR, OUTPUT_ERROR = 2, 5
#: A quad whose least Jacobian is below this share of its mean is nearly folded
NEARLY_FOLDED = 0.1

app = typer.Typer(
    no_args_is_help=True,
    help="Make plydyn decks from recipes of impacts on laminates.",
)


def main() -> None:
    """Run the command; errors in what the user wrote are told in words."""
    try:
        app()
    except PreError as error:
        _fail(str(error), OUTPUT_ERROR if isinstance(error, OutputError) else INPUT_ERROR)
    except MemoryError:
        _fail("the machine has too little memory for this mesh; take fewer quads")


def _fail(words: str, code: int = INPUT_ERROR) -> NoReturn:
    """Tell an error and end."""
    err.print(Text("error: ", style="bold red") + Text(words), soft_wrap=True)
    sys.exit(code)


@app.callback(invoke_without_command=True)
def common(
    version: Annotated[bool, typer.Option("--version", help="Print the version.")] = False,
) -> None:
    """Options of all commands."""
    if version:
        out.print(f"plydyn-pre {VERSION}")
        raise typer.Exit


@app.command()
def deck(
    recipe: Recipe,
    output: Annotated[
        str | None,
        typer.Option(
            "-o",
            "--output",
            help="The deck, or a folder that ends in /. Default: the name of the recipe.",
        ),
    ] = None,
    overrides: Overrides = None,
) -> None:
    """Make a deck from a recipe."""
    study, mesh = _study_and_mesh(recipe, overrides)
    path = _deck_path(recipe, output)
    with blaming(recipe):
        write_deck(_with_progress(deck_text(study, mesh), mesh), path)
        stages = write_stages(study, mesh, path)
        _tell_counts(study, mesh)
    _note_folded(recipe, quality(mesh))
    tell("deck", path)
    for stage in stages:
        tell("stage", stage)


@app.command()
def run(
    recipe: Recipe,
    folder: Annotated[Path, typer.Argument(help="Folder of the decks and results.")] = Path(
        "results"
    ),
    overrides: Overrides = None,
    threads: Annotated[int, typer.Option(min=1, help="Threads of the solver.")] = 1,
    pristine: Annotated[
        str | None,
        typer.Option(metavar="JOB", help="Results of the pristine plate, for the report."),
    ] = None,
    with_pristine: Annotated[
        bool,
        typer.Option("--with-pristine", help="Run it without its impact, too, in FOLDER/pristine."),
    ] = False,
    plain: Annotated[bool, typer.Option("--plain", help="Draw by matplotlib, not VTK.")] = False,
    report: Annotated[bool, typer.Option(help="Make the report, by plydyn-post.")] = True,
) -> None:
    """Make the decks of a recipe, run it and its stages, and make the report.

    What has run to its end is not run again, and what was broken off goes on. A signal or Ctrl-C
    stops the run with a restart file. The exit code is that of the solver.
    """
    if pristine and with_pristine:
        raise PreError("--pristine names results, --with-pristine makes them: give one of the two")
    study, grid = _study_and_mesh(recipe, overrides)
    chains = [(study, folder)]
    if with_pristine:
        chains.append((without_blow(study), folder / "pristine"))
    jobs = []
    with blaming(recipe):
        for one, where in chains:
            job = run_study(one, where, recipe=recipe, mesh=grid, threads=threads, told=print_line)
            if job.code:
                raise typer.Exit(job.code)
            jobs.append(job)
    job = jobs[0]
    if with_pristine:
        pristine = str(jobs[1].results[-1])
    if report:
        options = [
            *(("--pristine", pristine) if pristine else ()),
            *(("--plain",) if plain else ()),
        ]
        tell("report", make_report(job, options))


app.command(name="study")(study_command)


@app.command()
def ensemble(
    recipe: Recipe,
    count: Annotated[int, typer.Option("-n", "--count", min=2, help="Number of decks.")] = 5,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the first one.")] = 1,
    output: Annotated[
        str | None, typer.Option("-o", "--output", help="Folder, ending in /.")
    ] = None,
    overrides: Overrides = None,
) -> None:
    """Make several decks of a recipe with different random strengths of interfaces."""
    study, grid = _study_and_mesh(recipe, overrides)
    first = _deck_path(recipe, output)
    with blaming(recipe):
        for number, one in realisations(study, count, seed):
            path = first.with_name(f"{first.stem}_{number}.k")
            write_deck(_with_progress(deck_text(one, grid), grid), path)
            tell("deck", path)


@app.command()
def mesh(
    recipe: Recipe,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="A picture of the mesh, FILE.svg.")
    ] = None,
    overrides: Overrides = None,
) -> None:
    """Make the mesh of a recipe, and print its size, quality and sets."""
    if output is not None and output.suffix != ".svg":
        raise PreError(f"{output} is no name of a picture; {output.stem}.svg would be")
    study, grid = _study_and_mesh(recipe, overrides)
    with blaming(recipe):
        _tell_counts(study, grid)
    measures = quality(grid)
    unit = study.units.length
    tell("area", f"{measures.area:.9g} {unit}2")
    tell("sides of quads", f"{measures.shortest_side:.4g} to {measures.longest_side:.4g} {unit}")
    tell("least Jacobian", f"{measures.smallest_jacobian:.3f} x mean, quad {measures.worst_quad}")
    _note_folded(recipe, measures)
    for kind, sets in (("parts", grid.parts), ("node sets", grid.node_sets)):
        tell(kind, ", ".join(f"{name} ({len(members)})" for name, members in sets.items()))
    with blaming(recipe):
        for line in set_lines(study, grid):
            tell("set", line)
        if output is not None:
            _make_folder(output)
            write_deck(picture_lines(study, grid), output)
            tell("picture", output)


for _command in (layup, strengths, materials, models, keys, translate, foreign):
    app.command()(_command)


@app.command()
def new(
    path: Annotated[Path, typer.Argument(help="The recipe to write.")] = Path("recipe.toml"),
    template: Annotated[str, typer.Option(help=f"One of {', '.join(templates())}.")] = "impact",
) -> None:
    """Write a short recipe of an impact, or that of another template.

    The template impact-all has a comment on every key, the others are those of standard tests.
    """
    text = example_recipe(template)
    try:
        with path.open("x", encoding="utf-8") as stream:
            stream.write(text)
    except FileExistsError:
        raise PreError(f"{path} is there already; give another name") from None
    except OSError as error:
        raise OutputError(f"{path} cannot be written: {error.strerror}") from error
    tell("recipe", path)


def _deck_path(recipe: Path, output: str | None) -> Path:
    """Where the deck goes: its name, or that of the recipe in a folder; folders are made."""
    name = recipe.with_suffix(".k").name
    path = Path(output or name)
    in_folder = output is not None and (output.endswith(("/", os.sep)) or is_folder(path))
    path = path / name if in_folder else path
    _make_folder(path)
    return path


def _make_folder(path: Path) -> None:
    """Make the folder of a file."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{path.parent} cannot be made: {error.strerror}") from error


def _with_progress(pieces: Iterator[str], mesh: Mesh) -> Iterator[str]:
    """The pieces of a deck, with a bar on the screen where there is one."""
    lines = len(mesh.nodes) + len(mesh.quads)
    return iter(
        track(
            pieces,
            description="writing",
            total=lines // 1000,
            console=err,
            transient=True,
            disable=not err.is_terminal,
        )
    )


@contextmanager
def _waiting(words: str) -> Iterator[None]:
    """Show that something takes its time, where there is a screen."""
    if err.is_terminal:
        with err.status(words):
            yield
    else:
        yield


def _study_and_mesh(recipe: Path, overrides: list[str] | None) -> tuple[Study, Mesh]:
    """Read a recipe and make its mesh."""
    study = load_recipe(recipe, overrides or [])
    study = replace(study, title=title_with(study.title, overrides or []))
    for key in unused(study):
        if is_given(recipe, overrides or [], key):
            note(f"{recipe}: {key} is never used")
    with _waiting("meshing"):
        mesh = make_mesh(study.mesh)
    with blaming(recipe):
        found = [*doubts(study, mesh), *early_ends(study, mesh)]
        found += [*early_crushing(study, mesh), *early_shear(study, mesh)]
    for words in found:
        note(f"{recipe}: {words}")
    return study, mesh


def _tell_counts(study: Study, mesh: Mesh) -> None:
    """Print how large the model is."""
    counts = count(study, mesh)
    if study.bricks is None:
        tell("quads", f"{counts.quads} of {mesh.quads.shape[1]} nodes")
    else:
        tell("bricks", f"{counts.quads:,} of 8 nodes")
    tell("nodes", f"{counts.nodes}")
    tell("thickness levels", f"{counts.levels}")
    doubled = " and those of nodes that cracks double" if study.cracks else ""
    tell("DOF", f"{counts.freedoms:,}{doubled}")
    for what, words in (*told(study), *contact_lines(study, mesh)):
        tell(what, words)


def _note_folded(recipe: Path, measures: Quality) -> None:
    """Tell of the worst quad where it is nearly folded: it sets the stable step, or stops a run."""
    share = measures.smallest_jacobian
    if share < NEARLY_FOLDED:
        words = f"quad {measures.worst_quad} is nearly folded: its least Jacobian is {share:.3f}"
        note(f"{recipe}: {words} of its mean")
