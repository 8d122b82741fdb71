"""The paper's figures 11 to 14: forces of the damage impact, damaged plies and interfaces."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated

import typer

from plydyn_post.cscan import draw_cscan
from plydyn_post.delamination import draw_delamination
from plydyn_post.ply_maps import draw_ply_maps
from plydyn_post.results import Results
from plydyn_post.section import draw_section
from readings import damage
from runner.cases import Run, made_by
from runner.commands import Study, command
from runner.pages import Page, Section, draw_all

Tests = Annotated[
    list[Path] | None, typer.Option("--test", help="CSV of a test to lay over the forces.")
]


@command(folder="damage")
def figure11(tests: Tests = None) -> Study:
    """Meshes of the damage impact: 132, 192 and 260 Q9 with LE2 over each other."""
    return _forces("figure11", [model for model in damage.MODELS if model.order == 2], tests)


@command(folder="damage")
def figure12(tests: Tests = None) -> Study:
    """Orders of the damage impact: 192 Q9 with LE1, LE2 and LE3 over each other."""
    return _forces("figure12", [model for model in damage.MODELS if model.quads == 192], tests)


@command(folder="damage")
def figure13() -> Study:
    """Damage of the plies after the impact, 192 Q9 with LE3, and a cut."""
    return _maps({"figure13.png": draw_ply_maps, "figure13_section.png": draw_section})


@command(folder="damage")
def figure14() -> Study:
    """Delamination of each interface after the impact, 192 Q9 with LE3, and a scan of all."""
    return _maps({"figure14.png": draw_delamination, "figure14_scan.png": draw_cscan})


def _forces(name: str, models: Sequence[damage.DamageCase], tests: Sequence[Path] | None) -> Study:
    """Forces of models over each other, and what the impacts come to."""

    def report(runs: list[Run], folder: Path) -> list[Page]:
        found = [damage.read_impact(run) for run in runs]
        text = f"{damage.impacts_text(found)}\n{made_by(runs)}"
        sections = [
            Section(name.capitalize(), text, name),
            Section("Areas", damage.areas_text(found)),
        ]
        return [Page(name, sections, damage.draw_forces(runs, folder / f"{name}.png", tests or ()))]

    return Study(models, report, needs_all=True)


def _maps(drawings: dict[str, Callable[[Results, Path], object]]) -> Study:
    """Figures of the model with the most unknowns on 192 Q9."""

    def report(runs: list[Run], folder: Path) -> list[Page]:
        return [Page("maps", figures=[*draw_all(drawings, runs[0].results, folder).values()])]

    models = [model for model in damage.MODELS if (model.quads, model.order) == (192, 3)]
    return Study(models, report, needs_all=True)
