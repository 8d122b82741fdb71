"""Elastic bricks as dense matrices, as section 5 of `manual/theory.md` describes them."""

from __future__ import annotations

import numpy as np

from brick_decks import Bricks
from elasticity import Array

#: xi, eta and zeta of the nodes
CORNERS = np.array(
    [
        (x, y, z)
        for z in (-1.0, 1.0)
        for x, y in ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))
    ]
)
#: Values of eta zeta, zeta xi, xi eta and xi eta zeta at the nodes, (4, 8)
UNFELT = np.array([CORNERS[:, k].prod(axis=1) for k in ([1, 2], [2, 0], [0, 1], [0, 1, 2])])
#: Voigt order xx, yy, zz, xy, xz, yz
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
VISCOUS, STIFF = 3, 6


class BrickPatch:
    """Stiffness and drag of hourglass control (unknowns, unknowns), and mass (unknowns,)."""

    def __init__(
        self, mesh: Bricks, moduli: Array, density: float, hourglass: tuple[int, float] | None
    ) -> None:
        """Assemble bricks with moduli of their own, (bricks, 6, 6).

        With hourglass control they have one point, without it eight.
        """
        size = 3 * len(mesh.points)
        self.stiffness, self.drag = np.zeros((2, size, size))
        self.mass = np.zeros(size)
        for nodes, modulus in zip(mesh.bricks, moduli, strict=True):
            unknowns = (3 * nodes[:, None] + np.arange(3)).ravel()
            block = np.ix_(unknowns, unknowns)
            brick = _Brick(mesh.points[nodes], modulus)
            self.mass[unknowns] += density * np.repeat(brick.shares, 3)
            if hourglass is None:
                self.stiffness[block] += brick.full()
                continue
            self.stiffness[block] += brick.mean()
            kind, share = hourglass
            if kind == VISCOUS:
                self.drag[block] += share * brick.drag(density)
            else:
                self.stiffness[block] += share * brick.hold()


class _Brick:
    """One brick: its nodes (8, 3) and modulus."""

    def __init__(self, nodes: Array, modulus: Array) -> None:
        """Volumes of the nodes, mean gradients (8, 3), and amounts of unfelt shapes (12, 24)."""
        self.nodes, self.modulus = nodes, modulus
        self.shares, slopes = np.zeros(8), np.zeros((8, 3))
        for place, weight in _gauss(3):
            volume, gradient = self._gradient(place)
            self.shares += weight * volume * np.prod(1.0 + CORNERS * place, axis=1) / 8.0
            slopes += weight * volume * gradient
        self.volume = self.shares.sum()
        self.slopes = slopes / self.volume
        felt = UNFELT - (UNFELT @ nodes) @ self.slopes.T
        self.amounts = np.kron(felt / 8.0, np.eye(3))

    def mean(self) -> Array:
        """Stiffness of one point with the mean gradients."""
        strain = _strain(self.slopes)
        return self.volume * strain.T @ self.modulus @ strain

    def full(self) -> Array:
        """Stiffness of 2 x 2 x 2 points that share the mean of their volume strain."""
        points = [(weight, *self._gradient(place)) for place, weight in _gauss(2)]
        parts = np.array([weight * volume for weight, volume, _ in points])
        strains = np.array([_strain(gradient) for _, _, gradient in points])
        traces = strains[:, :3].sum(axis=1)
        strains[:, :3] += ((parts @ traces / parts.sum() - traces) / 3.0)[:, None]
        return np.einsum("p,pia,ij,pjb->ab", parts, strains, self.modulus, strains, optimize=True)

    def drag(self, density: float) -> Array:
        """Viscous control with a coefficient of 1, with the fastest wave along an axis."""
        impedance = np.sqrt(density * np.diag(self.modulus)[:3].max())
        rate = 0.25 * impedance * self.volume ** (2.0 / 3.0)
        return 64.0 * rate * self.amounts.T @ self.amounts

    def hold(self) -> Array:
        """Stiffness against the unfelt shapes of a box along the axes, with a coefficient of 1.

        Bending: strains along two axes that grow with the third coordinate, no stress across, no
        shear. Twisting: shear. The last shape: strain along one axis alone, in uniaxial stress.
        """
        half, c, energy = 0.5 * np.ptp(self.nodes, axis=0), self.modulus, np.zeros((12, 12))

        def add(modulus: Array, *amounts: dict[int, float]) -> None:
            strain = np.zeros((len(amounts), 12))
            for row, amount in zip(strain, amounts, strict=True):
                row[list(amount)] = list(amount.values())
            energy[:] += strain.T @ modulus @ strain

        for k, (i, j) in enumerate(((1, 2), (0, 2), (0, 1))):
            # the shape that grows along i and k has the number of j
            plane = c[np.ix_([i, j], [i, j])] - np.outer(c[[i, j], k], c[k, [i, j]]) / c[k, k]
            add(plane / 3.0, {3 * j + i: 1.0 / half[i]}, {3 * i + j: 1.0 / half[j]})
            shear = PAIRS.index((i, j))
            add(c[[[shear]], shear] / 3.0, {4 * i: 1.0 / half[j], 4 * j: 1.0 / half[i]})
            add(np.eye(1) / np.linalg.inv(c[:3, :3])[k, k] / 9.0, {9 + k: 1.0 / half[k]})
        return self.volume * self.amounts.T @ energy @ self.amounts

    def _gradient(self, place: Array) -> tuple[float, Array]:
        """Jacobian and gradients (8, 3) of the shape functions."""
        factors = 1.0 + CORNERS * place
        slopes = [np.delete(factors, k, axis=1).prod(axis=1) * CORNERS[:, k] for k in range(3)]
        slopes = np.stack(slopes, axis=1) / 8.0
        jacobian = self.nodes.T @ slopes
        return float(np.linalg.det(jacobian)), slopes @ np.linalg.inv(jacobian)


def _gauss(count: int) -> list[tuple[Array, float]]:
    """Gauss points in three directions and their weights."""
    line = list(zip(*np.polynomial.legendre.leggauss(count), strict=True))
    return [
        (np.array([x, y, z]), float(u * v * w)) for x, u in line for y, v in line for z, w in line
    ]


def _strain(gradient: Array) -> Array:
    """Strain from the unknowns of the nodes, engineering shear, (6, 24)."""
    strain = np.zeros((6, 24))
    for row, (i, j) in enumerate(PAIRS):
        strain[row, i::3] += gradient[:, j]
        if i != j:
            strain[row, j::3] += gradient[:, i]
    return strain
