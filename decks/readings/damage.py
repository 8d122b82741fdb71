"""The impact with damage: its models, what is read off a run of one, and the tables of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from plydyn_post.contact import contact
from plydyn_post.curves import running_mean
from plydyn_post.delamination import draw_delamination
from plydyn_post.dissipation import mechanisms
from plydyn_post.figures import Curve, curves_of, draw_history
from plydyn_post.interfaces import area_columns
from plydyn_post.results import Results
from plydyn_pre import OgridDisc
from readings.differences import WINDOW
from runner.cases import Case, Run, RunOf, StudyError
from runner.pages import Quantity, table, tabulate

#: A delaminated area that counts as the beginning of delamination, mm2
BEGUN = 1.0


@dataclass(frozen=True)
class DamageCase(Case):
    """A model of Table 7."""

    quads: int = 0
    order: int = 0
    paper: str = ""  # its time there on six cores, h:mm:ss


def _model(quads: int, order: int, paper: str) -> DamageCase:
    name = f"q{quads}_le{order}"
    recipe, label = f"damage_impact/{name}", f"{quads} Q9/LE{order}"
    return DamageCase(name, recipe, label, quads=quads, order=order, paper=paper)


MODELS = (
    _model(132, 2, "5:13:44"),
    _model(192, 1, "6:45:13"),
    _model(192, 2, "8:46:22"),
    _model(192, 3, "11:37:57"),
    _model(260, 2, "11:49:58"),
)


@dataclass(frozen=True)
class Impact:
    """What a run came to, for the whole plate; forces are 20 µs means, areas those at its end."""

    run: RunOf[Any]  # a study knows which cases it has made
    peak: float  # N
    peak_time: float  # s
    threshold: float | None  # N, when delamination begins
    duration: float | None  # s, nothing while in contact
    displacement: float  # mm, largest towards the plate
    absorbed: float | None  # mJ, nothing while in contact
    projected: float  # mm2
    interfaces: dict[int, float]  # mm2, by their numbers from the lowest up
    dissipated: dict[str, float]  # mJ by mechanism
    error: float  # share

    @property
    def label(self) -> str:
        """What tables call it."""
        return self.run.case.label

    @property
    def total(self) -> float:
        """Delaminated area of all interfaces, mm2."""
        return sum(self.interfaces.values())


#: Dissipated energies: heading, mechanism
ENERGIES = {
    "delamination [J]": "delamination",
    "matrix [J]": "matrix damage",
    "shear [J]": "ply plasticity",
    "fibres [J]": "fibre damage",
}


def _energy(heading: str, mechanism: str) -> Quantity:
    return Quantity(heading, lambda one: one.dissipated.get(mechanism, 0.0) / 1e3, ".2f")


LABEL = Quantity("model", lambda one: one.label)
PEAK = Quantity("peak force [N]", lambda one: one.peak, ".0f")
DISPLACEMENT = Quantity("displacement [mm]", lambda one: one.displacement, ".2f")
PROJECTED = Quantity("projected area [mm2]", lambda one: one.projected, ".0f")
TOTAL = Quantity("all interfaces [mm2]", lambda one: one.total, ".0f")
DISSIPATED = tuple(_energy(heading, mechanism) for heading, mechanism in ENERGIES.items())
DELAMINATION = DISSIPATED[0]
#: Energy of these mechanisms, and of all that there are
DISSIPATED_SUM = Quantity(
    "dissipated in all [J]",
    lambda one: sum(one.dissipated.get(name, 0.0) for name in ENERGIES.values()) / 1e3,
    ".2f",
)
DISSIPATED_ALL = Quantity("dissipated [J]", lambda one: sum(one.dissipated.values()) / 1e3, ".2f")
COLUMNS = (
    PEAK,
    Quantity("at [ms]", lambda one: one.peak_time, ".2f", 1e3),
    Quantity("first delamination at [N]", lambda one: one.threshold, ".0f"),
    Quantity("contact [ms]", lambda one: one.duration, ".2f", 1e3),
    DISPLACEMENT,
    Quantity("absorbed [J]", lambda one: one.absorbed, ".2f", 1e-3),
    PROJECTED,
    TOTAL,
    *DISSIPATED,
    Quantity("energy error [%]", lambda one: one.error, ".0e", 100.0),
)


def impacts_text(found: Sequence[Impact], label: Quantity = LABEL) -> str:
    """A table of what runs came to."""
    return tabulate((label, *COLUMNS), found)


def areas_text(found: Sequence[Impact], label: Quantity = LABEL) -> str:
    """Delaminated area of each interface at the end."""
    headings = [f"interface {number} [mm2]" for number in found[-1].interfaces]
    rows = [[label.cell(one), *(f"{it:.0f}" for it in one.interfaces.values())] for one in found]
    return table((label.heading, *headings), rows)


def core_size(case: Case) -> float:
    """The size of the quads in the core, mm."""
    return _disc(case).core / _disc(case).n


def _disc(case: Case) -> OgridDisc:
    """The mesh of a case."""
    mesh = case.model.mesh
    if not isinstance(mesh, OgridDisc):
        raise StudyError(f"{case.name}: the mesh is no disc")
    return mesh


def mesh_words(case: Case) -> str:
    """The number of quads and the size of those in the core."""
    mesh = _disc(case)
    quads = mesh.n**2 + 4 * mesh.n * mesh.rings
    share = "a quarter of " if mesh.quarter else ""
    return f"{share}{quads} Q9, {core_size(case):.3g} mm in the core"


def mean_force(results: Results) -> tuple[np.ndarray, np.ndarray]:
    """Times and the 20 µs mean of the contact force."""
    history = results.impactor()
    return history["time"], running_mean(history["time"], history["force"], WINDOW)


def read_impact(run: Run) -> Impact:
    """Read what a run came to, for the whole plate."""
    results = run.results
    time, force = mean_force(results)
    history, energy = results.impactor(), results.energy()
    start, end = contact(time, history["force"])
    over = end < time[-1]
    peak = int(np.argmax(force))
    areas = results.delamination() if results.has("delamination") else None
    of_each: dict[int, np.ndarray] = {}
    began = None
    if areas is not None:
        of_each = {number: areas[name] for number, name in sorted(area_columns(areas).items())}
        each = np.sum([*of_each.values()], axis=0) if of_each else np.zeros(1)
        began = areas["time"][np.argmax(each >= BEGUN)] if each[-1] >= BEGUN else None
    return Impact(
        run,
        peak=float(force[peak]),
        peak_time=float(time[peak]),
        threshold=None if began is None else float(np.interp(began, time, force)),
        duration=float(end - start) if over else None,
        displacement=-float(history["displacement"].min()),
        absorbed=float(np.interp(end, time, history["absorbed"])) if over else None,
        projected=0.0 if areas is None else float(areas["projected area"][-1]),
        interfaces={number: area[-1] for number, area in of_each.items()},
        dissipated={name: float(taken[-1]) for name, taken in mechanisms(energy).items()},
        error=float(np.abs(energy["error"]).max()),
    )


def draw_runs(
    drawn: Mapping[str, str],
    found: Mapping[str, Run],
    folder: Path,
    draw: Callable[[Results, Path], object] = draw_delamination,
) -> list[Path]:
    """Pictures of those runs that have one, by the names of their cases: of their delaminations."""
    made = [(found[name], folder / picture) for name, picture in drawn.items() if name in found]
    for run, path in made:
        draw(run.results, path)
    return [path for _, path in made]


def draw_forces(
    runs: Sequence[Run],
    path: Path,
    tests: Sequence[Path] = (),
    label: Callable[[Case], str] = lambda case: case.label,
) -> list[Path]:
    """Contact force of runs over time and over displacement, tests laid over."""
    curves = [Curve(label(run.case), run.results.impactor()) for run in runs]
    curves += [curve for curve in curves_of([], tests) if curve.measured]
    made = []
    for across, ending in (("time", ""), ("displacement", "_displacement")):
        shown = [one for one in curves if {across, "force"} <= set(one.table.names)]
        file = path.with_name(f"{path.stem}{ending}{path.suffix}")
        draw_history(shown, across, "force", file)
        made.append(file)
    return made
