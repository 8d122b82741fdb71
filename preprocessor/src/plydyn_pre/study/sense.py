"""Bodies that are in each other's place, and those that hold, load or move nothing.

The solver has the same rules for decks: see "Decks that mean nothing" in the manual.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from math import sqrt

import numpy as np

from plydyn_pre.errors import require
from plydyn_pre.mesh import Mesh
from plydyn_pre.mesh.grid import SIDES
from plydyn_pre.study.bodies import Run, runs
from plydyn_pre.study.conditions import Curve, Load, Motion
from plydyn_pre.study.fixtures import Clamp, Fixture
from plydyn_pre.study.idle import idle
from plydyn_pre.study.joints import Cohesive
from plydyn_pre.study.outlines import is_over, outlines, way_out, way_to_edge
from plydyn_pre.study.stages import Stage
from plydyn_pre.study.study import Study
from plydyn_pre.study.unused import used_materials

#: Coefficient of friction beyond which it is no longer one of materials that slide
LARGEST_FRICTION = 2.0
#: Share of the largest kinetic energy above which a plate still moves as one sees it
_LARGEST_REST = 0.1
#: Strain behind the front of a wave up to which a test may be slow
LARGEST_FRONT = 1.0e-3


def senseless(study: Study, mesh: Mesh) -> list[str]:
    """Keys of what does nothing, with the reason; refuses bodies in one place."""
    found = [*_friction(study), *_scatter(study, mesh)]
    for run in runs(study):
        found += _places(study, mesh, run)
        found += _windows(study, mesh, run)
        found += _clamps(study, mesh, run)
        found += idle(study, mesh, run)
        found += _loads(study, run)
        if isinstance(run.own, Stage):
            found += _stage(run, run.own)
    return list(dict.fromkeys(found))


def _places(study: Study, mesh: Mesh, run: Run) -> Iterator[str]:
    """Clamps that add up in one place; refuses other fixtures, and those of the impactor's."""
    seen: list[tuple[str, Fixture]] = []
    for key, fixture in run.fixtures.items():
        own = outlines(study, mesh, fixture)
        for other, before in seen:
            if fixture.face != before.face or own != outlines(study, mesh, before):
                continue
            words = f"is in the place of {other}"
            both = isinstance(fixture, Clamp) and isinstance(before, Clamp)
            require(both, key, f"{words}; leave one out, or give it another place or face")
            yield f"{key}: {words}, and adds its force"
        seen.append((key, fixture))
        if run.impactor is None or fixture.face != run.face:
            continue
        path, impactor = run.impactor
        centre = np.array(impactor.position or mesh.middle)
        rule = f"the centre is over {key}, which is on the same face"
        require(not is_over(own, centre)[0], f"{path}.position", rule)
        way = way_out(own, centre)
        if way < impactor.radius:
            yield (
                f"{path}.position: {key} on the same face begins {way:.4g} {study.units.length}"
                f" beside the axis, inside of its radius of {impactor.radius:g}; rigid bodies pass"
                " through each other"
            )


def _windows(study: Study, mesh: Mesh, run: Run) -> Iterator[str]:
    """Windows beside the plate, and those that are narrower than the impactor."""
    for key, fixture in run.fixtures.items():
        body = outlines(study, mesh, fixture)
        if not any(each.is_hole for each in body):
            continue
        if not np.any(way_to_edge(body, mesh.nodes) > 0.0):
            yield f"{key}: its window is open under no node of the plate"
        elif run.impactor is not None:
            path, impactor = run.impactor
            way = float(way_to_edge(body, np.array(impactor.position or mesh.middle))[0])
            if 0.0 < way < impactor.radius:
                yield (
                    f"{key}: its window begins {way:.4g} {study.units.length} beside the axis of"
                    f" {path}, inside of its radius of {impactor.radius:g}"
                )


def _clamps(study: Study, mesh: Mesh, run: Run) -> Iterator[str]:
    """Clamps that nothing stands against, and those that pull."""
    for key, clamp in run.fixtures.items():
        if not isinstance(clamp, Clamp):
            continue
        if clamp.curve and min(study.curves[clamp.curve].value) < 0.0 < clamp.force:
            yield (
                f"{key}.curve: {clamp.curve!r} is below zero at times; the clamp does not pull,"
                " and its force counts as none"
            )
        others = [each for each in run.fixtures.values() if each.face != clamp.face]
        under = mesh.nodes[is_over(outlines(study, mesh, clamp), mesh.nodes)]
        if run.is_held or any(is_over(outlines(study, mesh, each), under).any() for each in others):
            continue
        where = "where no fixture of the other face" if others else "and nothing on the other face"
        yield f"{key}: the clamp presses the plate {where} stands against it"


