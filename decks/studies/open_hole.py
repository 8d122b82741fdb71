"""Tension of a coupon with a hole, beside the strength of a data sheet."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path

import numpy as np

from plydyn_post.compression import Compression, read_compression
from plydyn_post.delamination import draw_delamination
from plydyn_post.dissipation import mechanisms
from readings.damage import ENERGIES
from runner.cases import Case, Run, made_by
from runner.commands import Study, command
from runner.pages import Page, Quantity, Section, change, clock, not_run, tabulate

#: HexPly 8552 with IM7, quasi-isotropic, dry, room temperature, MPa: 62 ksi of the data sheet
MEASURED = 428.0
#: Strain over which the modulus is taken
ELASTIC = 0.002
#: Strain at which stresses are compared, where no run has failed
COMPARED = 0.006
#: A run whose stress ends below this share of the largest has failed: that of `until_fall`
FALLEN = 0.9
#: Half of the rate, up to a strain of 1.2 %
SLOW = ("loads[1].value=1000.0", "control.end_time=1.25e-3")
#: Fracture energy of fibres, N/mm, and shares of one of two laws of softening in the deck that the
#: source of the material had up to its version 2.6
OTHER, STRENGTH, ENERGY = 133.3, 0.75, 0.375
#: One line for fibres
SINGLE = tuple(f"materials.ply.{key}=1.0" for key in ("FXT", "FGXT", "FXC", "FGXC"))


def _case(name: str, label: str, *varied: str) -> Case:
    recipe = re.sub("_(slow|fibres|single)$", "", name)
    return Case(name, f"validation/{recipe}", label, varied)


def _fibres(energy: float, *shares: float) -> tuple[str, ...]:
    """Another fracture energy of fibres, N/mm, and shares of strength and energy."""
    values = zip(("G1T", "FXT", "FGXT"), (energy, *shares), strict=True)
    return tuple(f"materials.ply.{key}={value:g}" for key, value in values)


CASES = (
    _case("open_hole_coarse", "quads of 0.83 mm at the hole"),
    _case("open_hole", "0.62 mm"),
    _case("open_hole_slow", "0.62 mm, half of the rate", *SLOW),
    _case("open_hole_coarse_single", "0.83 mm, fibres on one line", *SINGLE),
    _case(
        "open_hole_coarse_fibres",
        f"0.83 mm, fibres of {OTHER:g} N/mm, shares {STRENGTH:g} and {ENERGY:g}",
        *_fibres(OTHER, STRENGTH, ENERGY),
    ),
)


@dataclass(frozen=True)
class Coupon:
    """A run, and its stress over elongation."""

    run: Run

    @cached_property
    def test(self) -> Compression:
        """Force and elongation."""
        return read_compression(self.run.results)

    @property
    def strength(self) -> float | None:
        """Largest stress, MPa; nothing where it has not fallen by the end of the run."""
        largest = self.test.strength
        return largest if self.test.stress[-1] < FALLEN * largest else None

    def stress(self, strain: float) -> float:
        """Stress at a mean strain, MPa."""
        passed = self.test.shortening / self.test.length
        return float(np.interp(strain, passed, self.test.stress))

    def spent(self, mechanism: str) -> float:
        """Energy of a mechanism up to the largest force, J."""
        energy = self.run.results.energy()
        taken = mechanisms(energy)[mechanism]
        return float(np.interp(self.test.time[self.test.peak], energy["time"], taken)) / 1e3


COLUMNS = (
    Quantity("model", lambda coupon: coupon.run.case.label),
    Quantity("modulus [GPa]", lambda coupon: coupon.stress(ELASTIC) / ELASTIC, ".1f", 1e-3),
    Quantity("at 0.6 % [MPa]", lambda coupon: coupon.stress(COMPARED), ".0f"),
    Quantity("strength [MPa]", lambda coupon: coupon.strength, ".0f"),
    Quantity("to test", lambda coupon: coupon.strength and change(coupon.strength, MEASURED)),
    Quantity("at a strain of [%]", lambda coupon: 100.0 * coupon.test.strain, ".2f"),
    *(
        Quantity(heading, partial(Coupon.spent, mechanism=mechanism), ".2f")
        for heading, mechanism in ENERGIES.items()
    ),
    Quantity("kinetic energy [%]", lambda coupon: 100.0 * coupon.test.kinetic_share(), ".1f"),
    Quantity("processor time", lambda coupon: clock(coupon.run.effort.processor)),
)
#: Pictures of the interfaces at the state nearest to the largest force, by the names of their cases
DRAWN = {"open_hole_coarse": "validation_open_hole.png"}


@command()
def open_hole() -> Study:
    """Tension of a coupon with a hole, for manual/validation.md."""
    return Study(CASES, lambda runs, folder: [page_of(runs, folder)])


def page_of(runs: Sequence[Run], folder: Path) -> Page:
    """The table and the pictures of those cases that have run."""
    found = {run.case.name: run for run in runs}
    coupons = [Coupon(found[case.name]) for case in CASES if case.name in found]
    if not coupons:
        return Page("open_hole")
    made = made_by([one.run for one in coupons])
    text = f"{tabulate(COLUMNS, coupons)}{not_run(CASES, found)}\n{made}"
    drawn = {}
    for coupon in coupons:
        if (picture := DRAWN.get(coupon.run.case.name)) is not None:
            peak = float(coupon.test.time[coupon.test.peak])
            drawn[picture] = folder / picture
            draw_delamination(coupon.run.results, drawn[picture], peak)
    section = Section("Open-hole tension", text, "open hole")
    return Page("open_hole", [section], list(drawn.values()), drawn)
