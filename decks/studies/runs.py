"""The runs on the page of the damage impact, and what bounds them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from plydyn_post.cscan import draw_cscan
from plydyn_post.delamination import draw_delamination
from plydyn_post.ply_maps import draw_ply_maps
from plydyn_post.results import Results
from plydyn_post.section import draw_section
from readings import damage
from readings.symmetry import asymmetry
from runner.cases import Case, Run, made_by
from runner.commands import Study, command
from runner.pages import NOTHING, Page, Section, draw_all, table

#: As in a test: large displacement, and steps that do not take long
LARGE = (
    "control.kinematics=total_lagrangian",
    "control.step_factor=0.9",
    "control.scheme=implicit_interfaces",
    "control.largest_step=3.0e-8",
    "control.end_time=3.0e-3",
)
#: Large displacement resonates near 0.87 of the stable step, 21 ns here (manual/theory.md, 10)
SHORTER = {3: ("control.largest_step=1.5e-8",)}
FINE = Case(
    "quarter_fine", "damage_impact/quarter_fine", "a quarter of 1536 Q9/LE1, `quarter_fine`"
)
COARSE = Case("coarse", "damage_impact/coarse", "128 Q9/LE1, `coarse`")
LINEAR = Case("q192_le1_linear", "damage_impact/q192_le1", "192 Q9/LE1, the recipe as it stands")
ELASTIC = Case("tied_le1", "damage_impact/tied_le1", "192 Q9/LE1, tied and elastic")
#: The models of Table 7 with large displacement
TABLE_7 = tuple(
    replace(model, common=(*LARGE, *SHORTER.get(model.order, ()))) for model in damage.MODELS
)
RUNS = (FINE, COARSE, *TABLE_7, LINEAR)
#: Those that the picture of the page lays over each other
ORDERS = tuple(model for model in TABLE_7 if model.quads == 192)
#: Peak, contact and displacement from elsewhere: with membrane stiffening as one degree of freedom;
#: the range from an undamaged plate down; an independent program
BY_HAND = {
    "coarse": "elastic: 7.4 kN, 2.0 ms, 2.6 mm",
    "q192_le1_linear": "3.5 to 4.7 kN, 2.8 to 4 ms",
    "tied_le1": "4684 N, 2.70 ms, 3.34 mm",
}
#: Olsson's force of seven and of two delaminations that grow together
LATE_BY_HAND = "1.05 to 1.6 kN"
#: The last part of a run over which its force is averaged, s
LATE = 1e-3
#: Pictures of the fine quarter
PICTURES: dict[str, Callable[[Results, Path], Figure]] = {
    "cscan.png": draw_cscan,
    "damage_plies.png": draw_ply_maps,
    "damage_interfaces.png": draw_delamination,
    "damage_section.png": draw_section,
}


@command()
def runs() -> Study:
    """All runs on the page of the damage impact, and what bounds them."""
    return Study((*RUNS, ELASTIC), _report)


def _report(found: list[Run], folder: Path) -> list[Page]:
    shown = [run for run in found if run.case.name != ELASTIC.name]
    bound = [run for run in found if run.case.name in BY_HAND]
    impacts = [damage.read_impact(run) for run in shown]
    text = f"{damage.impacts_text(impacts)}\n{damage.areas_text(impacts)}\n{made_by(found)}"
    sections = [Section("Runs", text, "runs"), Section("Bounds", bounds_text(bound), "bounds")]
    figures = damage.draw_forces(shown, folder / "runs.png")
    pictures = {}
    orders = [run for run in shown if run.case.name in [case.name for case in ORDERS]]
    if orders:
        figures += damage.draw_forces(orders, folder / "damage_force.png")
        pictures["damage_force.png"] = figures[-2]
    for run in shown:
        if run.case.name == FINE.name:
            pictures |= (drawn := draw_all(PICTURES, run.results, folder))
            figures += drawn.values()
    return [Page("runs", sections, figures, pictures)]


def bounds_text(found: Sequence[Run]) -> str:
    """What single runs come to beside what is known without them."""
    rows = []
    for run in found:
        one = damage.read_impact(run)
        ended = NOTHING if one.duration is None else f"{1e3 * one.duration:.2f} ms"
        here = f"{one.peak:.0f} N, {ended}, {one.displacement:.2f} mm"
        rows.append([one.label, "peak, contact, displacement", BY_HAND[run.case.name], here])
        if one.duration is None:
            late = f"{late_force(run.results):.0f} N"
            rows.append([one.label, "mean force of the last ms", LATE_BY_HAND, late])
        off = f"{asymmetry(run.results):.1g} mm"
        rows.append([one.label, "displacements off symmetry to x and y", "0", off])
    return table(("run", "what", "by hand", "here"), rows)


def late_force(results: Results) -> float:
    """Mean of the contact force over the last part of a run, N."""
    time, force = damage.mean_force(results)
    late = time > time[-1] - LATE
    return float(np.trapezoid(force[late], time[late]) / np.ptp(time[late]))
