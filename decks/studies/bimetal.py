"""The bimetallic impact: layers and bricks over each other, and on finer and finer meshes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from plydyn_post.results import Results
from plydyn_post.style import WIDE, figure, look_of, save
from readings.bimetal_figures import (
    Face,
    along_y,
    asymmetry,
    draw_bimetal,
    lost_momentum,
    read_face,
)
from readings.differences import impact_numbers
from runner.cases import Case, Run, RunOf
from runner.commands import Study, command
from runner.pages import Page, Quantity, Section, tabulate
from studies.bricks import TABLE_4, Models, pick

LAYERS, BRICKS = "layers, LE1", "bricks of one point"
#: Side of the plate, mm
SIDE = 100.0
#: Distances of points on the axis of the figure, mm
TICKS = (0.25, 0.5, 1.0, 2.0)


@command()
def bimetal(models: Models = "le1,le2,bricks_1") -> Study:
    """The paper's figures 6, 7 and 8: deflection and plastic strain, layers and bricks."""

    def report(runs: list[Run], folder: Path) -> list[Page]:
        found = [(run.case.label, run.results) for run in runs]
        return [Page("bimetal", figures=draw_bimetal(found, folder))]

    return Study(pick(TABLE_4, models), report, needs_all=True)


@dataclass(frozen=True)
class MeshCase(Case):
    """A mesh of layers or bricks: squares of the core, rings around it, and what else is chosen."""

    core: float = SIDE  # mm, side of the core; that of the plate for equal squares
    n: int = 0  # quads along it
    rings: int = 0
    choice: str = ""  # words for the table

    @property
    def is_bricks(self) -> bool:
        """Whether the plate is of bricks."""
        return self.label == BRICKS

    @property
    def spacing(self) -> float:
        """Distance of neighbouring points in the core, mm."""
        return self.core / self.n / (1 if self.is_bricks else 2)


def _mesh(
    family: str, core: float, n: int, rings: int = 0, choice: str = "", *varied: str
) -> MeshCase:
    """The recipe of Table 4 with a mesh; rings around a core of 8 mm grow to four times the width.

    Without rings the plate is of equal squares.
    """
    bricks = family == BRICKS
    mesh: tuple[str, ...] = (f"mesh.quads=[{n}, {n}]",)
    if rings:
        # another kind of mesh comes first: it drops what the recipe says of its own
        mesh = ('mesh.kind="ogrid_square"', f"mesh.side={SIDE}", "mesh.order=1") if bricks else ()
        mesh += (f"mesh.core={core}", f"mesh.n={n}", f"mesh.rings={rings}")
        mesh += (f"mesh.grading={4.0 if core == 8.0 else 1.0}",)
    words = ("bricks" if bricks else "layers", f"{core:g}", str(n), str(rings), *choice.split())
    recipe = f"bimetal_impact/{'bricks_1' if bricks else 'le1'}"
    return MeshCase(
        "_".join(words),
        recipe,
        family,
        (*mesh, *varied),
        core=core,
        n=n,
        rings=rings,
        choice=choice,
    )


#: The meshes of Table 4, LE1 and ABQ-Coarse
PAPER = (_mesh(LAYERS, 20.0, 4, 2), _mesh(BRICKS, SIDE, 80))
#: From coarse to fine, layers and then bricks
MESHES = (
    PAPER[0],
    *(
        _mesh(LAYERS, 20.0, n, rings)
        for n, rings in ((4, 8), (8, 2), (8, 4), (8, 8), (12, 6), (16, 4))
    ),
    *(_mesh(LAYERS, 8.0, n, rings) for n, rings in ((8, 8), (16, 12))),
    _mesh(BRICKS, SIDE, 40),
    PAPER[1],
    *(_mesh(BRICKS, 20.0, n, rings) for n, rings in ((8, 8), (16, 8), (32, 12))),
    *(_mesh(BRICKS, 8.0, n, rings) for n, rings in ((16, 16), (32, 20))),
)
_POINTS, _STIFF = 'contact.method="points_on_plate"', "bricks.coefficient=1.0"
#: Other contact, order, hourglass control and points, on some of these meshes
CHOICES = (
    _mesh(LAYERS, 20.0, 4, 2, "LE2", "laminate.order=2"),
    _mesh(LAYERS, 8.0, 8, 8, "LE2", "laminate.order=2"),
    _mesh(LAYERS, 20.0, 16, 4, "points of the plate", _POINTS),
    _mesh(BRICKS, 20.0, 8, 8, "QH 1", _STIFF),
    _mesh(BRICKS, 20.0, 16, 8, "QH 1", _STIFF),
    _mesh(BRICKS, 8.0, 16, 16, "QH 1", _STIFF),
    _mesh(BRICKS, 20.0, 8, 8, "eight points", 'bricks.points="eight"'),
)


@command()
def bimetal_ladder() -> Study:
    """Layers and bricks of the bimetallic plate on finer and finer meshes; takes an hour."""
    return Study((*MESHES, *CHOICES), _report)


