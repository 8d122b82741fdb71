"""Stiffness of plies from engineering constants, in Voigt order xx, yy, zz, xy, xz, yz."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Material:
    """Constants of a ply in its own axes: 1 fibre, 2 across in the plane, 3 normal."""

    density: float
    young: tuple[float, float, float]
    poisson: tuple[float, float, float]  # nu12, nu13, nu23
    shear: tuple[float, float, float]  # G12, G13, G23


def isotropic(density: float, young: float, poisson: float) -> Material:
    """Make a material with the same constants in every direction."""
    shear = young / (2.0 * (1.0 + poisson))
    return Material(density, (young,) * 3, (poisson,) * 3, (shear,) * 3)


def ply_stiffness(material: Material) -> Array:
    """Stiffness in the axes of the ply, (6, 6), engineering shear strains."""
    young, (nu12, nu13, nu23) = np.array(material.young), material.poisson
    compliance = np.zeros((6, 6))
    compliance[:3, :3] = np.diag(1.0 / young)
    compliance[0, 1] = compliance[1, 0] = -nu12 / young[0]
    compliance[0, 2] = compliance[2, 0] = -nu13 / young[0]
    compliance[1, 2] = compliance[2, 1] = -nu23 / young[1]
    compliance[3:, 3:] = np.diag(1.0 / np.array(material.shear))
    return np.linalg.inv(compliance)


def stiffness(material: Material, angle: float = 0.0) -> Array:
    """Stiffness in the axes of the laminate, for fibres at an angle in degrees from x.

    With T the strains of the ply from those of the laminate, C = T' C_ply T.
    """
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    strain = np.zeros((6, 6))
    strain[0, [0, 1, 3]] = c * c, s * s, c * s
    strain[1, [0, 1, 3]] = s * s, c * c, -c * s
    strain[2, 2] = 1.0
    strain[3, [0, 1, 3]] = -2.0 * c * s, 2.0 * c * s, c * c - s * s
    strain[4, [4, 5]] = c, s
    strain[5, [4, 5]] = -s, c
    return strain.T @ ply_stiffness(material) @ strain


# A carbon ply, and another that differs from it in every constant; mm, s, t, N, MPa
CARBON = Material(1.6e-9, (153.0e3, 10.3e3, 10.3e3), (0.3, 0.3, 0.4), (6.0e3, 6.0e3, 3.7e3))
GLASS = Material(2.1e-9, (45.0e3, 12.0e3, 11.0e3), (0.28, 0.26, 0.35), (5.0e3, 4.5e3, 3.9e3))
STEEL = isotropic(7.85e-9, 210.0e3, 0.3)
