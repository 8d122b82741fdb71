"""What the parts of a study ask of each other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import hypot

from plydyn_pre.errors import require
from plydyn_pre.study.bricks import Bricks
from plydyn_pre.study.conditions import Curve, Lever, Load
from plydyn_pre.study.control import Control, Outputs, Units
from plydyn_pre.study.impactor import Impactor
from plydyn_pre.study.joints import Cohesive
from plydyn_pre.study.laminate import Laminate
from plydyn_pre.study.materials import Material, PlasticKinematic, PlyCodam2, PlyFracture3d
from plydyn_pre.units import unit_factor

#: Speed of the fastest guns of light gas, mm/s, and room above it
_FASTEST = 2.0e7
#: Thickness of a laminate over the radius of the impactor at most
_THICKEST = 1.0e6
#: Fields that need a material of some kind, and what such a material does
_NEEDS = {
    "plastic_strain": (PlasticKinematic | PlyFracture3d, "yields"),
    "damage_fibre": (PlyCodam2 | PlyFracture3d, "is damaged"),
    "damage_matrix": (PlyCodam2 | PlyFracture3d, "is damaged"),
    "damage_shear": (PlyCodam2 | PlyFracture3d, "is damaged"),
    "dissipated": (PlasticKinematic | PlyCodam2 | PlyFracture3d, "yields or is damaged"),
}


def check_fields(
    laminates: Iterable[Laminate], materials: Mapping[str, Material], outputs: Outputs
) -> None:
    """Refuse fields and histories that no material fills."""
    plies = [materials[ply.material] for laminate in laminates for ply in laminate.stack]
    for number, name in enumerate(outputs.fields or (), start=1):
        if name in _NEEDS:
            kinds, does = _NEEDS[name]
            rule = f"{name!r} needs a ply of a material that {does}"
            filled = any(isinstance(material, kinds) for material in plies)
            require(filled, f"outputs.fields[{number}]", rule)
    fails = any(isinstance(materials.get(each.joint), Cohesive) for each in laminates)
    rule = "needs interfaces of a cohesive material; leave it out"
    asked = outputs.delamination_interval is not None
    require(fails or not asked, "outputs.delamination_interval", rule)


def check_scheme(laminates: Iterable[Laminate], bricks: Bricks | None, control: Control) -> None:
    """Refuse a scheme without what it makes implicit."""
    if bricks is not None:
        require(control.scheme == "explicit", "control.scheme", 'bricks need "explicit"')
    joined = any(each.opened and each.joint != "apart" for each in laminates)
    rule = "no plies are joined by an interface that could be implicit"
    require(joined or control.scheme != "implicit_interfaces", "control.scheme", rule)


def check_thickness(path: str, laminate: Laminate, impactor: Impactor | None) -> None:
    """Refuse a laminate beside which an impactor is round-off."""
    thin = impactor is None or laminate.total <= _THICKEST * impactor.radius
    rule = f"{laminate.total:.6g} in all, too thick for the radius of the impactor"
    require(thin, f"{path}.thickness", rule)


def check_speed(impactor: Impactor | None, units: Units) -> None:
    """Refuse an impactor that is faster than any impact, which no time step can follow."""
    if impactor is not None:
        speed = hypot(*impactor.start)
        fastest = _FASTEST * unit_factor((1, -1, 0), vars(units))
        rule = f"{speed:.6g} is faster than any impact, {fastest:g} {units.length}/{units.time}"
        key = "velocity" if impactor.energy is None else "energy"
        require(speed <= fastest, f"impactor.{key}", rule)


def check_levers(loads: Iterable[Load], faces: set[str], control: Control) -> None:
    """Refuse levers where the inertia of columns is implicit, and on faces that have contact."""
    for number, load in enumerate(loads, start=1):
        if not isinstance(load, Lever):
            continue
        rule = 'a lever needs "explicit"'
        require(control.scheme == "explicit", "control.scheme", rule)
        met = load.face in faces or (load.face == "all" and bool(faces))
        rule = "a lever is not on a face that an impactor or a fixture meets"
        require(not met, f"loads[{number}].face", rule)


def check_step_curve(curves: Mapping[str, Curve], control: Control) -> None:
    """Refuse a curve that bounds the step by zero or less."""
    if curve := curves.get(control.step_curve):
        rule = "values that bound the step must be above zero"
        require(min(curve.value) > 0.0, f"curves.{control.step_curve}.value", rule)
