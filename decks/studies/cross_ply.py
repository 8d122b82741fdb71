"""Impacts on cross-ply plates of HS160/REM: what delaminates, in which shape, from when."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from plydyn_post.interfaces import DELAMINATED, Interface, read_interfaces
from plydyn_post.ply_maps import draw_ply_maps
from readings import damage
from readings.damage import Impact
from runner.cases import Case, Run, made_by
from runner.commands import Study, command
from runner.pages import Page, Quantity, Section, clock, not_run, tabulate

#: Distance of a node from the axis through the impact on which it lies, mm
NEAR = 1e-6
#: Energy of the recipes, J
OWN = 3.0
#: A finer and a coarser mesh
FINE, COARSE = ("mesh.quad=1.0",), ("mesh.quad=2.0",)
#: Toughnesses of the interfaces that are half of those of the recipe
HALF = ("materials.bond.GIC=0.1385", "materials.bond.GIIC=0.394")
#: The default for bands that are too wide: the matrix cracks below its strength
REDUCED = ("materials.ply.snap_back=reduce",)
#: Strengths of the interfaces that are lowered to the quads
LOWERED = ("materials.bond.fit=core",)
#: Runs up to the end of the contact; the others end after the largest force, when areas are final
WHOLE = ("hs160_1J", "hs160_3J", "hs160_90_3J")
SHORT = "control.end_time=4.0e-3"
#: The plate whose outer plies lie along x, the longer side, the other one, and the first with lines
#: around the impact and all over
ALONG, ACROSS = "[0_3/90_3]s", "[90_3/0_3]s"
CRACKED, EVERYWHERE = f"{ALONG} with cracks as lines", f"{ALONG} with lines all over the plate"
RECIPES = {
    ALONG: "hs160",
    ACROSS: "hs160_90",
    CRACKED: "hs160_cracks",
    EVERYWHERE: "hs160_lines",
}
#: What varies: the end of the name, and words
ENDINGS = {
    (): ("", "quads of 1.5 mm"),
    FINE: ("_fine", "quads of 1 mm"),
    COARSE: ("_coarse", "quads of 2 mm"),
    HALF: ("_half", "half of the toughnesses"),
    REDUCED: ("_reduced", "strength of the matrix lowered in wide quads (the default)"),
    LOWERED: ("_lowered", "strengths of interfaces fitted to the quads"),
}


def _case(layup: str, energy: float, *varied: str) -> Case:
    """An impact on [0_3/90_3]s or on [90_3/0_3]s, J."""
    recipe = RECIPES[layup]
    ending, what = ENDINGS[varied]
    name = f"{recipe}_{energy:g}J".replace(".", "_") + ending
    other = () if energy == OWN else (f"impactor.energy={1e3 * energy:.1f}",)
    end = () if name in WHOLE else (SHORT,)
    label = f"{layup}, {energy:g} J, {what}"
    return Case(name, f"validation/{recipe}", label, (*other, *varied, *end))


CASES = (
    *(_case(ALONG, energy) for energy in (1.0, 3.0, 5.0, 7.0)),
    *(_case(ALONG, energy, *quads) for energy in (3.0, 7.0) for quads in (COARSE, FINE)),
    _case(ALONG, 3.0, *HALF),
    *(_case(ALONG, energy, *REDUCED) for energy in (3.0, 5.0, 7.0)),
    *(_case(ACROSS, energy) for energy in (0.25, 0.5, 3.0)),
    *(_case(ACROSS, 3.0, *quads) for quads in (COARSE, FINE)),
    *(_case(CRACKED, energy) for energy in (3.0, 5.0, 7.0)),
    _case(CRACKED, 7.0, *LOWERED),
    _case(EVERYWHERE, 7.0),
)
#: Pictures of the interfaces after the impact, by the names of their cases
DRAWN = {
    "hs160_3J": "validation_cross_ply.png",
    "hs160_7J": "validation_cross_ply_7J.png",
    "hs160_90_3J": "validation_cross_ply_90.png",
    "hs160_cracks_7J": "validation_cross_ply_lines.png",
}
#: Pictures of the matrix of all plies
PLIES = {
    "hs160_7J": "validation_cross_ply_matrix.png",
    "hs160_7J_reduced": "validation_cross_ply_reduced.png",
}


@dataclass(frozen=True)
class Shape:
    """What delaminated between the two lowest groups of plies, mm."""

    length: float  # along the fibres of the lowest plies
    width: float  # the largest across them
    waist: float  # across them, below the impactor


@dataclass(frozen=True)
class Plate:
    """A run, and the shape of its lower interface."""

    impact: Impact
    shape: Shape

    @property
    def areas(self) -> list[float]:
        """Areas of the lower and of the upper interface, mm2."""
        return list(self.impact.interfaces.values())


def _of_impact(quantity: Quantity) -> Quantity:
    return replace(quantity, value=lambda plate: quantity.value(plate.impact))


COLUMNS = (
    _of_impact(damage.LABEL),
    Quantity("peak force [kN]", lambda plate: plate.impact.peak, ".2f", 1e-3),
    Quantity("lower interface [mm2]", lambda plate: plate.areas[0], ".0f"),
    Quantity("length [mm]", lambda plate: plate.shape.length, ".1f"),
    Quantity("width [mm]", lambda plate: plate.shape.width, ".1f"),
    Quantity("below the impactor [mm]", lambda plate: plate.shape.waist, ".1f"),
    Quantity("upper interface [mm2]", lambda plate: plate.areas[1], ".0f"),
    Quantity("absorbed [J]", lambda plate: plate.impact.absorbed, ".2f", 1e-3),
    *(_of_impact(one) for one in damage.DISSIPATED if one.heading != "shear [J]"),
    Quantity("processor time", lambda plate: clock(plate.impact.run.effort.processor)),
)


@command()
def cross_ply() -> Study:
    """Delaminations of cross-ply plates, for manual/validation.md."""
    return Study(CASES, lambda runs, folder: [page_of(runs, folder)])


def page_of(runs: Sequence[Run], folder: Path) -> Page:
    """The table and the pictures of those cases that have run."""
    found = {run.case.name: run for run in runs}
    ran = [found[case.name] for case in CASES if case.name in found]
    if not ran:
        return Page("cross_ply")
    plates = [read_plate(run) for run in ran]
    text = f"{tabulate(COLUMNS, plates)}{not_run(CASES, found)}\n{made_by(ran)}"
    matrix = partial(draw_ply_maps, mechanisms=("damage_matrix",), whole=True)
    drawn = damage.draw_runs(DRAWN, found, folder)
    drawn += damage.draw_runs(PLIES, found, folder, matrix)
    section = Section("Cross-ply plates", text, "cross-ply")
    return Page("cross_ply", [section], drawn, {path.name: path for path in drawn})


def read_plate(run: Run) -> Plate:
    """The numbers of a run."""
    return Plate(damage.read_impact(run), shape_of(read_interfaces(run.results).each[0]))


def shape_of(interface: Interface) -> Shape:
    """Lengths of what delaminated, from node to node; 0 where nothing has."""
    spent = interface.places[interface.spent >= DELAMINATED]
    along, across = (spent if interface.angles[0] == 0.0 else spent[:, ::-1]).T
    below = across[np.abs(along) < NEAR]
    return Shape(*(float(np.ptp(one)) if len(one) else 0.0 for one in (along, across, below)))
