"""Keywords of delaminations that are there before the run."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from plydyn_pre.deck.cards import Card, keyword
from plydyn_pre.deck.names import Names
from plydyn_pre.errors import RecipeError, require
from plydyn_pre.mesh import Mesh
from plydyn_pre.mesh.grid import Integers, Reals
from plydyn_pre.mesh.quality import places_in_quads
from plydyn_pre.mesh.region import Circle, in_ring
from plydyn_pre.study import Cohesive, InitialDelamination, Laminate, PlaceSet, runs
from plydyn_pre.study.sets import ALL


def delamination_keywords(names: Names) -> Iterator[str]:
    """A keyword for each delamination, with a card for each range of interfaces."""
    for number, one in enumerate(names.study.initial_delamination, start=1):
        yield _delamination(names, one, f"initial_delamination[{number}]")


def _delamination(names: Names, one: InitialDelamination, path: str) -> str:
    """The keyword of a delamination."""
    part = names.part(one.part, f"{path}.part")
    laminate = names.study.laminate_of(part)
    interfaces = _interfaces(names, one, laminate, path)
    place: Card = {"ssid": _quads(names, one, part, path)}
    damage: Card = {"damage": one.damage} if one.damage < 1.0 else {}
    circle: Card = {}
    if one.circle is not None:
        _check_circle(names, laminate, part, one.circle, f"{path}.circle")
        circle = dict(zip(("x", "y", "r"), map(float, one.circle), strict=True))
    rows = (
        {
            "pid": names.parts[part],
            "ifac1": group[0],
            "ifac2": group[-1],
            **place,
            **damage,
            **circle,
        }
        for group in runs(interfaces)
    )
    return keyword("INITIAL_DAMAGE" if damage else "INITIAL_DELAMINATION", *rows)


def _interfaces(
    names: Names, one: InitialDelamination, laminate: Laminate, path: str
) -> Sequence[int]:
    """The interfaces of a delamination, all of which can fail."""
    path, opened = f"{path}.interfaces", laminate.opened
    fails = bool(opened) and isinstance(names.study.materials.get(laminate.joint), Cohesive)
    rule = (
        f"the interfaces of the laminate are {laminate.interfaces!r}; a cohesive material is needed"
    )
    require(fails, path, rule)
    last = len(laminate.stack) - 1
    for number in one.numbers:
        rule = f"{number} must be from 1, between the two lowest plies, to {last}"
        require(1 <= number <= last, path, rule)
        rule = f"the plies at {number} are tied, for they have one direction; one of {list(opened)}"
        require(number in opened, path, rule)
    return sorted(set(one.numbers)) or opened


def _quads(names: Names, one: InitialDelamination, part: str, path: str) -> int:
    """Number of the set of quads of a delamination, 0 for all of the part."""
    if one.box is not None or one.ring is not None:
        return names.region(PlaceSet(box=one.box, ring=one.ring), part, path)
    number = names.quad_set(one.set, f"{path}.set")
    if one.set != ALL:
        outside = np.setdiff1d(names.quads_of(one.set, ""), names.mesh.parts[part])
        if len(outside):
            quad = names.mesh.quad_ids[outside[0]]
            raise RecipeError(f"{path}.set", f"quad {quad} of the set is not in the part {part!r}")
    return number


def _check_circle(names: Names, laminate: Laminate, part: str, circle: Circle, path: str) -> None:
    """Refuse a circle beside the part, and one that is lost between the points of interfaces."""
    x, y, radius = circle
    bond = names.study.joint_of(laminate)
    points = _points(names.mesh, names.mesh.parts[part], nodal=bond.quadrature == "nodes")
    if not in_ring(points, (x, y, 0.0, radius), 0.0).any():
        nearest = float(np.hypot(*(points - (x, y)).T).min())
        rule = (
            f"no point of the interfaces lies in it; the nearest is {nearest:.3g} from the middle"
        )
        raise RecipeError(path, f"{rule}: a larger circle on the plate, or a zone of finer quads")


def _points(mesh: Mesh, quads: Integers, *, nodal: bool) -> Reals:
    """Places where the interfaces of some quads are looked at, (points, 2)."""
    if nodal:
        return mesh.nodes[mesh.quads[quads].ravel()]
    abscissas, _ = np.polynomial.legendre.leggauss(mesh.order + 1)
    grid = np.stack(np.meshgrid(abscissas, abscissas), axis=-1).reshape(-1, 2)
    return places_in_quads(mesh, quads, grid).reshape(-1, 2)
