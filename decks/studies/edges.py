"""The edge of the damage impact: a held rim, and rings that the coupon slides in."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from readings import damage
from runner.cases import Case, Run, made_by
from runner.commands import Study, command
from runner.pages import Page, Quantity, Section, tabulate

#: The quarter with a held rim gets the quads and the time of the recipes with rings
_HELD = ("mesh.n=16", "mesh.rings=8", "control.end_time=4.0e-3")
_LINEAR = ("control.kinematics=linear",)


def _rings(name: str, recipe: str, words: str, friction: float, *others: str) -> Case:
    """A coupon between two rings with friction."""
    values = (f"fixtures[1].friction={friction}", f"fixtures[2].friction={friction}")
    label = f"{words}, friction {friction:g}"
    return Case(name, f"damage_impact/{recipe}", label, (*values, *others))


def _clamped(name: str, force: float, friction: float) -> Case:
    """A coupon on a ring with a clamp of some kN above."""
    words = f"ring, clamp of {force:g} kN" if force else "ring, no clamp"
    return _rings(name, "ring", words, friction, f"fixtures[2].force={1e3 * force}")


def _linear(case: Case) -> Case:
    """The same with linear strain."""
    varied = (*case.varied, *_LINEAR)
    return replace(case, name=f"{case.name}_linear", label=f"{case.label}, linear", varied=varied)


RIM = Case("rim", "damage_impact/quarter", "rim held", (), _HELD)
PAIR = _rings("pair_0", "ring_pair", "rings above and below", 0.0)
#: Those of the picture: the edges with large displacement
DRAWN = (
    RIM,
    PAIR,
    _clamped("clamp_1", 2.0, 0.1),
    _clamped("clamp_3", 2.0, 0.3),
    _rings("pair_3", "ring_pair", "rings above and below", 0.3),
    _clamped("strong_3", 20.0, 0.3),
    _clamped("open_0", 0.0, 0.0),
)
CASES = (*DRAWN, _linear(RIM), _linear(PAIR))


@command()
def edges() -> Study:
    """What the edge does to force, duration, displacement and areas of the damage impact."""
    return Study(CASES, _report, may_stop=True)


def _report(runs: list[Run], folder: Path) -> list[Page]:
    label = Quantity("edge", lambda one: one.label)
    end = Quantity("run to [ms]", lambda one: one.run.results.impactor()["time"][-1], ".2f", 1e3)
    found = [damage.read_impact(run) for run in runs]
    tables = (tabulate((label, end, *damage.COLUMNS), found), damage.areas_text(found, label))
    drawn = [run for run in runs if run.case.name in [case.name for case in DRAWN]]
    figures = damage.draw_forces(drawn, folder / "edges.png")
    text = "\n".join([*tables, made_by(runs)])
    pictures = {"damage_edges.png": figures[0]}
    return [Page("edges", [Section("Edges", text, "edges")], figures, pictures)]
