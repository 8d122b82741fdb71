"""Operations of the kernels, counted in their source: a multiplication or an addition is one."""

from __future__ import annotations

# A line of three nodes: to the Gauss points and derivatives there; a line of two nodes
LINE = {3: 8 + 6, 2: 6 + 1}
# Stress from strain, 13 constants
STRESS = 40
# A damage law at a point far from onset: stress with straight shear that does not grow, how far
# both modes are; what only picks lanes is not counted
DAMAGE = 20 + 21
# Nodes of a layer to the axes of the ply and back, each point of the thickness; axes of a point
TURN, AXES = 2 * 6, 4 * 3


def plate(nodes: int, order: int, kind: str) -> int:
    """Operations of one ply element: 4 or 9 nodes; linear, large, damage linear, damage large."""
    side, levels = {4: 2, 9: 3}[nodes], order + 1
    thickness = 2 * (3 * nodes * levels * (2 * levels - 1)) + 3 * nodes * levels
    plane = 2 * 3 * levels * 2 * side * LINE[side]
    point = {
        "linear": _linear,
        "large": _large,
        "damage linear": _damage_linear,
        "damage large": _damage_large,
    }[kind]
    # derivatives along z: between all points of a line, or from every second mode above
    modes = sum((levels - m + 1) // 2 for m in range(1, levels + 1))
    pairs = modes if kind == "linear" else levels**2
    rise = 2 * nodes * 3 * (2 * pairs + levels)
    turns = nodes * (levels * TURN + AXES) if kind.startswith("damage") else 0
    return thickness + plane + turns + nodes * levels * point() + rise


def _linear() -> int:
    """Strain, stress and flux at a point, linear."""
    strain = 3 + 3 + 7 + 4 + 4
    flux = 6 * 3
    return strain + STRESS + flux


def _large() -> int:
    """Gradient, Green-Lagrange strain, both stresses of Piola-Kirchhoff and flux at a point."""
    gradient = 6 * 3
    strain = 3 * 7 + 3 * 7
    return gradient + strain + STRESS + 9 * 6 + 6 * 3


def _damage_linear() -> int:
    """Strain, the law and flux at a point, in the axes of the ply, linear."""
    strain = 3 + 3 + 7 + 4 + 4
    return strain + DAMAGE + 7 + 6 * 3


def _damage_large() -> int:
    """As `_large`, with the law, in the axes of the ply."""
    gradient = 6 * 3
    strain = 3 * 7 + 3 * 7
    return gradient + strain + DAMAGE + 7 + 9 * 6 + 6 * 3
