"""Strengths of plies between others, after Camanho, Davila, Pinho, Iannucci and Robinson (2006).

A matrix crack in a ply that others hold must spend toughness to grow through it: the thinner the
ply, the higher is the stress at which it does. Neighbours of one material and direction are one
thick ply, a cluster.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi, sqrt

from plydyn_pre.errors import require
from plydyn_pre.study.laminate import Laminate, StackPly, is_alike
from plydyn_pre.study.materials import Material, PlyCodam2, PlyFracture3d

#: Plies that have strengths
DamagedPly = PlyCodam2 | PlyFracture3d
_HALVINGS = 200


@dataclass(frozen=True)
class Cluster:
    """Neighbouring plies of one material and direction."""

    first: int  # counted from the bottom, from 1
    last: int
    material: str
    angle: float
    thickness: float
    outer: bool  # has a face of the laminate


@dataclass(frozen=True)
class Strengths:
    """In-situ strengths of a cluster, stress."""

    YT: float  # matrix in tension
    YC: float  # matrix in compression
    SL: float  # shear in the plane 12
    ST: float  # shear in the plane 23; 0 where the ply has none


def clusters(laminate: Laminate) -> list[Cluster]:
    """The clusters of a laminate from the bottom up."""
    groups: list[list[tuple[int, StackPly]]] = []
    for number, ply in enumerate(laminate.stack, start=1):
        if groups and is_alike(groups[-1][-1][1], ply):
            groups[-1].append((number, ply))
        else:
            groups.append([(number, ply)])
    return [
        Cluster(
            first=group[0][0],
            last=group[-1][0],
            material=group[0][1].material,
            angle=group[0][1].angle,
            thickness=sum(ply.thickness for _, ply in group),
            outer=group is groups[0] or group is groups[-1],
        )
        for group in groups
    ]


def in_situ(ply: DamagedPly, thickness: float, outer: bool) -> Strengths:
    """Strengths of a ply of some thickness, with a free face or between others."""
    tension = _tension(ply, thickness, outer)
    shear = _shear(ply, thickness, outer)
    ratio = shear / ply.SL
    across = ply.ST if isinstance(ply, PlyCodam2) else 0.0
    return Strengths(YT=tension, YC=ratio * ply.YC, SL=shear, ST=ratio * across)


def toughnesses(ply: DamagedPly) -> tuple[float, float]:
    """Toughnesses of a crack through a ply in opening and in shear; 0 for one that is missing."""
    if isinstance(ply, PlyFracture3d):
        return ply.G2T, ply.G2S
    return ply.GIC or ply.G2T, ply.GIIC or ply.G2S


def check_in_situ(path: str, laminate: Laminate, materials: Mapping[str, Material]) -> None:
    """Refuse in-situ strengths without what they need."""
    if laminate.strengths == "given":
        return
    damaged = {
        ply.material: each
        for ply in laminate.stack
        if isinstance(each := materials[ply.material], DamagedPly)
    }
    rule = '"in-situ" needs a material of kind ply_codam2 or ply_fracture_3d'
    require(bool(damaged), f"{path}.strengths", rule)
    for name, ply in damaged.items():
        rule = "0; in-situ strengths need the toughness in shear, here or as G2S"
        require(toughnesses(ply)[1] > 0.0, f"materials.{name}.GIIC", rule)


def _tension(ply: DamagedPly, thickness: float, outer: bool) -> float:
    """Strength of the matrix in tension."""
    minor = ply.nu12 * ply.E2 / ply.E1
    compliance = 2.0 * (1.0 / ply.E2 - minor**2 / ply.E1)
    root = sqrt(toughnesses(ply)[0] / (pi * thickness * compliance))
    if outer:
        return max(1.79 * root, ply.YT)
    return max(sqrt(8.0) * root, 1.12 * sqrt(2.0) * ply.YT)


def _shear(ply: DamagedPly, thickness: float, outer: bool) -> float:
    """Strength in shear: the stress at which the work of shear pays for the crack."""
    toughness = toughnesses(ply)[1]
    if outer:
        return max(_stress_of(ply, 2.0 * toughness / (pi * thickness)), ply.SL)
    thin = _stress_of(ply, 4.0 * toughness / (pi * thickness))
    return max(thin, _stress_of(ply, 2.0 * _work(ply, ply.SL)))


def _work(ply: DamagedPly, stress: float) -> float:
    """Work of shear per volume up to a stress."""
    linear = stress**2 / (2.0 * ply.G12)
    if isinstance(ply, PlyFracture3d) and ply.shear == "hardening":
        over = max(stress**2 - ply.shear_yield**2, 0.0)
        return linear + over / (2.0 * ply.G12 * ply.shear_hardening)
    cubic = ply.cubic if isinstance(ply, PlyCodam2) else 0.0
    if cubic > 0.0 or ply.shear != "ramberg_osgood":
        return linear + 0.75 * cubic * stress**4
    power = ply.shear_exponent
    return linear + ply.shear_coefficient * power / (power + 1.0) * stress ** (power + 1.0)


def _stress_of(ply: DamagedPly, work: float) -> float:
    """The stress at which shear has done some work per volume, by halving."""
    low, high = 0.0, sqrt(2.0 * ply.G12 * work)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _work(ply, middle) < work else (low, middle)
    return high
