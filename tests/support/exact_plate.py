"""Exact three-dimensional solutions of simply supported cross-ply plates.

For one harmonic the fields are, with p = m pi / a and q = n pi / b,

    u   = U(z) cos px sin qy      v   = V(z) sin px cos qy      w   = W(z) sin px sin qy
    txz = X(z) cos px sin qy      tyz = Y(z) sin px cos qy      szz = Z(z) sin px sin qy

and equilibrium and Hooke's law make (U, V, W, X, Y, Z)' = A (U, V, W, X, Y, Z) in each ply, with A
constant: the solution is a product of matrix exponentials (Pagano 1970; Srinivas and Rao 1970).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

from elasticity import Array, Material, stiffness


@dataclass(frozen=True)
class CrossPly:
    """A rectangular cross-ply plate, simply supported on its four edges."""

    length: float  # along x
    width: float  # along y
    plies: tuple[tuple[Material, float, float], ...]  # material, thickness, angle: bottom up

    @property
    def thickness(self) -> float:
        """Thickness of the laminate."""
        return sum(ply[1] for ply in self.plies)


@dataclass(frozen=True)
class Fields:
    """Amplitudes of one harmonic at a height: displacements (3) and stresses (6, Voigt)."""

    displacement: Array
    stress: Array


def _system(c: Array, p: float, q: float, inertia: float) -> Array:
    """Matrix A of the first-order system; inertia is density times omega squared."""
    r13, r23 = c[0, 2] / c[2, 2], c[1, 2] / c[2, 2]
    q11, q22 = c[0, 0] - r13 * c[0, 2], c[1, 1] - r23 * c[1, 2]
    q12 = c[0, 1] - r13 * c[1, 2]
    cross = (q12 + c[3, 3]) * p * q
    return np.array(
        [
            [0.0, 0.0, -p, 1.0 / c[4, 4], 0.0, 0.0],
            [0.0, 0.0, -q, 0.0, 1.0 / c[5, 5], 0.0],
            [r13 * p, r23 * q, 0.0, 0.0, 0.0, 1.0 / c[2, 2]],
            [q11 * p * p + c[3, 3] * q * q - inertia, cross, 0.0, 0.0, 0.0, -r13 * p],
            [cross, q22 * q * q + c[3, 3] * p * p - inertia, 0.0, 0.0, 0.0, -r23 * q],
            [0.0, 0.0, -inertia, p, q, 0.0],
        ]
    )


class Harmonic:
    """One harmonic (m, n) of a plate at an angular frequency, zero for statics.

    Lengths are counted in thicknesses and stresses in the first ply's G12, which keeps the
    exponentials well conditioned.
    """

    def __init__(self, plate: CrossPly, m: int = 1, n: int = 1, omega: float = 0.0) -> None:
        """Set up the systems of all plies."""
        self.unit = plate.thickness
        self.modulus = plate.plies[0][0].shear[0]
        self.wave = np.pi * self.unit * np.array([m / plate.length, n / plate.width])
        self.heights = [ply[1] / self.unit for ply in plate.plies]
        self.moduli = [stiffness(ply[0], ply[2]) / self.modulus for ply in plate.plies]
        scale = (omega * self.unit) ** 2 / self.modulus
        self.systems = [
            _system(c, *self.wave, scale * ply[0].density)
            for c, ply in zip(self.moduli, plate.plies, strict=True)
        ]

    def transfer(self) -> Array:
        """Matrix from the bottom face to the top face, (6, 6)."""
        total = np.eye(6)
        for system, height in zip(self.systems, self.heights, strict=True):
            total = expm(system * height) @ total
        return total

    def bottom_under(self, load: float) -> Array:
        """State of the bottom face when the top face is pulled by `load`."""
        state = np.zeros(6)
        state[:3] = np.linalg.solve(self.transfer()[3:, :3], [0.0, 0.0, load / self.modulus])
        return state

    def fields(self, bottom: Array, ply: int, share: float) -> Fields:
        """Amplitudes in a ply (from 0) at a share of its thickness, from the bottom state."""
        state = bottom
        for k in range(ply):
            state = expm(self.systems[k] * self.heights[k]) @ state
        state = expm(self.systems[ply] * self.heights[ply] * share) @ state
        c, (p, q) = self.moduli[ply], self.wave
        xx, yy = -p * state[0], -q * state[1]
        zz = (state[5] - c[0, 2] * xx - c[1, 2] * yy) / c[2, 2]
        xy = q * state[0] + p * state[1]
        normal = c[:3, :3] @ [xx, yy, zz]
        stress = np.array([*normal, c[3, 3] * xy, state[3], state[4]])
        return Fields(state[:3] * self.unit, stress * self.modulus)


def frequency(plate: CrossPly, m: int, n: int, below: float) -> float:
    """Lowest natural angular frequency of a harmonic, looked for between zero and a bound."""

    def determinant(omega: float) -> float:
        return float(np.linalg.det(Harmonic(plate, m, n, omega).transfer()[3:, :3]))

    trials = np.linspace(below * 1e-3, below, 400)
    signs = np.sign([determinant(omega) for omega in trials])
    change = int(np.flatnonzero(signs[:-1] * signs[1:] < 0)[0])
    return float(brentq(determinant, trials[change], trials[change + 1], xtol=1e-12 * below))
