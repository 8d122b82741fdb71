"""Keywords of the run and of its outputs."""

from __future__ import annotations

from collections.abc import Iterator

from plydyn_pre.deck.cards import Card, id_cards, keyword, title_line
from plydyn_pre.deck.names import Names
from plydyn_pre.study import Control, Stage, Study

_KINEMATICS = {"linear": 0, "total_lagrangian": 1}
_SCHEMES = {"explicit": 0, "implicit_interfaces": 1, "implicit_thickness": 2}
_INTERVALS = {
    "energy_interval": "DATABASE_GLSTAT",
    "impactor_interval": "DATABASE_IMPACTOR",
    "node_interval": "DATABASE_NODOUT",
    "support_interval": "DATABASE_SPCFORC",
    "delamination_interval": "DATABASE_DELAM",
    "fixture_interval": "DATABASE_FIXTURE",
    "field_interval": "DATABASE_BINARY_D3PLOT",
}


def control_keywords(names: Names) -> Iterator[str]:
    """Title, units, time, step and strain measure."""
    study, control = names.study, names.study.control
    yield keyword("TITLE", title_line(study.title))
    yield keyword("CONTROL_UNITS", _units(study))
    yield keyword("CONTROL_TERMINATION", _termination(control))
    step = control.first_step, control.step_factor, control.mass_scaled_step
    if any(step) or control.step_curve:
        yield step_keyword(control, names.curve(control.step_curve))
    yield keyword("CONTROL_LAYERWISE", _scheme(control))
    if control.until_contact_ends > 0.0:
        yield contact_end_keyword(control.until_contact_ends)
    if control.quasi_static is not None:
        yield quasi_static_keyword(control)
    if control.damping > 0.0:
        yield keyword("DAMPING_GLOBAL", {"valdmp": control.damping})


def output_keywords(names: Names) -> Iterator[str]:
    """What is to be written, and when."""
    outputs = names.study.outputs
    yield from interval_keywords(names)
    if outputs.nodes:
        ids = [
            names.node_set(name, f"outputs.nodes[{number}]")
            for number, name in enumerate(outputs.nodes, start=1)
        ]
        yield keyword("DATABASE_HISTORY_NODE_SET", *id_cards(ids))
    for number, profile in enumerate(outputs.profiles, start=1):
        x, y = map(float, profile.at)
        place = {"id": number, "x": x, "y": y}
        yield keyword("DATABASE_PROFILE", place | {"npt": profile.points, "dt": profile.interval})


def interval_keywords(names: Names) -> Iterator[str]:
    """When what is written, and which fields."""
    outputs = names.study.outputs
    for field, name in _INTERVALS.items():
        interval = getattr(outputs, field)
        if interval is not None:
            yield keyword(name, {"dt": interval})
    if outputs.fields:
        yield keyword("DATABASE_FIELD", *outputs.fields)
    if outputs.restart_steps is not None:
        yield keyword("DATABASE_BINARY_RUNRSF", {"cycl": outputs.restart_steps})


def _units(study: Study) -> Card:
    """Names of units."""
    units = study.units
    return {"length": units.length, "time": units.time, "mass": units.mass, "temp": "K"}


def _termination(control: Control) -> Card:
    """The end of the run."""
    return {
        "endtim": control.end_time,
        "endcyc": control.end_cycle,
        "dtmin": control.smallest_step,
        "nosol": int(control.check_only),
    }


def contact_end_keyword(pause: float) -> str:
    """The end of the run, some time after the last contact; 0 takes that of a deck before back."""
    return keyword("CONTROL_END_OF_CONTACT", {"dur": pause})


def quasi_static_keyword(run: Control | Stage) -> str:
    """What is watched of energies and load; without a share, nothing of a deck before any more."""
    fall = {"fall": run.until_fall} if run.until_fall else {}
    return keyword("CONTROL_QUASI_STATIC", {"share": run.quasi_static or 0.0} | fall)


def _scheme(control: Control) -> Card:
    """Strain measure, limit of the energy balance, what is implicit."""
    return {
        "kinem": _KINEMATICS[control.kinematics],
        "englim": control.energy_limit,
        "impl": _SCHEMES[control.scheme],
        "dtmax": control.largest_step,
    }


def step_keyword(control: Control, curve: int) -> str:
    """The time step; the curve bounds it."""
    step = {"dtinit": control.first_step, "tssfac": control.step_factor}
    scaled = {"dt2ms": -control.mass_scaled_step or 0.0}
    return keyword("CONTROL_TIMESTEP", {**step, **scaled, "lctm": curve})
