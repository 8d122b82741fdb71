"""What follows from a study and an engineer wants to see: the fall, quads and process zones."""

from __future__ import annotations

from collections.abc import Iterator

from plydyn_pre.mesh import Coupon
from plydyn_pre.study import Impactor, Study, fitted_joints, process_zone
from plydyn_pre.study.levels import fitted_strengths
from plydyn_pre.study.unused import used_materials
from plydyn_pre.units import unit_factor

#: Standard gravity in mm/s^2
_GRAVITY = 9806.65
_JOULE, _KILOGRAM = 1.0e3, 1.0e-3  # in mJ and t


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
