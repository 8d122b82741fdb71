"""Impacts whose measured numbers nobody here has seen: two predictions, each made once."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from readings import damage
from runner.cases import Run, by_build
from runner.commands import Study, command
from runner.pages import one_section, table
from studies.validation import (
    ABSORBED,
    AREA,
    DISPLACEMENT,
    DURATION,
    PEAK,
    TIME,
    Test,
    columns_of,
    deviation,
    impacts_text,
    read_numbers,
    seeds_of,
    t700,
    word_of,
)

#: What broken points kept of their stiffness when the first prediction was made
FIRST = "materials.ply.largest_damage=0.99"
#: Sizes of quads asked for, by the ends of the names of cases, and those that come out
FINER = {"_fine": ("mesh.quad=2.0", "1.9"), "_finer": ("mesh.quad=1.5", "1.5")}
#: Names of the impacts, and the first words of their rows
IMPACTS = {
    "t700_6J": "T700/M21, 6.5 J",
    "t700_17J": "T700/M21, 17 J",
    "t700_29J": "T700/M21, 29.5 J",
}
#: Finer meshes and seeds by the first words of their rows
Rows = Mapping[str, tuple[tuple[Test, ...], tuple[Test, ...]]]
COARSE = "quads of 2.8 mm"
BLIND = tuple(t700(name, f"{label}, {COARSE}", {}, FIRST) for name, label in IMPACTS.items())
#: The same with another law of the plies than the default
OTHER_LAWS = (t700("t700_17J_planes", f"T700/M21 with planes of fracture, 17 J, {COARSE}", {}),)


def _meshes(name: str, label: str, ends: tuple[str, ...], *varied: str) -> tuple[Test, ...]:
    """An impact on finer meshes."""
    return tuple(
        t700(name + end, f"{label}, quads of {FINER[end][1]} mm", {}, *varied, FINER[end][0])
        for end in ends
    )


#: Finer meshes and five seeds of each impact, by the first words of their rows
BANDS = {
    label: (_meshes(name, label, ("_fine",), FIRST), seeds_of(name, FIRST))
    for name, label in IMPACTS.items()
}
#: The same impacts with the default that followed: three meshes and five seeds
SECOND = {
    label: (
        (
            t700(f"{name}_second", f"{label}, {COARSE}", {}),
            *_meshes(f"{name}_second", label, ("_fine", "_finer")),
        ),
        seeds_of(f"{name}_second"),
    )
    for name, label in IMPACTS.items()
}


@command()
def blind() -> Study:
    """Impacts whose measured numbers nobody here has seen, for manual/validation.md; run once."""
    return Study(
        [test.case for test in (*BLIND, *OTHER_LAWS)],
        one_section("Blind numbers", _blind_text, "blind"),
    )


@command()
def bands() -> Study:
    """A finer mesh and five seeds of the blind impacts, for manual/validation.md."""
    return _study(BANDS, "Scatter of the blind numbers", "bands")


@command()
def second() -> Study:
    """The blind impacts with the default of now: meshes and seeds, for manual/validation.md."""
    return _study(SECOND, "The second prediction", "second")


def _blind_text(runs: list[Run]) -> str:
    return impacts_text((*BLIND, *OTHER_LAWS), {run.case.name: run for run in runs})


def _study(rows: Rows, title: str, mark: str) -> Study:
    """Rows of meshes, and of means and standard deviations of seeds, a build after the other."""
    cases = [test.case for meshes, seeds in rows.values() for test in (*meshes, *seeds)]

    def text(runs: list[Run]) -> str:
        return by_build(runs, lambda own: _rows_text(rows, own)) or "Not run.\n"

    return Study(cases, one_section(title, text, mark))


def _rows_text(rows: Rows, runs: list[Run]) -> str:
    """Rows of the runs of a build."""
    found = {run.case.name: run for run in runs}
    lines = []
    for label, (meshes, seeds) in rows.items():
        for test in meshes:
            if test.case.name in found:
                numbers = read_numbers(damage.read_impact(found[test.case.name]))
                lines.append([test.case.label, *map(word_of, numbers.values())])
        ran = [found[seed.case.name] for seed in seeds if seed.case.name in found]
        if len(ran) > 1:
            cells = [f"{np.mean(of):.4g} ± {deviation(of):.3g}" for of in columns_of(ran).values()]
            lines.append([f"{label}, {len(ran)} seeds on 2.8 mm", *cells])
    return table(("test", PEAK, TIME, DURATION, DISPLACEMENT, ABSORBED, AREA), lines)
