"""Bending of a laminate by classical theory, and the deflection under a point force."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import cos, pi, radians, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from plydyn_pre.study.joints import Cohesive, Springs
from plydyn_pre.study.laminate import Laminate
from plydyn_pre.study.materials import Elastic, Material, PlasticKinematic

Reals = NDArray[np.float64]

#: Half waves along each side of a plate that are summed
_WAVES = 100
#: Points of the integral over half a period, whose error falls with their power
_PHASES = 64


def moduli(material: Material) -> tuple[float, float, float]:
    """Moduli of a ply: along its fibres, across the plies, and of the shear between both."""
    if isinstance(material, Springs | Cohesive):
        raise TypeError(f"{type(material).__name__} is not a ply")
    if isinstance(material, Elastic | PlasticKinematic):
        young, nu = _isotropic(material)
        return young, young, young / (2.0 * (1.0 + nu))
    return material.E1, material.E3, material.G13


def bending_stiffness(laminate: Laminate, materials: dict[str, Material]) -> Reals:
    """The matrix D without strain of the mid-plane, (3, 3)."""
    a, b, d = _stiffnesses(laminate, materials)
    return d - b @ np.linalg.solve(a, b)


def membrane_flexibility(laminate: Laminate, materials: Mapping[str, Material]) -> Reals:
    """The inverse of the matrix A, (3, 3)."""
    return np.linalg.inv(_stiffnesses(laminate, materials)[0])


def crack_moduli(
    laminate: Laminate, materials: Mapping[str, Material], plies: Iterable[Material]
) -> tuple[float, float]:
    """Square of the stress intensity over the energy release rate, of opening and of sliding.

    A crack along a laminate between two plies, as in one orthotropic body (Sih, Paris, Irwin, Int.
    J. Fract. Mech. 1 (1965) 189): the softer direction of the laminate, the smaller moduli across
    and in shear of the plies. Poisson's ratio, which adds some per cent, is left out.
    """
    along = 1.0 / (laminate.total * np.diag(membrane_flexibility(laminate, materials))[:2].max())
    _, across, shear = (min(each) for each in zip(*map(moduli, plies), strict=True))
    form = sqrt(0.5 * (sqrt(along / across) + along / (2.0 * shear)))
    return sqrt(along * across) / form, along / form


def _stiffnesses(laminate: Laminate, materials: Mapping[str, Material]) -> Reals:
    """The matrices A, B and D about the middle, (3, 3, 3)."""
    a, b, d = np.zeros((3, 3, 3))
    z = -0.5 * laminate.total
    for ply in laminate.stack:
        low, z = z, z + ply.thickness
        stiffness = _turned(_plane_stress(materials[ply.material]), ply.angle)
        a += stiffness * (z - low)
        b += stiffness * (z**2 - low**2) / 2.0
        d += stiffness * (z**3 - low**3) / 3.0
    return np.array([a, b, d])


def half_period(mass: float, linear: float, cubic: float, energy: float) -> float:
    """Half a period of a mass on a spring with a linear and a cubic term (Duffing)."""
    square = 4.0 * energy / (linear + sqrt(linear**2 + 4.0 * cubic * energy))
    phase = pi * (np.arange(_PHASES) + 0.5) / _PHASES
    springs = linear + 0.5 * cubic * square * (1.0 + np.sin(phase) ** 2)
    return float(pi * np.sqrt(mass / springs).mean())


def cubic_stiffness(flexibility: Reals, spans: Reals) -> float:
    """Force over the third power of the displacement of a simply supported rectangle.

    The membrane of von Karman's plate with one half wave along each side, whose edges stay straight
    and may come closer.
    """
    ends = 1.0 / (np.diag(flexibility)[:2] * spans**4)
    return float(pi**4 * spans.prod() * ends.sum() / 64.0)


def point_stiffness(d: Reals, arms: Reals, width: tuple[float, float]) -> float:
    """Force over displacement of a rectangle on simple supports, or of a beam.

    `arms` has the distances of the force from the supports on the low and the high side along x
    and y, (2, 2), infinite where there are none; coupling of bending and twisting is left out.
    """
    spans = arms.sum(axis=1)
    for axis in range(2):
        if not np.isfinite(spans[axis]):
            one, other = arms[1 - axis]
            bends = 1.0 / np.linalg.inv(d)[1 - axis, 1 - axis]
            return 3.0 * bends * width[axis] * (one + other) / (one * other) ** 2
    wave = np.arange(1, _WAVES + 1)
    x, y = ((wave / span) ** 2 for span in spans)
    shape = [np.sin(wave * pi * arms[k, 0] / spans[k]) ** 2 for k in range(2)]
    stiffness = d[0, 0] * x[:, None] ** 2 + d[1, 1] * y**2
    stiffness += 2.0 * (d[0, 1] + 2.0 * d[2, 2]) * np.outer(x, y)
    return float(pi**4 * spans.prod() / (4.0 * (np.outer(*shape) / stiffness).sum()))


def _plane_stress(material: Material) -> Reals:
    """Stiffness in the axes of a ply."""
    if isinstance(material, Springs | Cohesive):
        raise TypeError(f"{type(material).__name__} is not a ply")
    if isinstance(material, Elastic | PlasticKinematic):
        young, nu = _isotropic(material)
        first = second = young
        shear = young / (2.0 * (1.0 + nu))
    else:
        first, second, nu, shear = material.E1, material.E2, material.nu12, material.G12
    share = 1.0 - nu**2 * second / first
    coupling = nu * second / share
    return np.array(
        [[first / share, coupling, 0.0], [coupling, second / share, 0.0], [0.0, 0.0, shear]]
    )


def _isotropic(material: Elastic | PlasticKinematic) -> tuple[float, float]:
    """Young's modulus and Poisson's ratio."""
    if isinstance(material, Elastic):
        return material.E, material.nu
    return material.young, material.poisson


def _turned(stiffness: Reals, angle: float) -> Reals:
    """A stiffness in axes that are turned back by an angle, degrees."""
    c, s = cos(radians(angle)), sin(radians(angle))
    rows = [c * c, s * s, c * s], [s * s, c * c, -c * s], [-2.0 * c * s, 2.0 * c * s, c * c - s * s]
    strains = np.array(rows)
    return strains.T @ stiffness @ strains
