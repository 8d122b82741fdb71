"""What a quarter of a disc asks of the rest of a study."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from plydyn_pre.errors import require
from plydyn_pre.mesh import Shape
from plydyn_pre.mesh.quarter import PLANES
from plydyn_pre.study.conditions import FrameAcceleration, Impactor, Load, Pressure, Support
from plydyn_pre.study.laminate import Laminate


def is_quarter(shape: Shape) -> bool:
    """Whether a mesh is a quarter of what the study is of."""
    return getattr(shape, "quarter", False)


def planes() -> tuple[Support, ...]:
    """Supports that keep nodes in the planes of symmetry."""
    return tuple(Support(name, hold=axis) for name, axis in zip(PLANES, "xy", strict=True))


def check_quarter(
    mesh: Shape, laminates: Iterable[Laminate], impactor: Impactor | None, loads: Sequence[Load]
) -> None:
    """Refuse what is not symmetric to both planes."""
    for laminate in laminates:
        angles = {ply.angle % 90.0 for ply in laminate.stack}
        rule = "a quarter needs plies along x and y: 0 and 90 only"
        require(angles <= {0.0}, "laminate.layup", rule)
    if impactor:
        straight = impactor.guided or impactor.velocity[:2] == (0.0, 0.0)
        require(straight, "impactor.velocity", "a quarter is hit along z")
        centre = getattr(mesh, "centre", None)
        midway = impactor.position in (None, centre)
        require(midway, "impactor.position", "a quarter is hit in the middle of the whole")
    for number, load in enumerate(loads, start=1):
        across = isinstance(load, FrameAcceleration) and load.direction == "z"
        rule = "a quarter takes pressures and an acceleration along z"
        require(across or isinstance(load, Pressure), f"loads[{number}]", rule)
