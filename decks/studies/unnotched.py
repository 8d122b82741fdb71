"""Tension and compression of plain laminates, beside twelve measured strengths."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

from plydyn_post.compression import read_compression
from runner.cases import Case, Run, made_by
from runner.commands import Study, command
from runner.pages import Quantity, change, one_section, tabulate

RECIPE = "validation/unnotched"
#: Halves of the laminates, which are symmetric, from the face to the middle plane
LAYUPS = {
    "[45/0/-45/90]2s": "[45/0/-45/90]2",
    "[45/-45/0/45/-45/90/45/-45/45/-45]s": "[45/-45/0/45/-45/90/45/-45/45/-45]",
    "[0/45/0/90/0/-45/0/45/0/-45]s": "[0/45/0/90/0/-45/0/45/0/-45]",
}
#: Means of NCAMP for the ply of CAM-RP-2009-015, in place of those of the library
IM7 = {"E1": 158510, "E2": 8963, "nu12": 0.316, "G12": 4688, "XT": 2500.7, "XC": 1716.4}
IM7 |= {"YT": 64.05, "YC": 285.7, "SL": 91.15}
PLIES = {
    "AS4/8552": (),
    "IM7/8552": (
        "materials.ply.like=IM7/8552 190 gsm",
        "laminate.thickness=0.183",
        *(f"materials.ply.{name}={value}" for name, value in IM7.items()),
    ),
}
#: Speed of the end
ENDS = {"tension": 150.0, "compression": -150.0}
#: NCAMP CAM-RP-2010-002 and CAM-RP-2009-015, dry, room temperature, normalised means, MPa: layup by
#: layup, in tension and in compression
MEASURED = {
    "AS4/8552": ((610.9, 560.7), (438.6, 430.4), (1050.2, 903.6)),
    "IM7/8552": ((721.8, 600.2), (462.0, 458.1), (1210.9, 833.2)),
}


@dataclass(frozen=True)
class Coupon:
    """A run, and what it is."""

    run: Run
    material: str
    layup: str
    end: str

    @property
    def strength(self) -> float:
        """Largest stress, MPa."""
        return read_compression(self.run.results).strength

    @property
    def measured(self) -> float:
        """Mean of the tests, MPa."""
        return MEASURED[self.material][list(LAYUPS).index(self.layup)][list(ENDS).index(self.end)]


def _case(material: str, layup: str, end: str) -> Case:
    name = f"{material[:3].lower()}_{list(LAYUPS).index(layup) + 1}_{end}"
    varied = (f"laminate.layup={LAYUPS[layup]}", f"loads[1].value={ENDS[end]:g}")
    return Case(name, RECIPE, material, (*PLIES[material], *varied))


CHOICES = tuple(product(PLIES, LAYUPS, ENDS))
CASES = tuple(_case(*choice) for choice in CHOICES)
COLUMNS = (
    Quantity("ply", lambda one: one.material),
    Quantity("laminate", lambda one: one.layup),
    Quantity("test", lambda one: one.end),
    Quantity("measured [MPa]", lambda one: one.measured, ".0f"),
    Quantity("computed [MPa]", lambda one: one.strength, ".0f"),
    Quantity("to the test", lambda one: change(one.strength, one.measured)),
)


@command()
def unnotched() -> Study:
    """Strengths of plain laminates in tension and compression; some minutes."""
    return Study(CASES, one_section("Plain laminates", _text, "unnotched"))


def _text(runs: list[Run]) -> str:
    choices = dict(zip((case.name for case in CASES), CHOICES, strict=True))
    coupons = [Coupon(run, *choices[run.case.name]) for run in runs]
    return f"{tabulate(COLUMNS, coupons)}\n{made_by(runs)}"
