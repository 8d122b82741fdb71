"""What a study asks of the places of its mesh."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import pi, sqrt

import numpy as np

from plydyn_pre.deck.names import Names
from plydyn_pre.errors import RecipeError, require
from plydyn_pre.mesh.grid import Integers, Mesh, Reals
from plydyn_pre.study import Cohesive, Lever, Load, Motion

#: Contact nodes of an impactor
_MOST_CONTACT_NODES = 1_000_000
# reach of contact nodes from the axis over that of the plate
_TRAVEL = 2.0
# height up to which they are made at the start, distance from the axis of the quads that set their
# spacing, and the largest spacing, over the radius
_FIRST_HEIGHT, _ZONE, _MOST_SPACING = 0.125, 0.5, 0.75
_CORNERS = 4
# lengths of correlation from the origin within which strengths do not repeat themselves
_FARTHEST_SCATTER = 2.0**29
#: Impactors whose nodes are counted here; the solver counts those of the others
_ROUND = ("sphere", "tup")
# share of a quad by which a place may lie beside its straight sides: sides of nine nodes are curved
_BESIDE = 0.05
_FACES = {"all": {"bottom", "inside", "top"}, "plane": {"inside"}}


def check_places(names: Names) -> None:
    """Refuse places off the plate and nodes that are held and moved."""
    for number, profile in enumerate(names.study.outputs.profiles, start=1):
        rule = f"{list(profile.at)} is not on the plate"
        require(_is_on(names.mesh, profile.at), f"outputs.profiles[{number}].at", rule)
    _check_motions(names)
    _check_spacing(names)
    _check_scatter(names)


def _check_scatter(names: Names) -> None:
    """Refuse lengths of correlation so short that the field of strengths repeats itself."""
    farthest = float(np.abs(names.mesh.nodes).max())
    for name, material in names.study.materials.items():
        if isinstance(material, Cohesive) and material.scatters:
            rule = f"{material.scatter_length!r} is too short beside coordinates of {farthest:g}"
            fits = farthest < _FARTHEST_SCATTER * material.scatter_length
            require(fits, f"materials.{name}.scatter_length", rule)


def _check_spacing(names: Names) -> None:
    """Refuse more contact nodes than the solver takes; each has a square of the spacing."""
    impactor, contact = names.study.impactor, names.study.touch
    if impactor is None or contact.method == "points_on_plate":
        return
    if impactor.kind not in _ROUND:
        return
    centre = np.array(impactor.position or names.mesh.middle)
    reach = _TRAVEL * float(np.hypot(*(names.mesh.nodes - centre).T).max())
    cap = impactor.radius - sqrt(max(0.0, impactor.radius**2 - reach**2))
    cap = min(cap, _FIRST_HEIGHT * impactor.radius)
    least = 1.01 * sqrt(2.0 * pi * impactor.radius * cap / _MOST_CONTACT_NODES)
    spacing, origin = contact.spacing, ""
    if spacing <= 0.0:
        spacing, origin = _usual_spacing(names.mesh, centre, impactor.radius), ", that of the mesh,"
    rule = f"{spacing:.3g}{origin} gives too many contact nodes; {least:.3g} or more is needed"
    require(spacing >= least, "contact.spacing", rule)


def _usual_spacing(mesh: Mesh, centre: Reals, radius: float) -> float:
    """Distance of contact nodes where none is given: half that of points below the impactor."""
    away = np.hypot(*(mesh.nodes[mesh.quads[:, -1]] - centre).T)
    corners = mesh.nodes[mesh.quads[away <= max(_ZONE * radius, away.min()), :4]]
    sides = np.hypot(*(np.roll(corners, -1, axis=1) - corners).T)
    points_on_side = 1 if mesh.quads.shape[1] == _CORNERS else 2
    return min(_MOST_SPACING * radius, 0.5 * float(sides.min()) / points_on_side)


def _is_on(mesh: Mesh, place: tuple[float, float]) -> bool:
    """Whether a place lies in some quad, or hardly beside it."""
    corners = mesh.nodes[mesh.quads[:, :4]]
    sides = np.roll(corners, -1, axis=1) - corners
    to_place = np.array(place) - corners
    turns = sides[..., 0] * to_place[..., 1] - sides[..., 1] * to_place[..., 0]
    areas = np.abs(sides[:, :1, 0] * sides[:, 1:2, 1] - sides[:, :1, 1] * sides[:, 1:2, 0])
    return bool(np.any(np.all(turns >= -_BESIDE * areas, axis=1)))


def _check_motions(names: Names) -> None:
    """Refuse nodes that a load moves and something else holds or moves in its direction."""
    known = list(_held(names))
    for number, load in enumerate(names.study.loads, start=1):
        if not isinstance(load, Motion | Lever):
            continue
        path = f"loads[{number}]"
        faces = _FACES.get(load.face, {load.face})
        for key in ("set",) if isinstance(load, Motion) else ("hinge", "fulcrum"):
            nodes = names.nodes_of(getattr(load, key), f"{path}.{key}")
            for where, direction, others, held_faces in known:
                twice = np.intersect1d(nodes, others)
                if len(twice) and direction == load.direction and faces & held_faces:
                    node = names.mesh.node_ids[twice[0]]
                    rule = f"node {node} is held or moved along {direction} by {where} already"
                    raise RecipeError(f"{path}.{key}", rule)
            known.append((path, load.direction, nodes, faces))


def check_kept_levers(names: Names, loads: Iterable[Load]) -> None:
    """Refuse supports and motions of a stage where levers among the first loads stay."""
    led = [*_held(names), *_moved(names)]
    for number, lever in enumerate(loads, start=1):
        if not isinstance(lever, Lever):
            continue
        faces = _FACES.get(lever.face, {lever.face})
        for key in ("hinge", "fulcrum"):
            nodes = names.nodes_of(getattr(lever, key), f"loads[{number}].{key}")
            for path, direction, others, led_faces in led:
                twice = np.intersect1d(nodes, others)
                if len(twice) and direction == lever.direction and faces & led_faces:
                    node, where = names.mesh.node_ids[twice[0]], f"loads[{number}].{key}"
                    rule = f"node {node} is part of a lever along {direction} that stays, {where}"
                    raise RecipeError(f"{path}.set", rule)


def _moved(names: Names) -> Iterator[tuple[str, str, Integers, set[str]]]:
    """What moves which nodes in which direction on which faces, levers aside."""
    for number, load in enumerate(names.study.loads, start=1):
        if isinstance(load, Motion):
            path = f"loads[{number}]"
            nodes = names.nodes_of(load.set, f"{path}.set")
            yield path, load.direction, nodes, _FACES.get(load.face, {load.face})


def _held(names: Names) -> Iterator[tuple[str, str, Integers, set[str]]]:
    """What holds which nodes in which direction on which faces."""
    for number, support in enumerate(names.study.held, start=1):
        path = f"supports[{number}]"
        nodes = names.nodes_of(support.set, f"{path}.set")
        for direction in support.hold:
            yield path, direction, nodes, _FACES.get(support.face, {support.face})
