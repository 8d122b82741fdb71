"""Numbers of a study that are right as such, but look like those of another unit."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot

from plydyn_pre.mesh import Mesh
from plydyn_pre.study.study import Study
from plydyn_pre.units import unit_factor

#: Heights of falls that drop towers and runways have, mm
_LOWEST, _HIGHEST = 5.0, 1.0e6
#: Speeds of impacts, mm/s
_SLOWEST, _FASTEST = 10.0, 2.0e6
#: Standard gravity, mm/s^2
_GRAVITY = 9806.65
#: Lengths of the plate that an impactor travels until the end of a run
_FAR = 20.0
#: Share of the shorter side of the plate that a laminate is thick
_THICK = 0.25


def doubts(study: Study, mesh: Mesh) -> list[str]:
    """Keys whose numbers someone may have meant otherwise, with the reason."""
    sides = mesh.nodes.max(axis=0) - mesh.nodes.min(axis=0)
    return [*_impact(study, float(hypot(*sides[:2]))), *_thickness(study, float(min(sides[:2])))]


def _impact(study: Study, size: float) -> Iterator[str]:
    """A fall, a speed and an end of time as no test has them."""
    impactor = study.impactor
    if impactor is None or impactor.motion_z or impactor.velocity is None:
        return
    names, units = study.units, vars(study.units)
    speed = hypot(*impactor.velocity)
    height = speed**2 / (2.0 * _GRAVITY * unit_factor((1, -2, 0), units))
    low, high = (bound * unit_factor((1, 0, 0), units) for bound in (_LOWEST, _HIGHEST))
    if impactor.energy is not None and not low <= height <= high:
        unit = f"{names.mass} {names.length}2/{names.time}2"
        unit = {"t mm2/s2": "mJ", "kg m2/s2": "J"}.get(unit, unit)
        yield (
            f"impactor.energy: a fall from a height of {height:.4g} {names.length}; is the energy"
            f" in {unit} and the mass in {names.mass}?"
        )
    slow, fast = (bound * unit_factor((1, -1, 0), units) for bound in (_SLOWEST, _FASTEST))
    if impactor.energy is None and speed > 0.0 and not slow <= speed <= fast:
        yield (
            f"impactor.velocity: {speed:.4g}; is it in {names.length}/{names.time}? A slow push is"
            " a curve, motion_z"
        )
    travel = speed * study.control.end_time
    if travel > _FAR * size:
        yield (
            f"control.end_time: the impactor could travel {travel:.4g} {names.length} until then;"
            f" is it in {names.time}?"
        )


def _thickness(study: Study, side: float) -> Iterator[str]:
    """A laminate that is no plate."""
    for laminate in study.all_laminates:
        if laminate.total > _THICK * side:
            unit = study.units.length
            yield (
                f"laminate.thickness: {len(laminate.stack)} plies are {laminate.total:.4g} {unit}"
                f" thick on a plate {side:.4g} {unit} wide; is it that of one ply, in {unit}?"
            )
