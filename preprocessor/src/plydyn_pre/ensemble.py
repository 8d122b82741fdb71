"""Ensembles: one study with several realisations of its scattered strengths."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from plydyn_pre.errors import RecipeError
from plydyn_pre.study import Cohesive, PlyCodam2, Study
from plydyn_pre.study.scatter import scatters


def realisations(study: Study, count: int, seed: int) -> Iterator[tuple[int, Study]]:
    """The seeds from the first one on, each with the study that has it in all its materials."""
    scattered = {
        name: material
        for name, material in study.materials.items()
        if isinstance(material, Cohesive | PlyCodam2) and scatters(material)
    }
    if not scattered:
        words = "no strength scatters; give a cohesive material or a ply of kind ply_codam2 scatter"
        raise RecipeError("materials", f"{words} and scatter_length")
    for number in range(seed, seed + count):
        seeded = {name: replace(material, seed=number) for name, material in scattered.items()}
        title = f"{study.title}, seed {number}"
        yield number, replace(study, title=title, materials=study.materials | seeded)
