"""The bimetallic impact on finer and finer meshes: which of layers and bricks has converged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from plydyn_post.curves import read_numbers
from plydyn_post.results import Results, open_results
from plydyn_post.style import WIDE, figure, look_of, save

from studies.bimetal_figures import Face, along_y, read_face
from studies.jobs import ROOT, Job, freedoms_of
from studies.markdown import table

LAYERS, BRICKS = "layers, LE1", "bricks of one point"
#: Side of the plate, mm
SIDE = 100.0
#: Distances of points on the axis of the figure, mm
TICKS = (0.25, 0.5, 1.0, 2.0)


@dataclass(frozen=True)
class Rung:
    """A mesh: its family, its squares of the core, and what else is chosen."""

    family: str
    core: float  # mm, side of the core; that of the plate for equal squares
    n: int  # quads along it
    rings: int = 0
    grading: float = 1.0  # width of the outermost ring over that of the innermost
    choice: str = ""  # words for the table
    overrides: tuple[str, ...] = ()

    @property
    def is_bricks(self) -> bool:
        """Whether the plate is of bricks."""
        return "bricks" in self.family

    @property
    def name(self) -> str:
        """Name of the job."""
        kind = "bricks" if self.is_bricks else "layers"
        words = [kind, f"{self.core:g}", str(self.n), str(self.rings), *self.choice.split()]
        return "_".join(words)

    @property
    def apart(self) -> float:
        """Distance of neighbouring points in the core, mm."""
        return self.core / self.n / (1 if self.is_bricks else 2)

    def job(self, overrides: Sequence[str] = ()) -> Job:
        """The recipe of Table 4 with this mesh."""
        recipe = ROOT / f"decks/bimetal_impact/{'bricks_1' if self.is_bricks else 'le1'}.toml"
        if self.rings == 0:
            mesh = (f"mesh.quads=[{self.n}, {self.n}]",)
        else:
            mesh = (f"mesh.core={self.core}", f"mesh.n={self.n}", f"mesh.rings={self.rings}")
            mesh += (f"mesh.grading={self.grading}",)
            if self.is_bricks:
                mesh += ('mesh.kind="ogrid_square"', f"mesh.side={SIDE}", "mesh.order=1")
        return Job(self.name, recipe, (*mesh, *self.overrides, *overrides))


#: ABQ-Coarse of Table 4
PAPER_BRICKS = Rung(BRICKS, SIDE, 80)
#: From coarse to fine, layers and then bricks, and what else was tried
RUNGS = (
    Rung(LAYERS, 20.0, 4, 2),
    Rung(LAYERS, 20.0, 4, 8),
    Rung(LAYERS, 20.0, 8, 2),
    Rung(LAYERS, 20.0, 8, 4),
    Rung(LAYERS, 20.0, 8, 8),
    Rung(LAYERS, 20.0, 12, 6),
    Rung(LAYERS, 20.0, 16, 4),
    Rung(LAYERS, 8.0, 8, 8, 4.0),
    Rung(LAYERS, 8.0, 16, 12, 4.0),
    Rung(BRICKS, SIDE, 40),
    PAPER_BRICKS,
    Rung(BRICKS, 20.0, 8, 8),
    Rung(BRICKS, 20.0, 16, 8),
    Rung(BRICKS, 20.0, 32, 12),
    Rung(BRICKS, 8.0, 16, 16, 4.0),
    Rung(BRICKS, 8.0, 32, 20, 4.0),
)
#: Other contact, order, hourglass control and points, on meshes of the ladder
CHOICES = (
    Rung(LAYERS, 20.0, 4, 2, choice="LE2", overrides=("laminate.order=2",)),
    Rung(LAYERS, 8.0, 8, 8, 4.0, choice="LE2", overrides=("laminate.order=2",)),
    Rung(
        LAYERS,
        20.0,
        16,
        4,
        choice="points of the plate",
        overrides=('contact.method="points_on_plate"',),
    ),
    Rung(BRICKS, 20.0, 8, 8, choice="QH 1", overrides=("bricks.coefficient=1.0",)),
    Rung(BRICKS, 20.0, 16, 8, choice="QH 1", overrides=("bricks.coefficient=1.0",)),
    Rung(BRICKS, 8.0, 16, 16, 4.0, choice="QH 1", overrides=("bricks.coefficient=1.0",)),
    Rung(BRICKS, 20.0, 8, 8, choice="eight points", overrides=('bricks.points="eight"',)),
)


@dataclass(frozen=True)
class Found:
    """A rung that has run."""

    rung: Rung
    results: Results
    face: Face

    @property
    def dissipated(self) -> float:
        """Energy that plastic flow took, mJ."""
        return float(self.results.energy()["metal plasticity"][-1])


def open_found(folder: Path, rungs: Sequence[Rung]) -> list[Found]:
    """The rungs whose results lie in a folder, whole."""
    found = []
    for rung in rungs:
        listing = folder / f"{rung.name}.out"
        if listing.is_file() and "\nnormal end" in listing.read_text(encoding="utf-8"):
            results = open_results(folder / rung.name)
            found.append(Found(rung, results, read_face(results)))
    return found


def ladder_text(found: Sequence[Found]) -> str:
    """One line for each rung."""
    headings = (
        "model",
        "core [mm]",
        "squares",
        "points apart [mm]",
        "DOF",
        "peak force, 20 µs mean [N]",
        "plastic dissipation [mJ]",
        "of it in the first 0.1 ms",
        "deflection at the end [mm]",
        "largest plastic strain [%]",
        "hourglass energy [mJ]",
        "rebound [m/s]",
        "asymmetry [%]",
        "lost momentum [%]",
    )
    return table(headings, [_cells(one) for one in found])


def _cells(one: Found) -> list[str]:
    """One line of the table."""
    energy, ball = one.results.energy(), one.results.impactor()
    early = float(np.interp(1.0e-4, energy["time"], energy["metal plasticity"]))
    rung = one.rung
    around = "equal" if rung.rings == 0 else f"{rung.n} x {rung.n}, {rung.rings} rings"
    middle = np.abs(one.face.place).max(axis=1).argmin()
    return [
        f"{rung.family}; {rung.choice}" if rung.choice else rung.family,
        f"{rung.core:g}",
        around,
        f"{rung.apart:.3g}",
        f"{freedoms_of(one.results):,}",
        f"{read_numbers(one.results).mean_peak_force:.0f}",
        f"{one.dissipated:.1f}",
        f"{early:.1f}",
        f"{one.face.deflection[middle]:.3f}",
        f"{100.0 * one.face.strain.max():.1f}",
        f"{energy['hourglass'].max():.1f}" if rung.is_bricks else "-",
        f"{1e-3 * ball['velocity'][-1]:.2f}",
        f"{100.0 * asymmetry(one.face):.2g}",
        f"{100.0 * lost_momentum(ball, energy):.1g}",
    ]


def asymmetry(face: Face) -> float:
    """Largest difference of deflection between places that mirror each other, over the largest."""
    keys = np.round(face.place / (1e-6 * np.ptp(face.place))).astype(np.int64)
    own = {tuple(key): value for key, value in zip(keys.tolist(), face.deflection, strict=True)}
    mirrors = ((-1, 1, False), (1, -1, False), (1, 1, True))
    worst = 0.0
    for (x, y), value in own.items():
        for a, b, swapped in mirrors:
            place = (b * y, a * x) if swapped else (a * x, b * y)
            if place in own:
                worst = max(worst, abs(own[place] - value))
    return float(worst / np.abs(face.deflection).max())


def lost_momentum(ball: dict[str, np.ndarray], energy: dict[str, np.ndarray]) -> float:
    """Impulse of the force less the momentum of the ball, over that it came with."""
    mass = 2.0 * energy["impactor"][0] / ball["velocity"][0] ** 2
    gained = mass * (ball["velocity"][-1] - ball["velocity"][0])
    pushed = np.trapezoid(ball["force"], ball["time"])
    return float(abs(gained - pushed) / (mass * abs(ball["velocity"][0])))


def for_figures(found: Sequence[Found]) -> list[tuple[str, Results]]:
    """The paper's layers and bricks, and the finest of both, for figures 6 to 8."""
    chosen = []
    for family, word in ((LAYERS, "LE1"), (BRICKS, "bricks")):
        own = [one for one in found if one.rung.family == family and not one.rung.choice]
        coarse = [one for one in own if one.rung in (RUNGS[0], PAPER_BRICKS)]
        chosen += [(f"{word}, Table 4", one.results) for one in coarse]
        if own:
            finest = min(own, key=lambda one: one.rung.apart)
            chosen.append((f"{word}, {finest.rung.apart:.2g} mm", finest.results))
    return chosen


