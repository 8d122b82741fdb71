"""A linear layer-wise plate as matrices: a sparse stiffness and a diagonal mass."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array
from scipy.sparse.linalg import eigsh

from decks import Ply
from elasticity import Array, stiffness
from meshes import Integers, Mesh, plane_weights, shapes


class LayeredPlate:
    """Tied plies; unknowns by node of the mesh, then level from the bottom up, then x, y, z."""

    def __init__(self, mesh: Mesh, plies: Sequence[Ply], order: int) -> None:
        """Assemble stiffness (unknowns, unknowns) and mass (unknowns,), nothing held."""
        self.mesh, self.plies, self.order = mesh, plies, order
        self.levels = order * len(plies) + 1
        self.size = 3 * self.levels * len(mesh.points)
        self.height = sum(ply.thickness for ply in plies)
        self.stiffness = self._assemble()
        self.mass = self._masses()
        self.free = np.ones(self.size, bool)

    def hold(self, nodes: Sequence[int], directions: str) -> None:
        """Hold nodes in some of "xyz", all levels."""
        for direction in directions:
            for node in nodes:
                first = 3 * self.levels * node + "xyz".index(direction)
                self.free[first : first + 3 * self.levels : 3] = False

    def face(self, side: int) -> tuple[Array, Integers]:
        """Points of the top (1) or bottom (-1) face (nodes, 3), and their unknowns (nodes, 3)."""
        count = len(self.mesh.points)
        points = np.column_stack([self.mesh.points, np.full(count, 0.5 * side * self.height)])
        level = self.levels - 1 if side > 0 else 0
        first = 3 * (self.levels * np.arange(count) + level)
        return points, first[:, None] + np.arange(3)

    def strain_at(self, displacement: Array, quad: int, ply: int, place: Sequence[float]) -> Array:
        """Strain xx, yy, zz, xy, xz, yz at a place of a ply, from -1 to 1 along each axis."""
        nodes = self.mesh.quads[quad]
        strain = self._strain(nodes, self.plies[ply].thickness, place)[0]
        return strain @ displacement[self._unknowns(nodes, ply)]

    def stable_step(self) -> float:
        """Largest step of central differences, from the largest eigenvalue."""
        scale = diags_array(1.0 / np.sqrt(self.mass[self.free]))
        scaled = scale @ self.stiffness[self.free][:, self.free] @ scale
        return float(2.0 / np.sqrt(eigsh(scaled, 1, return_eigenvectors=False)[0]))

    def _lines(self, place: float) -> tuple[Array, Array]:
        """Lagrange polynomials through the thickness of a ply at -1 to 1, and their slopes."""
        nodes = np.linspace(-1.0, 1.0, self.order + 1)
        lines = [np.poly1d(np.poly(np.delete(nodes, k))) for k in range(self.order + 1)]
        lines = [line / line(node) for line, node in zip(lines, nodes, strict=True)]
        return np.array([f(place) for f in lines]), np.array([f.deriv()(place) for f in lines])

    def _assemble(self) -> csr_array:
        """Sum of the stiffness of all plies over all quads, (unknowns, unknowns)."""
        rows, columns, values = [], [], []
        for quad in self.mesh.quads:
            for number, ply in enumerate(self.plies):
                unknowns = self._unknowns(quad, number)
                rows.append(np.repeat(unknowns, len(unknowns)))
                columns.append(np.tile(unknowns, len(unknowns)))
                values.append(self._layer(quad, ply).ravel())
        places = (np.concatenate(rows), np.concatenate(columns))
        return csr_array(coo_array((np.concatenate(values), places), (self.size, self.size)))

    def _masses(self) -> Array:
        """Area of each node times the row sums through the thickness."""
        column = np.zeros(self.levels)
        for number, ply in enumerate(self.plies):
            for place, weight in zip(*np.polynomial.legendre.leggauss(4), strict=True):
                share = 0.5 * weight * ply.thickness * ply.material.density
                first = number * self.order
                column[first : first + self.order + 1] += share * self._lines(place)[0]
        return np.repeat(np.outer(plane_weights(self.mesh), column).ravel(), 3)

    def _unknowns(self, quad: Integers, number: int) -> Integers:
        """Unknowns of a ply over a quad, in the order of `_layer`."""
        levels = number * self.order + np.arange(self.order + 1)
        points = (self.levels * quad[:, None] + levels).ravel()
        return (3 * points[:, None] + np.arange(3)).ravel()

    def _layer(self, quad: Integers, ply: Ply) -> Array:
        """Stiffness of one ply over one quad, full integration."""
        modulus = stiffness(ply.material, ply.angle)
        total = np.zeros((3 * len(quad) * (self.order + 1),) * 2)
        plane = np.polynomial.legendre.leggauss(2 if len(quad) == 4 else 3)
        through = np.polynomial.legendre.leggauss(self.order + 1)
        for xi, u in zip(*plane, strict=True):
            for eta, v in zip(*plane, strict=True):
                for zeta, w in zip(*through, strict=True):
                    strain, area = self._strain(quad, ply.thickness, (xi, eta, zeta))
                    part = 0.5 * u * v * w * area * ply.thickness
                    total += part * strain.T @ modulus @ strain
        return total

    def _strain(
        self, quad: Integers, thickness: float, place: Sequence[float]
    ) -> tuple[Array, float]:
        """Strain from the unknowns of a ply over a quad, and area over that of the square."""
        values, slopes = shapes(len(quad), place[0], place[1])
        jacobian = slopes.T @ self.mesh.points[quad]
        slopes = slopes @ np.linalg.inv(jacobian).T
        line, rise = self._lines(place[2])
        gradient = np.stack(
            [
                np.outer(slopes[:, 0], line).ravel(),
                np.outer(slopes[:, 1], line).ravel(),
                np.outer(values, rise).ravel() * 2.0 / thickness,
            ]
        )
        return _strain(gradient), float(np.linalg.det(jacobian))


def _strain(gradient: Array) -> Array:
    """Strain xx, yy, zz, xy, xz, yz from the unknowns; gradient (3, points) of the shapes."""
    x, y, z = gradient
    strain = np.zeros((6, 3 * len(x)))
    strain[0, 0::3], strain[1, 1::3], strain[2, 2::3] = x, y, z
    strain[3, 0::3], strain[3, 1::3] = y, x
    strain[4, 0::3], strain[4, 2::3] = z, x
    strain[5, 1::3], strain[5, 2::3] = z, y
    return strain
