"""Simply supported cross-ply plates, exact in the plane and expanded through the thickness.

The displacements of one harmonic, as in `exact_plate`, with U(z), V(z) and W(z) piecewise Lagrange
polynomials on equal distances: what the elements give on a mesh of quads without end.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh

from elasticity import Array, stiffness
from exact_plate import CrossPly, Fields


class ExpandedHarmonic:
    """Stiffness and lumped mass of one harmonic; unknowns by level, then U, V, W."""

    def __init__(
        self, plate: CrossPly, order: int, sublayers: int = 1, m: int = 1, n: int = 1
    ) -> None:
        """Assemble all layers, from the bottom up."""
        self.order, self.sublayers = order, sublayers
        self.wave = np.pi * np.array([m / plate.length, n / plate.width])
        self.layers = [
            (stiffness(material, angle), thickness / sublayers, material.density)
            for material, thickness, angle in plate.plies
            for _ in range(sublayers)
        ]
        places = np.linspace(-1.0, 1.0, order + 1)
        self.shapes = [
            np.poly1d(np.poly(others) / np.prod(place - others))
            for place, others in ((place, places[places != place]) for place in places)
        ]
        size = 3 * (order * len(self.layers) + 1)
        self.stiffness, self.mass = np.zeros((size, size)), np.zeros(size)
        for k, (modulus, height, density) in enumerate(self.layers):
            for place, weight in zip(*np.polynomial.legendre.leggauss(order + 1), strict=True):
                strain, part = self._strain(place, height), 0.5 * weight * height
                self.stiffness[self._of(k), self._of(k)] += part * strain.T @ modulus @ strain
                self.mass[self._of(k)] += part * density * np.repeat(self._values(place), 3)

    def under(self, load: float) -> Array:
        """Unknowns when the top face is pulled by `load`."""
        force = np.zeros(len(self.mass))
        force[-1] = load
        return np.linalg.solve(self.stiffness, force)

    def fields(self, unknowns: Array, ply: int, share: float) -> Fields:
        """Amplitudes in a ply (from 0) at a share of its thickness."""
        sublayer = min(int(share * self.sublayers), self.sublayers - 1)
        place = 2.0 * (share * self.sublayers - sublayer) - 1.0
        k = ply * self.sublayers + sublayer
        modulus, height, _ = self.layers[k]
        own = unknowns[self._of(k)]
        displacement = self._values(place) @ own.reshape(-1, 3)
        return Fields(displacement, modulus @ self._strain(place, height) @ own)

    def modes(self) -> tuple[Array, Array]:
        """Angular frequencies, and shapes (unknowns, modes) of unit mass per area."""
        squares, shapes = eigh(self.stiffness, np.diag(self.mass))
        return np.sqrt(squares), shapes

    def _of(self, layer: int) -> slice:
        """Unknowns of a layer."""
        return slice(3 * self.order * layer, 3 * (self.order * (layer + 1) + 1))

    def _values(self, place: float) -> Array:
        """Lagrange polynomials at a place from -1 to 1."""
        return np.array([shape(place) for shape in self.shapes])

    def _strain(self, place: float, height: float) -> Array:
        """Amplitudes of the strains from the unknowns of a layer."""
        (p, q), matrix = self.wave, np.zeros((6, 3 * len(self.shapes)))
        for t, (shape, value) in enumerate(zip(self.shapes, self._values(place), strict=True)):
            slope, u, v, w = 2.0 / height * shape.deriv()(place), 3 * t, 3 * t + 1, 3 * t + 2
            matrix[[0, 3, 4], [u, u, u]] = -p * value, q * value, slope
            matrix[[1, 3, 5], [v, v, v]] = -q * value, p * value, slope
            matrix[[2, 4, 5], [w, w, w]] = slope, p * value, q * value
        return matrix
