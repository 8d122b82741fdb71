"""What a quarter of a disc asks of the rest of a study."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from plydyn_pre.errors import require
from plydyn_pre.mesh import Shape
from plydyn_pre.mesh.quarter import PLANES
from plydyn_pre.study.conditions import FrameAcceleration, Load, Pressure, Support
from plydyn_pre.study.fixtures import Bar, Clamp, Fixture
from plydyn_pre.study.impactor import Impactor
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
        straight = impactor.guided or impactor.start[:2] == (0.0, 0.0)
        require(straight, "impactor.velocity", "a quarter is hit along z")
        centre = getattr(mesh, "centre", None)
        midway = impactor.position in (None, centre)
        require(midway, "impactor.position", "a quarter is hit in the middle of the whole")
        along_one = impactor.axis is None or impactor.axis.count(0.0) == 2
        require(along_one, "impactor.axis", "a body on a quarter lies along x or y, or stands")
    for number, load in enumerate(loads, start=1):
        across = isinstance(load, FrameAcceleration) and load.direction == "z"
        rule = "a quarter takes pressures and an acceleration along z"
        require(across or isinstance(load, Pressure), f"loads[{number}]", rule)


def check_fixtures(mesh: Shape, fixtures: Sequence[Fixture]) -> None:
    """Refuse fixtures that are not symmetric to both planes, or not on the quarter."""
    middle = getattr(mesh, "centre", (0.0, 0.0))
    for number, fixture in enumerate(fixtures, start=1):
        path = f"fixtures[{number}]"
        if isinstance(fixture, Bar):
            places = [one[i] - middle[i] for one in (fixture.start, fixture.end) for i in (0, 1)]
            require(min(places) >= 0.0, f"{path}.start", "a quarter needs a bar on it")
            continue
        x, y = fixture.centre or middle
        at = (x - middle[0], y - middle[1])
        if isinstance(fixture, Clamp) and at != (0.0, 0.0):
            rule = "a quarter needs clamps in the middle of the whole, or wholly on the quarter"
            require(min(at) >= fixture.outer, f"{path}.centre", rule)
        else:
            rule = "a quarter needs fixtures in the middle of the whole"
            require(at == (0.0, 0.0), f"{path}.centre", rule)


def share_of(mesh: Shape, clamp: Clamp) -> float:
    """The share of a clamp that lies on the quarter."""
    middle = getattr(mesh, "centre", (0.0, 0.0))
    return 0.25 if (clamp.centre or middle) == middle else 1.0
