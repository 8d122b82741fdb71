"""What each mechanism of damage does to an impact that a test has measured."""

from __future__ import annotations

from readings import damage
from runner.cases import Case, Run, by_build
from runner.commands import Study, command
from runner.pages import NOTHING, change, clock, one_section, table
from studies.validation import ABSORBED, AREA, AT_25, DISPLACEMENT, DURATION, PEAK, read_numbers

#: A toughness that nothing spends
ENDLESS = "1.0e9"


def _never(strength: float, strengths: str, toughnesses: str) -> tuple[str, ...]:
    """Keys of a strength that is not reached, and of toughnesses."""
    given = {key: str(strength) for key in strengths.split()}
    given |= dict.fromkeys(toughnesses.split(), ENDLESS)
    return tuple(f"materials.ply.{key}={value}" for key, value in given.items())


FIBRES = _never(3.0e4, "XT XC", "G1T G1C")
MATRIX = _never(2.0e3, "YT YC SL ST", "G2T G2C G2S")
#: The impact that is varied: broken points keep 1 % of their stiffness, as they did by default when
#: this study was made
BASE = ("materials.ply.largest_damage=0.99",)
#: What differs from it, by the name of the run
VARIED = {
    "default": ("cracks keep 1 % of the stiffness", ()),
    "elastic": ("plies stay elastic", FIBRES + MATRIX),
    "whole_fibres": ("fibres never break", FIBRES),
    "whole_matrix": ("the matrix never cracks", MATRIX),
    "across": ("cracks weaken shear 13 and 23 too", ("materials.ply.weakens_across=true",)),
    "residual": ("they keep 0.1 %, the default", ("materials.ply.largest_damage=0.999",)),
    "looser": ("they keep a millionth", ("materials.ply.largest_damage=0.999999",)),
    "kept": (
        'strengths hold where bands are too wide (`snap_back = "drop"`)',
        ("materials.ply.snap_back=drop",),
    ),
    "slippery": ("delaminated plies do not rub", ("materials.bond.friction=0.0",)),
    "weak": ("half of $G_{IIc}$ of the interfaces", ("materials.bond.GIIC=1.05",)),
    "strong": (
        "twice the strengths of the interfaces",
        ("materials.bond.N=40.0", "materials.bond.S=72.0", "materials.bond.fit=none"),
    ),
    "order": ("order 2 through each ply", ("laminate.order=2",)),
    "paper": ('`model = "nagaraj2020"`', ("materials.ply.model=nagaraj2020",)),
}


@command()
def mechanisms() -> Study:
    """What each mechanism does to the impact of 25 J, for manual/validation.md."""
    cases = [
        Case(name, "validation/t700gc_25J", label, varied, BASE)
        for name, (label, varied) in VARIED.items()
    ]
    return Study(cases, one_section("Mechanisms", lambda runs: by_build(runs, _text)))


def _text(runs: list[Run]) -> str:
    """Rows of the runs of a build, behind what was measured."""
    shown = (PEAK, DURATION, DISPLACEMENT, ABSORBED, AREA)
    rows = []
    for run in runs:
        numbers = read_numbers(damage.read_impact(run))
        cells = [_cell(numbers[name], AT_25[name]) for name in shown]
        rows.append([run.case.label, *cells, clock(run.effort.processor)])
    measured = ["measured", *(f"{AT_25[name]:g}" for name in shown), ""]
    return table(("what is changed", *shown, "processor time"), [measured, *rows])


def _cell(value: float | None, measured: float) -> str:
    """A number, and how far it is from what was measured."""
    return NOTHING if value is None else f"{value:.4g} ({change(value, measured)})"
