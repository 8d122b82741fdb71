"""Commands of study.py about the damage impact."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer
from plydyn_post.cscan import draw_cscan, draw_delamination
from plydyn_post.ply_maps import draw_ply_maps
from plydyn_post.results import Results, open_results
from plydyn_post.section import draw_section

from studies import choices as open_choices
from studies import damage_times, implicit, runs
from studies.choices import BASE
from studies.commands import (
    DEFAULT,
    Again,
    Folder,
    Into,
    Kept,
    Overrides,
    Parallel,
    Solver,
    app,
    complain,
    list_files,
    run_all,
    run_most,
    tell,
)
from studies.damage import MODELS, Model, answers_text, areas_text, model_of, read_answer
from studies.damage_figures import draw_forces
from studies.jobs import ROOT, StudyError, builds, find_tools, kept_effort, made_by
from studies.markdown import insert

Tests = Annotated[
    list[Path] | None, typer.Option("--test", help="CSV of a test to lay over the forces.")
]


@app.command()
def figure11(
    output: Folder = DEFAULT / "damage",
    into: Into = None,
    plydyn: Solver = None,
    parallel: Parallel = 1,
    overrides: Overrides = None,
    tests: Tests = None,
    again: Again = False,
) -> None:
    """Meshes of the damage impact: 132, 192 and 260 Q9 with LE2 over each other."""
    models = [model for model in MODELS if model.order == 2]
    _compare(models, "figure11", (output, into, plydyn, parallel, overrides, again), tests)


@app.command()
def figure12(
    output: Folder = DEFAULT / "damage",
    into: Into = None,
    plydyn: Solver = None,
    parallel: Parallel = 1,
    overrides: Overrides = None,
    tests: Tests = None,
    again: Again = False,
) -> None:
    """Orders of the damage impact: 192 Q9 with LE1, LE2 and LE3 over each other."""
    models = [model for model in MODELS if model.quads == 192]
    _compare(models, "figure12", (output, into, plydyn, parallel, overrides, again), tests)


@app.command()
def figure13(
    output: Folder = DEFAULT / "damage",
    plydyn: Solver = None,
    overrides: Overrides = None,
    again: Again = False,
) -> None:
    """Damage of the plies after the impact, 192 Q9 with LE3, and a cut."""
    results = _finest(output, plydyn, overrides, again)
    draw_ply_maps(results, output / "figure13.png")
    draw_section(results, output / "figure13_section.png")
    list_files([output / "figure13.png", output / "figure13_section.png"])


@app.command()
def figure14(
    output: Folder = DEFAULT / "damage",
    plydyn: Solver = None,
    overrides: Overrides = None,
    again: Again = False,
) -> None:
    """Delamination of each interface after the impact, 192 Q9 with LE3, and a scan of all."""
    results = _finest(output, plydyn, overrides, again)
    draw_delamination(results, output / "figure14.png")
    draw_cscan(results, output / "figure14_scan.png")
    list_files([output / "figure14.png", output / "figure14_scan.png"])


def _finest(output: Path, plydyn: Path | None, overrides: list[str] | None, again: bool) -> Results:
    """Run the model of the paper's figures 13 and 14."""
    model = next(model for model in MODELS if (model.quads, model.order) == (192, 3))
    run_all(find_tools(plydyn), [model.job(overrides or ())], output, 1, again)
    return open_results(output / model.recipe)


_Common = tuple[Path, Path | None, Path | None, int, list[str] | None, bool]


def _compare(models: Sequence[Model], name: str, common: _Common, tests: list[Path] | None) -> None:
    """Run models, lay their forces over each other, and tell their answers."""
    output, into, plydyn, parallel, overrides, again = common
    jobs = [model.job(overrides or ()) for model in models]
    run_all(find_tools(plydyn), jobs, output, parallel, again)
    found = [(model.label, open_results(output / model.recipe)) for model in models]
    text = answers_text([(label, read_answer(results)) for label, results in found])
    text += f"\n{made_by(jobs, output)}"
    tell(output / f"{name}.md", [(name.capitalize(), text), ("Areas", areas_text(found))])
    list_files(draw_forces(found, tests or (), output, name))
    if into:
        insert(into, name, text)