def draw_ladder(found: Sequence[Found], folder: Path) -> Path:
    """What is dissipated over the distance of points, and the faces of the finest meshes."""
    with figure(1, 2, (WIDE, 3.2)) as (drawn, (left, right)):
        for k, family in enumerate((LAYERS, BRICKS)):
            own = [one for one in found if one.rung.family == family and not one.rung.choice]
            if not own:
                continue
            apart = [one.rung.apart for one in own]
            look = look_of(k) | {"linestyle": "none", "marker": "os"[k], "markersize": 4.0}
            left.plot(apart, [one.dissipated for one in own], label=family, **look)
            finest = min(own, key=lambda one: one.rung.apart)
            for one, style in ((own[0], ":"), (finest, "-")):
                place, value = along_y(one.face, "deflection")
                look = look_of(k) | {"linestyle": style}
                right.plot(place, value, label=f"{family}, {one.rung.apart:.2g} mm", **look)
        _finish(left, right)
        return save(drawn, folder / "bimetal_ladder.png")


def _finish(left: Axes, right: Axes) -> None:
    """Scales, words and keys of both pictures."""
    left.set(xlabel="Points apart under the ball [mm]", ylabel="Plastic dissipation [mJ]")
    left.set_xscale("log")
    left.set_xticks(TICKS, [f"{tick:g}" for tick in TICKS])
    left.minorticks_off()
    left.set_ylim(bottom=0.0)
    left.legend(loc="lower right")
    right.set(xlabel="y from the middle [mm]", ylabel="Deflection at 0.65 ms [mm]")
    right.set_xlim(-0.5 * SIDE, 0.5 * SIDE)
    right.legend(fontsize=6.5, loc="lower center", bbox_to_anchor=(0.45, 1.0), ncols=2)
