"""Locally implicit schemes against central differences throughout."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from plydyn_post.results import Results
from readings import damage
from readings.differences import WINDOW, force_difference, impact_numbers, norm_share
from readings.profiles import read_component
from runner.cases import Case, Run, RunOf, StudyError, made_by
from runner.commands import Study, command
from runner.pages import (
    Column,
    Page,
    Quantity,
    Section,
    one_section,
    percent,
    tabulate,
    with_change,
)

#: Schemes: what is implicit, the largest step in ns (0 for none), share of the stable step (0 for
#: that of the recipe)
Scheme = tuple[str, float, float]
EXPLICIT: Scheme = ("explicit", 0.0, 0.9)
COLUMNS: tuple[Scheme, ...] = tuple(("implicit_thickness", step, 0.9) for step in (40.0, 80.0, 0.0))
HALF: Scheme = ("explicit", 0.0, 0.45)
PAIRS: Scheme = ("implicit_interfaces", 0.0, 0.9)

#: The elastic impact, tied and with the springs between plies of the paper's table 6, N/mm3
SPRINGS = (
    'materials.springs={kind="springs",normal=1373300.0,shear=493300.0}',
    'laminate.interfaces="springs"',
)
JOINTS = {
    "tied": ((), (EXPLICIT, *COLUMNS)),
    "springs": (SPRINGS, (EXPLICIT, PAIRS, *COLUMNS)),
}
#: Stress is written often enough for means over the window of the forces
OUTPUTS = ("outputs.field_interval=1.0", "outputs.profiles=[{at=[40.0,40.0],interval=1.0e-6}]")
#: The model whose explicit run is repeated with half of its step: what the step alone does
HALVED = "le2"

#: The damage impact on a coarse mesh, up to its peak
COARSE = ("mesh.n=4", "mesh.rings=3", "control.end_time=1.6e-3", "outputs.field_interval=1.0")
DAMAGED = (HALF, EXPLICIT, ("implicit_interfaces", 20.0, 0.9), PAIRS, *COLUMNS)


@dataclass(frozen=True)
class SchemeCase(Case):
    """A model with one scheme."""

    of: str = ""  # name of the model

    @property
    def is_explicit(self) -> bool:
        """Whether it is what the others of its model are compared with."""
        return self.label == EXPLICIT[0]


def case_of(of: str, recipe: str, common: tuple[str, ...], scheme: Scheme) -> SchemeCase:
    """A model with a scheme, and with values replaced."""
    implicit, step, share = scheme
    words = implicit.replace("_", " ") + (f", {step:.0f} ns" if step else "")
    words += ", half step" if share == HALF[2] else ""
    control: tuple[str, ...] = (
        f'control.scheme="{implicit}"',
        f"control.largest_step={step * 1e-9}",
    )
    control += (f"control.step_factor={share}",) if share else ()
    name = f"{of}_{words.replace(', ', '_').replace(' ', '_')}"
    return SchemeCase(name, recipe, words, control, common, of=of)


@command()
def schemes(
    models: Annotated[
        str, typer.Option(help="Elastic models, by commas; empty for none.")
    ] = "le1,le2,le3",
) -> Study:
    """Locally implicit schemes against the explicit one, elastic and with damage."""
    elastic = elastic_cases([name for name in models.split(",") if name])
    damaged = [case_of("coarse", "damage_impact/q192_le2", COARSE, one) for one in DAMAGED]

    def report(runs: list[RunOf[SchemeCase]], _folder: Path) -> list[Page]:
        own, others = runs[: len(damaged)], runs[len(damaged) :]
        found = [damage.read_impact(run) for run in own]
        parts = {"Damage schemes": (tabulate(DAMAGE_COLUMNS, found), own)}
        if others:
            parts["Elastic schemes"] = (_elastic_text(others), others)
        sections = [
            Section(heading, f"{text}\n{made_by(some)}", heading.lower())
            for heading, (text, some) in parts.items()
        ]
        return [Page("schemes", sections)]

    return Study([*damaged, *elastic], report, needs_all=True)


def elastic_cases(models: Sequence[str]) -> list[SchemeCase]:
    """The elastic impacts, each model and joint with its explicit run first."""
    return [
        case_of(f"{model}_{joint}", f"elastic_impact/{model}", (*OUTPUTS, *springs), scheme)
        for joint, (springs, wanted) in JOINTS.items()
        for model in models
        for scheme in (*wanted, *([HALF] if model == HALVED else []))
    ]


def largest_step(run: Run) -> float:
    """Largest step that was taken, s."""
    found = re.search(r"largest step taken\s+(\S+)", run.listing)
    return float(found[1]) if found else 0.0


STEP = Quantity("step [ns]", lambda run: largest_step(run) / 1e-9, ".3g")
STEPS = Quantity("steps", lambda run: run.effort.steps, ",")


def of_run(column: Quantity) -> Quantity:
    """A column of a run as one of an impact."""
    return Quantity(column.heading, lambda one: column.cell(one.run))


DAMAGE_COLUMNS = (
    Quantity("scheme", lambda one: one.label),
    of_run(STEP),
    of_run(STEPS),
    *(damage.PEAK, damage.PROJECTED, damage.TOTAL),
    Quantity(damage.DELAMINATION.heading, damage.DELAMINATION.value, ".3f"),
    Quantity(damage.DISSIPATED_SUM.heading, damage.DISSIPATED_ALL.value, ".3f"),
)


def _elastic_text(runs: Sequence[RunOf[SchemeCase]]) -> str:
    """How far each scheme is from the explicit one: force, deflection, stress between plies."""
    base = {run.case.of: run for run in runs if run.case.is_explicit}
    columns: tuple[Column | Quantity, ...] = (
        Quantity("model", lambda run: run.case.of.replace("_", ", ").replace("le", "LE")),
        Quantity("scheme", lambda run: run.case.label),
        STEP,
        STEPS,
        _difference("force", lambda one, other: percent(force_difference(one, other))),
        _difference("deflection", _deflections),
        *(_stress_column(component) for component in ("syz", "szz")),
    )
    return tabulate(columns, runs, lambda run: base[run.case.of])


def _difference(heading: str, text: Callable[[Results, Results], str]) -> Column:
    """A column that is empty for what others are compared with."""
    return Column(
        heading, lambda one, other: "" if one is other else text(one.results, other.results)
    )


def _deflections(ours: Results, theirs: Results) -> str:
    deepest = [impact_numbers(one).largest_displacement for one in (ours, theirs)]
    return f"{100.0 * (deepest[0] / deepest[1] - 1.0):+.2f} %"


def _stress_column(component: str) -> Column:
    """Difference of means over time, through the thickness and the run, as a share of the other."""

    def text(ours: Results, theirs: Results) -> str:
        means = [_means(one, component) for one in (ours, theirs)]
        rows = min(map(len, means))
        return percent(norm_share(means[0][:rows] - means[1][:rows], means[1][:rows]))

    return _difference(f"mean `{component}`", text)


def _means(results: Results, component: str) -> np.ndarray:
    """Stress at the places of a profile, means over the window of forces; (times, places)."""
    found = read_component(results, 1, component)
    width = max(1, round(WINDOW / float(np.median(np.diff(found.times)))))
    sums = np.cumsum(found.values, axis=0)
    return (sums[width:] - sums[:-width]) / width


@command()
def implicit(
    models: Annotated[
        str, typer.Option(help="Recipes, separated by commas.")
    ] = "q192_le1,q192_le2",
    wanted: Annotated[
        str, typer.Option("--schemes", help="Schemes, each with its largest step in ns if wanted.")
    ] = "implicit_interfaces,implicit_thickness:50,implicit_thickness",
) -> Study:
    """Force, areas, energies and time with implicit interfaces beside central differences."""

    def text(runs: list[Run]) -> str:
        return f"{implicit_text([damage.read_impact(run) for run in runs])}\n{made_by(runs)}"

    return Study(
        implicit_cases(models, wanted), one_section("Implicit interfaces", text, "implicit")
    )


def implicit_cases(models: str, wanted: str) -> list[SchemeCase]:
    """Recipes with central differences and with some schemes, both named between commas."""
    words = [one for one in (EXPLICIT[0], *wanted.split(",")) if one]
    return [
        case_of(model, f"damage_impact/{model}", (), _scheme(one))
        for model in models.split(",")
        for one in words
    ]


def _scheme(words: str) -> Scheme:
    """A scheme from its name and its largest step in ns, between which is a colon."""
    name, _, step = words.partition(":")
    try:
        return name, float(step or 0.0), 0.0
    except ValueError as error:
        raise StudyError(f"{words} is not a scheme like implicit_interfaces:20") from error


IMPLICIT_COLUMNS = (
    Quantity("model", lambda one: one.run.case.of),
    Quantity("scheme", lambda one: one.label.replace("explicit", "central differences")),
    of_run(STEP),
    of_run(STEPS),
    Quantity("processor time [s]", lambda one: one.run.effort.processor, ".0f"),
    *with_change(damage.PEAK, damage.PROJECTED, damage.TOTAL),
    *damage.DISSIPATED,
    *with_change(damage.DISSIPATED_SUM),
)


def implicit_text(found: Sequence[damage.Impact]) -> str:
    """The table; each model is compared with its run with central differences."""
    cases = [one.run.case for one in found]
    base = {case.of: one for case, one in zip(cases, found, strict=True) if case.is_explicit}
    for case in cases:
        if case.of not in base:
            raise StudyError(f"{case.of} has not run with central differences")
    return tabulate(IMPLICIT_COLUMNS, found, lambda one: base[one.run.case.of])
