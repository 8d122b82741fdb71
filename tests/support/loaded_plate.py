"""Frequencies and buckling of a compressed cross-ply, by Ritz's method for a solid.

The plate lies in 0 < x < length, 0 < y < width, on hard simple supports along y = 0 and y = width:

    u = U(x, z) sin(k y),  v = V(x, z) cos(k y),  w = W(x, z) sin(k y),  k = pi / width.

Along z U, V and W are polynomials in every ply. Along x they are Legendre polynomials between
clamped ends, or one half-wave of a plate on simple supports, from crest to crest, which is exact:

    U ~ sin(pi x / length),  V, W ~ cos(pi x / length).

The plate is compressed by a strain along x alone, free to become wider: stresses s_x and s_y of
every ply. Small motion about that state has the energy (Washizu 1968, initial stress problems)

    K - strain G,  G = int -s_x (U_x^2 + V_x^2 + W_x^2) - s_y k^2 (U^2 + V^2 + W^2)

for a unit of strain, and the mass M. The plate buckles where K - strain G loses its definiteness.
The solid has transverse shear in it. Orders are those beyond which no printed digit changes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import eigh

from decks import Ply
from elasticity import Array, stiffness

#: Polynomials along x, and their order through a ply
TERMS, ORDER = 14, 2


def membrane(ply: Ply) -> Array:
    """Stiffness in plane stress, components xx and yy, (2, 2)."""
    full = stiffness(ply.material, ply.angle)[:3, :3]
    return full[:2, :2] - np.outer(full[:2, 2], full[2, :2]) / full[2, 2]


@dataclass(frozen=True)
class LoadedPlate:
    """A symmetric stack of plies of 0 and 90 degrees, its ends clamped or crests of a wave."""

    length: float
    width: float
    plies: Sequence[Ply]
    clamped: bool

    @property
    def widening(self) -> float:
        """Strain across for a unit of compression, without force across."""
        _, a12, a22 = self._sums
        return a12 / a22

    @property
    def stress(self) -> float:
        """Mean stress for a unit of compression."""
        a11, a12, a22 = self._sums
        return (a11 - a12**2 / a22) / sum(ply.thickness for ply in self.plies)

    @property
    def _sums(self) -> tuple[float, float, float]:
        """Membrane stiffness of the laminate: A11, A12, A22."""
        total = sum(ply.thickness * membrane(ply) for ply in self.plies)
        return float(total[0, 0]), float(total[0, 1]), float(total[1, 1])

    @cached_property
    def _matrices(self) -> tuple[Array, Array, Array]:
        """K, G and M, (3 n, 3 n) with U, V and W after each other."""
        x, lengths = self._points
        along = [self._terms(x, component) for component in range(3)]
        k = np.pi / self.width
        levels = len(self.plies) * ORDER + 1
        size = along[0][0].shape[1] * levels
        found = [np.zeros((3 * size, 3 * size)) for _ in range(3)]
        for place, ply in enumerate(self.plies):
            rows = slice(place * ORDER, (place + 1) * ORDER + 1)
            values, slopes = np.zeros((2, ORDER + 1, levels))
            values[:, rows], slopes[:, rows], weights = _through(ply.thickness)
            c = stiffness(ply.material, ply.angle)
            first = membrane(ply) @ [-1.0, self.widening]
            for xi, weight in enumerate(lengths):
                for z, part in enumerate(weights):
                    value = [np.kron(each[0][xi], values[z]) for each in along]
                    slope = [np.kron(each[1][xi], values[z]) for each in along]
                    normal = [np.kron(each[0][xi], slopes[z]) for each in along]
                    strain = _strain(value, slope, normal, k)
                    share = weight * part
                    found[0] += share * strain.T @ c @ strain
                    for own in range(3):
                        at = slice(own * size, (own + 1) * size)
                        square = np.outer(value[own], value[own])
                        found[2][at, at] += share * ply.material.density * square
                        found[1][at, at] -= share * first[1] * k**2 * square
                        found[1][at, at] -= share * first[0] * np.outer(slope[own], slope[own])
        return found[0], found[1], found[2]

    def buckling_strain(self) -> float:
        """Compression at which the plate buckles."""
        k, g, _ = self._matrices
        return float(1.0 / eigh(g, k, eigvals_only=True, subset_by_index=[len(k) - 1] * 2)[0])

    def mode(self, strain: float) -> tuple[float, Array]:
        """First angular frequency at a compression, and its deflection at 4 `TERMS` + 1 points.

        The deflection is that of the middle plane along x, largest 1, with its x, (2, points).
        """
        k, g, m = self._matrices
        squares, shapes = eigh(k - strain * g, m, subset_by_index=[0, 0])
        x = np.linspace(0.0, self.length, 4 * TERMS + 1)
        terms = self._terms(x, 2)[0]
        deflection = shapes[2 * len(shapes) // 3 :, 0].reshape(terms.shape[1], -1)
        shape = terms @ deflection[:, deflection.shape[1] // 2]
        return float(np.sqrt(squares[0])), np.stack([x, shape / shape[np.argmax(np.abs(shape))]])

    @property
    def _points(self) -> tuple[Array, Array]:
        """Gauss points along x and their weights."""
        places, weights = legendre.leggauss(TERMS + 2)
        return 0.5 * self.length * (places + 1.0), 0.5 * self.length * weights

    def _terms(self, x: Array, component: int) -> tuple[Array, Array]:
        """Functions of U, V or W along x and their slopes, (points, terms)."""
        if self.clamped:
            return _polynomials(x, self.length, bubbles=component != 1)
        p = np.pi / self.length
        sine, cosine = np.sin(p * x)[:, None], np.cos(p * x)[:, None]
        return (sine, p * cosine) if component == 0 else (cosine, -p * sine)


def _strain(value: list[Array], slope: list[Array], normal: list[Array], k: float) -> Array:
    """Strains xx, yy, zz, xy, xz, yz of the coefficients, without sin(k y) or cos(k y)."""
    none = np.zeros_like(value[0])
    return np.stack(
        [
            np.concatenate([slope[0], none, none]),
            np.concatenate([none, -k * value[1], none]),
            np.concatenate([none, none, normal[2]]),
            np.concatenate([k * value[0], slope[1], none]),
            np.concatenate([normal[0], none, slope[2]]),
            np.concatenate([none, normal[1], k * value[2]]),
        ]
    )


def _polynomials(x: Array, length: float, bubbles: bool) -> tuple[Array, Array]:
    """Legendre polynomials and their slopes, or times 1 - xi^2, which is nothing at the ends."""
    values, slopes = np.empty((2, len(x), TERMS))
    xi = 2.0 * x / length - 1.0
    for term in range(TERMS):
        series = legendre.Legendre.basis(term)
        if bubbles:
            series = series * legendre.Legendre.fromroots([-1.0, 1.0])
        values[:, term] = series(xi)
        slopes[:, term] = series.deriv()(xi) * 2.0 / length
    return values, slopes


def _through(thickness: float) -> tuple[Array, Array, Array]:
    """Values and slopes of Lagrange's quadratics at Gauss points of a ply, and their weights."""
    z, weights = legendre.leggauss(ORDER + 1)
    values = np.stack([z * (z - 1.0) / 2.0, 1.0 - z**2, z * (z + 1.0) / 2.0], axis=1)
    slopes = np.stack([z - 0.5, -2.0 * z, z + 0.5], axis=1) * 2.0 / thickness
    return values, slopes, 0.5 * thickness * weights
