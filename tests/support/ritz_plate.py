"""Deflection of a laminated plate in or on a window, by Ritz's method with transverse shear.

Reissner and Mindlin: u = z phi_x, v = z phi_y and w over |x| < length/2, |y| < width/2 of a
symmetric laminate with bending stiffness D, D16 and D26 included, all in Legendre polynomials. On
supports along its edges w is (1 - xi^2)(1 - eta^2) times these. A plate that lies on something may
lift: w >= 0 at places of what it lies on, by non-negative forces there (Lawson and Hanson 1974).
`TERMS` polynomials along each axis: with two less the deflection changes by less than 0.1 %.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.polynomial import legendre
from scipy.optimize import nnls

from decks import Ply
from elasticity import Array, stiffness

#: Polynomials along each axis, and the share of shear stiffness of a parabola of stress
TERMS, SHEAR = 22, 5.0 / 6.0
#: Springs below a plate that lies on something, over its stiffness: without them it could fly away
SOFT = 1.0e-9


def bending_stiffness(plies: Sequence[Ply]) -> tuple[Array, Array]:
    """D (3, 3) in xx, yy, xy, and shear stiffness (2, 2) in xz, yz with its share."""
    total = sum(ply.thickness for ply in plies)
    height, bending, shear = -0.5 * total, np.zeros((3, 3)), np.zeros((2, 2))
    for ply in plies:
        full = stiffness(ply.material, ply.angle)
        plane, cross = full[np.ix_([0, 1, 3], [0, 1, 3])], full[[0, 1, 3], 2]
        reduced = plane - np.outer(cross, cross) / full[2, 2]
        above = height + ply.thickness
        bending += reduced * (above**3 - height**3) / 3.0
        shear += SHEAR * full[4:, 4:] * ply.thickness
        height = above
    return bending, shear


def deflection(
    plies: Sequence[Ply], size: tuple[float, float], patch: float, base: Array | None = None
) -> float:
    """Deflection at the middle for a unit of force, spread over a square of some side there.

    On supports along the edges, or on places of a base, (places, 2), that only push.
    """
    half, held = 0.5 * np.array(size), base is None
    k = _stiffness(plies, half, held=held)
    places, weights = legendre.leggauss(TERMS)
    reach = patch / (2.0 * half)
    means = [0.5 * weights @ _polynomials(each * places, held=held)[0] for each in reach]
    load, middle = np.kron(*means), _values(np.zeros((1, 2)), held=held)[0]
    if held:
        return float(middle @ _inverse(k) @ load)
    soft = _inverse(k + SOFT * np.trace(k) / len(k) * np.eye(len(k)))
    rows = _values(base / half, held=False)
    root = np.linalg.cholesky(rows @ soft @ rows.T + SOFT * np.eye(len(rows)) * np.max(soft))
    forces, _ = nnls(root.T, np.linalg.solve(root, rows @ soft @ load))
    return float(middle @ soft @ (load - rows.T @ forces))


def _inverse(k: Array) -> Array:
    """Compliance of w alone, with rotations that follow."""
    n = TERMS**2
    return np.linalg.inv(k)[2 * n :, 2 * n :]


def _values(places: Array, *, held: bool) -> Array:
    """All products of polynomials of w at places (n, 2), (n, terms^2)."""
    along, across = (_polynomials(places[:, axis], held=held)[0] for axis in (0, 1))
    return np.einsum("pi,pj->pij", along, across).reshape(len(places), -1)


def _stiffness(plies: Sequence[Ply], half: Array, *, held: bool) -> Array:
    """Stiffness of phi_x, phi_y and w of a plate with half the sides, (3 n, 3 n)."""
    bending, shear = bending_stiffness(plies)
    places, weights = legendre.leggauss(TERMS + 4)
    free, lifted = _polynomials(places, held=False), _polynomials(places, held=held)
    w_x, w_y = (_products(lifted, axis) / half[axis] for axis in (0, 1))
    f, (f_x, f_y) = _products(free), (_products(free, axis) / half[axis] for axis in (0, 1))
    none = np.zeros_like(f)
    bend = [np.hstack(row) for row in ((f_x, none, none), (none, f_y, none), (f_y, f_x, none))]
    slip = [np.hstack(row) for row in ((f, none, w_x), (none, f, w_y))]
    share = np.kron(weights, weights) * np.prod(half)
    return _quadratic(np.stack(bend), bending, share) + _quadratic(np.stack(slip), shear, share)


def _quadratic(strain: Array, stiffness: Array, share: Array) -> Array:
    """Stiffness of strains (components, points, coefficients) with weights of points."""
    root = np.einsum("ij,jpn->ipn", np.linalg.cholesky(stiffness).T, strain)
    root = (np.sqrt(share)[:, None] * root).reshape(-1, strain.shape[-1])
    return root.T @ root


def _products(parts: tuple[Array, Array], axis: int = -1) -> Array:
    """All products at all points, or their derivatives along an axis, (points^2, terms^2)."""
    return np.kron(parts[int(axis == 0)], parts[int(axis == 1)])


def _polynomials(places: Array, *, held: bool) -> tuple[Array, Array]:
    """Legendre polynomials, times 1 - xi^2 where held, and derivatives, (places, terms)."""
    values = legendre.legvander(places, TERMS - 1)
    slopes = np.stack([legendre.legval(places, legendre.legder(row)) for row in np.eye(TERMS)], 1)
    if not held:
        return values, slopes
    bubble = (1.0 - places**2)[:, None]
    return bubble * values, bubble * slopes - 2.0 * places[:, None] * values
