"""Figures of the damage impact: forces over each other, and what refinement changes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from plydyn_post.figures import Curve, curves_of, draw_history
from plydyn_post.results import Results
from plydyn_post.style import WIDE, figure, look_of, save
from plydyn_post.table import Table

from studies.damage import Answer


def draw_forces(
    found: Sequence[tuple[str, Results]],
    tests: Sequence[Path],
    folder: Path,
    name: str,
    parts: int = 1,
) -> list[Path]:
    """Contact force of models over time and over displacement, tests laid over.

    Each run is of one of some equal parts of the plate.
    """
    curves = [Curve(label, whole_force(results.impactor(), parts)) for label, results in found]
    curves += [curve for curve in curves_of([], tests) if curve.measured]
    made = []
    for across, ending in (("time", ""), ("displacement", "_displacement")):
        shown = [one for one in curves if {across, "force"} <= set(one.table.names)]
        made.append(draw_history(shown, across, "force", folder / f"{name}{ending}.png"))
    return made


def whole_force(history: Table, parts: int) -> Table:
    """A history with the force on all of some equal parts of the plate."""
    factors = [parts if name == "force" else 1 for name in history.names]
    return replace(history, values=history.values * np.array(factors))


def draw_refinement(found: Sequence[tuple[float, Answer]], path: Path) -> Path:
    """Peak force, areas and energies over the size of the quads in the core."""
    size = np.array([one for one, _ in found])
    answers = [answer for _, answer in found]
    with figure(1, 3, size=(WIDE, 2.7)) as (made, (force, area, energy)):
        _plot(force, size, {"peak": [one.peak for one in answers]})
        force.set_ylabel("Force, 20 µs mean [N]")
        _plot(
            area,
            size,
            {
                "projected": [one.projected for one in answers],
                "all interfaces": [one.total for one in answers],
            },
        )
        area.set_ylabel("Delaminated area [mm²]")
        names = {"delamination": "delamination", "matrix damage": "matrix",
                 "ply plasticity": "shear", "fibre damage": "fibres"}  # fmt: skip
        _plot(
            energy,
            size,
            {
                words: [one.taken.get(name, 0.0) / 1e3 for one in answers]
                for name, words in names.items()
            },
        )
        energy.set_ylabel("Dissipated energy [J]")
        for axes in (force, area, energy):
            axes.set_xlabel("Quads of the core [mm]")
            axes.set_ylim(bottom=0.0)
            axes.set_xlim(left=0.0)
            axes.legend(fontsize=7)
        return save(made, path)


def _plot(axes: object, size: np.ndarray, values: dict[str, list[float]]) -> None:
    for place, (label, numbers) in enumerate(values.items()):
        axes.plot(size, numbers, marker="o", markersize=3.5, label=label, **look_of(place))
