"""Locally implicit schemes against central differences throughout."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from plydyn_post.curves import read_numbers
from plydyn_post.results import Results, open_results

from studies.damage import RECIPES as DAMAGE
from studies.damage import read_answer
from studies.differences import WINDOW, force_difference, norm_share, section
from studies.jobs import ROOT, Job, read_effort
from studies.markdown import table
from studies.stress import percent

NS, JOULES = 1e-9, 1e-3
#: Schemes: what is implicit, the largest step in ns (0 for none), share of the stable step
Scheme = tuple[str, float, float]
EXPLICIT: Scheme = ("explicit", 0.0, 0.9)
COLUMNS: tuple[Scheme, ...] = tuple(("implicit_thickness", step, 0.9) for step in (40.0, 80.0, 0.0))
HALF: Scheme = ("explicit", 0.0, 0.45)
PAIRS: Scheme = ("implicit_interfaces", 0.0, 0.9)

#: The elastic impact: springs between plies are those of the paper's table 6, N/mm3
ELASTIC = ROOT / "decks/elastic_impact"
MODELS = ("le1", "le2", "le3")
SPRINGS = (
    'materials.springs={kind="springs",normal=1373300.0,shear=493300.0}',
    'laminate.interfaces="springs"',
)
JOINTS = {"tied": (EXPLICIT, *COLUMNS), "springs": (EXPLICIT, PAIRS, *COLUMNS)}
#: Stress is written often enough for means over the window of the forces
OUTPUTS = ("outputs.field_interval=1.0", "outputs.profiles=[{at=[40.0,40.0],interval=1.0e-6}]")
#: Components that are compared at that place
SHEAR, PEEL = "syz", "szz"
#: The model whose explicit run is repeated with half of its step: what the step alone does
HALVED = "le2"

#: The damage impact on a coarse mesh, up to its peak
COARSE = ("mesh.n=4", "mesh.rings=3", "control.end_time=1.6e-3", "outputs.field_interval=1.0")
DAMAGED = (HALF, EXPLICIT, ("implicit_interfaces", 20.0, 0.9), PAIRS, *COLUMNS)


@dataclass(frozen=True)
class Case:
    """A model with one scheme."""

    job: Job
    model: str
    scheme: str

    def results(self, folder: Path) -> Results:
        """Its results."""
        return open_results(folder / self.job.name)


def elastic_cases(models: Sequence[str] = MODELS) -> list[Case]:
    """The elastic impacts, each model and joint with its explicit run first."""
    return [
        case_of(
            f"{model}_{joint}",
            ELASTIC / f"{model}.toml",
            (*OUTPUTS, *(SPRINGS if joint == "springs" else ())),
            scheme,
        )
        for joint, schemes in JOINTS.items()
        for model in models
        for scheme in (*schemes, *([HALF] if model == HALVED else []))
    ]


def damage_cases() -> list[Case]:
    """The damage impacts on a coarse mesh."""
    return [case_of("coarse", DAMAGE / "q192_le2.toml", COARSE, scheme) for scheme in DAMAGED]


def case_of(model: str, recipe: Path, replaced: tuple[str, ...], scheme: Scheme) -> Case:
    """A model with a scheme, and with values replaced."""
    implicit, step, share = scheme
    words = implicit.replace("_", " ") + (f", {step:.0f} ns" if step else "")
    words += ", half step" if share < EXPLICIT[2] else ""
    control = (
        f'control.scheme="{implicit}"',
        f"control.largest_step={step * NS}",
        f"control.step_factor={share}",
    )
    name = f"{model}_{words.replace(', ', '_').replace(' ', '_')}"
    return Case(Job(name, recipe, (*replaced, *control)), model, words)


def elastic_text(cases: Sequence[Case], folder: Path) -> str:
    """How far each scheme is from the explicit one: force, deflection, stress between plies."""
    headings = ["model", "scheme", "step [ns]", "steps", "force", "deflection"]
    headings += [f"mean `{SHEAR}`", f"mean `{PEEL}`"]
    rows = []
    for case in cases:
        base = next(one for one in cases if one.model == case.model)
        same = case is base
        rows.append(
            [
                case.model.replace("_", ", ").replace("le", "LE"),
                case.scheme,
                *step_cells(case, folder),
                *([""] * 4 if same else _differences(case.results(folder), base.results(folder))),
            ]
        )
    return table(headings, rows)


def step_cells(case: Case, folder: Path) -> list[str]:
    """Largest step and number of steps, in print."""
    listing = folder / f"{case.job.name}.out"
    found = re.search(r"largest step taken\s+(\S+)", listing.read_text(encoding="utf-8"))
    step = float(found[1]) / NS if found else 0.0
    return [f"{step:.3g}", f"{read_effort(listing, 0.0, 0.0).steps:,}"]


def _differences(ours: Results, theirs: Results) -> list[str]:
    """Of the mean force, of the largest displacement, of mean stress over the run; in print."""
    deepest = [read_numbers(one).largest_displacement for one in (ours, theirs)]
    return [
        percent(force_difference(ours, theirs)),
        f"{100.0 * (deepest[0] / deepest[1] - 1.0):+.2f} %",
        *(percent(_stress_difference(ours, theirs, one)) for one in (SHEAR, PEEL)),
    ]


def _stress_difference(ours: Results, theirs: Results, component: str) -> float:
    """Difference of means over time, through the thickness and the run, as a share of the other."""
    means = [_means(one, component) for one in (ours, theirs)]
    rows = min(map(len, means))
    return norm_share(means[0][:rows] - means[1][:rows], means[1][:rows])


def _means(results: Results, component: str) -> np.ndarray:
    """Stress at the places of a profile, means over the window of forces; (times, places)."""
    found = section(results, 1, component)
    width = max(1, round(WINDOW / float(np.median(np.diff(found.times)))))
    sums = np.cumsum(found.values, axis=0)
    return (sums[width:] - sums[:-width]) / width


def damage_text(cases: Sequence[Case], folder: Path) -> str:
    """What each scheme makes of forces, delaminated areas and energies."""
    headings = ("scheme", "step [ns]", "steps", "peak force [N]", "projected area [mm2]")
    headings += ("all interfaces [mm2]", "delamination [J]", "dissipated in all [J]")
    rows = []
    for case in cases:
        answer = read_answer(case.results(folder))
        rows.append(
            [
                case.scheme,
                *step_cells(case, folder),
                f"{answer.peak:.0f}",
                f"{answer.projected:.0f}",
                f"{answer.total:.0f}",
                f"{answer.taken.get('delamination', 0.0) * JOULES:.3f}",
                f"{sum(answer.taken.values()) * JOULES:.3f}",
            ]
        )
    return table(headings, rows)
