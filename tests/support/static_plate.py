"""Bent plates at rest by the same elements as the solver's, assembled and solved as one system.

`python tests/support/static_plate.py` prints the table of `tests/verification/bending`: errors of
the deflection at z = 0 and of the stress along x on top, both in the middle of the plate, over
Pagano's.
"""

from __future__ import annotations

import sys

import numpy as np
from scipy.sparse.linalg import spsolve

from decks import Ply
from elasticity import Material, stiffness
from exact_plate import CrossPly, Harmonic
from layered_plate import LayeredPlate
from meshes import consistent_forces, regular

PLY = Material(1.0e-9, (25.0e3, 1.0e3, 1.0e3), (0.25, 0.25, 0.25), (500.0, 500.0, 200.0))
PULL = 0.01  # MPa
#: Quads on a side of the quarter
QUADS = 4
#: a/h, order, sublayers
CASES = [(s, p, n) for s in (4.0, 10.0) for p, n in ((1, 1), (2, 1), (3, 1), (1, 3))]


def pagano(ratio: float) -> CrossPly:
    """Three equal plies, 1 mm thick in all."""
    return CrossPly(ratio, ratio, tuple((PLY, 1.0 / 3.0, angle) for angle in (0.0, 90.0, 0.0)))


def errors(ratio: float, order: int, sublayers: int) -> tuple[float, float]:
    """Errors of deflection and stress in percent."""
    exact, half = pagano(ratio), 0.5 * ratio
    mesh = regular(half, half, QUADS, QUADS, 9)
    layers = [
        Ply(material, thickness / sublayers, angle)
        for material, thickness, angle in exact.plies
        for _ in range(sublayers)
    ]
    plate = LayeredPlate(mesh, layers, order)
    plate.hold(mesh.where(x=0.0), "yz")
    plate.hold(mesh.where(y=0.0), "xz")
    plate.hold(mesh.where(x=half), "x")
    plate.hold(mesh.where(y=half), "y")
    wave = np.pi / ratio
    forces = np.zeros(plate.size)
    pressed = consistent_forces(mesh, lambda x, y: PULL * np.sin(wave * x) * np.sin(wave * y))
    forces[plate.face(1)[1][:, 2]] = pressed
    moved, free = np.zeros(plate.size), plate.free
    moved[free] = spsolve(plate.stiffness[free][:, free].tocsc(), forces[free])
    deflection = _in_the_middle(plate, moved, mesh.at(half, half))
    corner = QUADS**2 - 1
    strain = plate.strain_at(moved, corner, len(layers) - 1, (1.0, 1.0, 1.0))
    stress = float((stiffness(PLY, 0.0) @ strain)[0])
    harmonic = Harmonic(exact)
    bottom = harmonic.bottom_under(PULL)
    middle, top = harmonic.fields(bottom, 1, 0.5), harmonic.fields(bottom, 2, 1.0)
    return (
        100.0 * (deflection / float(middle.displacement[2]) - 1.0),
        100.0 * (stress / float(top.stress[0]) - 1.0),
    )


def _in_the_middle(plate: LayeredPlate, moved: np.ndarray, node: int) -> float:
    """Deflection of a node at half the height: between levels, the mean of a layer's polynomial."""
    first = 3 * plate.levels * node
    column = moved[first + 2 : first + 3 * plate.levels : 3]
    layer = len(plate.plies) // 2
    own = column[layer * plate.order : (layer + 1) * plate.order + 1]
    places = np.linspace(-1.0, 1.0, plate.order + 1)
    return float(np.polyval(np.polyfit(places, own, plate.order), 0.0))


if __name__ == "__main__":
    for case in CASES:
        deflection, stress = errors(*case)
        sys.stdout.write(
            f"    ({case[0]}, {case[1]}, {case[2]}, {deflection:.2f}, {stress:.1f}),\n"
        )
