"""Cracks of the matrix as lines around the place of an impact."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from math import isclose

from plydyn_pre.errors import RecipeError, require, require_not_negative, require_positive
from plydyn_pre.mesh import Coupon, Rectangle, Shape
from plydyn_pre.mesh.coupon import Level
from plydyn_pre.study.control import Control, Units
from plydyn_pre.study.joints import Cohesive
from plydyn_pre.study.laminate import Laminate, is_alike
from plydyn_pre.study.materials import Material
from plydyn_pre.units import unit_factor

#: Name of the part of a zone of cracks
ZONE_OF_CRACKS = "cracks"
#: Distance from the rim of the core to the zone, in quads: lines end inside of equal quads
_RIM = 1.0
_SLACK = 1.0e-6
#: Sides of quads at a level, mm: those on which forces and areas with crack lines were compared
_QUADS: dict[Level, float] = {"look": 1.5, "standard": 1.0, "fine": 0.75}
#: Energy of a crack that begins in mode I, N/mm: less than the toughness of a delamination
_TOUGHNESS = 0.3


@dataclass(frozen=True)
class Cracks:
    """Cracks of every ply along lines parallel to its fibres.

    In a coupon they lie in a circle in its core, which is a part of its own, of the name "cracks";
    in a rectangle everywhere. The fibres lie along the edges and diagonals of the quads, at 0, 45,
    90 and -45 degrees.
    """

    spacing: float  # between two cracks of a ply, rounded to lines of nodes
    radius: float = 0.0  # of the zone in a coupon; 0: half of the core less a quad
    material: str = ""  # of the plies in that zone; without it that of the laminate
    GC: float = 0.0  # energy per area of crack in all modes; 0: 0.3 N/mm
    friction: float = 0.3  # coefficient, of closed cracks
    stiffness: float = 0.0  # traction per opening; 0: ten times E2 over the distance of lines
    YT: float = 0.0  # strength across the fibres; 0: that of the ply
    SL: float = 0.0  # shear strength along the fibres; 0: that of the ply
    ST: float = 0.0  # strength in shear through the thickness; 0: YT
    debris: float = 0.0  # largest opening of a crack that debris holds, length; 0 for none

    def __post_init__(self) -> None:
        """Refuse numbers that no crack has."""
        require_positive(self, "spacing")
        require_not_negative(self, "radius", "GC", "friction", "stiffness", "YT", "SL", "ST")
        require_not_negative(self, "debris")

    def toughness(self, units: Units) -> float:
        """Energy per area of crack in some units."""
        return self.GC or _TOUGHNESS * unit_factor((0, -2, 1), vars(units))


def quads_with_cracks(shape: Coupon, units: Units) -> Coupon:
    """A coupon whose quads have a size, also where cracks and its level give it."""
    size = _QUADS[shape.level] * unit_factor((1, 0, 0), vars(units))
    return replace(shape, quad=shape.quad or size)


def with_radius(cracks: Cracks, shape: Coupon) -> Cracks:
    """Cracks whose zone has a radius: the largest one if none is given."""
    return replace(cracks, radius=cracks.radius or _largest_radius(shape))


def _largest_radius(shape: Coupon) -> float:
    """Of a zone that leaves a quad of the core all around it."""
    radius = shape.core / 2.0 - _RIM * shape.quad
    rule = f"{shape.core:g} must be above {2.0 * _RIM * shape.quad:g}, two quads, for cracks in it"
    require(radius > 0.0, "mesh.core", rule)
    return radius


def check_cracks(
    cracks: Cracks,
    shape: Shape,
    control: Control,
    laminate: Laminate,
    materials: Mapping[str, Material],
) -> None:
    """Refuse what crack lines cannot go with, by the key that has to change."""
    _check_mesh(shape, cracks, laminate)
    rule = 'cracks need "explicit", and interfaces of 1e5 N/mm3 (normal, shear) to go with it'
    require(control.scheme == "explicit", "control.scheme", rule)
    _check_laminate(laminate, materials)


def _check_mesh(shape: Shape, cracks: Cracks, laminate: Laminate) -> None:
    """Equal quads of four nodes wherever lines are, and a whole plate."""
    if isinstance(shape, Rectangle):
        _check_rectangle(shape, cracks, laminate)
    elif not isinstance(shape, Coupon):
        rule = 'cracks need equal quads: the core of a "coupon", or a "rectangle"'
        raise RecipeError("mesh.kind", rule)
    require(shape.order == 1, "mesh.order", "cracks need quads of four nodes: order = 1")
    if isinstance(shape, Coupon):
        require(not shape.quarter, "mesh.quarter", "cracks would lie on the planes of symmetry")
        rim = _largest_radius(shape)
        rule = f"{cracks.radius:g} must be at most {rim:g}, half of the core less a quad"
        require(cracks.radius <= rim * (1.0 + _SLACK), "cracks.radius", rule)


def _check_rectangle(shape: Rectangle, cracks: Cracks, laminate: Laminate) -> None:
    """All of its quads are equal, and all of them crack."""
    rule = "cracks need equal quads; leave it out"
    require(shape.grading == 1.0, "mesh.grading", rule)
    require(not shape.zones, "mesh.zones", rule)
    for name in ("radius", "material"):
        rule = "a rectangle cracks everywhere; leave it out, or take a coupon"
        require(not getattr(cracks, name), f"cracks.{name}", rule)
    a, b = (side / quads for side, quads in zip(shape.sides, shape.quads, strict=True))
    straight = all(ply.angle % 90.0 == 0.0 for ply in laminate.stack)
    rule = f"the diagonals of quads of {a:g} x {b:g} lie along no ply at 45 degrees"
    require(straight or isclose(a, b, rel_tol=1e-3), "mesh.quads", rule)


def _check_laminate(laminate: Laminate, materials: Mapping[str, Material]) -> None:
    """Plies of one layer each, with interfaces between all of them."""
    for number, ply in enumerate(laminate.stack, start=1):
        rule = f"ply {number} has order {ply.order}; cracks need 1"
        require(ply.order == 1, "laminate.order", rule)
        rule = f"ply {number} has {ply.layers} layers; cracks need one a ply"
        require(ply.layers == 1, "laminate.layers", rule)
        require(ply.angle % 45.0 == 0.0, "laminate.layup", _angle(number, ply.angle))
    for number, pair in enumerate(pairwise(laminate.stack), start=1):
        rule = (
            f"plies {number} and {number + 1} are alike; cracks need them as one ply:"
            " join_alike = true"
        )
        joined = not is_alike(*pair) or number in laminate.opened
        require(joined, "laminate.join_alike", rule)
    every = len(laminate.opened) == len(laminate.stack) - 1
    require(every, "laminate.interfaces", "cracks need plies that are not tied to each other")
    joint = materials.get(laminate.joint)
    fitted = isinstance(joint, Cohesive) and joint.fit in ("strengths", "both")
    rule = "strengths are fitted to the mesh; cracks decide where delaminations begin: leave it out"
    require(not fitted, f"materials.{laminate.joint}.fit", rule)


def _angle(number: int, angle: float) -> str:
    """Why a ply cannot have crack lines."""
    return (
        f"ply {number} at {angle:g} degrees: crack lines follow edges and diagonals of quads, at 0,"
        " 45, 90 and -45 degrees; cracks = false (--set cracks=false) smears cracks over quads"
    )
