"""Tension and compression of plain laminates, beside twelve measured strengths."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

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
SOFT, WHOLE = list(LAYUPS)[1], 100.0


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


@dataclass(frozen=True)
class Curve:
    """Stress [MPa] over strain of a test, as far as it was run."""

    strain: np.ndarray
    stress: np.ndarray
    first: float  # strain at which a fibre breaks

    def strength(self) -> float:
        """Largest stress."""
        return float(self.stress.max())

    def at_strength(self) -> str:
        """Strain there [%], and whether the run ends before the stress falls."""
        k = int(self.stress.argmax())
        return f"{100 * self.strain[k]:.2f}" + (", end" if k == len(self.strain) - 1 else "")

    def at_first(self) -> float:
        """Stress as the first fibre breaks."""
        return float(np.interp(self.first, self.strain, self.stress))


def _curve(run: Run) -> Curve:
    """What the pulled end says of a run."""
    test, energy = read_compression(run.results), run.results.energy()
    strain = np.abs(test.shortening) / test.length
    first = energy["time"][np.flatnonzero(energy["fibre damage"] > 0.0)[0]]
    return Curve(strain, test.stress, float(np.interp(first, test.time, strain)))


def _text(runs: list[Run]) -> str:
    coupons = dict(zip((case.name for case in CASES), COUPONS, strict=True))
    curves = {run.case.name: _curve(run) for run in runs}
    columns = (
        Quantity("ply", lambda name: coupons[name].material),
        Quantity("laminate", lambda name: coupons[name].label),
        Quantity("test", lambda name: coupons[name].end),
        Quantity("measured [MPa]", lambda name: coupons[name].measured, ".0f"),
        Quantity("computed [MPa]", lambda name: curves[name].strength(), ".0f"),
        Quantity(
            "to the test", lambda name: change(curves[name].strength(), coupons[name].measured)
        ),
        Quantity("at a strain of [%]", lambda name: curves[name].at_strength()),
        Quantity("as fibres begin to break [MPa]", lambda name: curves[name].at_first(), ".0f"),
    )
    return f"{tabulate(columns, list(curves))}\n{made_by(runs)}"
