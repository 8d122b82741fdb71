"""Stress through the thickness of one ply at a point, in the axes of the plate and of the ply."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plydyn_post.errors import ResultsError
from plydyn_post.grid import PLY_TENSOR, TENSOR
from plydyn_post.plies import read_stack
from plydyn_post.results import Results
from plydyn_post.sheets import find


@dataclass(frozen=True)
class PlyStress:
    """Stresses at the heights of the nodes of a ply, from the bottom up.

    A ply of several numerical layers has two rows where they meet.
    """

    ply: int  # from the bottom, from 1
    angle: float  # degrees
    time: float
    z: np.ndarray  # (heights,) at time zero
    stress: dict[str, np.ndarray]  # (heights,) each: sxx to sxz of the plate, s11 to s13 of the ply


def read_ply_stress(
    results: Results, ply: int, x: float, y: float, time: float | None = None
) -> PlyStress:
    """The stress of a ply over a point, at the state nearest to a time or at the last one."""
    stack = read_stack(results, time)
    chosen = {one.number: one for one in stack.plies}.get(ply)
    if chosen is None:
        raise ResultsError(f"{results.fields} has no ply {ply}; it has {len(stack.plies)}")
    found = find(stack.places, np.array([[x, y]]))
    column = int(found.quad[0])
    if column < 0:
        raise ResultsError(f"{results.fields}: the plate has no point at x {x:g}, y {y:g}")
    in_ply = "stress" not in stack.grid.point_data
    name = "stress_ply" if in_ply else "stress"
    if name not in stack.grid.point_data:
        raise ResultsError(f"{results.fields} has no stress; ask for it with *DATABASE_FIELD")
    points = np.asarray(stack.grid.points, dtype=float)[chosen.nodes[column]]
    values = stack.values(chosen, name)[column]
    z = np.einsum("ij,lijk->lk", found.weights[0], points[..., 2]).ravel()
    given = np.einsum("ij,lijkc->lkc", found.weights[0], values).reshape(-1, 6)
    plate = turned(given, -chosen.angle) if in_ply else given
    own = given if in_ply else turned(given, chosen.angle)
    stress = {f"s{name}": plate[:, place] for place, name in enumerate(TENSOR)}
    stress |= {f"s{name}": own[:, place] for place, name in enumerate(PLY_TENSOR)}
    return PlyStress(ply, chosen.angle, stack.time, z, stress)


def turned(stress: np.ndarray, angle: float) -> np.ndarray:
    """Stresses in axes turned about z by an angle in degrees, (n, 6) in the order of VTK."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    xx, yy, zz, xy, yz, xz = stress.T
    return np.column_stack(
        [
            c * c * xx + s * s * yy + 2.0 * c * s * xy,
            s * s * xx + c * c * yy - 2.0 * c * s * xy,
            zz,
            c * s * (yy - xx) + (c * c - s * s) * xy,
            c * yz - s * xz,
            s * yz + c * xz,
        ]
    )