def _loads(study: Study, run: Run) -> Iterator[str]:
    """Motions along the plate so fast that the front of their wave strains it much."""
    if isinstance(run.own, Stage) and run.own.quasi_static:
        return
    wave = _fastest_wave(study)
    for number, load in enumerate(run.own.loads, start=1):
        speed = _speed(load, study.curves)
        if speed > LARGEST_FRONT * wave:
            unit = f"{study.units.length}/{study.units.time}"
            yield (
                f"{run.path}loads[{number}].value: at {speed:.4g} {unit} the front of the wave"
                f" alone strains the plate by {100.0 * speed / wave:.3g} % or more;"
                f" a slow test has {LARGEST_FRONT * wave:.2g} {unit} at most"
            )


def _fastest_wave(study: Study) -> float:
    """Speed of a wave along the stiffest direction of all plies."""
    plies = [study.materials[ply.material] for each in study.all_laminates for ply in each.stack]
    moduli = ("E1", "E2", "E", "young")
    return max(
        sqrt(max(getattr(p, key, 0.0) for key in moduli) / vars(p)["density"]) for p in plies
    )


def _speed(load: Load, curves: Mapping[str, Curve]) -> float:
    """Largest speed of a motion along the plate; 0 for other loads."""
    if not isinstance(load, Motion) or load.direction == "z":
        return 0.0
    curve = curves.get(load.curve)
    if load.quantity == "velocity":
        return abs(load.value) * (max(map(abs, curve.value)) if curve else 1.0)
    if load.quantity == "acceleration" or curve is None:
        return 0.0
    steps = zip(pairwise(curve.time), pairwise(curve.value), strict=True)
    return abs(load.value) * max(abs((v - u) / (t - s)) for (s, t), (u, v) in steps)


def _stage(run: Run, stage: Stage) -> Iterator[str]:
    """A stage that does not come to rest, or that leaves what it should remove."""
    if stage.at_rest > _LARGEST_REST:
        yield (
            f"{run.path}at_rest: a plate with {stage.at_rest:g} of its largest kinetic energy is"
            " not at rest; 1e-4 is usual"
        )
    if stage.at_rest > 0.0 and run.impactor is not None and not run.impactor[1].motion_z:
        yield (
            f"{run.path}at_rest: {run.impactor[0]} is not damped; a plate that it touches does"
            ' not come to rest; remove = ["impactor"]'
        )
    left = [key for key in run.fixtures if not key.startswith(run.path)]
    left += [run.impactor[0]] if run.impactor and stage.impactor is None else []
    if (stage.supports or any(isinstance(load, Motion) for load in stage.loads)) and (
        left and not stage.remove
    ):
        yield (
            f"{run.path}remove: the plate is held anew, and none of {', '.join(left)} is removed"
        )


def _friction(study: Study) -> Iterator[str]:
    """Coefficients of friction that no materials have."""
    bodies: dict[str, object] = {}
    for path, own in study.named_runs:
        bodies |= {f"{path}fixtures[{n}]": one for n, one in enumerate(own.fixtures, start=1)}
        bodies[f"{path}contact"] = own.contact
    bodies |= {f"materials.{name}": study.materials.get(name) for name in used_materials(study)}
    for path, body in bodies.items():
        for key in ("friction", "dynamic_friction"):
            value = getattr(body, key, 0.0)
            if value > LARGEST_FRICTION:
                yield f"{path}.{key}: {value:g}; materials have 0.1 to 1"


def _scatter(study: Study, mesh: Mesh) -> Iterator[str]:
    """Lengths of scatter that no quad sees, or no plate."""
    corners = mesh.nodes[mesh.quads[:, :4]]
    side = min(float(np.hypot(*(corners[:, a] - corners[:, b]).T).min()) for a, b in SIDES)
    plate = float((mesh.nodes.max(axis=0) - mesh.nodes.min(axis=0)).max())
    for name in sorted(used_materials(study) & study.materials.keys()):
        material = study.materials[name]
        if not isinstance(material, Cohesive) or not material.scatters:
            continue
        length = material.scatter_length
        if length < side:
            yield (
                f"materials.{name}.scatter_length: {length:g} is below the sides of all quads,"
                f" {side:.3g}; every point has a strength of its own"
            )
        elif length > plate:
            yield (
                f"materials.{name}.scatter_length: {length:g} is above the sides of the plate,"
                f" {plate:.4g}; all of it has about the same strength"
            )
