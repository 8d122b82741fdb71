"""The impact of 25 J with cracks as lines: three meshes, and one change at a time."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from plydyn_post.areas import damaged_areas
from plydyn_post.cscan import draw_cscan
from plydyn_post.curves import running_mean
from plydyn_post.delamination import draw_delamination
from plydyn_post.style import WIDE, figure, look_of, save
from readings import damage
from runner.cases import Case, Run, made_by
from runner.commands import Study, command
from runner.pages import NOTHING, Page, Section, draw_all, table
from studies.validation import AT_25, FORCE_AT_25, forces_text

RECIPE, PLY, BOND = "validation/t700gc_25J_cracks", "materials.ply", "materials.bond"
#: Runs with a change end soon after the peak; areas are read then, s
SHORT, READ = ("control.end_time=2.05e-3",), 2.0e-3
#: Mean that damps the vibration of the plate at the peak, s
SMOOTH = 1.0e-4
#: Toughnesses that the source gives for the interfaces of T700/M21
TOUGH = (f"{BOND}.GIC=0.5", f"{BOND}.GIIC=1.6")
MESHES = (
    Case("c15", RECIPE, "crack lines, quads of 1.5 mm"),
    Case("c10", RECIPE, "1.0 mm", ("mesh.quad=1.0",)),
    Case("c075", RECIPE, "0.75 mm", ("mesh.quad=0.75",)),
)
#: One change of the first one each
CHANGES = (
    Case("one15", RECIPE, "fibres on one line", (f"{PLY}.FXT=1.0", f"{PLY}.FGXT=1.0"), SHORT),
    Case("l93", RECIPE, "lines of 0.9 and 0.3", (f"{PLY}.FXT=0.9", f"{PLY}.FGXT=0.3"), SHORT),
    Case("gc06", RECIPE, "energy of cracks 0.6 N/mm", ("cracks.GC=0.6",), SHORT),
    Case("st75", RECIPE, "strength through the thickness 75 MPa", ("cracks.ST=75.0",), SHORT),
    Case("n60", RECIPE, "interfaces of 60 and 80 MPa", (f"{BOND}.N=60.0", f"{BOND}.S=80.0"), SHORT),
    Case("g16", RECIPE, "interfaces as tough as T700/M21", TOUGH, SHORT),
    Case("debris", RECIPE, "debris of 0.02 mm in cracks", ("cracks.debris=0.02",)),
    Case("n15", "validation/t700gc_25J_smeared", "no lines: cracks smeared", (), SHORT),
)
MEASURED = [AT_25[name] for name in ("peak force [kN]", "at [ms]", "displacement [mm]")]
#: Pictures of the finest mesh
PICTURES = {"cracks_interfaces.png": draw_delamination, "cracks_cscan.png": draw_cscan}


@command()
def crack_lines() -> Study:
    """The impact of 25 J with cracks as lines, on three meshes and with one change at a time."""
    return Study((*MESHES, *CHANGES), _report, may_stop=True)


def _report(runs: list[Run], folder: Path) -> list[Page]:
    meshes = {case.name for case in MESHES}
    shown = [run for run in runs if run.case.name in meshes] or runs
    force = _draw(shown, folder / "cracks_force.png")
    pictures = {force.name: force} | draw_all(PICTURES, shown[-1].results, folder)
    tables = (rows_text(runs), areas_text(runs), ends_text(runs), forces_text(shown))
    text = "\n".join((*tables, made_by(runs)))
    return [
        Page(
            "crack_lines",
            [Section("Crack lines", text, "crack lines")],
            [*pictures.values()],
            pictures,
        )
    ]


def rows_text(runs: Sequence[Run]) -> str:
    """Force and displacement, and energies when the areas are read."""
    energies = ("fibres [J]", "matrix [J]", "shear [J]", "delamination [J]", "friction [J]")
    headings = ("model", "peak force [kN]", "mean of 0.1 ms [kN]", "at [ms]", "displacement [mm]")
    rows = [["measured", f"{MEASURED[0]:.2f}", NOTHING, f"{MEASURED[1]:.2f}", f"{MEASURED[2]:.2f}"]]
    rows[0] += [NOTHING] * len(energies)
    columns = ("fibre damage", "matrix damage", "ply plasticity", "delamination", "friction")
    for run in runs:
        one, energy = damage.read_impact(run), run.results.energy()
        taken = [np.interp(READ, energy["time"], energy[name]) / 1e3 for name in columns]
        numbers = [one.peak / 1e3, smooth_peak(run), 1e3 * one.peak_time, one.displacement, *taken]
        rows.append([run.case.label, *(f"{number:.2f}" for number in numbers)])
    return table((*headings, *energies), rows)


def smooth_peak(run: Run) -> float:
    """The largest mean of the force, kN."""
    history = run.results.impactor()
    means = running_mean(history["time"], history["force"], SMOOTH)
    return float(means.max()) / 1e3


def areas_text(runs: Sequence[Run]) -> str:
    """Areas of which half of the fracture energy is spent; the projected one also by damage."""
    rows = [["measured", *[NOTHING] * 6, NOTHING, f"{AT_25['projected area [mm2]']:.0f}"]]
    for run in runs:
        areas = run.results.delamination()
        names = [f"interface {number} area" for number in range(1, 7)] + ["projected area"]
        each = [np.interp(READ, areas["time"], areas[name]) for name in names]
        rows.append([run.case.label, *(f"{area:.0f}" for area in each), damaged_area(run)])
    headings = [f"interface {number} [mm2]" for number in range(1, 7)]
    return table(("model", *headings, "projected [mm2]", "by damage of 0.99 [mm2]"), rows)


def damaged_area(run: Run) -> str:
    """Projected area with a damage of 0.99 and more, where a run has fields."""
    if not run.results.interface_fields.is_file():
        return NOTHING
    return f"{damaged_areas(run.results, READ).projected:.0f}"


def ends_text(runs: Sequence[Run]) -> str:
    """What needs the end of the contact."""
    rows = [["measured", f"{AT_25['contact [ms]']:.2f}", f"{AT_25['absorbed [J]']:.1f}"]]
    for run in runs:
        one = damage.read_impact(run)
        if one.duration is not None and one.absorbed is not None:
            rows.append([run.case.label, f"{1e3 * one.duration:.2f}", f"{one.absorbed / 1e3:.2f}"])
    return table(("model", "contact [ms]", "absorbed [J]"), rows)


def _draw(runs: Sequence[Run], path: Path) -> Path:
    """Force over time beside the measured one."""
    with figure(1, 1, size=(WIDE, 3.0)) as (made, axes):
        for number, run in enumerate(runs):
            time, force = damage.mean_force(run.results)
            axes.plot(1e3 * time, force / 1e3, label=run.case.label, **look_of(number))
        axes.plot(list(FORCE_AT_25), list(FORCE_AT_25.values()), "ko", label="measured")
        axes.set(xlabel="Time [ms]", ylabel="Force, 20 µs mean [kN]")
        axes.legend()
        save(made, path)
    return path
