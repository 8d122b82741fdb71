"""How long an impactor will touch the plate, estimated before the run as the solver does it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import hypot

import numpy as np
from numpy.typing import NDArray

from plydyn_pre.deck.names import Names
from plydyn_pre.mesh import Mesh
from plydyn_pre.mesh.grid import Reals
from plydyn_pre.study import Bar, Contact, Fixture, Motion, Outputs, Plane, Punch, Study
from plydyn_pre.study.bending import (
    bending_stiffness,
    cubic_stiffness,
    half_period,
    membrane_flexibility,
    point_stiffness,
)

#: Supports are looked for along x and y, within this distance sideways over that to them
_SLOPE = 0.25


@dataclass(frozen=True)
class ContactDuration:
    """Half a period of the impactor's mass on the plate between its supports."""

    path: str  # of the impactor and of the end time, before their keys
    start: float  # time of the first touch
    duration: float  # time
    spans: tuple[float, float]  # between the supports along x and y, infinite for none
    end_time: float  # of the run

    @property
    def end(self) -> float:
        """Time at which the contact ends."""
        return self.start + self.duration


def contact_durations(study: Study, mesh: Mesh) -> Iterator[ContactDuration]:
    """Estimates for the impactors of a study and its stages that fall onto a plate."""
    if study.bricks is not None:
        return
    if found := _estimate(study, mesh, "control.", study.control.end_time):
        yield found
    fixtures, supports = study.fixtures, study.supports
    for number, stage in enumerate(study.stages, start=1):
        fixtures = (*(() if "fixtures" in stage.remove else fixtures), *stage.fixtures)
        supports = stage.supports if stage.supports or stage.loads else supports
        if stage.impactor is None:
            continue
        part = replace(
            study,
            fixtures=fixtures,
            supports=supports,
            loads=stage.loads if stage.supports or stage.loads else study.loads,
            impactor=stage.impactor,
            contact=stage.contact,
            control=replace(study.control, until_contact_ends=0.0),
            outputs=Outputs(),
            stages=(),
        )
        if found := _estimate(part, mesh, f"stages[{number}].", stage.end_time):
            yield found


def _estimate(study: Study, mesh: Mesh, path: str, end_time: float) -> ContactDuration | None:
    """The estimate for the impactor of a study; none where the formula does not fit."""
    impactor = study.impactor
    if impactor is None or impactor.motion_z:
        return None
    speed = hypot(*impactor.start)
    names = Names(study, mesh)
    laminate = study.laminate_of(next(iter(names.mesh.parts)))
    arms = _arms(names, np.array(impactor.position or mesh.middle))
    spans = arms.sum(axis=1)
    whole = 2.0 if study.share < 1.0 else 1.0
    width = whole * (mesh.nodes.max(axis=0) - mesh.nodes.min(axis=0))[:2]
    if speed == 0.0 or not np.isfinite(spans).any() or arms.min() <= laminate.total:
        return None
    density = sum(
        vars(study.materials[ply.material])["density"] * ply.thickness for ply in laminate.stack
    )
    if impactor.mass <= density * np.where(np.isfinite(spans), spans, width).prod():
        return None
    linear = point_stiffness(bending_stiffness(laminate, study.materials), arms, tuple(width))
    cubic = 0.0
    if study.control.kinematics == "total_lagrangian" and np.isfinite(spans).all():
        cubic = cubic_stiffness(membrane_flexibility(laminate, study.materials), spans)
    energy = 0.5 * impactor.mass * impactor.start[2] ** 2
    half = half_period(impactor.mass, linear, cubic, energy)
    return ContactDuration(path, impactor.gap / speed, half, tuple(spans.tolist()), end_time)


def _arms(names: Names, place: Reals) -> Reals:
    """Distances to the next supports on the low and the high side, (along x and y, 2)."""
    way = names.mesh.nodes[_holding(names)][:, :2] - place
    arms = np.full((2, 2), np.inf)
    for axis in range(2):
        along, across = way[:, axis], np.abs(way[:, 1 - axis])
        ahead = across <= _SLOPE * np.abs(along)
        for side, there in enumerate((along < 0.0, along >= 0.0)):
            found = np.abs(along[ahead & there])
            arms[axis, side] = found.min(initial=np.inf)
    return arms.min(axis=1, keepdims=True).repeat(2, axis=1) if names.study.share < 1.0 else arms


def _holding(names: Names) -> NDArray[np.bool_]:
    """Nodes that are held along z, or have a fixture behind them."""
    study, holds = names.study, np.zeros(len(names.mesh.nodes), dtype=bool)
    for number, support in enumerate(study.held, start=1):
        if "z" in support.hold:
            holds[names.nodes_of(support.set, f"supports[{number}].set")] = True
    for number, load in enumerate(study.loads, start=1):
        if isinstance(load, Motion) and load.direction == "z":
            holds[names.nodes_of(load.set, f"loads[{number}].set")] = True
    for fixture in study.fixtures:
        if fixture.face != (study.contact or Contact()).face:
            holds |= _behind(study, names.mesh, fixture)
    return holds


def _behind(study: Study, mesh: Mesh, fixture: Fixture) -> NDArray[np.bool_]:
    """Nodes that have a fixture behind them."""
    nodes = mesh.nodes[:, :2]
    if isinstance(fixture, Bar):
        start, end = np.array(fixture.start), np.array(fixture.end)
        share = ((nodes - start) @ (end - start) / ((end - start) @ (end - start))).clip(0.0, 1.0)
        return (
            np.linalg.norm(nodes - start - np.outer(share, end - start), axis=1) <= fixture.radius
        )
    way = np.abs(nodes - (fixture.centre or mesh.middle))
    if isinstance(fixture, Plane | Punch):
        opening = study.window_of(fixture) if isinstance(fixture, Plane) else fixture.size
        inside = _is_inside(way, opening)
        return ~inside if isinstance(fixture, Plane) else inside
    radius = np.hypot(*way.T)
    return (fixture.inner <= radius) & (radius <= fixture.outer)


def _is_inside(way: Reals, size: float | tuple[float, float]) -> NDArray[np.bool_]:
    """Whether places lie inside a circle or a rectangle around the origin."""
    if isinstance(size, tuple):
        return np.asarray(np.all(way < 0.5 * np.array(size) * (1.0 - 1.0e-9), axis=1))
    return np.asarray(np.hypot(way[:, 0], way[:, 1]) < 0.5 * size * (1.0 - 1.0e-9))
