"""Tests that were measured, computed with the defaults of the templates."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from plydyn_post.grid import read_state, read_times
from readings import damage
from readings.damage import Impact
from runner.cases import ROOT, Case, Run, StudyError, by_build
from runner.commands import Study, command
from runner.pages import NOTHING, Page, Quantity, Section, change, clock, not_run, table, tabulate
from studies import cross_ply, open_hole

#: Largest penetration counts in mm, forces in N, energies in mJ
PEAK, TIME, DURATION = "peak force [kN]", "at [ms]", "contact [ms]"
DISPLACEMENT, ABSORBED, AREA = "displacement [mm]", "absorbed [J]", "projected area [mm2]"


@dataclass(frozen=True)
class Test:
    """A test: its recipe, and what was measured; nothing where the answer is not known here."""

    case: Case
    measured: dict[str, float]


def t700(name: str, label: str, measured: dict[str, float], *varied: str) -> Test:
    """An impact on T700 by the recipe of the first words of its name."""
    recipe = re.sub("(_(second|linear|fine|finer|finest|averaged|seed.))+$", "", name)
    return Test(Case(name, f"validation/{recipe}", label, varied), measured)


#: AITM 1-0010, 25 J: the measured numbers of Tan, Falzon, Chiu and Price (2015), Composites A 71,
#: as far as their figures can be read; others at which nobody has looked yet
AT_25 = {PEAK: 8.55, TIME: 1.5, DURATION: 3.55, DISPLACEMENT: 5.13, ABSORBED: 12.2, AREA: 1443.0}
#: Force of the same test over time, kN at ms
FORCE_AT_25 = {0.5: 4.94, 1.0: 7.13, 1.5: 8.41, 2.0: 6.65, 2.5: 4.24, 3.0: 1.73}
#: Strains that drive damage are averaged over circles, mm
AVERAGED = (
    "mesh.quad=2.0",
    "materials.ply.average_along=3.0",
    "materials.ply.average_across=3.0",
)
#: Shear stays linear until the matrix cracks
LINEAR = "materials.ply.shear=linear"
FINE_LINEAR = ("mesh.quad=2.0", LINEAR)
TESTS = (
    t700("t700gc_25J", "T700GC/M21, 25 J, quads of 2.8 mm", AT_25),
    t700("t700gc_25J_fine", "T700GC/M21, 25 J, quads of 1.9 mm", AT_25, "mesh.quad=2.0"),
    t700("t700gc_25J_finest", "T700GC/M21, 25 J, quads of 1 mm", AT_25, "mesh.quad=1.0"),
    t700("t700gc_25J_planes", "the same with planes of fracture, quads of 2.8 mm", AT_25),
    t700("t700gc_25J_planes_fine", "planes of fracture, 1.9 mm", AT_25, "mesh.quad=2.0"),
    t700("t700gc_25J_planes_linear", "planes, linear shear, 2.8 mm", AT_25, LINEAR),
    t700("t700gc_25J_planes_linear_fine", "planes, linear shear, 1.9 mm", AT_25, *FINE_LINEAR),
    t700("t700gc_25J_planes_finest", "planes of fracture, 1 mm", AT_25, "mesh.quad=1.0"),
    t700("t700gc_25J_averaged", "the default, strains averaged, 1.9 mm", AT_25, *AVERAGED),
)
#: Strengths of the interfaces that scatter by a tenth over 2 mm, as those of resins do
SCATTER = ("materials.bond.scatter=12.0", "materials.bond.scatter_length=2.0")


def seeds_of(name: str, *varied: str) -> tuple[Test, ...]:
    """Five realisations of an impact."""
    return tuple(
        t700(f"{name}_seed{k}", f"seed {k}", {}, *varied, *SCATTER, f"materials.bond.seed={k}")
        for k in range(1, 6)
    )


SEEDS = seeds_of("t700gc_25J")
#: Pictures of the interfaces after the impact, by the names of their cases
DRAWN = {
    "t700gc_25J": "validation_interfaces.png",
    "t700gc_25J_finest": "validation_interfaces_finest.png",
}
#: Mean damage of the fibres of a cell that counts as broken
BROKEN = 0.5
#: Where the study of beams stands, and how many cells its rows have
BEAMS, BEAM_CELLS = ROOT / "manual/verification_studies.md", 9


@command()
def validation() -> Study:
    """All tests that were measured, for manual/validation.md."""
    cases = [test.case for test in (*TESTS, *SEEDS)]
    return Study([*cases, *cross_ply.CASES, *open_hole.CASES], _report)


def read_numbers(one: Impact) -> dict[str, float | None]:
    """What a run came to, by the names of the table."""
    return {
        PEAK: one.peak / 1e3,
        TIME: 1e3 * one.peak_time,
        DURATION: None if one.duration is None else 1e3 * one.duration,
        DISPLACEMENT: one.displacement,
        ABSORBED: None if one.absorbed is None else one.absorbed / 1e3,
        AREA: one.projected,
    }


def _report(runs: list[Run], folder: Path) -> list[Page]:
    impacts = [
        run for run in runs if run.case.name in {test.case.name for test in (*TESTS, *SEEDS)}
    ]
    first = [_page_of(impacts, folder)] if impacts else []
    return [*first, cross_ply.page_of(runs, folder), open_hole.page_of(runs, folder)]


def _page_of(runs: list[Run], folder: Path) -> Page:
    """Tables and pictures of the impact of 25 J, and of the beams."""
    found = {run.case.name: run for run in runs}
    seeds = [found[seed.case.name] for seed in SEEDS if seed.case.name in found]
    sections = [
        Section("Impacts", impacts_text(TESTS, found, _details_text), "impacts"),
        Section("Scatter", by_build(seeds, _seeds_text) or "Not run.\n", "seeds"),
        Section("Beams", beams_text(BEAMS.read_text(encoding="utf-8")), "beams"),
    ]
    tests = {test.case.name for test in TESTS}
    drawn = [run for run in runs if run.case.name in tests] or runs
    measured = write_measured(folder / "measured.csv")
    figures = damage.draw_forces(drawn, folder / "validation_force.png", [measured])
    made = damage.draw_runs(DRAWN, found, folder)
    pictures = {"validation_force.png": figures[-2]} | {path.name: path for path in made}
    return Page("validation", sections, [*figures, *made], pictures)


def word_of(value: float | None) -> str:
    """A number of a row, or the sign of none."""
    return NOTHING if value is None else f"{value:.4g}"


def columns_of(runs: Sequence[Run]) -> dict[str, np.ndarray]:
    """Each number of some runs, by its name."""
    read = [read_numbers(damage.read_impact(run)) for run in runs]
    return {name: np.array([one[name] for one in read], dtype=float) for name in read[0]}


def write_measured(path: Path) -> Path:
    """The measured force as a table that figures lay over curves."""
    rows = [f"{1e-3 * time:g},{1e3 * force:g}" for time, force in FORCE_AT_25.items()]
    path.write_text("\n".join(["time [s],force [N]", *rows, ""]), encoding="utf-8")
    return path


def forces_text(runs: Sequence[Run]) -> str:
    """Force at the times at which the measured one is known."""
    rows = [["measured", *(f"{force:.2f}" for force in FORCE_AT_25.values())]]
    for run in runs:
        times, forces = damage.mean_force(run.results)
        found = np.interp(list(FORCE_AT_25), 1e3 * times, forces / 1e3)
        rows.append([run.case.label, *(f"{force:.2f}" for force in found)])
    return table(("force [kN] at [ms]", *(f"{time:.1f}" for time in FORCE_AT_25)), rows)


def _details_text(runs: Sequence[Run]) -> str:
    """Energy by mechanism, delaminated area by interface, and force over time."""
    read = [damage.read_impact(run) for run in runs]
    rubbed = Quantity("friction [J]", lambda one: one.dissipated.get("friction", 0.0) / 1e3, ".2f")
    broken = Quantity("fibres broken over [mm]", broken_width, ".1f")
    least = Quantity("least volume", least_volume, ".2f")
    columns = (damage.LABEL, *damage.DISSIPATED, broken, rubbed, least, damage.TOTAL)
    return f"\n{tabulate(columns, read)}\n{damage.areas_text(read)}\n{forces_text(runs)}"


def least_volume(one: Impact) -> float:
    """Smallest ratio of volumes at a Gauss point."""
    return float(one.run.results.energy()["least volume"].min())


def broken_width(one: Impact) -> float:
    """Twice the distance of the farthest point with broken fibres from the axes through the impact.

    Mid-points of cells, as points between two quads have the mean of both.
    """
    path = one.run.results.fields
    state = read_state(path, len(read_times(path)) - 1)
    cells = state.point_data_to_cell_data()
    places = state.cell_centers().points[cells["damage_fibre"] > BROKEN]
    return 2.0 * float(np.abs(places[:, :2]).max()) if len(places) else 0.0


def _seeds_text(runs: Sequence[Run]) -> str:
    """Mean, standard deviation and range of runs with different seeds."""
    if len(runs) < 2:
        return "Not run.\n"
    columns = columns_of(runs)
    rows = [
        [word, *(f"{of(values):.3g}" for values in columns.values())]
        for word, of in (
            ("mean", np.mean),
            ("standard deviation", deviation),
            ("smallest", np.min),
            ("largest", np.max),
        )
    ]
    return table((f"{len(runs)} seeds", *columns), rows)


def deviation(values: np.ndarray) -> float:
    """The standard deviation of a few runs."""
    return float(np.std(values, ddof=1))


def beams_text(page: str) -> str:
    """Measured and computed forces of beams, from the study on the page of the verification."""
    _, found, rest = page.partition("<!-- delamination study -->")
    if not found:
        raise StudyError(f"{BEAMS} has no table of the delamination of beams")
    rows = []
    for line in rest.partition("<!-- end of")[0].splitlines():
        cells = [cell.strip() for cell in line.strip("| ").split("|")]
        if len(cells) == BEAM_CELLS and cells[1:4] == ["2", "1", ""]:
            name, force, theory, test = cells[0], *map(float, cells[4:7])
            numbers = (force / test, force / theory, force)
            changes = (change(test, 1.0), change(theory, 1.0))
            rows.append([name, *(f"{number:.0f}" for number in numbers), *changes])
    headings = ("test", "measured [N]", "beam theory [N]", "computed [N]", "to test", "to theory")
    return table(headings, rows)


def impacts_text(
    tests: Sequence[Test],
    found: dict[str, Run],
    more: Callable[[list[Run]], str] = lambda _runs: "",
) -> str:
    """Rows of the tests that have run and more about them, a build after the other."""
    known = {test.case.name: test for test in tests}

    def of_build(runs: list[Run]) -> str:
        return rows_text([(known[run.case.name], run) for run in runs]) + more(runs)

    return by_build([found[name] for name in known if name in found], of_build) + not_run(
        [test.case for test in tests], found
    )


def rows_text(ran: Sequence[tuple[Test, Run]]) -> str:
    """Rows of tests with their runs, each behind what was measured."""
    rows: list[list[str]] = []
    before: Mapping[str, float] = {}
    for test, run in ran:
        if test.measured and test.measured is not before:
            rows.append(["measured", *(f"{value:g}" for value in test.measured.values()), ""])
        before = test.measured
        rows.append(_row(run, test))
    headings = ("test", PEAK, TIME, DURATION, DISPLACEMENT, ABSORBED, AREA, "processor time")
    return table(headings, rows)


def _row(run: Run, test: Test) -> list[str]:
    numbers = read_numbers(damage.read_impact(run))
    cells = []
    for name, value in numbers.items():
        word = word_of(value)
        if value is not None and name in test.measured and np.isfinite(value):
            word += f" ({change(value, test.measured[name])})"
        cells.append(word)
    return [run.case.label, *cells, clock(run.effort.processor)]
