"""The damage impact: its models, and what is read off a run of one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from plydyn_post.curves import contact, running_mean
from plydyn_post.dissipation import mechanisms
from plydyn_post.interfaces import area_columns
from plydyn_post.results import Results
from plydyn_pre.recipe import load_recipe

from studies.jobs import ROOT, Job
from studies.markdown import table

RECIPES = ROOT / "decks/damage_impact"
#: Window of the running mean of forces, s
WINDOW = 20e-6
#: A delaminated area that counts as the beginning of delamination, mm2
BEGUN = 1.0
#: Headings of a table of answers
HEADINGS = (
    "peak force [N]",
    "at [ms]",
    "first delamination at [N]",
    "contact [ms]",
    "displacement [mm]",
    "absorbed [J]",
    "projected area [mm2]",
    "all interfaces [mm2]",
    "delamination [J]",
    "matrix [J]",
    "shear [J]",
    "fibres [J]",
    "energy error [%]",
)


@dataclass(frozen=True)
class Model:
    """A model of Table 7."""

    recipe: str
    label: str
    quads: int
    order: int
    paper: str  # its time there on six cores, h:mm:ss

    def job(self, overrides: Sequence[str] = ()) -> Job:
        """The job of the model, with values replaced."""
        return Job(self.recipe, RECIPES / f"{self.recipe}.toml", tuple(overrides))


MODELS = (
    Model("q132_le2", "132 Q9/LE2", 132, 2, "5:13:44"),
    Model("q192_le1", "192 Q9/LE1", 192, 1, "6:45:13"),
    Model("q192_le2", "192 Q9/LE2", 192, 2, "8:46:22"),
    Model("q192_le3", "192 Q9/LE3", 192, 3, "11:37:57"),
    Model("q260_le2", "260 Q9/LE2", 260, 2, "11:49:58"),
)


def model_of(recipe: str) -> Model:
    """The model of a recipe."""
    return next(model for model in MODELS if model.recipe == recipe)


@dataclass(frozen=True)
class Answer:
    """What an impact with damage comes to; forces are 20 µs means."""

    peak: float  # N
    peak_time: float  # s
    threshold: float | None  # N, when delamination begins
    duration: float | None  # s, nothing while in contact
    displacement: float  # mm
    absorbed: float | None  # mJ, nothing while in contact
    projected: float  # mm2
    total: float  # mm2
    taken: dict[str, float]  # mJ by mechanism
    error: float  # share

    def cells(self) -> list[str]:
        """The cells of a row of a table."""
        return [
            f"{self.peak:.0f}",
            f"{1e3 * self.peak_time:.2f}",
            _number(self.threshold, 1.0, ".0f"),
            _number(self.duration, 1e3, ".2f"),
            f"{self.displacement:.2f}",
            _number(self.absorbed, 1e-3, ".2f"),
            f"{self.projected:.0f}",
            f"{self.total:.0f}",
            *(f"{one:.2f}" for one in energies(self)),
            f"{100.0 * self.error:.0e}",
        ]


#: Mechanisms in the order of the headings
_ENERGIES = ("delamination", "matrix damage", "ply plasticity", "fibre damage")


def energies(answer: Answer) -> list[float]:
    """Dissipated energies in J, in the order of the headings."""
    return [answer.taken.get(name, 0.0) / 1e3 for name in _ENERGIES]


def _number(value: float | None, scale: float, form: str) -> str:
    return "–" if value is None else f"{scale * value:{form}}"


def change(value: float, base: float) -> str:
    """A change as a share, with its sign."""
    if base in (value, 0.0):
        return "–"
    return f"{round(100.0 * (value / base - 1.0)):+d} %"


def mean_force(results: Results) -> tuple[np.ndarray, np.ndarray]:
    """Times and the 20 µs mean of the contact force."""
    history = results.impactor()
    return history["time"], running_mean(history["time"], history["force"], WINDOW)


def read_answer(results: Results, parts: int = 1) -> Answer:
    """Read the answer off a run; areas are those at its end.

    A run of one of several equal parts, such as a quarter of a disc, counts as often as there are.
    """
    time, force = mean_force(results)
    force = parts * force
    history, energy = results.impactor(), results.energy()
    start, end = contact(time, history["force"])
    over = end < time[-1]
    peak = int(np.argmax(force))
    areas = results.delamination() if results.has("delamination") else None
    each = None
    if areas is not None:
        each = parts * np.sum([areas[name] for name in area_columns(areas).values()], 0)
    began = None if each is None or each[-1] < BEGUN else areas["time"][np.argmax(each >= BEGUN)]
    return Answer(
        peak=float(force[peak]),
        peak_time=float(time[peak]),
        threshold=None if began is None else float(np.interp(began, time, force)),
        duration=float(end - start) if over else None,
        displacement=float(np.abs(history["displacement"]).max()),
        absorbed=parts * float(np.interp(end, time, history["absorbed"])) if over else None,
        projected=0.0 if areas is None else parts * float(areas["projected area"][-1]),
        total=0.0 if each is None else float(each[-1]),
        taken={name: parts * float(taken[-1]) for name, taken in mechanisms(energy).items()},
        error=float(np.abs(energy["error"]).max()),
    )


def answers_text(rows: Sequence[tuple[str, Answer]]) -> str:
    """A table of answers, one row for each name."""
    return table(("model", *HEADINGS), [[name, *answer.cells()] for name, answer in rows])


def areas_text(found: Sequence[tuple[str, Results]], parts: int = 1) -> str:
    """Delaminated area of each interface at the end in mm2, one row for each run of equal parts."""
    rows, numbers = [], []
    for name, results in found:
        areas = results.delamination()
        columns = area_columns(areas)
        numbers = sorted(columns)
        rows.append([name, *(f"{parts * areas[columns[one]][-1]:.0f}" for one in numbers)])
    return table(("model", *(f"interface {one} [mm2]" for one in numbers)), rows)


def mesh_words(recipe: Path, overrides: Sequence[str]) -> str:
    """The number of quads and the size of those in the core."""
    mesh = load_recipe(recipe, overrides).mesh
    quads = mesh.n**2 + 4 * mesh.n * mesh.rings
    share = "a quarter of " if mesh.quarter else ""
    return f"{share}{quads} Q9, {mesh.core / mesh.n:.3g} mm in the core"


def parts_of(recipe: Path, overrides: Sequence[str]) -> int:
    """How many parts like that of the recipe make the whole."""
    return round(1.0 / load_recipe(recipe, overrides).share)


def core_size(recipe: Path, overrides: Sequence[str]) -> float:
    """The size of the quads in the core, mm."""
    mesh = load_recipe(recipe, overrides).mesh
    return mesh.core / mesh.n
