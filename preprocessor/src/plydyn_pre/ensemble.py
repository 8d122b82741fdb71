"""Ensembles: one study with several realisations of the scattered strengths of its bonds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from plydyn_pre.errors import RecipeError
from plydyn_pre.study import Cohesive, Study
from plydyn_pre.study.unused import used_materials
from plydyn_pre.typed import LARGEST_WHOLE


def realisations(study: Study, count: int, seed: int) -> Iterator[tuple[int, Study]]:
    """The seeds from the first one on, each with the study that has it in all its materials."""
    scattered = {
        name: material
        for name, material in study.materials.items()
        if name in used_materials(study) and isinstance(material, Cohesive) and material.scatters
    }
    if not scattered:
        words = "no strength in use scatters; give a cohesive material scatter and scatter_length"
        raise RecipeError("materials", words)
    last = seed + count - 1
    if last > LARGEST_WHOLE:
        raise RecipeError("", f"the last seed is {last:,}, at most {LARGEST_WHOLE:,} can be")
    for number in range(seed, seed + count):
        seeded = {name: replace(material, seed=number) for name, material in scattered.items()}
        title = f"{study.title}, seed {number}"
        yield number, replace(study, title=title, materials=study.materials | seeded)