def _report(runs: list[RunOf[MeshCase]], folder: Path) -> list[Page]:
    found = [Plate(run, read_face(run.results)) for run in runs]
    figures = [_draw(found, folder), *draw_bimetal(_for_figures(found), folder)]
    section = Section("Ladder", tabulate(COLUMNS, found), "ladder")
    names = [one.name if one == figures[0] else f"bimetal_{one.name}" for one in figures]
    pictures = dict(zip(names, figures, strict=True))
    return [Page("bimetal_ladder", [section], figures, pictures)]


@dataclass(frozen=True)
class Plate:
    """A mesh that has run, and the face that was hit."""

    run: RunOf[MeshCase]
    face: Face

    @property
    def dissipated(self) -> float:
        """Energy that plastic flow took, mJ."""
        return float(self.run.results.energy()["metal plasticity"][-1])


def _words(one: Plate) -> str:
    case = one.run.case
    return f"{case.label}; {case.choice}" if case.choice else case.label


def _squares(one: Plate) -> str:
    case = one.run.case
    return f"{case.n} x {case.n}, {case.rings} rings" if case.rings else "equal"


def _early(one: Plate) -> float:
    energy = one.run.results.energy()
    return float(np.interp(1.0e-4, energy["time"], energy["metal plasticity"]))


def _middle(one: Plate) -> float:
    return one.face.deflection[np.abs(one.face.place).max(axis=1).argmin()]


def _hourglass(one: Plate) -> str:
    largest = one.run.results.energy()["hourglass"].max() if one.run.case.is_bricks else None
    return "-" if largest is None else f"{largest:.1f}"


COLUMNS = (
    Quantity("model", _words),
    Quantity("core [mm]", lambda one: one.run.case.core, "g"),
    Quantity("squares", _squares),
    Quantity("points apart [mm]", lambda one: one.run.case.spacing, ".3g"),
    Quantity("DOF", lambda one: one.run.effort.dofs, ","),
    Quantity(
        "peak force, 20 µs mean [N]",
        lambda one: impact_numbers(one.run.results).mean_peak_force,
        ".0f",
    ),
    Quantity("plastic dissipation [mJ]", lambda one: one.dissipated, ".1f"),
    Quantity("of it in the first 0.1 ms", _early, ".1f"),
    Quantity("deflection at the end [mm]", _middle, ".3f"),
    Quantity("largest plastic strain [%]", lambda one: one.face.strain.max(), ".1f", 100.0),
    Quantity("hourglass energy [mJ]", _hourglass),
    Quantity("rebound [m/s]", lambda one: one.run.results.impactor()["velocity"][-1], ".2f", 1e-3),
    Quantity("asymmetry [%]", lambda one: asymmetry(one.face), ".2g", 100.0),
    Quantity("lost momentum [%]", lambda one: lost_momentum(one.run.results), ".1g", 100.0),
)


def _families(found: Sequence[Plate]) -> list[list[Plate]]:
    """The layers and the bricks, each from coarse to fine, without other choices."""
    plain = [one for one in found if not one.run.case.choice]
    return [[one for one in plain if one.run.case.label == family] for family in (LAYERS, BRICKS)]


def _finest(family: Sequence[Plate]) -> Plate:
    return min(family, key=lambda one: one.run.case.spacing)


def _for_figures(found: Sequence[Plate]) -> list[tuple[str, Results]]:
    """The paper's layers and bricks, and the finest of both, for figures 6 to 8."""
    names, chosen = [one.name for one in PAPER], []
    for word, family in zip(("LE1", "bricks"), _families(found), strict=True):
        coarse = [one for one in family if one.run.case.name in names]
        chosen += [(f"{word}, Table 4", one.run.results) for one in coarse]
        if family:
            finest = _finest(family).run
            chosen.append((f"{word}, {finest.case.spacing:.2g} mm", finest.results))
    return chosen


def _draw(found: Sequence[Plate], folder: Path) -> Path:
    """What is dissipated over the distance of points, and the faces of the finest meshes."""
    with figure(1, 2, (WIDE, 3.2)) as (drawn, (left, right)):
        for k, own in enumerate(_families(found)):
            if not own:
                continue
            look = look_of(k) | {"linestyle": "none", "marker": "os"[k], "markersize": 4.0}
            spacing = [one.run.case.spacing for one in own]
            left.plot(spacing, [one.dissipated for one in own], label=own[0].run.case.label, **look)
            for one, style in ((own[0], ":"), (_finest(own), "-")):
                case = one.run.case
                look = look_of(k) | {"linestyle": style}
                label = f"{case.label}, {case.spacing:.2g} mm"
                right.plot(*along_y(one.face, "deflection"), label=label, **look)
        left.set(xlabel="Points apart under the ball [mm]", ylabel="Plastic dissipation [mJ]")
        left.set_xscale("log")
        left.set_xticks(TICKS, [f"{tick:g}" for tick in TICKS])
        left.minorticks_off()
        left.set_ylim(bottom=0.0)
        left.legend(loc="lower right")
        right.set(xlabel="y from the middle [mm]", ylabel="Deflection at 0.65 ms [mm]")
        right.set_xlim(-0.5 * SIDE, 0.5 * SIDE)
        right.legend(fontsize=6.5, loc="lower center", bbox_to_anchor=(0.45, 1.0), ncols=2)
        return save(drawn, folder / "bimetal_ladder.png")
