"""Deflection and buckling of a laminated plate, by Ritz's method with transverse shear.

Reissner and Mindlin: u = z phi_x, v = z phi_y and w over |x| < length/2, |y| < width/2 of a
symmetric laminate with bending stiffness D, D16 and D26 included, all in Legendre polynomials. On
supports along its edges w is (1 - xi^2)(1 - eta^2) times these. A plate that lies on something may
lift: w >= 0 at places of what it lies on, by non-negative forces there (Lawson and Hanson 1974).
`TERMS` polynomials along each axis: with two less the deflection changes by less than 0.1 %.

A plate that is compressed along x with its ends clamped and its sides on hard simple supports has
the factors 1 - xi^2 in phi_x, phi_y and w, and 1 - eta^2 in phi_x and w. Its stiffness of w, with
rotations that follow, loses the compressive stress times the thickness times the square of w_x.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import eigh
from scipy.optimize import nnls

from decks import Ply
from elasticity import Array, stiffness

#: Whether something is nothing at the ends x, and at the sides y
Edges = tuple[bool, bool]
FREE = (False, False)
#: Polynomials along each axis, and the share of shear stiffness of a parabola of stress
TERMS, SHEAR = 22, 5.0 / 6.0
#: Springs below a plate that lies on something, over its stiffness: without them it could fly away
SOFT = 1.0e-9


def bending_stiffness(plies: Sequence[Ply]) -> tuple[Array, Array]:
    """D (3, 3) in xx, yy, xy, and shear stiffness (2, 2) in xz, yz with its share."""
    total = sum(ply.thickness for ply in plies)
    height, bending, shear = -0.5 * total, np.zeros((3, 3)), np.zeros((2, 2))
    for ply in plies:
        above = height + ply.thickness
        bending += plane_stress(ply) * (above**3 - height**3) / 3.0
        shear += SHEAR * stiffness(ply.material, ply.angle)[4:, 4:] * ply.thickness
        height = above
    return bending, shear


def plane_stress(ply: Ply) -> Array:
    """Stiffness of a ply in xx, yy, xy without stress along z, (3, 3)."""
    full = stiffness(ply.material, ply.angle)
    plane, cross = full[np.ix_([0, 1, 3], [0, 1, 3])], full[[0, 1, 3], 2]
    return plane - np.outer(cross, cross) / full[2, 2]


def deflection(
    plies: Sequence[Ply], size: tuple[float, float], patch: float, base: Array | None = None
) -> float:
    """Deflection at the middle for a unit of force, spread over a square of some side there.

    On supports along the edges, or on places of a base, (places, 2), that only push.
    """
    half, held = 0.5 * np.array(size), base is None
    k = _stiffness(plies, half, (FREE, FREE, (held, held)))
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


def compressed(
    plies: Sequence[Ply], size: tuple[float, float], stress: float
) -> tuple[float, Callable[[Array], Array]]:
    """Square of the lowest angular frequency between clamped ends under a compressive stress.

    Without the inertia of rotation. Also its shape, at most 1, over places (n, 2) from the middle.
    """
    half = 0.5 * np.array(size)
    stiff, geometric, mass = _compression(plies, half)
    squares, shapes = eigh(stiff - stress * geometric, mass, subset_by_index=(0, 0))

    def shape(places: Array) -> Array:
        values = _values(places / half, held=True) @ shapes[:, 0]
        return values / np.abs(values).max()

    return float(squares[0]), shape


def buckling_stress(plies: Sequence[Ply], size: tuple[float, float]) -> float:
    """Compressive stress at which a plate between clamped ends buckles."""
    stiff, geometric, _ = _compression(plies, 0.5 * np.array(size))
    return 1.0 / float(eigh(geometric, stiff, eigvals_only=True)[-1])


def _compression(plies: Sequence[Ply], half: Array) -> tuple[Array, Array, Array]:
    """Stiffness of w, what a unit of stress takes from it, and mass."""
    places, weights = legendre.leggauss(TERMS + 4)
    parts = _products((True, True), places)
    share = np.kron(weights, weights) * np.prod(half)
    total = sum(ply.thickness for ply in plies)
    inertia = sum(ply.material.density * ply.thickness for ply in plies)
    whole = _stiffness(plies, half, ((True, True), (True, False), (True, True)))
    n = TERMS**2
    turns = whole[: 2 * n, : 2 * n]
    stiff = whole[2 * n :, 2 * n :] - whole[2 * n :, : 2 * n] @ np.linalg.solve(
        turns, whole[: 2 * n, 2 * n :]
    )
    slope = parts[1] / half[0]
    geometric = total * slope.T @ (share[:, None] * slope)
    mass = inertia * parts[0].T @ (share[:, None] * parts[0])
    return 0.5 * (stiff + stiff.T), geometric, mass


def _inverse(k: Array) -> Array:
    """Compliance of w alone, with rotations that follow."""
    n = TERMS**2
    return np.linalg.inv(k)[2 * n :, 2 * n :]


def _values(places: Array, *, held: bool) -> Array:
    """All products of polynomials of w at places (n, 2), (n, terms^2)."""
    along, across = (_polynomials(places[:, axis], held=held)[0] for axis in (0, 1))
    return np.einsum("pi,pj->pij", along, across).reshape(len(places), -1)


def _stiffness(plies: Sequence[Ply], half: Array, held: tuple[Edges, Edges, Edges]) -> Array:
    """Stiffness of phi_x, phi_y and w of a plate with half the sides, (3 n, 3 n).

    Each is nothing at the ends, at the sides, at both or at none.
    """
    bending, shear = bending_stiffness(plies)
    places, weights = legendre.leggauss(TERMS + 4)
    (x, x_x, x_y), (y, y_x, y_y), (none, w_x, w_y) = (_products(each, places) for each in held)
    x_x, y_x, w_x = (each / half[0] for each in (x_x, y_x, w_x))
    x_y, y_y, w_y = (each / half[1] for each in (x_y, y_y, w_y))
    none = np.zeros_like(none)
    bend = [np.hstack(row) for row in ((x_x, none, none), (none, y_y, none), (x_y, y_x, none))]
    slip = [np.hstack(row) for row in ((x, none, w_x), (none, y, w_y))]
    share = np.kron(weights, weights) * np.prod(half)
    return _quadratic(np.stack(bend), bending, share) + _quadratic(np.stack(slip), shear, share)


def _quadratic(strain: Array, stiffness: Array, share: Array) -> Array:
    """Stiffness of strains (components, points, coefficients) with weights of points."""
    root = np.einsum("ij,jpn->ipn", np.linalg.cholesky(stiffness).T, strain)
    root = (np.sqrt(share)[:, None] * root).reshape(-1, strain.shape[-1])
    return root.T @ root


def _products(held: Edges, places: Array) -> tuple[Array, Array, Array]:
    """All products at all points, and their derivatives along both axes, (points^2, terms^2)."""
    (x, slope_x), (y, slope_y) = (_polynomials(places, held=each) for each in held)
    return np.kron(x, y), np.kron(slope_x, y), np.kron(x, slope_y)


def _polynomials(places: Array, *, held: bool) -> tuple[Array, Array]:
    """Legendre polynomials, times 1 - xi^2 where held, and derivatives, (places, terms)."""
    values = legendre.legvander(places, TERMS - 1)
    slopes = np.stack([legendre.legval(places, legendre.legder(row)) for row in np.eye(TERMS)], 1)
    if not held:
        return values, slopes
    bubble = (1.0 - places**2)[:, None]
    return bubble * values, bubble * slopes - 2.0 * places[:, None] * values
