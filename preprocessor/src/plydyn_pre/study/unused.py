"""What a study defines and nothing uses."""

from __future__ import annotations

from plydyn_pre.study.study import Study


def unused(study: Study) -> list[str]:
    """Keys of materials, sets, curves and the mesh that do not reach the deck."""
    used = {
        "materials": used_materials(study),
        "sets": _sets(study),
        "curves": _curves(study),
    }
    names = [
        f"{table}.{name}"
        for table, names in used.items()
        for name in getattr(study, table)
        if name not in names
    ]
    meshed = [f"mesh.{key}" for key in getattr(study.mesh, "idle", ())]
    return names + _idle(study, used["materials"]) + meshed


def _idle(study: Study, used: set[str]) -> list[str]:
    """Keys of materials that have no effect by what else is chosen."""
    return [
        f"materials.{name}.{key}"
        for name, material in study.materials.items()
        if name in used
        for key in getattr(material, "idle", ())
    ]


def used_materials(study: Study) -> set[str]:
    """Names of the materials of plies and of what joins them."""
    laminates = [*study.laminates.values(), *([study.laminate] if study.laminate else [])]
    plies = {ply.material for laminate in laminates for ply in laminate.stack}
    zone = {study.cracks.material} - {""} if study.cracks else set()
    return plies | zone | {laminate.joint for laminate in laminates}


def _curves(study: Study) -> set[str]:
    """Names of the curves of the step, the impactor, loads, fixtures and materials in use."""
    known = used_materials(study) & study.materials.keys()
    materials = [study.materials[name] for name in known]
    shear = {getattr(material, "shear_curve", "") for material in materials}
    parts = study.parts_of_chain
    loads = {getattr(load, "curve", "") for part in parts for load in part.loads}
    keys = ("curve", "move_x", "move_y", "move_z")
    bodies = [fixture for part in parts for fixture in part.fixtures]
    fixtures = {getattr(fixture, key, "") for fixture in bodies for key in keys}
    impactors = {getattr(part.impactor, "motion_z", "") for part in parts}
    return {study.control.step_curve} | impactors | loads | shear | fixtures


def _sets(study: Study) -> set[str]:
    """Names of the sets of supports, loads and outputs."""
    parts = study.parts_of_chain
    uses: list[object] = [user for part in parts for user in (*part.supports, *part.loads)]
    uses += study.initial_delamination
    users = {getattr(user, key, "") for user in uses for key in ("set", "hinge", "fulcrum")}
    return users.union(*(part.outputs.nodes for part in parts))
