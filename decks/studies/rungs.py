"""The rungs of the ladder: meshes, contact discretisations and orders."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from plydyn_post.results import Results, open_results
from plydyn_pre.recipe import load_recipe

from studies.jobs import ROOT, Job

RECIPES = ROOT / "decks/elastic_impact_ladder"
#: Meshes without a recipe of their own: name, and what is replaced in the recipe of n4
EXTRA = (
    ("n16", ("mesh.n=16", "mesh.rings=8")),
    ("n24", ("mesh.n=24", "mesh.rings=12")),
    *(
        (f"c8_n{n}", ("mesh.core=8", f"mesh.n={n}", f"mesh.rings={n}", "mesh.grading=4"))
        for n in (4, 8, 12, 16)
    ),
)
CONTACTS = ("nodes", "points")
#: The order that meshes are compared with; orders are compared on meshes up to some quads
ORDER, MOST_QUADS = 2, 450
#: Fewer and smaller states than in the recipes, more profiles
OUTPUTS = (
    "outputs.field_interval=1.0",
    "outputs.profiles=[{at=[48.0,48.0],interval=5.0e-6},{at=[40.0,40.0],interval=5.0e-6}]",
)


@dataclass(frozen=True)
class Rung:
    """A mesh with a contact discretisation and an order."""

    job: Job
    case: str  # name of the mesh
    core: float  # side of the core, mm
    quads: int
    spacing: float  # of the points of the plate in the core, mm
    contact: str  # where it is looked for: nodes on the impactor, or points of the plate
    order: int


@dataclass(frozen=True)
class Found:
    """A rung and its results."""

    rung: Rung
    results: Results


def rungs(orders: Sequence[int], overrides: Sequence[str] = ()) -> list[Rung]:
    """All rungs, those with a coarse core first; other orders on the smaller meshes only."""
    found = [
        _rung(case, recipe, (*replaced, *overrides), contact, order)
        for contact in CONTACTS
        for case, recipe, replaced in _meshes(contact)
        for order in orders
    ]
    chosen = [rung for rung in found if rung.order == ORDER or rung.quads <= MOST_QUADS]
    return sorted(
        chosen, key=lambda one: (-one.core, -one.spacing, one.contact != "nodes", one.order)
    )


def _meshes(contact: str) -> list[tuple[str, Path, tuple[str, ...]]]:
    """Name, recipe and what is replaced in it, for all meshes."""
    ending = f"_{contact}.toml"
    own = {path.name.removesuffix(ending): path for path in RECIPES.glob(f"*{ending}")}
    extra = [(name, own["n4"], replaced) for name, replaced in EXTRA if name not in own]
    return [(name, path, ()) for name, path in own.items()] + extra


def _rung(case: str, recipe: Path, replaced: tuple[str, ...], contact: str, order: int) -> Rung:
    replaced = (*replaced, *OUTPUTS, f"laminate.order={order}")
    mesh = load_recipe(recipe, replaced).mesh
    return Rung(
        Job(f"{case}_{contact}_le{order}", recipe, replaced),
        case,
        mesh.core,
        mesh.n**2 + 4 * mesh.n * mesh.rings,
        mesh.core / (2 * mesh.n),
        contact,
        order,
    )


def open_rungs(ladder: Sequence[Rung], folder: Path) -> list[Found]:
    """The results of all rungs."""
    return [Found(rung, open_results(folder / rung.job.name)) for rung in ladder]


def pick(
    found: Sequence[Found], case: str | None = None, contact: str | None = None, order: int = ORDER
) -> list[Found]:
    """Those of a mesh, of a contact discretisation, and of an order."""
    return [
        one
        for one in found
        if one.rung.order == order
        and case in (None, one.rung.case)
        and contact in (None, one.rung.contact)
    ]


def cases(found: Sequence[Found], order: int = ORDER) -> list[str]:
    """The meshes that were run with an order."""
    return list(dict.fromkeys(one.rung.case for one in pick(found, order=order)))
