"""Commands of study.py about finer meshes of the damage impact."""

from __future__ import annotations

from typing import Annotated

import typer

from studies import refinement, variants
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
    run_most,
    tell,
)
from studies.jobs import StudyError, find_tools, made_by
from studies.markdown import insert


@app.command()
def refine(
    output: Folder = DEFAULT / "refine",
    model: Annotated[
        str, typer.Option("--model", help="Recipe; without it the ladders of the page.")
    ] = "",
    sizes: Annotated[
        str, typer.Option("--n", help="Quads along the core, by commas; else those of the page.")
    ] = "",
    kept: Kept = False,
    into: Into = None,
    plydyn: Solver = None,
    parallel: Parallel = 1,
    overrides: Overrides = None,
    again: Again = False,
) -> None:
    """Finer and finer meshes, rings in proportion, until force, areas and energies settle."""
    ladders = {one: one.jobs(overrides or ()) for one in refinement.pick(model, sizes)}
    jobs = sorted(
        (job for ladder in ladders.values() for job in ladder), key=refinement.work, reverse=True
    )
    failed = [] if kept else run_most(find_tools(plydyn), jobs, output, parallel, again)
    shown = {
        one: found for one, jobs in ladders.items() if (found := refinement.collect(jobs, output))
    }
    if not shown:
        raise StudyError("\n".join([f"no mesh has run to its end in {output}", *failed]))
    for one, found in shown.items():
        sections = refinement.sections_of(found)
        builds = made_by(ladders[one], output)
        tell(output / f"{one.model}.md", [*sections, ("Builds", builds)])
        list_files(refinement.draw(found, output, one.model))
        if into:
            text = "\n".join([*(text for _, text in sections), builds])
            insert(into, f"{one.model} refinement", text)
    complain(failed)


@app.command("variants")
def variants_command(
    output: Folder = DEFAULT / "variants",
    kept: Kept = False,
    into: Into = None,
    plydyn: Solver = None,
    parallel: Parallel = 1,
    overrides: Overrides = None,
    again: Again = False,
) -> None:
    """Why meshes differ: whole discs, a larger core, lower strengths on some of the meshes."""
    jobs = sorted(variants.jobs_of(overrides or ()), key=refinement.work, reverse=True)
    failed = [] if kept else run_most(find_tools(plydyn), jobs, output, parallel, again)
    found = variants.collect(output)
    if not found:
        raise StudyError("\n".join([f"no variant has run to its end in {output}", *failed]))
    text = f"{variants.variants_text(found)}\n{made_by(jobs, output)}"
    tell(output / "variants.md", [("Variants", text)])
    if into:
        insert(into, "variants", text)
    complain(failed)
