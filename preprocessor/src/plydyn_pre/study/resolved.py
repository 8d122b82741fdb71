"""Studies whose plies have in-situ strengths, and interfaces strengths that a mesh resolves."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from plydyn_pre.library import Origin
from plydyn_pre.mesh import Coupon
from plydyn_pre.study.cracks import ZONE_OF_CRACKS
from plydyn_pre.study.in_situ import Cluster, DamagedPly, Strengths, clusters, in_situ, toughnesses
from plydyn_pre.study.joints import Cohesive
from plydyn_pre.study.laminate import Laminate
from plydyn_pre.study.levels import fitted_strengths
from plydyn_pre.study.materials import Material
from plydyn_pre.study.sets import PlaceSet
from plydyn_pre.study.study import Study


def resolved(study: Study) -> Study:
    """The study with all that follows from the rest of it.

    Strengths of plies in situ and of interfaces, and the part of a zone of cracks.
    """
    with_strengths = with_in_situ(with_fitted_joints(study))
    return with_cracks(with_strengths)


def with_fitted_joints(study: Study) -> Study:
    """The study with strengths of interfaces that the quads of the core of a coupon can resolve."""
    if not isinstance(study.mesh, Coupon):
        return study
    materials = dict(study.materials)
    for name, joint in fitted_joints(study):
        found = fitted_strengths(name, study.mesh, study.all_laminates, study.materials)
        N, S = (float(f"{strength:.6g}") for strength in found)
        materials[name] = replace(joint, fit="none", N=N, S=S)
    return _changed(study, materials=materials)


def with_cracks(study: Study) -> Study:
    """The study whose zone of cracks is a part with the laminate, or with plies of its own."""
    if study.cracks is None or study.laminate is None or not isinstance(study.mesh, Coupon):
        return study
    circle = (*study.mesh.core_middle, study.cracks.radius)
    material = study.cracks.material or study.laminate.material
    title = f"{ZONE_OF_CRACKS} {study.laminate.layup}"
    inside = replace(study.laminate, title=title, material=material)
    return _changed(
        study,
        parts={**study.parts, ZONE_OF_CRACKS: PlaceSet(circle=circle)},
        laminates={**study.laminates, ZONE_OF_CRACKS: inside},
    )


def fitted_joints(study: Study) -> Iterator[tuple[str, Cohesive]]:
    """Interfaces in use whose strengths are fitted to the core, by their names."""
    used = {laminate.joint for laminate in study.all_laminates}
    for name, joint in study.materials.items():
        if name in used and isinstance(joint, Cohesive) and joint.is_fitted_to_core:
            yield name, joint


def with_in_situ(study: Study) -> Study:
    """The study with a material of its own for each cluster, where laminates ask for it."""
    if all(laminate.strengths == "given" for laminate in study.all_laminates):
        return study
    materials = dict(study.materials)
    origins = dict(study.origins)
    known = materials, origins
    laminates = {name: _renamed(each, *known) for name, each in study.laminates.items()}
    laminate = _renamed(study.laminate, *known) if study.laminate else None
    tables = {"materials": materials, "origins": origins, "laminates": laminates}
    return _changed(study, laminate=laminate, **tables)


def _renamed(
    laminate: Laminate, materials: dict[str, Material], origins: dict[str, Origin]
) -> Laminate:
    """A laminate whose clusters have materials of their own, which are added."""
    if laminate.strengths == "given":
        return laminate
    stack = list(laminate.stack)
    for cluster in clusters(laminate):
        ply = materials[cluster.material]
        if not isinstance(ply, DamagedPly):
            continue
        place = "outer" if cluster.outer else "embedded"
        name = f"{cluster.material} {cluster.thickness:g} {place}"
        exact = vars(in_situ(ply, cluster.thickness, cluster.outer))
        known = {key: value for key, value in exact.items() if hasattr(ply, key)}
        strengths: dict[str, Any] = {key: float(f"{value:.6g}") for key, value in known.items()}
        title = f"{ply.title or cluster.material} in situ {cluster.thickness:g} {place}"
        materials[name] = replace(ply, **strengths, title=title)
        if cluster.material in origins:
            origins[name] = origins[cluster.material]
        for number in range(cluster.first - 1, cluster.last):
            stack[number] = replace(stack[number], material=name)
    return _changed(laminate, stack=tuple(stack))


def _changed(thing: Any, **values: Any) -> Any:  # noqa: ANN401 - a study or a laminate
    """A frozen thing with other values, which are not checked again."""
    changed = copy.copy(thing)
    for name, value in values.items():
        object.__setattr__(changed, name, value)
    return changed


def strengths_of(study: Study) -> Iterator[tuple[str, Cluster, DamagedPly, Strengths | None]]:
    """Clusters of damaged plies with what they are made of and their in-situ strengths."""
    named = [("", study.laminate)] if study.laminate else []
    for part, laminate in [*named, *study.laminates.items()]:
        for cluster in clusters(laminate):
            ply = study.materials[cluster.material]
            if isinstance(ply, DamagedPly):
                known = toughnesses(ply)[1] > 0.0
                found = in_situ(ply, cluster.thickness, cluster.outer) if known else None
                yield part, cluster, ply, found
