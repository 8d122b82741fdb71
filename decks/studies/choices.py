"""What the paper leaves open of the damage impact, and other answers to each question."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import typer

from readings import damage
from runner.cases import Case, Run, StudyError, made_by
from runner.commands import Study, command
from runner.pages import Page, Quantity, Section, tabulate, with_change

PLY, BOND = "materials.hts40_9772", "materials.interface"
#: The recipe that the choices are made for, and how far: beyond the peak
MODEL, SHORT = "coarse", ("control.end_time=2.0e-3",)
_CENTRAL = ("control.scheme=explicit", "control.largest_step=0.0")


@dataclass(frozen=True)
class Choice:
    """An answer to an open question that is not the one of the recipes."""

    name: str
    question: str
    answer: str
    overrides: tuple[str, ...]


#: The recipes as they are
BASE = Choice("base", "all as in the recipes", "", ())
CHOICES = (
    Choice("linear", "kinematics", "linear strain", ("control.kinematics=linear",)),
    Choice("large", "kinematics", "total Lagrangian", ("control.kinematics=total_lagrangian",)),
    Choice("width_band", "width of the crack band", "13/18 of the quad",
           (f"{PLY}.width_rule=band",)),
    Choice("width_root", "width of the crack band", "root of the area of the Gauss point",
           (f"{PLY}.width_rule=root_point",)),
    Choice("snap_reduce", "band too wide for the toughness", "strength is reduced",
           (f"{PLY}.snap_back=reduce",)),
    Choice("across", "shear across the thickness", "weakened by damage, 1 % remains",
           (f"{PLY}.weakens_across=true", f"{PLY}.largest_damage=0.99")),
    Choice("hashin", "matrix in compression", "Hashin 1980, S23 = 40 MPa",
           (f"{PLY}.matrix_compression=hashin", f"{PLY}.ST=40.0")),
    Choice("closure", "cracks in compression", "close, with damage of their own",
           (f"{PLY}.closure=true",)),
    Choice("plateau", "crushed fibres", "keep 0.2 of their strength", (f"{PLY}.plateau=0.2",)),
    Choice("linear_shear", "shear until the matrix cracks", "linear", (f"{PLY}.shear=linear",)),
    Choice("shear_toughness", "toughness of matrix in shear", "0.79 kJ/m2", (f"{PLY}.G2S=0.79",)),
    Choice("nodes", "quadrature of the interfaces", "nodes", (f"{BOND}.quadrature=nodes",)),
    Choice("eta_low", "exponent of mixed modes", "1.45", (f"{BOND}.exponent=1.45",)),
    Choice("eta_high", "exponent of mixed modes", "2.284", (f"{BOND}.exponent=2.284",)),
    Choice("whole", "closing of failed faces", "full stiffness", (f"{BOND}.closing=whole",)),
    Choice("fit", "strengths of the interfaces", "lowered to fit the mesh",
           (f"{BOND}.fit=strengths",)),
    Choice("residual", "what remains of broken points", "5 %", (f"{PLY}.largest_damage=0.95",)),
    Choice("central", "scheme", "central differences", _CENTRAL),
    Choice("core_10", "side of the core", "10 mm", ("mesh.core=10",)),
    Choice("core_15", "side of the core", "15 mm", ("mesh.core=15",)),
    Choice("core_22", "side of the core", "22 mm", ("mesh.core=22",)),
    Choice("points", "contact", "points of the plate", ("contact.method=points_on_plate",)),
)  # fmt: skip


@command()
def choices(
    given: tuple[str, ...],
    model: Annotated[str, typer.Option(help="Recipe that the others differ from.")] = MODEL,
    only: Annotated[str, typer.Option(help="Names of choices, by commas.")] = "",
    without: Annotated[str, typer.Option(help="Names of those not to make.")] = "",
) -> Study:
    """What each choice that the paper leaves open does to the force and to the areas."""
    return Study(pick(only, model, given, without), _report)


@dataclass(frozen=True)
class ChoiceCase(Case):
    """A choice on a model."""

    choice: Choice = BASE


def case_of(choice: Choice, model: str) -> ChoiceCase:
    """The case of a choice on a model."""
    name, recipe = f"{model}_{choice.name}", f"damage_impact/{model}"
    return ChoiceCase(name, recipe, choice.name, choice.overrides, SHORT, choice=choice)


def pick(
    names: str, model: str, given: tuple[str, ...] = (), unwanted: str = ""
) -> list[ChoiceCase]:
    """The base and the choices with some names, separated by commas; all without.

    A choice that a recipe has made already is left out, and so are those with unwanted names.
    """
    wanted, left_out = _split(names), _split(unwanted)
    base, *others = (replace(case_of(one, model), given=given) for one in (BASE, *CHOICES))
    others = [one for one in others if not wanted or one.label in wanted]
    others = [one for one in others if one.label not in left_out]
    return [base, *(one for one in others if one.model != base.model)]


def _split(names: str) -> set[str]:
    """Names between commas."""
    return {name.strip() for name in names.split(",") if name.strip()}


def _report(runs: list[Run], folder: Path) -> list[Page]:
    found = [damage.read_impact(run) for run in runs]
    if found[0].run.case.choice is not BASE:
        raise StudyError(f"the base of the choices has not run to its end in {folder}")
    text = f"{choices_text(found)}\n{made_by(runs)}"
    areas = Section("Areas", damage.areas_text(found))
    return [Page("choices", [Section("Open choices", text, "choices"), areas])]


COLUMNS = (
    Quantity("open question", lambda one: one.run.case.choice.question),
    Quantity("other answer", lambda one: one.run.case.choice.answer),
    *with_change(damage.PEAK, damage.PROJECTED),
    damage.TOTAL,
    damage.DISSIPATED_ALL,
    damage.DISPLACEMENT,
)


def choices_text(found: Sequence[damage.Impact]) -> str:
    """How far each choice moves the peak force and the delaminated area; the base is the first."""
    return tabulate(COLUMNS, found, lambda _: found[0])
