"""Strength after impact with cracks as lines: a prediction that is frozen before it is compared."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from plydyn_post.areas import damaged_areas
from plydyn_post.compression import Compression, read_compression
from plydyn_post.delamination import draw_delamination
from plydyn_post.ending import ending_words, read_ending
from plydyn_post.numbers import LATER, compare
from plydyn_post.results import Results, open_results
from plydyn_post.sublaminate_figures import draw_sublaminates
from readings import damage
from readings.damage import Impact
from runner.cases import Case, Run, StudyError, made_by
from runner.commands import Study, command
from runner.pages import NOTHING, Page, Section, change, one_section, percent, table

#: The chain, and T700/M21 in place of T700GC/M21
RECIPE, STAGES = "validation/t700gc_25J_cracks_cai", ("settle", "compression")
T700 = (
    "materials.ply.like=T700/M21",
    "materials.struck.like=T700/M21 3D",
    "materials.bond.like=T700/M21 interface",
)
#: How names of pristine plates end, and their first run, before the impactor meets them
WHOLE, UNTOUCHED = "_whole", "control.end_time=1.0e-5"


def _chain(name: str, label: str, *varied: str) -> Case:
    """An impact and the compression after it."""
    return Case(name, RECIPE, label, varied, stages=STAGES)


def _struck(name: str, energy: float) -> Case:
    """An impact of some energy [J] on T700/M21."""
    return _chain(name, f"T700/M21, {energy:g} J", *T700, f"impactor.energy={1e3 * energy:g}")


def _other(case: Case, name: str, how: str, *varied: str) -> Case:
    """A case with other values of its recipe, and how that is put in words."""
    return replace(case, name=name, label=f"{case.label}, {how}", varied=(*case.varied, *varied))


HARDEST = _struck("cai_29J", 29.5)
CASES = (
    HARDEST,
    _struck("cai_17J", 17.0),
    _struck("cai_6J", 6.5),
    _chain(f"cai{WHOLE}", "T700/M21, pristine", *T700, UNTOUCHED),
)
COARSE = "mesh.quad=2"
COARSER = _other(HARDEST, "cai_29J_coarse", "quads of 2 mm", COARSE)
#: What the mesh does to the strength after the hardest impact
LEVELS = (HARDEST, COARSER)
#: What the rate of the compression does to it, and a stress that crushed fibres keep: the share of
#: the strength at which kink bands broaden (Vogler and Kyriakides, 1999)
SLOWER = "stages[2].loads[1].value=-250", "stages[2].end_time=7.0e-3"
KEPT = [f"materials.{ply}.{key}" for ply in ("ply", "struck") for key in ("plateau=0.4", "FXC=1")]
DEPENDS = (
    COARSER,
    _other(COARSER, "cai_29J_slow", "compressed at 250 mm/s", *SLOWER),
    _other(COARSER, "cai_29J_kept", "crushed fibres on one line, which keep 0.4", *KEPT),
)

#: Thin plies on a plate of 6 x 4 inches, ASTM D7136 and D7137
PLATE = "validation/as4_8552_30J_cai"
#: Strengths of interfaces lowered by one factor, as the recipe had them first
ONE_FACTOR, BY_ONE = ("materials.bond.fit=core",), "interfaces by one factor"


def _im7(name: str, layup: str, thickness: float, energy: float) -> Case:
    """A plate of IM7/8552 of 190 g/m2 in place of AS4/8552; energy in J."""
    ply = "IM7/8552 190 gsm"
    varied = (
        f"materials.ply.like={ply}",
        f"materials.struck.like={ply}",
        f"materials.bond.like={ply} interface",
        f"laminate.layup={layup}",
        f"laminate.thickness={thickness:g}",
        f"impactor.energy={1e3 * energy:g}",
    )
    return Case(name, PLATE, f"{ply} {layup}, {energy:g} J", (*varied, COARSE), stages=STAGES)


THINNER = _im7("im7_54J_modes", "[45/0/-45/90]4s", 0.1906, 54.2)
THICKER = _im7("im7_68J_modes", "[45/0/90/0/-45/0/45/0/-45/0]2s", 0.1905, 67.8)
PLATES = (
    _other(THINNER, "im7_54J", BY_ONE, *ONE_FACTOR),
    _other(THICKER, "im7_68J", BY_ONE, *ONE_FACTOR),
    THINNER,
    THICKER,
)

#: The coupons of NCAMP, and what their strengths were after 30 J [MPa]
#: (NCAMP CAM-RP-2010-002 Rev A, 2011, 4.31)
COUPONS = (177.65, 181.93, 176.46, 175.06, 172.80, 178.48, 171.18)
AS4 = "AS4/8552 [45/0/-45/90]3s"
#: A pair of strengths of interfaces [MPa] that was tried before each mode had a rule of its own
TRIED = tuple(f"materials.bond.{each}" for each in ("fit=none", "N=33.3", "S=50"))
#: A strength of opening of the size that thin sublaminates ask for on these quads
#: (tests/verification/delamination/thin_arms.py), and that of sliding which the recipe comes to
OPENED = tuple(f"materials.bond.{each}" for each in ("fit=none", "N=5", "S=54.6"))
STRUCK = Case("as4_30J_modes", PLATE, f"{AS4}, 30 J", (COARSE,), stages=STAGES)
NCAMP = (
    STRUCK,
    _other(STRUCK, "as4_30J_stronger", "interfaces of 33 and 50 MPa", *TRIED),
    _other(STRUCK, "as4_30J_soft", "interfaces that open at 5 MPa", *OPENED),
    _other(STRUCK, "as4_30J_coarse", BY_ONE, *ONE_FACTOR),
    Case(f"as4{WHOLE}", PLATE, f"{AS4}, pristine", (COARSE, UNTOUCHED), threads=2, stages=STAGES),
    Case("as4_30J", PLATE, f"{AS4}, 30 J, quads of 1.5 mm", stages=STAGES),
)


@command()
def third() -> Study:
    """Impacts and compression after them with crack lines, for manual/validation.md; run once."""
    return Study(CASES, _pictured("third", "The third prediction"))


@command()
def levels() -> Study:
    """The hardest impact of the third prediction, and compression, on two meshes; an hour."""
    return Study(LEVELS, one_section("The third prediction on two meshes", _text, "levels"))


@command()
def depends() -> Study:
    """The same on the coarser quads, compressed more slowly, and with a plateau; hours."""
    return Study(DEPENDS, one_section("Rate and plateau", _text, "depends"))


@command()
def plates() -> Study:
    """The same of plates of 32 and 40 thin plies on quads of 2 mm; hours for each."""
    return Study(PLATES, _pictured("plates", "Plates of thin plies"))


@command()
def ncamp() -> Study:
    """A plate of 24 thin plies beside coupons, on quads of 2 and 1.5 mm; hours."""
    return Study(NCAMP, _beside)


def _beside(runs: list[Run], folder: Path) -> list[Page]:
    """The tables, and the strengths of struck plates over that of the coupons."""
    mean, lowest, highest = float(np.mean(COUPONS)), min(COUPONS), max(COUPONS)
    struck = [run for run in runs if not _is_whole(run)]
    if not struck:
        raise StudyError("no struck plate has run")
    strengths = [read_compression(run.results).strength for run in struck]
    words = (
        f"{len(COUPONS)} coupons had {mean:.0f} MPa in the mean ({lowest:.0f} to {highest:.0f}): "
        f"computed {', '.join(change(each, mean) for each in strengths)}."
    )
    text = f"{_text(runs)}\n{words}\n"
    return [_page("ncamp", "Strength after 30 J beside coupons", text, struck[0], folder)]


def _text(runs: list[Run]) -> str:
    """Tables of impacts and strengths."""
    return f"{impacts_text(runs)}\n{strengths_text(runs)}\n{made_by(runs)}"


def _pictured(name: str, heading: str) -> Callable[[list[Run], Path], list[Page]]:
    """A report of one page: the tables, and pictures of the first chain."""
    return lambda runs, folder: [_page(name, heading, _text(runs), runs[0], folder)]


def _page(name: str, heading: str, text: str, run: Run, folder: Path) -> Page:
    """A section with pictures of one chain: interfaces, and sublaminates at the strength."""
    figures = [folder / f"{name}_{kind}.png" for kind in ("interfaces", "sublaminates")]
    draw_delamination(_job(run, run.case.name), figures[0])
    draw_sublaminates(read_compression(run.results), np.zeros(2), figures[1])
    pictures = {figure.name: figure for figure in figures}
    return Page(name, [Section(heading, text, name)], figures, pictures)


def _job(run: Run, name: str) -> Results:
    """One of the jobs of a chain."""
    return open_results(run.results.folder / name)


def impacts_text(runs: Sequence[Run]) -> str:
    """What the impacts of the chains came to, with both areas and the dent after the settling."""
    headings = (
        "test",
        "peak force [kN]",
        "at [ms]",
        "contact [ms]",
        "displacement [mm]",
        "absorbed [J]",
        "projected area [mm2]",
        "by damage of 0.99 [mm2]",
        "dent after settling [mm]",
    )
    return table(headings, [_impact(run) for run in runs if not _is_whole(run)])


def _is_whole(run: Run) -> bool:
    """Whether a plate was not struck."""
    return run.case.name.endswith(WHOLE)


def _impact(run: Run) -> list[str]:
    """The first two jobs of a chain."""
    job, settled = (_job(run, name) for name in run.case.jobs[:2])
    one: Impact = damage.read_impact(Run(run.case, run.effort, job))
    ends = [None if one.duration is None else 1e3 * one.duration]
    ends += [one.displacement, None if one.absorbed is None else one.absorbed / 1e3]
    later = [row for row in compare([job, settled]).rows if row.name == LATER]
    areas = [one.projected, damaged_areas(job).projected]
    numbers = [one.peak / 1e3, 1e3 * one.peak_time, *ends, *areas, later[0].values[0]]
    return [run.case.label, *(NOTHING if each is None else f"{each:.4g}" for each in numbers)]


def strengths_text(runs: Sequence[Run]) -> str:
    """Strength, its share of the pristine one, and what broke while the stress fell."""
    tests = {run.case.name: read_compression(run.results) for run in runs}
    whole = next((tests[run.case.name] for run in runs if _is_whole(run)), None)
    headings = (
        "test",
        "strength [MPa]",
        "of the pristine one",
        "end shortening [mm]",
        "kinetic / internal",
        "what ended the test",
    )
    return table(headings, [_strength(run.case.label, tests[run.case.name], whole) for run in runs])


def _strength(label: str, test: Compression, whole: Compression | None) -> list[str]:
    """A row of a coupon."""
    share = NOTHING if whole is None else percent(test.strength / whole.strength)
    return [
        label,
        f"{test.strength:.4g}",
        share,
        f"{float(test.shortening[test.peak]):.3g}",
        percent(test.kinetic_share()),
        ending_words(test, read_ending(test))[0],
    ]
