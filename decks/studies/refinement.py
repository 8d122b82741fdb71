"""The damage impact on finer and finer meshes, and why these differ."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from plydyn_post.style import WIDE, figure, look_of, save
from plydyn_pre.mesh.ogrid import OgridDisc, OgridSquare
from readings import damage
from runner.cases import Case, Run, StudyError, made_by
from runner.commands import Study, command
from runner.pages import Page, Quantity, Section, change, one_section, table, tabulate

#: The meshes of the page: recipe, and quads along the core
PAGE = {"quarter": (8, 12, 16, 24, 32, 48), "quarter_elastic": (12, 16, 24)}
MESH = Quantity("model", lambda one: damage.mesh_words(one.run.case))


@command()
def refine(
    model: Annotated[str, typer.Option(help="Recipe; without it those of the page.")] = "",
    sizes: Annotated[
        str, typer.Option("--n", help="Quads along the core, by commas; else those of the page.")
    ] = "",
) -> Study:
    """Finer and finer meshes, rings in proportion, until force, areas and energies settle."""
    cases = [
        case for name, numbers in pick(model, sizes).items() for case in refined(name, numbers)
    ]
    return Study(cases, _report, work=work)


def pick(model: str, sizes: str) -> dict[str, tuple[int, ...]]:
    """The meshes of a recipe with some n, by commas; without them those of the page."""
    found = {name: own for name, own in PAGE.items() if model in ("", name)}
    numbers = tuple(sorted({int(number) for number in sizes.split(",") if number.strip()}))
    if numbers and numbers[0] < 2:
        raise StudyError("--n must name numbers of quads of 2 and more")
    if not found and not numbers:
        raise StudyError(f"{model} has no meshes on the page; --n must name numbers of quads")
    return dict.fromkeys(found or [model], numbers) if numbers else found


def refined(model: str, sizes: Sequence[int]) -> list[Case]:
    """A recipe with n x n quads in the core and n / 2 rings, from the coarsest on."""
    return [Case(f"{model}_n{n}", f"damage_impact/{model}", varied=mesh_of(n)) for n in sizes]


def mesh_of(n: int) -> tuple[str, str]:
    """Values that make a mesh with n x n quads in the core."""
    return f"mesh.n={n}", f"mesh.rings={max(2, n // 2)}"


def work(case: Case) -> float:
    """How much work a run is beside others: more quads, and shorter steps the smaller they are."""
    mesh = case.model.mesh
    if not isinstance(mesh, OgridSquare | OgridDisc):
        raise StudyError(f"{case.recipe}: the mesh has no rings around a core")
    return case.model.share * (mesh.n**2 + 4 * mesh.n * mesh.rings) * mesh.n / mesh.core


def _report(runs: list[Run], folder: Path) -> list[Page]:
    pages = []
    for recipe in dict.fromkeys(run.case.recipe for run in runs):
        own, name = [run for run in runs if run.case.recipe == recipe], Path(recipe).name
        found, mark = [damage.read_impact(run) for run in own], f"{name} refinement"
        sections = [
            Section("Refinement", damage.impacts_text(found, MESH), mark),
            Section("Areas", damage.areas_text(found, MESH), mark),
            Section("Changes", changes_text(found), mark),
            Section("Builds", made_by(own), mark),
        ]
        figures = [_draw(found, folder / f"{name}.png")]
        figures += damage.draw_forces(own, folder / f"{name}_force.png", label=damage.mesh_words)
        pages.append(Page(name, sections, figures))
    return pages


ENERGIES = dict(zip(("delamination", "matrix", "shear", "fibres"), damage.DISSIPATED, strict=True))
#: The numbers that must settle
SETTLING = {
    "peak force": damage.PEAK,
    "displacement": damage.DISPLACEMENT,
    "projected area": damage.PROJECTED,
    "all interfaces": damage.TOTAL,
    "energy of delamination": ENERGIES["delamination"],
    **{f"of {name}": ENERGIES[name] for name in ("matrix", "shear", "fibres")},
    "dissipated in all": damage.DISSIPATED_SUM,
}


def changes_text(found: Sequence[damage.Impact]) -> str:
    """How each number changes from a mesh to the next."""
    steps = list(itertools.pairwise(found))
    sizes = [[damage.core_size(one.run.case) for one in step] for step in steps]
    headings = [f"{before:.3g} to {after:.3g} mm" for before, after in sizes]
    rows = [
        [name, *(change(it.value(after), it.value(before)) for before, after in steps)]
        for name, it in SETTLING.items()
    ]
    return table(("change", *headings), rows)


def _draw(found: Sequence[damage.Impact], path: Path) -> Path:
    """Peak force, areas and energies over the size of the quads in the core."""
    panels = {
        "Force, 20 µs mean [N]": {"peak": damage.PEAK},
        "Delaminated area [mm²]": {"projected": damage.PROJECTED, "all interfaces": damage.TOTAL},
        "Dissipated energy [J]": ENERGIES,
    }
    size = [damage.core_size(one.run.case) for one in found]
    with figure(1, 3, size=(WIDE, 2.7)) as (made, grid):
        for axes, (heading, curves) in zip(grid, panels.items(), strict=True):
            for place, (label, quantity) in enumerate(curves.items()):
                look = look_of(place) | {"marker": "o", "markersize": 3.5}
                axes.plot(size, [quantity.value(one) for one in found], label=label, **look)
            axes.set_ylabel(heading)
            axes.set_xlabel("Quads of the core [mm]")
            axes.set_ylim(bottom=0.0)
            axes.set_xlim(left=0.0)
            axes.legend(fontsize=7)
        return save(made, path)


#: What the variants change of the quarter
WHOLE = ("mesh.quarter=false",)
LARGE_CORE = ("mesh.core=36", "mesh.rings=8")
REDUCED = ("materials.hts40_9772.snap_back=reduce",)
FITTED = ("materials.interface.fit=strengths",)


def _variant(name: str, label: str, n: int, varied: tuple[str, ...]) -> Case:
    """A mesh of a quarter with n x n quads in the core, and what is different."""
    return Case(f"{name}_n{n}", "damage_impact/quarter", label, (*mesh_of(n), *varied))


VARIANTS = (
    _variant("whole", "the whole disc", 12, WHOLE),
    _variant("whole", "the whole disc", 24, WHOLE),
    _variant("whole_core_36", "the whole disc, core of 36 mm", 36, (*WHOLE, *LARGE_CORE)),
    _variant("core_36", "core of 36 mm", 36, LARGE_CORE),
    *(_variant("reduced", "strength is reduced to the band", n, REDUCED) for n in (12, 16, 24)),
    _variant("fitted", "strengths of interfaces fit the mesh", 12, FITTED),
)


@command()
def variants() -> Study:
    """Why meshes differ: whole discs, a larger core, lower strengths on some of the meshes."""
    return Study(VARIANTS, one_section("Variants", _variants), work=work)


def _variants(runs: list[Run]) -> str:
    return f"{variants_text([damage.read_impact(run) for run in runs])}\n{made_by(runs)}"


def _each(one: damage.Impact) -> str:
    return ", ".join(f"{area:.0f}" for area in one.interfaces.values())


def variants_text(found: Sequence[damage.Impact]) -> str:
    """Peak and areas of the variants."""
    columns = (
        Quantity("mesh", lambda one: damage.mesh_words(one.run.case)),
        Quantity("what is different", lambda one: one.label),
        *(damage.PEAK, damage.DISPLACEMENT, damage.PROJECTED, damage.TOTAL),
        Quantity("interfaces from the lowest up [mm2]", _each),
    )
    return tabulate(columns, found)
