"""The damage impact on finer and finer meshes: what still changes from one to the next."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from plydyn_post.results import Results, open_results

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


def jobs_of(model: str, sizes: str, overrides: Sequence[str]) -> list[Job]:
    """A model with n x n quads in the core for some n, by commas; rings in proportion, n / 2."""
    numbers = sorted({int(number) for number in sizes.split(",") if number.strip()})
    if not numbers or numbers[0] < 2:
        raise StudyError("--n must name numbers of quads of 2 and more")
    path = RECIPES / f"{model}.toml"
    return [
        Job(f"{model}_n{n}", path, (f"mesh.n={n}", f"mesh.rings={max(2, n // 2)}", *overrides))
        for n in numbers
    ]


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
