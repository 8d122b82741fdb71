"""The elastic impact on finer and finer meshes, with both contact discretisations and orders.

The yardstick is the mesh graded from the middle to the edges with the smallest quads.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from matplotlib.axes import Axes

from plydyn_post.profile import draw_profiles, read_profiles
from plydyn_post.style import COLOURS, WIDE, figure, legend_above, save
from plydyn_pre.mesh.lines import graded_line
from plydyn_pre.mesh.ogrid import OgridSquare
from plydyn_pre.mesh.rectangle import Rectangle
from readings import differences
from readings.profiles import JUMP, LARGEST, MEANS, SIZE, WHOLE, agreements
from runner.cases import ROOT, Case, RunOf, StudyError
from runner.commands import Study, command
from runner.pages import Page, Quantity, Section, percent, table, tabulate
from studies.stress import OUTPUTS

FOLDER = "elastic_impact_ladder"
#: Meshes without a recipe of their own: name, recipe, and what is replaced there
EXTRA = {
    "n24": ("n4", ("mesh.n=24", "mesh.rings=12")),
    **{
        f"c8_n{n}": ("n4", ("mesh.core=8", f"mesh.n={n}", f"mesh.rings={n}", "mesh.grading=4"))
        for n in (4, 8, 12, 16)
    },
    **{f"g{n}": ("g44", (f"mesh.quads=[{n},{n}]",)) for n in (22, 32)},
}
#: Where contact is looked for, with its words in figures
CONTACTS = {"nodes": "nodes on the impactor", "points": "points of the plate"}
#: The order that meshes are compared with, as forces do not depend on it; orders are compared on
#: meshes up to some quads
ORDER, MOST_QUADS = 1, 450
#: Times between which the mean force has its two largest maxima, s
FIRST, SECOND = (240e-6, 300e-6), (310e-6, 370e-6)


@dataclass(frozen=True)
class MeshCase(Case):
    """A mesh with a contact discretisation and an order."""

    mesh: str = ""
    contact: str = "nodes"
    order: int = ORDER

    @property
    def squares(self) -> Rectangle | OgridSquare:
        """The mesh of its recipe, graded or with a core."""
        mesh = self.model.mesh
        if not isinstance(mesh, Rectangle | OgridSquare):
            raise TypeError(f"{self.recipe}: the mesh is no square")
        return mesh

    @property
    def core(self) -> float:
        """Side of the core, mm; 0 of a graded mesh, which has none."""
        mesh = self.squares
        return 0.0 if isinstance(mesh, Rectangle) else mesh.core

    @property
    def quads(self) -> int:
        """All quads."""
        mesh = self.squares
        if isinstance(mesh, Rectangle):
            return mesh.quads[0] * mesh.quads[1]
        return mesh.n**2 + 4 * mesh.n * mesh.rings

    @property
    def spacing(self) -> float:
        """Least distance of the points of the plate, mm."""
        mesh = self.squares
        if isinstance(mesh, Rectangle):
            line = graded_line(0.5 * mesh.sides[0], mesh.quads[0] // 2, mesh.grading)
            return 0.5 * float(line[1])
        return self.core / (2 * mesh.n)


Run = RunOf[MeshCase]


@command()
def converge(
    orders: Annotated[str, typer.Option(help="Orders through a ply.")] = "1,2,3",
    meshes: Annotated[str, typer.Option(help="Meshes, such as n4,n12,g44; all if none.")] = "",
) -> Study:
    """Finer meshes, both contact discretisations and orders; takes about an hour."""
    wanted = sorted(int(order) for order in orders.split(","))
    if ORDER not in wanted:
        raise StudyError(f"meshes are compared with order {ORDER}; --orders must name it")
    chosen = [case for case in mesh_cases(wanted) if case.mesh in (meshes or case.mesh).split(",")]
    if not chosen:
        raise StudyError(f"no mesh is called {meshes}")
    return Study(chosen, lambda runs, folder: _report(runs, wanted, folder), True)


def mesh_cases(orders: Sequence[int]) -> list[MeshCase]:
    """All cases, those with a large core first; other orders on the smaller meshes only."""
    found = []
    for contact in CONTACTS:
        ending = f"_{contact}.toml"
        own = {path.name.removesuffix(ending) for path in _recipes().glob(f"*{ending}")}
        meshes: dict[str, tuple[str, tuple[str, ...]]]
        meshes = {name: (name, ()) for name in sorted(own)} | EXTRA
        found += [
            MeshCase(
                f"{name}_{contact}_le{order}",
                f"{FOLDER}/{recipe}_{contact}",
                varied=(*mesh, f"laminate.order={order}"),
                common=OUTPUTS,
                mesh=name,
                contact=contact,
                order=order,
            )
            for name, (recipe, mesh) in meshes.items()
            for order in orders
        ]
    chosen = [one for one in found if one.order == ORDER or one.quads <= MOST_QUADS]
    return sorted(
        chosen, key=lambda one: (-one.core, -one.spacing, one.contact != "nodes", one.order)
    )


def _recipes() -> Path:
    return ROOT / "decks" / FOLDER


def pick(
    runs: Sequence[Run], mesh: str | None = None, contact: str | None = None, order: int = ORDER
) -> list[Run]:
    """Those of a mesh, of a contact discretisation, and of an order."""
    return [
        run
        for run in runs
        if run.case.order == order
        and mesh in (None, run.case.mesh)
        and contact in (None, run.case.contact)
    ]


def meshes_of(runs: Sequence[Run], orders: Sequence[int] = (ORDER,)) -> list[str]:
    """The meshes that were run with some orders."""
    found = dict.fromkeys(run.case.mesh for run in runs)
    return [mesh for mesh in found if all(pick(runs, mesh, order=order) for order in orders)]


def _report(runs: list[Run], orders: Sequence[int], folder: Path) -> list[Page]:
    sections = [
        Section("Numbers", tabulate(NUMBERS, pick(runs)), "numbers"),
        Section("Meshes and contact", _meshes_text(runs), "meshes and contact"),
    ]
    if len(orders) > 1:
        sections.append(Section("Orders", _orders_text(runs, orders), "orders"))
    return [Page("converge", sections, _draw(runs, orders, folder))]


def _number(heading: str, name: str, form: str, scale: float = 1) -> Quantity:
    """A number of the impact by its name in the postprocessor."""
    numbers = differences.impact_numbers
    return Quantity(heading, lambda run: getattr(numbers(run.results), name), form, scale)


def _rebound(run: Run) -> str:
    speed = differences.impact_numbers(run.results).rebound_velocity
    return "in contact" if speed is None else f"{1e-3 * speed:.3f}"


def _largest(run: Run, window: tuple[float, float]) -> str:
    """The largest mean force within a window of time, and when."""
    time, force = differences.mean_force(run.results)
    within = np.flatnonzero((time >= window[0]) & (time <= window[1]))
    peak = within[np.argmax(force[within])]
    return f"{force[peak]:.0f} at {1e6 * time[peak]:.0f}"


#: What an analyst reads off each run
NUMBERS = (
    Quantity("mesh and contact", lambda run: f"{run.case.mesh}_{run.case.contact}"),
    Quantity("quads", lambda run: run.case.quads, ","),
    Quantity("DOF", lambda run: run.effort.dofs, ","),
    Quantity("points apart [mm]", lambda run: run.case.spacing, ".3g"),
    Quantity("most in contact", lambda run: run.results.impactor()["contacts"].max(), ".0f"),
    _number("peak force, raw [N]", "peak_force", ".0f"),
    Quantity("plateau, 20 µs mean [N at µs]", lambda run: _largest(run, (0, differences.PLATEAU))),
    Quantity("first maximum", lambda run: _largest(run, FIRST)),
    Quantity("second maximum", lambda run: _largest(run, SECOND)),
    _number("duration [ms]", "contact_duration", ".3f", 1e3),
    _number("displacement [mm]", "largest_displacement", ".3f"),
    Quantity("rebound [m/s]", _rebound),
    _number("energy error [-]", "energy_error", ".0e"),
)


def _meshes_text(runs: Sequence[Run]) -> str:
    """Differences to the finest run, and between both contact discretisations on each mesh."""
    finest = pick(runs)[-1]
    headings = [f"mesh; to {finest.case.mesh}_{finest.case.contact}", "points apart [mm]"]
    for pair in (*CONTACTS, "points to nodes"):
        headings += [f"{pair}: force, L2", "force, largest", "velocity"]
    rows = []
    for mesh in meshes_of(runs):
        nodes, points = (pick(runs, mesh, contact)[0] for contact in CONTACTS)
        pairs = ((nodes, finest), (points, finest), (points, nodes))
        texts = [text for ours, theirs in pairs for text in _differences(ours, theirs)]
        rows.append([mesh, f"{nodes.case.spacing:.3g}", *texts])
    return table(headings, rows)


def _differences(one: Run, other: Run) -> list[str]:
    """Differences in force over the run, at any time, and in velocity, in print."""
    if one is other:
        return ["0"] * 3
    ours, theirs = one.results, other.results
    shares = (
        differences.force_difference(ours, theirs),
        differences.largest_force_difference(ours, theirs),
        differences.velocity_difference(ours, theirs),
    )
    return [percent(share) for share in shares]


def _orders_text(runs: Sequence[Run], orders: Sequence[int]) -> str:
    """Differences of lower orders to the highest: force and velocity, and shear at (40, 40)."""
    best = f"LE{max(orders)}"
    shear = (LARGEST, SIZE, WHOLE, MEANS, JUMP)
    headings = [f"mesh and contact; to {best}", "order", "force, L2", "force, largest", "velocity"]
    headings += ["syz at (40, 40): largest", *(one.heading for one in shear[1:])]
    rows = []
    for mesh in meshes_of(runs, orders):
        for contact in CONTACTS:
            own = {f"LE{order}": pick(runs, mesh, contact, order)[0] for order in orders}
            results = {name: run.results for name, run in own.items()}
            for one in agreements(results, best, 2, "syz"):
                cells = [*_differences(own[one.name], own[best]), *(it.cell(one) for it in shear)]
                rows.append([f"{mesh}_{contact}", one.name, *cells])
    return table(headings, rows)


def _draw(runs: Sequence[Run], orders: Sequence[int], folder: Path) -> list[Path]:
    """Forces over each other, differences over the mesh, and shear of the orders."""
    cores = sorted({run.case.core for run in runs}, reverse=True)
    meshes: dict[str, dict[str, Run]] = {}
    contacts: dict[str, dict[str, Run]] = {}
    compared: dict[str, dict[str, Run]] = {}
    for core in cores:
        for contact, words in CONTACTS.items():
            own = [run for run in pick(runs, contact=contact) if run.case.core == core]
            meshes[f"{words}, core {core:g} mm" if core else f"{words}, graded"] = {
                run.case.mesh: run for run in own
            }
    for mesh in meshes_of(runs):
        nodes, points = (pick(runs, mesh, contact)[0] for contact in CONTACTS)
        title = f"{mesh}, points {nodes.case.spacing:.2g} mm apart"
        contacts[title] = dict(zip(CONTACTS.values(), (nodes, points), strict=True))
    for mesh in meshes_of(runs, orders):
        compared[f"{mesh}, {CONTACTS['nodes']}"] = {
            f"LE{order}": pick(runs, mesh, "nodes", order)[0] for order in orders
        }
    finest = [run.results for run in list(compared.values())[-1].values()]
    shear = read_profiles(finest, 2, differences.peak_time(finest[-1]))
    orders_of_shear = folder / "shear_orders.png"
    draw_profiles(shear, ("sxz", "syz"), orders_of_shear)
    return [
        differences.draw_panels(meshes, 2, folder / "force_meshes.png"),
        differences.draw_panels(contacts, 3, folder / "force_contacts.png"),
        differences.draw_panels(compared, 3, folder / "force_orders.png"),
        _draw_differences(runs, cores, folder / "differences.png"),
        orders_of_shear,
    ]


def _draw_differences(runs: Sequence[Run], cores: Sequence[float], path: Path) -> Path:
    """Differences of the mean force over the distance of points, a panel for each core."""
    finest = pick(runs)[-1]
    with figure(1, len(cores), size=(WIDE, 3.2), sharey=True, squeeze=False) as (made, grid):
        for axes, core in zip(grid[0], cores, strict=True):
            own = [run for run in pick(runs) if run.case.core == core]
            for place, (contact, words) in enumerate(CONTACTS.items()):
                pairs = [(one, finest) for one in pick(own, contact=contact) if one is not finest]
                _plot_differences(axes, pairs, f"{words}, to the finest", place)
            pairs = [(its[0], its[1]) for its in (pick(own, mesh) for mesh in meshes_of(own))]
            _plot_differences(axes, pairs, "one to the other on the same mesh", 2)
            axes.set(xlabel="Distance of points in the core [mm]", ylim=(0.0, None))
            axes.set_title(f"core {core:g} mm" if core else "graded", fontsize=8.5, loc="left")
            axes.set_xlim(left=0.0)
        grid[0][0].set_ylabel("Force, relative L2 [%]")
        legend_above(made, grid[0][0])
        return save(made, path)


def _plot_differences(axes: Axes, pairs: Sequence[tuple[Run, Run]], label: str, place: int) -> None:
    shares = [100.0 * differences.force_difference(one.results, its.results) for one, its in pairs]
    spacing = [one.case.spacing for one, _ in pairs]
    axes.plot(spacing, shares, "os^"[place] + "-", label=label, color=COLOURS[place], markersize=4)
