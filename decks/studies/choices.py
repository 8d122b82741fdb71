"""What the paper leaves open of the damage impact, and other answers to each question."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from plydyn_pre.recipe import load_recipe

from studies.damage import RECIPES, Answer, change
from studies.jobs import Job
from studies.markdown import table

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


def pick(
    names: str, recipe: str, overrides: Sequence[str] = (), unwanted: str = ""
) -> list[Choice]:
    """The base and the choices with some names, separated by commas; all without.

    A choice that a recipe has made already is left out, and so are those with unwanted names.
    """
    wanted = _split(names)
    path = RECIPES / f"{recipe}.toml"
    base = load_recipe(path, overrides)
    others = [choice for choice in CHOICES if not wanted or choice.name in wanted]
    others = [choice for choice in others if choice.name not in _split(unwanted)]
    return [BASE] + [
        choice for choice in others if load_recipe(path, (*overrides, *choice.overrides)) != base
    ]


def _split(names: str) -> set[str]:
    """Names between commas."""
    return {name.strip() for name in names.split(",") if name.strip()}


def job_of(choice: Choice, recipe: str, overrides: Sequence[str]) -> Job:
    """The job of a choice on a model."""
    replaced = (*overrides, *choice.overrides)
    return Job(f"{recipe}_{choice.name}", RECIPES / f"{recipe}.toml", replaced)


def choices_text(found: Sequence[tuple[Choice, Answer]]) -> str:
    """How far each choice moves the peak force and the delaminated area."""
    base = next(answer for choice, answer in found if choice is BASE)
    headings = (
        "open question", "other answer", "peak force [N]", "change", "projected area [mm2]",
        "change", "all interfaces [mm2]", "dissipated [J]", "displacement [mm]",
    )  # fmt: skip
    rows = []
    for choice, answer in found:
        rows.append(
            [
                choice.question,
                choice.answer or "–",
                f"{answer.peak:.0f}",
                change(answer.peak, base.peak),
                f"{answer.projected:.0f}",
                change(answer.projected, base.projected),
                f"{answer.total:.0f}",
                f"{sum(answer.taken.values()) / 1e3:.2f}",
                f"{answer.displacement:.2f}",
            ]
        )
    return table(headings, rows)
