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


#: The laminate of which eight of ten plies lie at 45 degrees, and a toughness [N/mm] with which a
#: cracked matrix keeps its strength
SOFT, WHOLE = "[45/-45/0/45/-45/90/45/-45/45/-45]s", 100.0


@dataclass(frozen=True)
class Coupon:
    """A test."""

    material: str
    layup: str
    end: str
    is_whole: bool = False  # a cracked matrix keeps its strength

    @property
    def measured(self) -> float:
        """Mean of the tests, MPa."""
        return MEASURED[self.material][list(LAYUPS).index(self.layup)][list(ENDS).index(self.end)]

    @property
    def label(self) -> str:
        """The laminate, and what is changed."""
        return f"{self.layup}, the matrix keeps its strength" if self.is_whole else self.layup

    def case(self) -> Case:
        """The run of it."""
        name = f"{self.material[:3].lower()}_{list(LAYUPS).index(self.layup) + 1}_{self.end}"
        varied = [f"laminate.layup={LAYUPS[self.layup]}", f"loads[1].value={ENDS[self.end]:g}"]
        if self.is_whole:
            name += "_whole"
            varied += [f"materials.ply.{each}={WHOLE:g}" for each in ("G2T", "G2C", "G2S")]
        return Case(name, RECIPE, self.material, (*PLIES[self.material], *varied))


COUPONS = tuple(Coupon(*words) for words in product(PLIES, LAYUPS, ENDS))
COUPONS += tuple(Coupon(material, SOFT, end, True) for material, end in product(PLIES, ENDS))
CASES = tuple(coupon.case() for coupon in COUPONS)


@command()
def unnotched() -> Study:
    """Strengths of plain laminates in tension and compression; some minutes."""
    return Study(CASES, one_section("Plain laminates", _text, "unnotched"))


def _text(runs: list[Run]) -> str:
    coupons = dict(zip((case.name for case in CASES), COUPONS, strict=True))
    strengths = {run.case.name: read_compression(run.results).strength for run in runs}
    columns = (
        Quantity("ply", lambda name: coupons[name].material),
        Quantity("laminate", lambda name: coupons[name].label),
        Quantity("test", lambda name: coupons[name].end),
        Quantity("measured [MPa]", lambda name: coupons[name].measured, ".0f"),
        Quantity("computed [MPa]", lambda name: strengths[name], ".0f"),
        Quantity("to the test", lambda name: change(strengths[name], coupons[name].measured)),
    )
    return f"{tabulate(columns, list(strengths))}\n{made_by(runs)}"
