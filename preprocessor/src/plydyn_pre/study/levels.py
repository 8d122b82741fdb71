"""Sizes of quads by the process zone of the interfaces of a laminate."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from math import pi, sqrt

from plydyn_pre.mesh.coupon import Coupon, core_quads
from plydyn_pre.study.bending import crack_moduli, moduli
from plydyn_pre.study.joints import Cohesive
from plydyn_pre.study.laminate import Laminate, StackPly
from plydyn_pre.study.materials import Material

#: Node distances that the process zone of sliding spans at a level: three for the strengths of a
#: card to hold (Turon et al., 2007); with fewer an interface needs fitted, lower ones
_SPACINGS = {"look": 0.4, "standard": 0.8, "fine": 3.0}
#: The largest quad at a level, as a share of the core
_LARGEST_SHARE = {"look": 1.0 / 16.0, "standard": 1.0 / 32.0, "fine": 1.0 / 64.0}
#: Node distances that a zone must span
_POINTS = 3
#: Share of E G/strength^2 that a zone has in a large body (Rice; Falk et al.)
_RICE = 9.0 * pi / 32.0


@dataclass(frozen=True)
class ProcessZone:
    """Lengths of the zones in which the interfaces of a laminate soften; the shortest of all."""

    opening: float
    sliding: float


def process_zone(
    laminates: Iterable[Laminate], materials: Mapping[str, Material]
) -> ProcessZone | None:
    """The shortest zones, as the solver's listing has them; None where no interface fails.

    The smaller of the zone of a large body and that between thin layers (Yang and Cox, 2005).
    """
    zones = [
        _zone(joint, thickness, *plies)
        for laminate in laminates
        if isinstance(joint := materials.get(laminate.joint), Cohesive)
        for thickness, plies in _beside(laminate, materials)
    ]
    if not zones:
        return None
    return ProcessZone(min(zone.opening for zone in zones), min(zone.sliding for zone in zones))


def sized(
    shape: Coupon, laminates: Iterable[Laminate], materials: Mapping[str, Material]
) -> Coupon:
    """A coupon whose quads have a size: the one that is given, or that of its level.

    The core is divided evenly, so that they are a little smaller.
    """
    size = shape.quad or _LARGEST_SHARE[shape.level] * shape.core
    zone = process_zone(laminates, materials)
    if zone and not shape.quad:
        size = min(size, shape.order * zone.sliding / _SPACINGS[shape.level])
    return replace(shape, quad=shape.core / core_quads(shape.core, size))


def fitted_strengths(
    name: str, shape: Coupon, laminates: Iterable[Laminate], materials: Mapping[str, Material]
) -> tuple[float, float]:
    """Strengths of opening and sliding of an interface that the quads of the core resolve.

    Their zones in a large body then span three node distances (Turon et al., 2007). "core" takes
    one factor for both, as FIT of the solver does, quad by quad, and the modulus across the plies;
    "modes" gives each mode its own factor and the modulus of its crack.
    """
    joint, length = materials[name], _POINTS * shape.quad / shape.order
    if not isinstance(joint, Cohesive):
        raise TypeError(f"{name} has no strengths")
    opening, sliding = [1.0], [1.0]
    for laminate in laminates:
        if laminate.joint != name:
            continue
        for _, plies in _beside(laminate, materials):
            if joint.fit == "modes":
                of_modes = crack_moduli(laminate, materials, plies)
            else:
                of_modes = (min(moduli(ply)[1] for ply in plies),) * 2
            opening.append(sqrt(_RICE * of_modes[0] * joint.GIC / length) / joint.N)
            sliding.append(sqrt(_RICE * of_modes[1] * joint.GIIC / length) / joint.S)
    one, other = min(opening), min(sliding)
    if joint.fit == "core":
        one = other = min(one, other)
    return one * joint.N, other * joint.S


def _beside(
    laminate: Laminate, materials: Mapping[str, Material]
) -> Iterator[tuple[float, tuple[Material, Material]]]:
    """Thickness of the thinner stack beside each open interface, and the plies at it."""
    stack, ends = laminate.stack, [0, *laminate.opened, len(laminate.stack)]
    thick = [_thickness(stack[a:b]) for a, b in pairwise(ends)]
    for place, interface in enumerate(laminate.opened):
        plies = materials[stack[interface - 1].material], materials[stack[interface].material]
        yield min(thick[place], thick[place + 1]), plies


def _thickness(plies: Iterable[StackPly]) -> float:
    """Thickness of some plies."""
    return sum(ply.thickness for ply in plies)


def _zone(joint: Cohesive, thickness: float, one: Material, other: Material) -> ProcessZone:
    """The zones of an interface between two plies."""
    along = min(moduli(one)[0], moduli(other)[0])
    across = min(moduli(one)[1], moduli(other)[1])
    opening = (along * joint.GIC * thickness**3 / joint.N**2) ** 0.25
    sliding = sqrt(along * joint.GIIC * thickness) / joint.S
    return ProcessZone(
        min(opening, _RICE * across * joint.GIC / joint.N**2),
        min(sliding, _RICE * across * joint.GIIC / joint.S**2),
    )
