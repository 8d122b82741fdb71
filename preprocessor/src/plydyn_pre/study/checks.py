"""What the parts of a study ask of each other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import hypot

from plydyn_pre.errors import require
from plydyn_pre.mesh import Shape
from plydyn_pre.mesh.quarter import PLANES
from plydyn_pre.study.bricks import Bricks
from plydyn_pre.study.conditions import (
    Curve,
    FrameAcceleration,
    Lever,
    Load,
    Pressure,
    Support,
)
from plydyn_pre.study.control import Control, Outputs, Units
from plydyn_pre.study.fixtures import Bar, Clamp, Fixture
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


def is_quarter(shape: Shape) -> bool:
    """Whether a mesh is a quarter of what the study is of."""
    return getattr(shape, "quarter", False)


def planes() -> tuple[Support, ...]:
    """Supports that keep nodes in the planes of symmetry."""
    return tuple(Support(name, hold=axis) for name, axis in zip(PLANES, "xy", strict=True))


def check_quarter(
    mesh: Shape, laminates: Iterable[Laminate], impactor: Impactor | None, loads: Sequence[Load]
) -> None:
    """Refuse what is not symmetric to both planes."""
    for laminate in laminates:
        angles = {ply.angle % 90.0 for ply in laminate.stack}
        rule = "a quarter needs plies along x and y: 0 and 90 only"
        require(angles <= {0.0}, "laminate.layup", rule)
    if impactor:
        straight = impactor.guided or impactor.start[:2] == (0.0, 0.0)
        require(straight, "impactor.velocity", "a quarter is hit along z")
        centre = getattr(mesh, "centre", None)
        midway = impactor.position in (None, centre)
        require(midway, "impactor.position", "a quarter is hit in the middle of the whole")
        along_one = impactor.axis is None or impactor.axis.count(0.0) == 2
        require(along_one, "impactor.axis", "a body on a quarter lies along x or y, or stands")
    for number, load in enumerate(loads, start=1):
        across = isinstance(load, FrameAcceleration) and load.direction == "z"
        rule = "a quarter takes pressures and an acceleration along z"
        require(across or isinstance(load, Pressure), f"loads[{number}]", rule)


def check_fixtures(mesh: Shape, fixtures: Sequence[Fixture]) -> None:
    """Refuse fixtures that are not symmetric to both planes, or not on the quarter."""
    middle = getattr(mesh, "centre", (0.0, 0.0))
    for number, fixture in enumerate(fixtures, start=1):
        path = f"fixtures[{number}]"
        if isinstance(fixture, Bar):
            places = [one[i] - middle[i] for one in (fixture.start, fixture.end) for i in (0, 1)]
            require(min(places) >= 0.0, f"{path}.start", "a quarter needs a bar on it")
            continue
        x, y = fixture.centre or middle
        at = (x - middle[0], y - middle[1])
        if isinstance(fixture, Clamp) and at != (0.0, 0.0):
            rule = "a quarter needs clamps in the middle of the whole, or wholly on the quarter"
            require(min(at) >= fixture.outer, f"{path}.centre", rule)
        else:
            rule = "a quarter needs fixtures in the middle of the whole"
            require(at == (0.0, 0.0), f"{path}.centre", rule)


def share_of(mesh: Shape, clamp: Clamp) -> float:
    """The share of a clamp that lies on the quarter."""
    middle = getattr(mesh, "centre", (0.0, 0.0))
    return 0.25 if (clamp.centre or middle) == middle else 1.0
