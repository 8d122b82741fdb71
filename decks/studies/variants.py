"""Runs that tell why meshes of the damage impact differ: each changes one thing of a quarter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from plydyn_post.interfaces import area_columns

from studies.damage import RECIPES
from studies.jobs import Job
from studies.markdown import table
from studies.refinement import Refined, mesh_of
from studies.refinement import collect as collect_jobs

WHOLE = ("mesh.quarter=false",)
LARGE_CORE = ("mesh.core=36", "mesh.rings=8")
REDUCED = ("materials.hts40_9772.snap_back=reduce",)
FITTED = ("materials.interface.fit=strengths",)


@dataclass(frozen=True)
class Variant:
    """A mesh of a quarter with n x n quads in the core, and what is different."""

    name: str
    words: str
    n: int
    overrides: tuple[str, ...]

    def job(self, overrides: Sequence[str] = ()) -> Job:
        """Its job; values may be replaced further."""
        replaced = (*mesh_of(self.n), *self.overrides, *overrides)
        return Job(f"{self.name}_n{self.n}", RECIPES / "quarter.toml", replaced)


VARIANTS = (
    Variant("whole", "the whole disc", 12, WHOLE),
    Variant("whole", "the whole disc", 24, WHOLE),
    Variant("whole_core_36", "the whole disc, core of 36 mm", 36, (*WHOLE, *LARGE_CORE)),
    Variant("core_36", "core of 36 mm", 36, LARGE_CORE),
    *(Variant("reduced", "strength is reduced to the band", n, REDUCED) for n in (12, 16, 24)),
    Variant("fitted", "strengths of interfaces fit the mesh", 12, FITTED),
)


def jobs_of(overrides: Sequence[str]) -> list[Job]:
    """The jobs of all variants."""
    return [one.job(overrides) for one in VARIANTS]


def collect(folder: Path) -> list[tuple[Variant, Refined]]:
    """What those variants came to that have run to their end in a folder."""
    return [(one, found) for one in VARIANTS for found in collect_jobs([one.job()], folder)]


def variants_text(found: Sequence[tuple[Variant, Refined]]) -> str:
    """Peak and areas of the variants."""
    headings = (
        "mesh", "what is different", "peak force [N]", "displacement [mm]",
        "projected area [mm2]", "all interfaces [mm2]", "interfaces from the lowest up [mm2]",
    )  # fmt: skip
    rows = []
    for variant, one in found:
        areas = one.results.delamination()
        columns = sorted(area_columns(areas).items())
        rows.append(
            [
                one.words,
                variant.words,
                f"{one.answer.peak:.0f}",
                f"{one.answer.displacement:.2f}",
                f"{one.answer.projected:.0f}",
                f"{one.answer.total:.0f}",
                ", ".join(f"{one.parts * areas[name][-1]:.0f}" for _, name in columns),
            ]
        )
    return table(headings, rows)
