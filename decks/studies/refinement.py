"""The damage impact on finer and finer meshes: what still changes from one to the next."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from plydyn_post.results import Results, open_results
from plydyn_pre.recipe import load_recipe

from studies.damage import (
    RECIPES,
    Answer,
    answers_text,
    areas_text,
    change,
    core_size,
    energies,
    mesh_words,
    parts_of,
    read_answer,
)
from studies.damage_figures import draw_forces, draw_refinement
from studies.jobs import Job, StudyError, kept_effort
from studies.markdown import table


@dataclass(frozen=True)
class Refined:
    """What a mesh came to."""

    words: str
    size: float  # of the quads in the core, mm
    parts: int  # that make the whole, like the one that was run
    answer: Answer  # of the whole
    results: Results


@dataclass(frozen=True)
class Ladder:
    """A recipe with n x n quads in the core for some n; rings in proportion, n / 2."""

    model: str
    sizes: tuple[int, ...]

    def jobs(self, overrides: Sequence[str] = ()) -> list[Job]:
        """Its jobs from the coarsest on; values may be replaced further."""
        path = RECIPES / f"{self.model}.toml"
        return [Job(f"{self.model}_n{n}", path, (*mesh_of(n), *overrides)) for n in self.sizes]


#: The ladders of the page
LADDERS = (
    Ladder("quarter", (8, 12, 16, 24, 32, 48)),
    Ladder("quarter_elastic", (12, 16, 24)),
)


def mesh_of(n: int) -> tuple[str, str]:
    """Values that make a mesh with n x n quads in the core."""
    return f"mesh.n={n}", f"mesh.rings={max(2, n // 2)}"


def pick(model: str, sizes: str) -> list[Ladder]:
    """The ladder of a recipe with some n, by commas; without them those of the page."""
    found = [one for one in LADDERS if model in ("", one.model)]
    numbers = sorted({int(number) for number in sizes.split(",") if number.strip()})
    if numbers and numbers[0] < 2:
        raise StudyError("--n must name numbers of quads of 2 and more")
    if not found and not numbers:
        raise StudyError(f"{model} has no ladder on the page; --n must name numbers of quads")
    if numbers:
        found = [replace(one, sizes=tuple(numbers)) for one in found or [Ladder(model, ())]]
    return found


def work(job: Job) -> float:
    """How much work a run is beside others: more quads, and shorter steps the smaller they are."""
    study = load_recipe(job.recipe, job.overrides)
    mesh = study.mesh
    return study.share * (mesh.n**2 + 4 * mesh.n * mesh.rings) * mesh.n / mesh.core


def collect(jobs: Sequence[Job], folder: Path) -> list[Refined]:
    """What those meshes came to that have run to their end in a folder."""
    found = []
    for job in jobs:
        if kept_effort(job, folder) is None:
            continue
        results, parts = open_results(folder / job.name), parts_of(job.recipe, job.overrides)
        words = mesh_words(job.recipe, job.overrides)
        size = core_size(job.recipe, job.overrides)
        found.append(Refined(words, size, parts, read_answer(results, parts), results))
    return found


def sections_of(found: Sequence[Refined]) -> list[tuple[str, str]]:
    """Tables of answers, of areas, and of what changes from mesh to mesh, with their headings."""
    areas = areas_text([(one.words, one.results) for one in found], found[0].parts)
    return [
        ("Refinement", answers_text([(one.words, one.answer) for one in found])),
        ("Areas", areas),
        ("Changes", changes_text([(one.size, one.answer) for one in found])),
    ]


def changes_text(found: Sequence[tuple[float, Answer]]) -> str:
    """How each number changes from a mesh to the next; found has sizes of quads in mm."""
    steps = [(found[i], found[i + 1]) for i in range(len(found) - 1)]
    headings = [f"{before:.3g} to {after:.3g} mm" for (before, _), (after, _) in steps]
    pairs = [(_numbers(before), _numbers(after)) for (_, before), (_, after) in steps]
    names = _numbers(found[0][1])
    rows = [
        [name, *(change(after[name], before[name]) for before, after in pairs)] for name in names
    ]
    return table(("change", *headings), rows)


def _numbers(answer: Answer) -> dict[str, float]:
    """The numbers that must settle."""
    delamination, matrix, shear, fibres = energies(answer)
    return {
        "peak force": answer.peak,
        "displacement": answer.displacement,
        "projected area": answer.projected,
        "all interfaces": answer.total,
        "energy of delamination": delamination,
        "of matrix": matrix,
        "of shear": shear,
        "of fibres": fibres,
        "dissipated in all": sum(energies(answer)),
    }


def draw(found: Sequence[Refined], folder: Path, name: str) -> list[Path]:
    """Draw forces over each other, and numbers over the size of quads."""
    sizes = draw_refinement([(one.size, one.answer) for one in found], folder / f"{name}.png")
    runs = [(one.words, one.results) for one in found]
    return [sizes, *draw_forces(runs, (), folder, f"{name}_force", found[0].parts)]
