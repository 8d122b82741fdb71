"""Repeat the studies of the impacts, from a checkout after ``decks/quickstart.sh``.

    .venv/bin/python decks/study.py times --into decks/README.md
    .venv/bin/python decks/study.py profiles
    .venv/bin/python decks/study.py converge
    .venv/bin/python decks/study.py schemes --into manual/theory.md
    .venv/bin/python decks/study.py figure11
    .venv/bin/python decks/study.py figure12
    .venv/bin/python decks/study.py figure13
    .venv/bin/python decks/study.py figure14
    .venv/bin/python decks/study.py table7
    .venv/bin/python decks/study.py table2
    .venv/bin/python decks/study.py table4
    .venv/bin/python decks/study.py bimetal
    .venv/bin/python decks/study.py bimetal_ladder
    .venv/bin/python decks/study.py runs
    .venv/bin/python decks/study.py implicit
    .venv/bin/python decks/study.py choices
    .venv/bin/python decks/study.py refine
    .venv/bin/python decks/study.py variants

Decks, results, tables and figures go to ``results/study``; ``--into`` puts a table into a page,
between its two marks.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from typing import Annotated

import typer
from plydyn_post.errors import ResultsError
from plydyn_post.results import Results, open_results
from plydyn_pre.errors import PreError

from studies import (
    brick_commands,
    damage_commands,
    ladder,
    refinement_commands,
    schemes,
    stress,
    times,
)
from studies.commands import (
    DEFAULT,
    Again,
    Folder,
    Into,
    Overrides,
    Parallel,
    Solver,
    app,
    console,
    list_files,
    progress,
    run_all,
    tell,
)
from studies.jobs import ROOT, Job, StudyError, find_tools, made_by
from studies.ladder_figures import draw_ladder
from studies.markdown import insert
from studies.rungs import ORDER, OUTPUTS, open_rungs, rungs
from studies.runs import PICTURES

__all__ = ["brick_commands", "damage_commands", "main", "refinement_commands"]

FAILED = 3


@app.command("times")
def times_command(
    output: Folder = DEFAULT / "times",
    repeats: Annotated[int, typer.Option("--repeats", help="Runs of each model.", min=1)] = 3,
    core: Annotated[int, typer.Option("--core", help="Core to run on.")] = 0,
    into: Into = None,
    plydyn: Solver = None,
    overrides: Overrides = None,
) -> None:
    """Wall times of LE1, LE2, LE3 and 3LE1 on one core; wants a quiet machine."""
    tools = find_tools(plydyn)
    with progress() as bar:
        line = bar.add_task("", total=repeats * len(times.MODELS))

        def tick(name: str, turn: int, share: float) -> None:
            done = turn * len(times.MODELS) + [one[0] for one in times.MODELS].index(name) + share
            bar.update(line, completed=done, description=f"{name}, turn {turn + 1}")

        found = times.measure(tools, output, repeats, core, tuple(overrides or ()), tick)
    tell(output / "times.md", [("Times", times.times_text(found, tools.version()))])
    if into:
        insert(into, "times", times.times_text(found, tools.version()))


@app.command()
def profiles(
    output: Folder = DEFAULT / "profiles",
    into: Into = None,
    plydyn: Solver = None,
    parallel: Parallel = 1,
    overrides: Overrides = None,
    again: Again = False,
) -> None:
    """Stress through the thickness: the paper's figures 4 and 5 in numbers."""
    replaced = (*OUTPUTS, *(overrides or ()))
    jobs = [
        Job(name, ROOT / f"decks/elastic_impact/{name}.toml", replaced) for name in stress.MODELS
    ]
    run_all(find_tools(plydyn), jobs, output, parallel, again)
    found: dict[str, Results] = {job.name: open_results(output / job.name) for job in jobs}
    text = stress.stress_text(found)
    tell(output / "profiles.md", [("Profiles", text)])
    pictures = stress.draw_stress(list(found.values()), output)
    list_files(pictures)
    if into:
        if into.resolve().is_relative_to(ROOT):
            for picture in pictures:
                shutil.copy(picture, PICTURES / f"elastic_{picture.name}")
        insert(into, "profiles", text)


@app.command()
def converge(
    output: Folder = DEFAULT / "converge",
    orders: Annotated[str, typer.Option("--orders", help="Orders through a ply.")] = "1,2,3",
    into: Into = None,
    plydyn: Solver = None,
    parallel: Parallel = 1,
    overrides: Overrides = None,
    again: Again = False,
) -> None:
    """The ladder of meshes, both contact discretisations and orders; takes about an hour."""
    wanted = sorted(int(order) for order in orders.split(","))
    if ORDER not in wanted:
        raise StudyError(f"meshes are compared with order {ORDER}; --orders must name it")
    wished = rungs(wanted, overrides or ())
    run_all(find_tools(plydyn), [rung.job for rung in wished], output, parallel, again)
    found = open_rungs(wished, output)
    sections = [
        ("Numbers", ladder.numbers_text(found)),
        ("Meshes and contact", ladder.meshes_text(found)),
        ("Orders", ladder.orders_text(found, wanted)),
    ]
    tell(output / "converge.md", sections)
    list_files(draw_ladder(found, wanted, output))
    if into:
        for heading, text in sections:
            insert(into, heading.lower(), text)


@app.command("schemes")
def schemes_command(
    output: Folder = DEFAULT / "schemes",
    models: Annotated[
        str, typer.Option("--models", help="Elastic models, by commas; empty for none.")
    ] = "le1,le2,le3",
    into: Into = None,
    plydyn: Solver = None,
    parallel: Parallel = 1,
    again: Again = False,
) -> None:
    """Locally implicit schemes against the explicit one, elastic and with damage."""
    names = [name for name in models.split(",") if name]
    elastic, damaged = schemes.elastic_cases(names), schemes.damage_cases()
    jobs = [case.job for case in (*elastic, *damaged)]
    run_all(find_tools(plydyn), jobs, output, parallel, again)
    text = schemes.damage_text(damaged, output)
    by = made_by([case.job for case in damaged], output)
    sections = [("Damage schemes", f"{text}\n{by}")]
    if elastic:
        text = schemes.elastic_text(elastic, output)
        by = made_by([case.job for case in elastic], output)
        sections.append(("Elastic schemes", f"{text}\n{by}"))
    tell(output / "schemes.md", sections)
    if into:
        for heading, text in sections:
            insert(into, heading.lower(), text)


def main(command: Callable[[], None] = app) -> None:
    """Run the command; what goes wrong is told in words."""
    try:
        command()
    except (StudyError, ResultsError, PreError, OSError) as error:
        console.print(f"study: {error}", markup=False, soft_wrap=True)
        raise SystemExit(FAILED) from error


if __name__ == "__main__":
    main()
