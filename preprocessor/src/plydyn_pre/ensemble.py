"""Ensembles: one study with several realisations of its scattered strengths."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from plydyn_pre.errors import RecipeError
from plydyn_pre.study import Cohesive, Study


def realisations(study: Study, count: int, seed: int) -> Iterator[tuple[int, Study]]:
    """The seeds from the first one on, each with the study that has it in all its materials."""
    scattered = [
        name
        for name, material in study.materials.items()
        if isinstance(material, Cohesive) and material.scatter
    ]
    if not scattered:
        words = "no strength scatters; give a cohesive material scatter and scatter_length"
        raise RecipeError("materials", words)
    for number in range(seed, seed + count):
        seeded = {name: replace(study.materials[name], seed=number) for name in scattered}
        title = f"{study.title}, seed {number}"
        yield number, replace(study, title=title, materials=study.materials | seeded)
