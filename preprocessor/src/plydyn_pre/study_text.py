"""What follows from a study and an engineer wants to see, from the fall to in-situ strengths."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import isfinite

from plydyn_pre.deck.contact_duration import contact_durations
from plydyn_pre.deck.names import Names
from plydyn_pre.errors import RecipeError
from plydyn_pre.mesh import Coupon, Mesh
from plydyn_pre.mesh.quality import quad_areas
from plydyn_pre.study import (
    REGIONS,
    Cluster,
    DamagedPly,
    Impactor,
    PlyFracture3d,
    Strengths,
    Study,
    fitted_joints,
    process_zone,
)
from plydyn_pre.study.levels import fitted_strengths
from plydyn_pre.study.unused import used_materials
from plydyn_pre.units import unit_factor

#: Standard gravity in mm/s^2
_GRAVITY = 9806.65
_JOULE, _KILOGRAM = 1.0e3, 1.0e-3  # in mJ and t
_STRENGTHS = ("YT", "YC", "SL")


def told(study: Study) -> Iterator[tuple[str, str]]:
    """Headings with their words."""
    names = used_materials(study)
    for name, origin in study.origins.items():
        if name in names:
            yield "origin", f"{name}: {origin.words}"
    if study.impactor is not None and study.impactor.energy is not None:
        yield "fall", _fall(study, study.impactor)
    if isinstance(study.mesh, Coupon):
        yield "core", _core(study, study.mesh)
        for name, joint in fitted_joints(study):
            N, S = fitted_strengths(name, study.mesh, study.all_laminates, study.materials)
            words = f"N {N:.4g} in place of {joint.N:.4g}, S {S:.4g} of {joint.S:.4g}"
            if (N, S) == (joint.N, joint.S):
                words = f"N {N:.4g} and S {S:.4g} as they are: zones are long enough"
            yield "fitted to core", f"{name}: {words}"


def _fall(study: Study, impactor: Impactor) -> str:
    """Energy, mass, velocity and height of a fall."""
    units = vars(study.units)
    energy = (impactor.energy or 0.0) / (_JOULE * unit_factor((2, -2, 1), units))
    mass = impactor.mass / (_KILOGRAM * unit_factor((0, 0, 1), units))
    speed = -impactor.start[2]
    height = speed**2 / (2.0 * _GRAVITY * unit_factor((1, -2, 0), units))
    names = study.units
    return (
        f"{energy:.4g} J of {mass:.4g} kg: {speed:.5g} {names.length}/{names.time}, from a height"
        f" of {height:.4g} {names.length}"
    )


def _core(study: Study, shape: Coupon) -> str:
    """Quads of the core beside the process zones of the interfaces."""
    unit = study.units.length
    words = f"quads of {shape.quad:.4g} {unit}"
    if shape.core_middle != shape.centre:
        x, y = shape.core_middle
        words += f" around [{x:.4g}, {y:.4g}]"
    zone = process_zone(study.all_laminates, study.materials)
    if zone is None:
        return words
    spacing = shape.quad / shape.order
    return (
        f"{words}; process zones {zone.opening:.3g} (opening) and {zone.sliding:.3g} {unit}"
        f" (sliding), {zone.opening / spacing:.2g} and {zone.sliding / spacing:.2g} node distances"
    )


def contact_lines(study: Study, mesh: Mesh) -> Iterator[tuple[str, str]]:
    """Headings with the estimates."""
    names = study.units
    for found in contact_durations(study, mesh):
        sides = [f"{span:.4g}" for span in found.spans if isfinite(span)]
        kind = "plate" if len(sides) > 1 else "beam"
        stage = "" if found.path == "control." else f"{found.path}impactor: "
        yield (
            "contact",
            f"{stage}about {found.duration:.2g} {names.time}, half a period on a simply supported"
            f" {kind} of {' x '.join(sides)} {names.length}",
        )


def early_ends(study: Study, mesh: Mesh) -> Iterator[str]:
    """Ends of runs before that of the contact, by their keys."""
    for found in contact_durations(study, mesh):
        if found.start < found.end_time < found.end:
            yield (
                f"{found.path}end_time: the impactor will touch the plate for about"
                f" {found.duration:.2g} {study.units.time}, longer than the run lasts; give more"
                f" than {found.end:.2g}, and until_contact_ends for an end after the contact"
            )


def set_lines(study: Study, mesh: Mesh) -> Iterator[str]:
    """Each set with its nodes, and with its quads and their area where it can have quads."""
    names, areas = Names(study, mesh), quad_areas(mesh)
    for name, rule in study.sets.items():
        nodes, quads = names.members_of(name)
        line = f"{name}: {len(nodes)} nodes"
        if rule.key in REGIONS:
            line += f", {len(quads)} quads, {areas[quads].sum():.6g} {study.units.length}2"
        yield line


def strength_lines(
    rows: Iterable[tuple[str, Cluster, DamagedPly, Strengths | None]],
) -> Iterator[str]:
    """A heading and a line for each cluster: strengths as given, and behind them in situ."""
    heads = "".join(f"{name:>9}{'in situ':>9}" for name in _STRENGTHS)
    yield f"{'plies':>9}{'angle':>7}{'thickness':>11}{'place':>10}{heads}"
    for part, cluster, ply, found in rows:
        if found is None:
            path = f"materials.{cluster.material}.GIIC"
            raise RecipeError(path, "0; in-situ strengths need it, here or as G2S")
        plies = f"{cluster.first}" if cluster.first == cluster.last else ""
        plies = plies or f"{cluster.first}-{cluster.last}"
        place = "outer" if cluster.outer else "embedded"
        cells = "".join(
            f"{getattr(each, name):>9.5g}" for name in _STRENGTHS for each in (ply, found)
        )
        line = f"{plies:>9}{cluster.angle:>7g}{cluster.thickness:>11.4g}{place:>10}{cells}"
        yield f"{line}  {part}".rstrip()


def is_linear(ply: DamagedPly) -> bool:
    """Whether in-situ strengths take the shear of a ply as linear."""
    if isinstance(ply, PlyFracture3d):
        return ply.shear in ("linear", "curve")
    return ply.cubic <= 0.0 and ply.shear != "ramberg_osgood"
