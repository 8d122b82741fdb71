"""Plates that nothing acts on; bodies that never come to them: at rest, led away, or beside.

Where nothing else moves the plate nothing can happen, which is an error. A plate that something
else moves may come to them, and a stage finds a plate that may move: they are noted.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import hypot

import numpy as np

from plydyn_pre.errors import require
from plydyn_pre.mesh import Mesh
from plydyn_pre.study.bodies import Run
from plydyn_pre.study.conditions import Curve, InitialVelocity, Load
from plydyn_pre.study.fixtures import Clamp, Fixture
from plydyn_pre.study.impactor import Impactor
from plydyn_pre.study.stages import Stage
from plydyn_pre.study.study import Study


def idle(study: Study, mesh: Mesh, run: Run) -> Iterator[str]:
    """Keys of bodies that never come; refuses them where nothing moves the plate."""
    curves = study.curves
    for key, fixture in run.fixtures.items():
        curve = getattr(fixture, "move_z", "")
        if curve and _leads(curves[curve], 1.0 if fixture.face == "top" else -1.0):
            words = f"{curve!r} leads away from the plate"
            yield _told(f"{key}.move_z", words, moves=_moves(run, curves) or _comes(run, curves))
    if run.impactor is None and not _moves(run, curves):
        yield "impactor: there is none, and no load and no fixture moves the plate"
    if run.impactor is None or run.own.impactor is None:
        return
    path, impactor = run.impactor
    moves = _moves(run, curves, run.face)
    if words := _misses(study, mesh, impactor):
        yield _told(f"{path}.position", words, moves=moves)
    elif not _is_driven(impactor, curves):
        if not moves:
            _told(path, "it is at rest", moves=False)
    elif not _comes(run, curves):
        away = f"{impactor.motion_z!r} leads away from the plate"
        key, words = (f"{path}.motion_z", away) if impactor.motion_z else _flies(path, impactor)
        yield _told(key, words, moves=moves)


def _told(key: str, words: str, *, moves: bool) -> str:
    """The words about a key; an error where nothing moves the plate."""
    require(moves, key, f"{words}; nothing moves the plate, either, so that nothing can happen")
    return f"{key}: {words}"


def _flies(path: str, impactor: Impactor) -> tuple[str, str]:
    """The key of a velocity that does not lead to the plate, and why."""
    if impactor.start[2] == 0.0:
        return (
            f"{path}.velocity",
            "it leads along the plate alone, without a touch",
        )
    return f"{path}.velocity", "it leads away from the plate"


def _misses(study: Study, mesh: Mesh, impactor: Impactor) -> str:
    """How far a body is beside the plate that it falls past; empty for one that may meet it."""
    centre = np.array(impactor.position or mesh.middle)
    low, high = mesh.nodes.min(axis=0)[:2], mesh.nodes.max(axis=0)[:2]
    apart = float(np.hypot(*np.maximum(np.maximum(low - centre, centre - high), 0.0)))
    axis = impactor.axis or (0.0, 0.0, 1.0)
    reach = impactor.radius + impactor.length * hypot(*axis[:2]) / hypot(*axis)
    if apart <= reach or any(impactor.start[:2]):
        return ""
    return (
        f"{apart:.4g} {study.units.length} beside the plate, which the impactor misses; x is from"
        f" {low[0]:g} to {high[0]:g}, y from {low[1]:g} to {high[1]:g}"
    )


def _is_driven(impactor: Impactor, curves: Mapping[str, Curve]) -> bool:
    """Whether anything moves an impactor."""
    if impactor.motion_z:
        return any(curves[impactor.motion_z].value)
    return any(impactor.start) or impactor.gravity != 0.0


def _comes(run: Run, curves: Mapping[str, Curve]) -> bool:
    """Whether the impactor moves towards its face, or may touch it from the start."""
    if run.impactor is None:
        return False
    _, impactor = run.impactor
    sign = 1.0 if run.face == "top" else -1.0
    if impactor.motion_z:
        return min(sign * value for value in curves[impactor.motion_z].value) < 0.0
    if impactor.gap == 0.0 and impactor.start[2] == 0.0 and any(impactor.start):
        return True
    return min(sign * impactor.start[2], sign * impactor.gravity) < 0.0


def _leads(curve: Curve, sign: float) -> bool:
    """Whether a curve has values of one sign alone."""
    values = [sign * value for value in curve.value]
    return min(values) >= 0.0 and max(values) > 0.0


def _moves(run: Run, curves: Mapping[str, Curve], face: str = "") -> bool:
    """Whether loads or fixtures move the plate, clamps on a face aside; in a stage it may move."""
    pressing = any(_presses(each, curves, face) for each in run.fixtures.values())
    loading = any(_acts(load, curves) for load in run.own.loads)
    return pressing or loading or isinstance(run.own, Stage)


def _presses(fixture: Fixture, curves: Mapping[str, Curve], face: str) -> bool:
    """Whether a fixture is more than a body that stands still or leaves the plate."""
    if isinstance(fixture, Clamp):
        pressing = not fixture.curve or any(curves[fixture.curve].value)
        return fixture.face != face and fixture.force != 0.0 and pressing
    names = [name for name in (fixture.move_x, fixture.move_y, fixture.move_z) if name]
    moving = any(any(curves[name].value) for name in names)
    sign = 1.0 if fixture.face == "top" else -1.0
    return moving and not (fixture.move_z and _leads(curves[fixture.move_z], sign))


def _acts(load: Load, curves: Mapping[str, Curve]) -> bool:
    """Whether a load is anything but zero."""
    if isinstance(load, InitialVelocity):
        return any(load.velocity)
    return load.value != 0.0 and (not load.curve or any(curves[load.curve].value))
