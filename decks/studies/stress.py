"""Stress through the thickness of the elastic plate: the paper's figures 4 and 5."""

from __future__ import annotations

from pathlib import Path

from plydyn_post.profile import INTERLAMINAR, draw_profiles, read_profiles
from plydyn_post.results import Results
from readings.differences import peak_time
from readings.profiles import END, JUMP, LARGEST, MEANS, NAME, PEAK, SIZE, WHOLE, agreements
from runner.cases import Case, Run
from runner.commands import Study, command
from runner.pages import Page, Quantity, Section, tabulate

#: Models of the paper's figures; the one that the others are compared with
MODELS, REFERENCE = ("le1", "le2", "le3", "3le1"), "le3"
#: Fewer and smaller states than in the recipes, more profiles
OUTPUTS = (
    "outputs.field_interval=1.0",
    "outputs.profiles=[{at=[48.0,48.0],interval=5.0e-6},{at=[40.0,40.0],interval=5.0e-6}]",
)
#: Number of the profile, its place, component: figures 4a, 4b and 5
SHOWN = ((1, "(48, 48)", "sxx", "4a"), (1, "(48, 48)", "sxy", "4b"), (2, "(40, 40)", "syz", "5"))
#: Number of the profile, components and name of each picture
FIGURES = ((1, ("sxx", "sxy"), "figure_4_at_48_48"), (2, ("sxz", "syz"), "figure_5_at_40_40"))


@command()
def profiles() -> Study:
    """Stress through the thickness: the paper's figures 4 and 5 in numbers."""
    cases = [Case(name, f"elastic_impact/{name}", common=OUTPUTS) for name in MODELS]
    return Study(cases, _report, needs_all=True)


def _report(runs: list[Run], folder: Path) -> list[Page]:
    found = {run.case.name: run.results for run in runs}
    time = peak_time(found[REFERENCE])
    drawn = [folder / f"{name}.png" for *_, name in FIGURES]
    for (number, names, _), path in zip(FIGURES, drawn, strict=True):
        draw_profiles(read_profiles(list(found.values()), number, time), names, path)
    pictures = {f"elastic_{one.name}": one for one in drawn}
    return [Page("profiles", [Section("Profiles", _text(found), "profiles")], drawn, pictures)]


def _text(found: dict[str, Results]) -> str:
    """One table for each of the figures; jumps only of components that should have none."""
    name, time = REFERENCE.upper(), peak_time(found[REFERENCE])
    parts = [
        f"At {1e6 * time:.0f} µs, the peak of the 20 µs mean of the contact force of {name}."
        f" Differences are to {name}: the largest as a share of its largest stress, relative L2 as"
        " a share of its size through the thickness, or through the thickness and all instants.\n"
    ]
    for number, place, component, figure in SHOWN:
        columns: tuple[Quantity, ...] = (NAME, PEAK, LARGEST, SIZE, WHOLE, MEANS)
        columns += (JUMP, END) if component in INTERLAMINAR else ()
        parts.append(f"Figure {figure}, `{component}` at {place}:\n")
        parts.append(tabulate(columns, agreements(found, REFERENCE, number, component)))
    return "\n".join(parts)