@app.command("runs")
def runs_command(
    output: Folder = DEFAULT / "runs",
    kept: Kept = False,
    into: Into = None,
    plydyn: Solver = None,
    parallel: Parallel = 1,
    overrides: Overrides = None,
    again: Again = False,
) -> None:
    """All runs that the page of the damage impact tells of, and what they are held against."""
    wanted = (*runs.RUNS, runs.ELASTIC)
    jobs = [run.job(overrides or ()) for run in wanted]
    failed = [] if kept else run_most(find_tools(plydyn), jobs, output, parallel, again)
    found = runs.collect(wanted, output)
    if not found:
        raise StudyError(f"no run has come to its end in {output}")
    shown = [(run, results) for run, results in found if run is not runs.ELASTIC]
    held = [one for one in found if one[0] in (runs.ELASTIC, runs.LINEAR, runs.COARSE)]
    text = f"{runs.runs_text(shown)}\n{made_by(jobs, output)}"
    sections = [("Runs", text), ("Bounds", runs.bounds_text(held))]
    tell(output / "runs.md", sections)
    orders = [(run.words, one) for run, one in shown if run in runs.ORDERS]
    list_files(draw_forces([(run.words, one) for run, one in shown], (), output, "runs"))
    pictures = draw_forces(orders, (), output, "damage_force") if orders else []
    list_files(pictures)
    if into:
        if pictures and into.resolve().is_relative_to(ROOT):
            shutil.copy(pictures[0], runs.PICTURES)
            list_files(runs.draw_quick_start(shown))
        for heading, text in sections:
            insert(into, heading.lower(), text)
    complain(failed)


@app.command()
def table7(
    output: Folder = DEFAULT / "table7",
    models: Annotated[str, typer.Option("--models", help="Recipes, separated by commas.")] = "",
    threads: Annotated[str, typer.Option("--threads", help="Numbers of threads.")] = "1,2",
    kept: Kept = False,
    into: Into = None,
    plydyn: Solver = None,
    parallel: Annotated[
        int, typer.Option("--parallel", help="Runs on one core at a time.", min=1)
    ] = 1,
    overrides: Overrides = None,
) -> None:
    """Steps and times of the models of Table 7; wants a quiet machine. Rows that lie there stay."""
    chosen = [model_of(name) for name in models.split(",")] if models else list(MODELS)
    numbers = [int(number) for number in threads.split(",")]
    for number in () if kept else numbers:
        jobs = [damage_times.job_of(model, number, overrides or ()) for model in chosen]
        at_once = parallel if number == 1 else 1
        run_all(find_tools(plydyn), jobs, output, at_once, True, number)
    found = damage_times.collect(output, numbers)
    if not found:
        raise StudyError(f"no model has run to its end in {output}")
    jobs = [damage_times.job_of(model, number) for model in MODELS for number in numbers]
    text = damage_times.times_text(found, numbers, builds(jobs, output, lines=3))
    tell(output / "table7.md", [("Table 7", text)])
    if into:
        insert(into, "table 7", text)


@app.command("implicit")
def implicit_command(
    output: Folder = DEFAULT / "implicit",
    models: Annotated[
        str, typer.Option("--models", help="Recipes, separated by commas.")
    ] = "q192_le1,q192_le2",
    wanted: Annotated[
        str, typer.Option("--schemes", help="Schemes, each with its largest step in ns if wanted.")
    ] = implicit.SCHEMES,
    kept: Kept = False,
    into: Into = None,
    plydyn: Solver = None,
    parallel: Parallel = 1,
    overrides: Overrides = None,
    again: Again = False,
) -> None:
    """Force, areas, energies and time with implicit interfaces beside central differences."""
    cases = implicit.cases_of(models, wanted, overrides or ())
    jobs = [case.job for case in cases]
    failed = [] if kept else run_most(find_tools(plydyn), jobs, output, parallel, again)
    found = implicit.collect(cases, output)
    if not found:
        raise StudyError(f"no model has run to its end in {output}")
    text = f"{implicit.implicit_text(found, output)}\n{made_by(jobs, output)}"
    tell(output / "implicit.md", [("Implicit interfaces", text)])
    if into:
        insert(into, "implicit", text)
    complain(failed)


@app.command()
def choices(
    output: Folder = DEFAULT / "choices",
    model: Annotated[
        str, typer.Option("--model", help="Recipe that the others differ from.")
    ] = open_choices.MODEL,
    only: Annotated[str, typer.Option("--only", help="Names of choices, by commas.")] = "",
    without: Annotated[str, typer.Option("--without", help="Names of those not to make.")] = "",
    kept: Kept = False,
    into: Into = None,
    plydyn: Solver = None,
    parallel: Parallel = 1,
    overrides: Overrides = None,
    again: Again = False,
) -> None:
    """What each choice that the paper leaves open does to the force and to the areas."""
    replaced = (*open_choices.SHORT, *(overrides or ()))
    wanted = open_choices.pick(only, model, replaced, without)
    jobs = [open_choices.job_of(choice, model, replaced) for choice in wanted]
    failed = [] if kept else run_most(find_tools(plydyn), jobs, output, parallel, again)
    found = [
        (choice, open_results(output / job.name))
        for choice, job in zip(wanted, jobs, strict=True)
        if kept_effort(job, output)
    ]
    if BASE not in [choice for choice, _ in found]:
        raise StudyError("\n".join([f"{model} has not run to its end in {output}", *failed]))
    text = open_choices.choices_text([(choice, read_answer(one)) for choice, one in found])
    text += f"\n{made_by(jobs, output)}"
    areas = areas_text([(choice.name, one) for choice, one in found])
    tell(output / "choices.md", [("Open choices", text), ("Areas", areas)])
    if into:
        insert(into, "choices", text)
    complain(failed)
